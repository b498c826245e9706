// SPDX-License-Identifier: Apache-2.0
// The output folder of a map. Every field of report.json is explained in `evigrid map --help` or by its name's unit.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "error.hpp"
#include "mapping.hpp"
#include "out/costmap.hpp"
#include "out/layers.hpp"
#include "picture/map_picture.hpp"
#include "saved_map.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::ordered_json;

/// Absurd ranges reach the engine as NaN; here they get back the reason that is theirs.
Json refused(const Report& report, std::uint64_t absurd) {
  Json out = Json::object();
  for (int i = 0; i < kRefusalCount; ++i) {
    std::uint64_t n = report.refused[static_cast<std::size_t>(i)];
    const auto reason = static_cast<Refusal>(i);
    if (reason == Refusal::not_a_number) {
      absurd = std::min(absurd, n);
      n -= absurd;
    }
    if (n > 0) out[std::string(name(reason))] = n;
  }
  if (absurd > 0) out["absurd"] = absurd;
  return out;
}

Json make_report(const Log& log, const Fused& f, const MappingOptions& o, const Layers& layers) {
  const auto tiles = f.map.tiles_per_worker();
  const auto worked = std::count_if(tiles.begin(), tiles.end(), [](std::uint64_t n) { return n > 0; });
  Json r;
  r["format"] = log.format;
  r["scans"] = log.scans.size();
  r["rule"] = name(f.map.params().rule);
  r["models"] = f.models;
  if (!f.map.kernel_note().empty()) r["kernel_note"] = f.map.kernel_note();
  r["cell_m"] = f.map.params().cell_m;
  if (f.map.params().decay_s > 0) r["decay_s"] = f.map.params().decay_s;
  r["size_cells"] = {layers.rect.width, layers.rect.height};
  r["origin_cells"] = {layers.rect.x, layers.rect.y};
  r["map_hash"] = fmt::format("{:016x}", f.map.hash());
  r["maths_version"] = kMathsVersion;
  r["cells_updated"] = f.report.cells_updated;
  r["readings_used"] = f.report.readings_used;
  r["readings_refused"] = refused(f.report, log.absurd_ranges);
  r["readings_clipped"] = f.report.readings_clipped;
  r["stamps_backwards"] = f.report.stamps_backwards;
  r["records_skipped"] = log.skipped;
  r["records_malformed"] = log.malformed;
  r["warnings"] = log.warnings;
  r["max_conflict"] = f.report.max_conflict;
  r["total_conflicts"] = f.report.total_conflicts;
  r["kernel"] = f.map.kernel_name();
  r["executor"] = f.map.executor_name();
  r["threads"] = worked;
  r["threads_asked"] = o.threads;
  r["concurrency"] = f.executor->concurrency();
  r["tiles_per_worker"] = std::vector<std::uint64_t>(tiles.begin(), tiles.end());
  r["tiles"] = f.map.tiles();
  r["memory_bytes"] = f.map.memory_bytes();
  if (f.map.paged_bytes() > 0) r["paged_bytes"] = f.map.paged_bytes();
  Json sensors = Json::array();
  const auto declared = f.map.sensors();
  for (std::size_t i = 0; i < declared.size(); ++i) {
    const Sensor& s = declared[i];
    sensors.push_back({{"kind", log.sensors[i].kind},
                       {"model", name(s.model)},
                       {"beams", s.beams},
                       {"max_range_m", s.max_range_m},
                       {"no_return_m", s.no_return_m},
                       {"reliability", s.reliability}});
    if (s.revision) sensors.back()["revision"] = o.revision;
  }
  r["sensors"] = sensors;
  r["masses"] = fmt::format("masses.npy: float32 ({}, height, width): {}; row 0 is the smallest y", layers.count(),
                            plane_names(layers));
  return r;
}

}  // namespace

void write_results(OutDir& out, const Log& log, const Fused& fused, const Layers& layers, const MappingOptions& options,
                   Clock::time_point start, const Json& extra) {
  if (layers.rect.empty()) throw InputError("no reading could be used: all were refused, the map is empty");
  Json report = make_report(log, fused, options, layers);
  std::vector<Pose2> path;
  for (const LogScan& scan : log.scans) {
    if (std::isfinite(scan.T_map_robot.x_m) && std::isfinite(scan.T_map_robot.y_m)) path.push_back(scan.T_map_robot);
  }
  const std::string hash = report["map_hash"];
  const PictureText text{fmt::format("evigrid: {}, {}, cell {:g} m", report["rule"].get<std::string>(),
                                     fmt::join(fused.models, " + "), layers.cell_m),
                         fmt::format("map hash {}, {} scans, {} x {} cells", hash, log.scans.size(), layers.rect.width,
                                     layers.rect.height)};
  const auto picture = [&](const std::string& file, Look look) {
    out.write(file, png(draw(look, layers, path, text, {0, options.max_image_mb, file})), {});
  };
  picture("map.png", Look::mixed);
  for (const Look look : parse_looks("--layers", options.layers)) {
    if (!is_kept(look, layers)) continue;  // "all" draws what is there
    picture(fmt::format("layer_{}.png", row_of(look).name), look);
  }
  const std::string head = npy_head(layers);
  out.write("masses.npy", std::as_bytes(std::span(head)), std::as_bytes(std::span(layers.planes)));
  const PgmMode mode = parse_pgm_mode(options.pgm_mode);
  out.write("map.pgm", pgm(layers, mode));
  out.write("map.yaml", map_yaml(layers, "map.pgm", mode));
  if (options.costmap) {
    out.write("costmap.npy", costmap_npy(fused.map, layers.rect));
    out.write("costmap.pgm", costmap_pgm(fused.map, layers.rect));
    out.write("occupancy.npy", occupancy_npy(fused.map, layers.rect));
  }
  out.write_by(kMapFile, [&](std::ostream& file) { save(fused.map, file); });
  if (!fused.journal.is_null()) report["journal"] = fused.journal;
  for (const auto& [key, value] : extra.items()) report[key] = value;
  report["fusion_s"] = fused.fusion_s;
  report["wall_s"] = seconds_since(start);
  const std::string bytes =
      report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";  // paths may hold any bytes
  out.write("report.json", bytes);
  if (!options.json.empty() && options.json != "-") out.write_outside(options.json, bytes);
  out.commit();
  for (const std::string& warning : log.warnings) {
    if (log.format == "scene")
      std::cerr << "evigrid: warning: " << warning << '\n';  // those of a recording are counted
  }
  if (options.json == "-") {
    std::cout << bytes;
  } else {
    std::cout << fmt::format("{}: {} scans, {} readings used, {} refused, {} cells updated in {:.3f} s, map hash {}\n",
                             out.path().string(), log.scans.size(), fused.report.readings_used,
                             fused.report.refused_total(), fused.report.cells_updated, fused.fusion_s, hash);
  }
}

}  // namespace evigrid::driver
