// SPDX-License-Identifier: Apache-2.0
// Delafosse, Delahoche, Clérentin & Jolly-Desodt 2007: a platform with two omnidirectional cameras maps a crossing of
// corridors by beacons, each with a belief of its existence, corrects its place by them, and fills a TBM grid.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "error.hpp"
#include "paper/agreement.hpp"
#include "paper/delafosse2007/loop.hpp"
#include "paper/plan_picture.hpp"
#include "paper/plan_ways.hpp"
#include "paper/plot.hpp"
#include "paper/runs.hpp"
#include "picture/map_picture.hpp"
#include "progress.hpp"
#include "score/truth.hpp"

namespace evigrid::driver {
namespace {

constexpr Floors kFloors{.precision = 0.1, .recall = 0.05, .mistaken_rate = 0.2};

Canvas draw_beacons(const LoopRun& m, const std::string& title, const std::string& file) {
  return draw_map(m.layers, m.way, {title, "the way is the corrected one"}, {.name = file});
}

Canvas draw_loop(const LoopWorld& world, const LoopRun& run) {
  PlanDrawn way{"the loop, as corrected", {}, kPath}, seen{"landmarks in sight from it", {}, kStart, false},
      beacons{fmt::format("beacons seen again {} times or more", kSeen), {}, kThingColour, false};
  for (const Pose2& p : run.way) way.points.push_back({p.x_m, p.y_m});
  for (std::size_t i = 0; i < world.edges.size(); ++i)
    if (run.in_sight[i]) seen.points.push_back(world.edges[i]);
  for (const Beacon& b : run.beacons)
    if (b.matched >= kSeen) beacons.points.push_back(b.centre);
  return draw_plan(world.room.scene, {"the loop in the building", "the part of the plan around it"},
                   {way, seen, beacons});
}

/// Every variant over the same other seeds.
void add_seeds(PaperResult& out, const PaperOptions& o, std::uint64_t first) {
  struct Sum {
    const char* name;
    LoopVariant variant;
    std::size_t within = 0, sure = 0, nearer = 0;
    double error_m = 0;
  };
  std::array<Sum, 3> sums{
      {{"other seeds: beacons within 0.3 m, error of the place, runs with less than odometry's", {}},
       {"the same with the true heading", {.true_heading = true}},
       {"the same, the centre of gravity around the newest box", {.true_heading = true, .box_centre = true}}}};
  const std::uint64_t seeds = o.quick ? 2 : 20;
  double odometry_m = 0;
  Progress progress("other seeds");
  for (std::uint64_t k = 1; k <= seeds; ++k) {
    PaperOptions other = o;
    other.seed = first + k;
    const LoopWorld world = make_loop_world(other);
    for (Sum& s : sums) {
      const LoopRun run = map_loop(world, Evidence::increment, s.variant);
      const Landmarks marks = judge(run, world);
      s.within += marks.within, s.sure += marks.sure;
      s.error_m += run.error_m.back() / static_cast<double>(seeds);
      s.nearer += run.error_m.back() < run.odometry_error_m.back();
      if (&s == sums.data()) odometry_m += run.odometry_error_m.back() / static_cast<double>(seeds);
    }
    progress.show(k, seeds);
  }
  for (const Sum& s : sums)
    out.findings.push_back({s.name,
                            "",
                            fmt::format("{} of {}; {:.3f} m on average, odometry {:.3f} m; {} of {}", s.within, s.sure,
                                        s.error_m, odometry_m, s.nearer, seeds),
                            Aim::fact,
                            false,
                            fmt::format("{} seeds of bearings, matches and wheels", seeds),
                            {s.within, s.sure, s.error_m, odometry_m, s.nearer, seeds}});
  out.page.heading("Why the beacons are off");
  out.page.paragraph(
      "The method corrects the place and not the heading, which the wheels lose: the same runs with the true heading "
      "have more beacons in their places. And a beacon walks: its centre moves to the centre of gravity of the 25 "
      "cells "
      "around it, while every nearer look empties the cells before the edge and leaves those behind it, which the "
      "first, longest box filled; so it moves away from the platform step by step, though every new box lies at the "
      "edge. Around the newest box it does not, but then the place follows each new look, and is worse. Corrections "
      "are whole cells of 5 cm, as long as the error of wheels that drift as little as these: over other seeds the "
      "place is hardly better than odometry's.");
}

}  // namespace

PaperResult run_delafosse2007(const PaperOptions& o) {
  const LoopWorld world = make_loop_world(o);
  const LoopRun whole = map_loop(world, Evidence::accumulated), ours = map_loop(world, Evidence::increment);
  const SceneTruth truth = scene_truth(world.room.scene, world.room.scene.map.cell_m);
  if (!truth.grid) throw InputError("the true room: " + truth.why_not);
  const Landmarks marks = judge(ours, world), marks_whole = judge(whole, world);
  const Score agrees = score(ours.layers, *truth.grid), agrees_whole = score(whole.layers, *truth.grid);
  PaperResult out{Page("Beacons and a TBM grid",
                       "M. Delafosse, L. Delahoche, A. Clérentin, A.-M. Jolly-Desodt: An incremental mapping method "
                       "based on a Dempster-Shafer fusion architecture. ICINCO 2007."),
                  {}};
  const StereoSpec stereo;
  const bool paper_room = o.world.empty();
  // Of a building the loop sees a part.
  const auto in_sight = paper_room
                            ? world.edges.size()
                            : static_cast<std::size_t>(std::count(ours.in_sight.begin(), ours.in_sight.end(), true));
  const Aim target = paper_room ? Aim::target : Aim::reported;
  out.findings = {
      {"beacons within 0.3 m of a true landmark",
       "landmarks well placed (figure 14)",
       fmt::format("{} of {}; {:.2f} m on average, {:.2f} m at most", marks.within, marks.sure, marks.mean_m,
                   marks.most_m),
       target,
       marks.sure > 0 && marks.within == marks.sure,
       fmt::format("beacons with m(yes) of at least {:g}, seen again {} times or more; to the nearest vertical edge",
                   kSure, kSeen),
       {marks.within, marks.sure, marks.mean_m, marks.most_m}},
      {"error of the place at the end of the loop, lower than odometry's",
       "corrected by the beacons",
       fmt::format("{:.3f} m, odometry {:.3f} m", ours.error_m.back(), ours.odometry_error_m.back()),
       target,
       ours.error_m.back() < ours.odometry_error_m.back(),
       "wheels of 0.02 % drift each way and 2 mm of noise over a metre; the heading is the wheels'; a shortened run "
       "ends "
       "on the way",
       {ours.error_m.back(), ours.odometry_error_m.back()}},
      {"landmarks found",
       "",
       fmt::format("{} of {}", marks.found, in_sight),
       Aim::fact,
       false,
       paper_room ? "true edges with such a beacon within 0.3 m"
                  : "edges in sight at some stop, with such a beacon within 0.3 m",
       {marks.found, in_sight}},
      {"matches, of them with a false primitive",
       "",
       fmt::format("{} of {} primitives, {}", ours.matches, ours.primitives, ours.false_matches),
       Aim::fact,
       false,
       fmt::format("{:.0f} % of the stereo matches take another edge; correlation {:g} to {:g} then, else {:g} to {:g}",
                   100 * stereo.false_share, stereo.false_low, stereo.false_high, stereo.true_low, stereo.true_high),
       {ours.matches, ours.primitives, ours.false_matches}},
      {"refused: bearings that may be parallel, boxes wider than 0.8 m",
       "",
       fmt::format("{}, {}", ours.parallel, ours.too_wide),
       Aim::fact,
       false,
       "interval triangulation",
       {ours.parallel, ours.too_wide}},
      {"with the beacon's whole mass at every match, as printed: beacons within 0.3 m, error of the place",
       "",
       fmt::format("{} of {}; {:.3f} m", marks_whole.within, marks_whole.sure, whole.error_m.back()),
       Aim::fact,
       false,
       "section 3.4 to the letter; ours tells the cells the primitive and its match only, so that no evidence counts "
       "twice",
       {marks_whole.within, marks_whole.sure, whole.error_m.back()}},
  };
  if (paper_room) {
    for (Finding& f : agreement("TBM grid", agrees, kFloors)) out.findings.push_back(std::move(f));
  } else {
    out.findings.push_back({"stops with no vertical edge in sight",
                            "",
                            fmt::format("{} of {}", ours.blind, world.truth.size()),
                            Aim::fact,
                            false,
                            fmt::format("the loop is {:.1f} m long; there the place is what the wheels say",
                                        length_of(world.room.scene.trajectory.waypoints)),
                            {ours.blind, world.truth.size()}});
  }
  out.files = {{"accumulated.png",
                png(draw_beacons(whole, "the beacon's whole mass at every match (the paper)", "accumulated.png"))},
               {"increment.png", png(draw_beacons(ours, "what is new alone", "increment.png"))}};
  if (!paper_room) out.files.push_back({"building.png", png(draw_loop(world, ours))});
  PaperResult seeds{Page("", ""), {}};
  if (paper_room) {
    add_seeds(seeds, o, world.room.scene.trajectory.seed);
    for (Finding& f : seeds.findings) out.findings.push_back(std::move(f));
  }
  Page& page = out.page;
  page.paragraph(fmt::format(
      "A platform with two omnidirectional cameras, 0.5 m apart, drives a closed loop through {} "
      "and stops {} times, every 0.3 m. Vertical edges give bearings; matched pairs are triangulated in interval "
      "arithmetic to boxes, matched with beacons by belief functions, and fused into a grid.",
      paper_room ? "a crossing of corridors" : "the plan " + o.world, world.truth.size()));
  if (!paper_room)
    page.paragraph(
        "This is not the paper's hall: its published figures do not apply here and are not aimed at, the same "
        "behaviour "
        "is shown in another building.");
  page.findings(out.findings);
  page.heading("The grid");
  page.begin_row();
  for (const PaperFile& f : out.files) page.picture(f.bytes, f.name);
  page.end_row();
  PlotSeries a{"corrected", {}}, b{"odometry", {}}, beacons{"beacons", {}, false}, edges{"true edges", {}, false};
  for (std::size_t i = 0; i < ours.error_m.size(); ++i) {
    a.points.emplace_back(static_cast<double>(i), ours.error_m[i]);
    b.points.emplace_back(static_cast<double>(i), ours.odometry_error_m[i]);
  }
  for (const Beacon& k : ours.beacons)
    if (k.matched >= kSeen) beacons.points.emplace_back(k.centre.x_m, k.centre.y_m);
  for (const raycast::Point& e : world.edges) edges.points.emplace_back(e.x_m, e.y_m);
  page.raw(svg_plot({"error of the place", "stop", "m"}, {a, b}));
  page.raw(svg_plot({"beacons and true edges", "x, m", "y, m"}, {edges, beacons}, false));
  page.heading("How the grids agree with the room");
  const MetricTable metrics = metric_table(
      {{"increment", agrees, mean_conflict(ours.layers)}, {"accumulated", agrees_whole, mean_conflict(whole.layers)}});
  page.table(metrics.head, metrics.rows);
  page.append(seeds.page);
  page.heading("What the text leaves open");
  page.list(
      {std::string(paper_room ? "The hall, its edges, the loop"
                              : "The landmarks, corners of the plan that turn by 45 degrees within 0.3 m and lie 0.6 m "
                                "apart; lesser edges are not looked at. The loop: the first 25 m of a tour through all "
                                "that the platform can reach, and the shortest way back") +
           ", bearings of 0.15 degrees with an interval of 0.4 on either side, correlations: "
           "ours. An edge that a surface hides from either camera is not seen; edges count up to 3 m.",
       "The printed y lost the minus of its denominator. Multiplied through by cosines the two equations have no pole "
       "at 90 degrees.",
       fmt::format("Figure 9: m(Q) falls from 0.95 to 0 at {:g} m, m(not Q) rises beyond; beacons farther than twice "
                   "that are left out. A beacon is matched once a stop.",
                   kGate_m),
       "The boxes turn with the platform: the smallest box with the grid's axes around them is fused.",
       "Fusing a beacon's accumulated mass at every match counts its evidence again and again: the paper does, and the "
       "increment is shown beside it.",
       "Cells keep m(empty set) of the open world; pictures and scores divide it out. The heading is not corrected, as "
       "in the ours.",
       "The grid knows edges and the free space up to them; walls between the edges are not seen, so its recall of "
       "walls is low."});
  return out;
}

}  // namespace evigrid::driver
