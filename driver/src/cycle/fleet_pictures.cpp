// SPDX-License-Identifier: Apache-2.0
// The pictures of a fleet's run: times over cycles, times against what was varied, and the costmap with the robots.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "cycle/fleet_report.hpp"
#include "picture/chart.hpp"
#include "picture/furniture.hpp"

namespace evigrid::driver {
namespace {

constexpr Rgb kStageColours[] = {{230, 159, 0}, {0, 158, 115}, {0, 114, 178}, {204, 121, 167}, kInk};  // Okabe & Ito
constexpr int kFleetSide_px = 1024;

std::string summary(const FleetTrial& trial) {
  return fmt::format("{} robots x {} sensors, {} x {} cells of {:g} m, {}, {}, {} {} threads, policy {}",
                     trial.options.robots, trial.sensors, trial.options.grid, trial.options.grid, trial.options.cell_m,
                     name(trial.map.params().rule), fmt::join(trial.models, " + "), trial.map.executor_name(),
                     trial.executor->concurrency(), trial.options.policy);
}

/// What a sweep held fixed.
std::string all_but(const std::string& what, const nlohmann::ordered_json& r) {
  std::string out;
  const auto add = [&](const char* varied, const std::string& text) {
    if (what != varied) out.append(text).append(", ");
  };
  add("robots", fmt::format("{} robots", r["robots"].get<std::int64_t>()));
  add("sensors", fmt::format("{} sensors", r["sensors_per_robot"].get<std::int64_t>()));
  add("grid", fmt::format("{} cells a side", r["grid_cells"].get<std::int64_t>()));
  add("cell", fmt::format("{:g} m", r["cell_m"].get<double>()));
  add("threads", fmt::format("{} threads", r["concurrency"].get<int>()));
  return out + fmt::format("{}, {}, {} cycles each", r["rule"].get<std::string>(), r["kernel"].get<std::string>(),
                           r["cycles"].get<std::int64_t>());
}

/// One byte of a costmap as a colour: unknown grey, free white, lethal dark, between them paler.
Rgb cost_colour(int cost) {
  if (cost == 255) return {158, 158, 158};
  if (cost == 254) return {20, 33, 61};
  const auto grey = static_cast<std::uint8_t>(250 - cost / 2);
  return {grey, grey, grey};
}

/// Of the cells under each pixel, row 0 the smallest y: thin walls stay, unknown (-1) is only where nothing is known.
/// By the tiles that exist: a building has any number of cells.
std::vector<int> worst_costs(const CostTiles& costs, std::int64_t side, std::int64_t step, int px) {
  std::vector<int> worst(static_cast<std::size_t>(px) * static_cast<std::size_t>(px), -1);
  costs.for_each([&](CellIndex at, const std::uint8_t* bytes) {
    for (std::int64_t i = 0; i < CostTiles::kSide * CostTiles::kSide; ++i) {
      const std::int64_t x = at.x + i % CostTiles::kSide, y = at.y + i / CostTiles::kSide;
      if (bytes[i] == 255 || x < 0 || y < 0 || x >= side || y >= side) continue;
      int& pixel = worst[static_cast<std::size_t>(y / step * px + x / step)];
      pixel = std::max(pixel, static_cast<int>(bytes[i]));
    }
  });
  return worst;
}

}  // namespace

Canvas draw_cycles(const FleetTrial& trial) {
  Chart chart{{"evigrid cycle: time of every cycle", summary(trial)},
              "cycle",
              "ms ",
              {},
              trial.options.deadline_ms,
              "deadline"};
  std::size_t i = 0;
  for (const StageRow& stage : stage_rows()) {
    Series s{stage.name, kStageColours[i++], {}, {}};
    for (const CycleRow& row : trial.cycles.rows) {
      s.x.push_back(static_cast<double>(row.cycle));
      s.y.push_back(row.*stage.seconds * 1000);
    }
    chart.series.push_back(std::move(s));
  }
  return draw_chart(chart);
}

Canvas draw_sweep(const std::string& what, const std::vector<SweepPoint>& points, double deadline_ms) {
  struct Line {
    const char *name, *stage, *part;
    Rgb colour;
  };
  constexpr Line kLines[] = {{"p99", "whole", "p99", {230, 159, 0}},
                             {"p50", "whole", "p50", kInk},
                             {"cast", "cast", "p50", {0, 158, 115}},
                             {"fuse", "fuse", "p50", {0, 114, 178}},
                             {"render", "render", "p50", {204, 121, 167}}};
  Chart chart{{"evigrid cycle: time of a cycle against " + what, ""}, what, "ms ", {}, std::nullopt, ""};
  double top = 0;
  for (const Line& line : kLines) {
    Series s{line.name, line.colour, {}, {}, 2, true};
    for (const SweepPoint& p : points) {
      s.x.push_back(p.value);
      s.y.push_back(p.report["stages_ms"][line.stage][line.part].get<double>());
      top = std::max(top, s.y.back());
    }
    chart.series.push_back(std::move(s));
  }
  if (top > 0.4 * deadline_ms) {
    chart.limit = deadline_ms;
    chart.limit_name = "deadline";
  }
  if (!points.empty())
    chart.text.subtitle = "p99 and p50 of the whole, p50 of the stages; " + all_but(what, points.back().report);
  return draw_chart(chart);
}

Canvas draw_fleet(const FleetTrial& trial) {
  const std::int64_t side = trial.options.grid,
                     step = std::max<std::int64_t>(1, (side + kFleetSide_px - 1) / kFleetSide_px);
  const auto px = static_cast<int>((side + step - 1) / step), scale = std::max(1, 640 / px);
  const int shown = px * scale;
  Canvas canvas(std::max(shown + 2 * kMargin_px, 640), shown + kHead_px + kMargin_px + kLine_px, kPaper);
  draw_head(canvas, {"evigrid cycle: the costmap at the end", summary(trial)});
  const std::vector<int> worst = worst_costs(trial.costs, side, step, px);
  for (int y = 0; y < px; ++y) {
    for (int x = 0; x < px; ++x) {
      const int cost = worst[static_cast<std::size_t>(y) * static_cast<std::size_t>(px) + static_cast<std::size_t>(x)];
      canvas.rect(kMargin_px + x * scale, kHead_px + (px - 1 - y) * scale, scale, scale,
                  cost_colour(cost < 0 ? 255 : cost));
    }
  }
  const double px_per_m = static_cast<double>(scale) / (trial.options.cell_m * static_cast<double>(step));
  const std::size_t n = std::min(trial.last_poses.size(), static_cast<std::size_t>(trial.options.robots));
  for (std::size_t i = trial.last_poses.size() - n; i < trial.last_poses.size(); ++i) {
    const Pose2& p = trial.last_poses[i];
    canvas.disc(kMargin_px + p.x_m * px_per_m, kHead_px + shown - p.y_m * px_per_m, 3, {213, 94, 0});
  }
  draw_scale_bar(canvas, canvas.width() - kMargin_px, canvas.height() - kLine_px, px_per_m);
  canvas.disc(kMargin_px + 5, canvas.height() - kLine_px + 7, 4, {213, 94, 0});
  canvas.text(kMargin_px + 16, canvas.height() - kLine_px, "robots", 2, kInk);
  return canvas;
}

}  // namespace evigrid::driver
