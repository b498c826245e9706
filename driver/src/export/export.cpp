// SPDX-License-Identifier: Apache-2.0
#include "export/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iostream>
#include <iterator>
#include <utility>

#include "bag/bag.hpp"
#include "error.hpp"
#include "export/octomap_slab.hpp"
#include "export/tables.hpp"

namespace evigrid::driver {
namespace {

namespace fs = std::filesystem;
constexpr std::pair<std::string_view, ExportFormat> kFormats[] = {{"csv", ExportFormat::csv},
                                                                  {"npy", ExportFormat::npy},
                                                                  {"map_server", ExportFormat::map_server},
                                                                  {"octomap", ExportFormat::octomap},
                                                                  {"bag", ExportFormat::bag}};

void write_map_server(const Exported& what, const ExportOptions& o, OutDir& out, const fs::path& file) {
  const PgmMode mode = parse_pgm_mode(o.mode, "--mode");
  const PgmThresholds limits{o.occupied, o.free};
  const Layers layers =
      render_layers(what.map, what.rect, file.string() + " (--region exports a part)", o.max_image_mb);
  const std::string image = fs::path(file.filename()).replace_extension(".pgm").string();
  out.write(image, pgm(layers, mode, limits));
  const bool yml = file.extension() == ".yml";  // as it was asked for
  out.write(fs::path(image).replace_extension(yml ? ".yml" : ".yaml").string(), map_yaml(layers, image, mode, limits));
}

}  // namespace

std::string_view name(ExportFormat format) { return kFormats[static_cast<std::size_t>(format)].first; }

ExportFormat parse_export_format(const std::string& name) {
  std::string known;
  for (const auto& [word, format] : kFormats) {
    if (name == word) return format;
    known += (known.empty() ? "" : ", ") + std::string(word);
  }
  throw InputError(fmt::format("--format: '{}' is unknown; known: {}", name, known));
}

ExportFormat export_format_of(const fs::path& out) {
  std::string extension = out.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (out == "-" || extension == ".csv") return ExportFormat::csv;
  if (extension == ".yaml" || extension == ".yml" || extension == ".pgm") return ExportFormat::map_server;
  if (extension == ".bt") return ExportFormat::octomap;
  if (extension == ".bag") return ExportFormat::bag;
  throw InputError(
      fmt::format("-o: '{}' says no format by its extension; give --format csv, npy (a folder), map_server, "
                  "octomap or bag",
                  out.string()));
}

void require_built(ExportFormat format) {
  if (format == ExportFormat::octomap && !octomap_is_built())
    throw InputError(
        "--format octomap: this evigrid was built without OctoMap; install liboctomap-dev and build again");
  if (format == ExportFormat::bag) require_bags("--format bag");
}

void check_export(const ExportOptions& o) {
  if (!(o.free >= 0 && o.free < o.occupied && o.occupied <= 1)) {
    throw InputError(
        fmt::format("--free, --occupied: {} and {} must be within [0, 1], free below occupied", o.free, o.occupied));
  }
  if (!(o.max_unknown >= 0 && o.max_unknown <= 1))
    throw InputError(fmt::format("--max-unknown: {} is not within [0, 1]", o.max_unknown));
  if (o.max_image_mb <= 0) throw InputError(fmt::format("--max-image-mb: {} is not above 0", o.max_image_mb));
  parse_pgm_mode(o.mode, "--mode");
  if (!(o.z_low_m <= o.z_high_m)) throw InputError("--slab: z0,z1 in metres, with z0 not above z1");
  if (o.frame.empty() || o.topic.empty()) throw InputError("--frame, --topic: must not be empty");
}

void export_map(const Exported& what, ExportFormat format, const ExportOptions& o, const std::string& to) {
  if (what.map.bounds().empty()) throw InputError(what.source + ": no cell was seen there, there is nothing to export");
  const std::vector<ExportPlane> planes =
      o.planes.empty() ? standard_planes(what.map.params()) : parse_planes(o.planes, what.map.params());
  if (format == ExportFormat::csv && to == "-") return write_csv(what, planes, o.metres, std::cout);
  const fs::path file = fs::absolute(to);
  OutDir out(format == ExportFormat::npy ? to : file.parent_path().string());
  const std::string name = file.filename().string();
  switch (format) {
    case ExportFormat::csv:
      out.write_by(name, [&](std::ostream& csv) { write_csv(what, planes, o.metres, csv); });
      break;
    case ExportFormat::npy:
      write_npy(what, planes, o, out);
      break;
    case ExportFormat::map_server:
      write_map_server(what, o, out, file);
      break;
    case ExportFormat::octomap:
      out.write_by(name, [&](std::ostream& bt) { write_octomap(what, o, bt); });
      break;
    case ExportFormat::bag:
      out.write_at(name, [&](const fs::path& path) { write_grid_bag(what, o, path); });
      break;
  }
  out.commit();
}

}  // namespace evigrid::driver
