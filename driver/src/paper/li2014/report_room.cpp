// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "paper/agreement.hpp"
#include "paper/li2014/cycle_findings.hpp"
#include "paper/li2014/dynamic_room.hpp"
#include "paper/li2014/report.hpp"
#include "picture/map_picture.hpp"

namespace evigrid::driver {
namespace {

constexpr double kShown = 0.5;        // of an outline, or of the scans that hear the person
constexpr double kMostlyEmpty = 0.9;  // of the cells that the person left
// Walls of this model begin 22 % before a reading of 1 m, and cells are 1 cm: the map is thick.
constexpr Floors kFloors{.precision = 0.15, .recall = 0.8, .mistaken_rate = 0.45};

std::string share(double s) { return fmt::format("{:.0f} %", 100 * s); }

}  // namespace

void add_dynamic_room(PaperResult& out, const PaperOptions& o, const PaperWorld& world) {
  std::vector<RoomMapping> mappings;
  for (const double reliability : {1.0, 0.98, 0.95, 0.9}) {
    if (o.quick && reliability != 1) continue;
    for (const Rule rule : {Rule::germ_pcr2, Rule::dempster}) mappings.push_back({rule, reliability});
  }
  const RoomRun run = map_dynamic_room(world, mappings, o.quick, o.threads);
  const RoomResult &dsmt = run.results[0], &dst = run.results[1];
  const bool paper_room = o.world.empty();
  // A shortened drive has not seen all of it.
  const Aim target = o.quick || !paper_room ? Aim::reported : Aim::target;
  for (std::size_t b = 0; b < dsmt.object_shown.size(); ++b) {
    const double a = dsmt.object_shown[b], d = dst.object_shown[b];
    const std::string
        thing = b == 0 ? "A" : "B",
        how = "share of its outline with a cell called occupied within 5 cm, at the end; shown: above one half";
    out.findings.push_back({thing + ": DSmT shows it", "shown", share(a), target, a > kShown, how, a});
    out.findings.push_back(
        {thing + ": Dempster estimates that there is nothing", "not shown", share(d), target, d <= kShown, how, d});
  }
  const double cell_cm = 100 * world.scene.map.cell_m;
  const double shown = ratio(dsmt.person_shown, dsmt.person_seen), dst_shown = ratio(dst.person_shown, dst.person_seen);
  const std::string how = fmt::format(
      "of {} scans with an echo of a leg: share with a cell called occupied within 5 cm of it", dsmt.person_seen);
  out.findings.push_back(
      {"the person where it stands: DSmT shows it", "shown", share(shown), target, shown > kShown, how, shown});
  out.findings.push_back({"the person: Dempster estimates that there is nothing", "not shown", share(dst_shown), target,
                          dst_shown <= kShown, how, dst_shown});
  const double empty = ratio(dsmt.left_empty, dsmt.left);
  out.findings.push_back(
      {"places that the person left are empty again, DSmT", "empty", share(empty), target, empty > kMostlyEmpty,
       fmt::format("of {} cells once called occupied for it and 15 cm from it at the end", dsmt.left), empty});
  out.findings.push_back({"the same, Dempster",
                          "",
                          fmt::format("{} of {} cells", dst.left_empty, dst.left),
                          Aim::fact,
                          false,
                          "the same",
                          {dst.left_empty, dst.left}});
  out.findings.push_back(
      {"cells in one cycle", "about 50 thousand groups", std::to_string(dsmt.most_cells), Aim::reported, false,
       fmt::format("pairs of a reading and a cell of {:g} cm, the most of one scan", cell_cm), dsmt.most_cells});
  out.findings.push_back(cycle_kept("the cycle of 100 ms is kept while mapping", dsmt.most_cycle_ms, dsmt.mean_cycle_ms,
                                    paper_room ? Aim::target : Aim::reported));
  if (paper_room)
    for (Finding& f : agreement("DSmT's map", dsmt.score, kFloors)) out.findings.push_back(std::move(f));
  Page& page = out.page;
  page.heading(paper_room ? "The dynamic room" : "A person and two small things in the building");
  page.paragraph(fmt::format(
      "{} scans along the way; the person walks all the while. Below the same with a reliability floor: Shafer's "
      "discount of every reading, which keeps a little unknown in each.",
      run.way.size()));
  std::vector<std::vector<std::string>> rows;
  for (const RoomResult& r : run.results) {
    std::vector<std::string> row{r.mapping.name()};
    for (const double thing : r.object_shown) row.push_back(share(thing));
    row.insert(row.end(), {fmt::format("{} of {}", r.person_shown, r.person_seen),
                           fmt::format("{} / {} of {}", r.left_empty, r.left_occupied, r.left)});
    rows.push_back(std::move(row));
  }
  std::vector<std::string> head{"rule"};
  for (std::size_t b = 0; b < dsmt.object_shown.size(); ++b) head.push_back(b == 0 ? "A shown" : "B shown");
  head.insert(head.end(), {"person shown, scans", "places left: empty / occupied, cells"});
  page.table(head, rows);
  std::vector<ScoredMap> scored;
  for (const RoomResult& r : run.results) scored.push_back({r.mapping.name(), r.score, mean_conflict(r.layers)});
  page.begin_row();
  const auto picture = [&](const Layers& layers, const std::string& title, const std::string& file,
                           const std::vector<Pose2>& way) {
    out.files.push_back(
        {file, png(draw_map(layers, way, {title, fmt::format("cells of {:g} cm", cell_cm)}, {.name = file}))});
    page.picture(out.files.back().bytes, title);
  };
  for (const RoomResult* r : {&dsmt, &dst}) {
    const std::string name = r->mapping.rule == Rule::germ_pcr2 ? "dsmt" : "dempster";
    picture(r->halfway,
            fmt::format("{}: person at ({:.2f}, {:.2f})", r->mapping.name(), run.person_halfway.x_m,
                        run.person_halfway.y_m),
            name + "_person.png", {});
    picture(r->layers, fmt::format("{}: at the end", r->mapping.name()), name + "_end.png", run.way);
  }
  page.end_row();
  const MetricTable metrics = metric_table(scored);
  page.table(metrics.head, metrics.rows);
}

}  // namespace evigrid::driver
