// SPDX-License-Identifier: Apache-2.0
#include "compare/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <utility>

#include "bag/bag.hpp"
#include "compare/table.hpp"
#include "error.hpp"
#include "log/readers.hpp"
#include "mapping.hpp"
#include "model_options.hpp"
#include "out/out_dir.hpp"
#include "picture/growing_sheet.hpp"
#include "score/truth.hpp"
#include "simulated.hpp"

namespace evigrid::driver {
namespace {

constexpr int kPanel_px = 420, kFewPanel_px = 640, kMostColumns = 4;  // a sheet of few panels shows them larger

/// One set of readings and, where the world is known, what a perfect map of it would say.
struct Subject {
  std::string robot;
  Log log;
  std::optional<scenes::Scene> scene;
};

bool is_sonar_model(const std::string& model) { return parse_model(model) != Model::beam; }

bool is_scene(const std::string& input) {
  return std::filesystem::path(input).extension() == ".toml" ||
         !scenes::find_embedded(scenes::embedded_scenes(), input).empty();
}

std::vector<Subject> read_subjects(const CompareOptions& o) {
  std::vector<Subject> out;
  if (!o.inputs.empty() && !is_scene(o.inputs.front())) {
    if (!o.robots.empty()) throw InputError("--robots: a recorded log has its own robot");
    if (!o.world.world.empty()) throw InputError("--world: cannot be given beside a log");
    refuse_world_options(o.world);
    if (o.world.seed) throw InputError("--seed: is for scenes and a --world");
    out.push_back({"", read_log(o.inputs, "auto", o.bag), std::nullopt});
    const Log& log = out.back().log;
    require_plane(log, o.inputs.front());
    if (log.poses == Poses::none) {
      throw InputError(fmt::format("{}: format {} has no poses; `evigrid map --scans` maps some of its scans",
                                   o.inputs.front(), log.format));
    }
    return out;
  }
  if (o.inputs.size() > 1) throw InputError("one scene at a time");
  refuse_bag_options(o.bag);
  for (const std::string& robot : o.robots.empty() ? std::vector<std::string>{""} : o.robots) {
    WorldOptions options = o.world;
    if (!o.inputs.empty()) options.scene = o.inputs.front();
    options.robot = robot;
    const SceneInput input = open_input(options);
    out.push_back({robot, simulate(input.scene, {.threads = o.mapping.threads}).log, input.scene});
  }
  return out;
}

std::string name_of(const CompareOptions& o) {
  const std::string path = !o.inputs.empty()        ? o.inputs.front()
                           : !o.world.world.empty() ? o.world.world
                                                    : "default scene";
  return std::filesystem::path(path).filename().string();
}

/// One row to be: which readings, and how they are fused.
struct Job {
  const Subject* subject;
  MappingOptions options;  // as the row's rule and model want them
};

Layers layers_of(const Job& job) {
  return render_layers(fuse(job.subject->log, job.options, make_plan(job.options)).map, job.options.max_image_mb);
}

/// The row; the sheet gets the picture, and the map is gone again.
CompareRow fuse_one(const Job& job, const std::optional<scenes::TruthGrid>& truth, GrowingSheet& sheet) {
  const Log& log = job.subject->log;
  const Plan plan = make_plan(job.options);
  const Fused fused = fuse(log, job.options, plan);
  const Layers layers = render_layers(fused.map, job.options.max_image_mb);
  sheet.add(layers);
  CompareRow r;
  r.robot = job.subject->robot;
  r.rule = job.options.rule;
  r.cell_m = layers.cell_m;
  r.model = fmt::format("{}", fmt::join(fused.models, "+"));
  r.cells_updated = fused.report.cells_updated;
  r.readings_used = fused.report.readings_used;
  r.readings_refused = fused.report.refused_total();
  r.total_conflicts = fused.report.total_conflicts;
  r.fusion_s = fused.fusion_s;
  r.map_hash = fmt::format("{:016x}", fused.map.hash());
  double conflict = 0, unknown = 0, touched = 0;
  const std::size_t n = layers.cells();
  for (std::size_t i = 0; i < n; ++i) {
    unknown += layers.u()[i];
    if (layers.u()[i] == 1) continue;
    conflict += layers.conflict()[i];
    ++touched;
  }
  r.mean_conflict = touched > 0 ? conflict / touched : 0;
  r.ignorance = n > 0 ? unknown / static_cast<double>(n) : 1;
  Log as_mapped = log;  // by the model and the limits that made the map
  for (std::size_t i = 0; i < as_mapped.sensors.size(); ++i) as_mapped.sensors[i].sensor = fused.map.sensors()[i];
  r.rerendered = rerender(layers, as_mapped);
  r.flips = readings_to_flip(plan.params);
  if (truth) r.score = score(layers, *truth);
  return r;
}

/// Forgetting and readings that are no distinct evidence ask for cells that hold masses: why a rule's do not serve, or
/// empty.
std::string why_not_with(const MappingOptions& o, const Log& log) {
  MapParams params{.rule = parse_map_rule(o.rule)};
  if (o.decay_s) params.decay_s = *o.decay_s;
  try {
    Map map(params, make_serial_executor());
    for (const LogSensor& s : log.sensors) map.add(configured(s, o, holds_both_kinds(log)));
  } catch (const std::invalid_argument& bad) {
    return bad.what();
  }
  return {};
}

std::string caption(const CompareRow& r) {
  return r.robot.empty() ? fmt::format("{}, {}", r.rule, r.model) : fmt::format("{}: {}, {}", r.robot, r.rule, r.model);
}

std::vector<std::string> figures(const CompareRow& r) {
  std::vector<std::string> lines;
  if (r.score) {
    const auto line = [](const char* what, const Agreement& a) {
      return fmt::format("{}: precision {:.3f}  recall {:.3f}  mistaken {:.4f}", what, a.precision, a.recall,
                         a.mistaken_rate);
    };
    lines.push_back(line("strict       ", r.score->strict));
    lines.push_back(line("within 1 cell", r.score->near));
  }
  lines.push_back(fmt::format("{} cell updates in {:.1f} ms", r.cells_updated, r.fusion_s * 1e3));
  return lines;
}

/// What fits together, in the order of the table. Throws InputError when nothing does.
std::vector<Job> jobs_of(const std::vector<Subject>& subjects, const CompareOptions& o,
                         const std::vector<std::string>& sonar_models) {
  std::vector<Job> jobs;
  std::string not_together;
  for (const Subject& subject : subjects) {
    MappingOptions options = o.mapping;
    const bool cones = std::any_of(subject.log.sensors.begin(), subject.log.sensors.end(),
                                   [](const LogSensor& s) { return s.sensor.model != Model::beam; });
    if (cones && sonar_models.empty()) throw InputError("--models: names no model for sonars");
    if (subject.scene) use_map_options(*subject.scene, options);
    for (const std::string& rule : o.rules) {
      for (const std::string& model : cones ? sonar_models : std::vector<std::string>{""}) {
        if (!model.empty()) {
          if (const auto why = why_not_together(parse_map_rule(rule), parse_model(model)); !why.empty()) {
            not_together = fmt::format("{} cannot be fused by {}: {}", model, rule, why);
            continue;
          }
        }
        options.rule = rule;
        options.model = model;
        if (const auto why = why_not_with(options, subject.log); !why.empty()) {
          not_together = why;
          continue;
        }
        jobs.push_back({&subject, options});
      }
    }
  }
  if (jobs.empty()) throw InputError(not_together);
  return jobs;
}

}  // namespace

void compare(const CompareOptions& given) {
  const auto start = Clock::now();
  CompareOptions o = given;
  for (const std::string& rule : o.rules) parse_map_rule(rule);
  std::vector<std::string> sonar_models;
  for (const std::string& model : o.models) {
    if (is_sonar_model(model)) sonar_models.push_back(model);
  }
  if (o.rules.empty()) throw InputError("--rules: names no rule");
  std::vector<std::string> models = o.models;
  models.emplace_back(name(Model::beam));
  require_used(parse_settings(o.mapping.params), models);
  o.mapping.params_of_other_models = true;
  OutDir out(o.mapping.out_dir);
  if (!o.mapping.json.empty() && o.mapping.json != "-") require_writable(o.mapping.json);
  const std::vector<Subject> subjects = read_subjects(o);

  if (!o.mapping.cell_m) {  // one for all, the finest that any of them would take: scores and sheet compare cells
    for (const Subject& subject : subjects) {
      if (!subject.scene) continue;
      o.mapping.cell_m = std::min(o.mapping.cell_m.value_or(subject.scene->map.cell_m), subject.scene->map.cell_m);
    }
  }
  const std::vector<Job> jobs = jobs_of(subjects, o, sonar_models);
  SceneTruth truth;
  if (const auto& scene = jobs.front().subject->scene)
    truth = scene_truth(*scene, make_plan(jobs.front().options).params.cell_m);
  // The sheet shows the world; readings that leak far outside of it must not make it small.
  std::optional<CellRect> world;
  if (truth.grid) world = {truth.grid->x, truth.grid->y, truth.grid->width, truth.grid->height};
  const int panel_px = jobs.size() < kMostColumns ? kFewPanel_px : kPanel_px;

  GrowingSheet sheet(panel_px, world);
  std::vector<CompareRow> rows;
  for (const Job& job : jobs) rows.push_back(fuse_one(job, truth.grid, sheet));
  std::vector<Thumbnail> pictures = sheet.finish([&](std::size_t i) { return layers_of(jobs[i]); });
  std::vector<Panel> panels;
  if (world)
    panels.push_back({"truth",
                      {"dark: surfaces  pale: free  grey: out of sight"},
                      thumbnail(*truth.grid, sheet_scale(*world, panel_px))});
  for (std::size_t i = 0; i < rows.size(); ++i)
    panels.push_back({caption(rows[i]), figures(rows[i]), std::move(pictures[i])});
  const std::string title = fmt::format("evigrid compare: {}, cell {:g} m", name_of(o), rows.front().cell_m);
  const int count = static_cast<int>(panels.size());
  const int columns = count <= kMostColumns ? count : count % 3 == 0 ? 3 : kMostColumns;
  out.write("sheet.png", png(draw_sheet(title, panels, columns)), {});
  out.write("compare.csv", to_csv(rows));
  out.write("compare.md", to_markdown(rows));
  nlohmann::ordered_json report{{"input", name_of(o)}, {"rows", to_json(rows)}, {"wall_s", seconds_since(start)}};
  if (!truth.why_not.empty()) report["truth"] = {{"skipped", truth.why_not}};
  const std::string bytes = report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  out.write("report.json", bytes);
  if (!o.mapping.json.empty() && o.mapping.json != "-") out.write_outside(o.mapping.json, bytes);
  out.commit();
  std::cout << (o.mapping.json == "-" ? bytes
                                      : to_markdown(rows) + "Look at " + (out.path() / "sheet.png").string() + "\n");
}

}  // namespace evigrid::driver
