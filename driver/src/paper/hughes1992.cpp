// SPDX-License-Identifier: Apache-2.0
// Hughes & Murphy 1992, section 5: how well move-to-station comes back to one place, what averaging does instead, and
// what becomes of it in a gymnasium.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "evigrid/scenes/simulate.hpp"
#include "paper/agreement.hpp"
#include "paper/plot.hpp"
#include "paper/points.hpp"
#include "paper/runs.hpp"
#include "paper/station_rooms.hpp"
#include "picture/map_picture.hpp"
#include "score/truth.hpp"

namespace evigrid::driver {
namespace {

constexpr double kPaperCells = 256 * 256;
constexpr const char* kRobot = "hughes24";
constexpr scenes::Pose kOtherEntry{28, 16, 3};
// Wide arcs, and from the middle of a cluttered room most walls are out of sight: recall counts them all.
constexpr Floors kFloors{.precision = 0.3, .recall = 0.05, .mistaken_rate = 0.2};

Canvas panels(const Map& map, const StationRun& run, const std::string& title, const std::string& file) {
  std::vector<Pose2> way;
  for (const scenes::Pose& p : run.poses) way.push_back(to_engine(p));
  PictureText text;
  text.title = title;
  return draw_panels(render_layers(map, 512), way, text, {.name = file});
}

std::string metres(double m) { return fmt::format("{:.2f} m", m); }

PlotSeries ends(const char* name, const std::vector<StationRun>& runs) {
  PlotSeries s{name, {}, false};
  for (const StationRun& r : runs) s.points.emplace_back(r.end().x_m, r.end().y_m);
  return s;
}

std::string share_of_paper(std::size_t cells) {
  return fmt::format("{}, {:.1f} %", cells, 100.0 * static_cast<double>(cells) / kPaperCells);
}

std::vector<std::string> room_row(const std::string& name, const Experiment& e) {
  return {name,
          fmt::format("{} of {}", e.spread.within, e.runs.size()),
          fmt::format("{:.2f}", e.spread.largest_m),
          std::to_string(e.spread.most_moves),
          fmt::format("{} of {}", e.spread.settled, e.runs.size()),
          share_of_paper(e.least_cells),
          as_published(e) ? "yes" : "no"};
}

/// Section 6: from the door into a hall larger than the sonars reach; from another side; and with silent sonars.
void gymnasium(const PaperOptions& o, PaperResult& out, std::vector<PaperFile>& pictures) {
  const PaperWorld gym(paper_scene({.seed = o.seed}, "hughes1992_gymnasium", kRobot));
  const std::uint64_t seed = gym.scene.trajectory.seed;
  const scenes::Pose door = scenes::drive(gym.scene.trajectory).front();
  const raycast::Point middle{15, 10}, high = gym.floor->high();
  std::optional<Canvas> last;
  const StationOptions options{.most_moves = o.quick ? 20 : 60, .threads = o.threads};
  const StationRun drift = move_to_station(gym, door, seed, options, [&](const Map& map, const StationRun& run) {
    if (run.moves() % 5 == 0)
      last = panels(map, run, fmt::format("gymnasium after {} moves", run.moves()), "gymnasium.png");
  });
  const StationRun other = move_to_station(gym, kOtherEntry, seed + 1, options);
  StationOptions silent = options;
  silent.no_echo = NoEcho::nothing;
  const StationRun deaf = move_to_station(gym, door, seed, silent);
  const raycast::Point end = drift.end();
  const double way = distance(place(door), end), off = distance(middle, end), apart = distance(end, other.end());
  const double to_wall = std::min({end.x_m, end.y_m, high.x_m - end.x_m, high.y_m - end.y_m});
  const std::string ended = fmt::format("after {} moves{}", drift.moves(), drift.settled ? "" : ", still moving");
  out.findings.push_back({"gymnasium of 30 x 20 m: drawn from the door into the open, not to the centre",
                          "drifts",
                          fmt::format("{} from the door, {} from the centre {}", metres(way), metres(off), ended),
                          Aim::target,
                          drift.moves() > kPublishedMoves && off > kStation_m,
                          "the same behaviour from the door",
                          {way, off, drift.moves()}});
  out.findings.push_back({"gymnasium: entering from another side", "another place, not repeatable",
                          metres(apart) + " apart", Aim::target, apart > kStation_m,
                          "distance of the two ends, from the door and from (28, 16) m", apart});
  out.findings.push_back({"gymnasium: where it stops", "at another wall", metres(to_wall) + " from the nearest wall",
                          Aim::reported, false, "the run from the door", to_wall});
  out.findings.push_back({"gymnasium, if no echo says nothing", "", fmt::format("{} moves", deaf.moves()), Aim::fact,
                          false, "else a sonar that hears nothing tells that its cone is empty up to 7.62 m",
                          deaf.moves()});
  if (last) pictures.push_back({"gymnasium.png", png(*last)});
}

}  // namespace

PaperResult run_hughes1992(const PaperOptions& o) {
  const bool paper_room = o.world.empty();
  const std::size_t count = o.quick ? 6 : 20;
  const Rooms rooms = paper_room ? drawn_rooms(o, o.quick ? 3 : 20, count) : Rooms{};
  const PaperWorld room =
      paper_room ? drawn_room(o, rooms.nearest + 1) : PaperWorld(paper_scene(o, "hughes1992", kRobot));
  PaperResult out{
      Page("Move to station by Dempster–Shafer theory",
           "K. Hughes, R. Murphy: Ultrasonic robot localization using Dempster-Shafer theory. SPIE 1766, 1992."),
      {}};

  std::vector<PaperFile> pictures;
  std::optional<Score> agrees;
  double conflict = 0;
  const SceneTruth truth = scene_truth(room.scene, room.scene.map.cell_m);
  const StationOptions options{.threads = o.threads};
  const raycast::Point first = place(scenes::drive(room.scene.trajectory).front());
  const Experiment main = experiment(room, first, count, options, [&](const Map& map, const StationRun& run) {
    if (truth.grid) {
      const Layers layers = render_layers(map, 512);
      agrees = score(layers, *truth.grid);
      conflict = mean_conflict(layers);
    }
    const std::string file = fmt::format("run1_move{}.png", run.moves());
    pictures.push_back({file, png(panels(map, run, fmt::format("run 1 after {} moves", run.moves()), file))});
  });
  std::vector<StationRun> averaged;
  for (std::size_t i = 0; i < count; ++i)
    averaged.push_back(average_to_station(room, main.from[i], room.scene.trajectory.seed + 1001 + i));
  const Spread ours = main.spread, theirs = spread(averaged, ours.centre);
  const Aim target = paper_room ? Aim::target : Aim::reported;
  out.findings = {
      {"runs that end within 0.457 m of their common station",
       paper_room ? "20 of 20" : "",
       fmt::format("{} of {}", ours.within, count),
       target,
       ours.within == count,
       "starts up to 1.8 m apart; centre of the smallest circle around all ends",
       {ours.within, count}},
      {"farthest end from the common station", "0.457 m (1.5 ft)", metres(ours.largest_m), target,
       ours.largest_m <= kStation_m, "the same runs", ours.largest_m},
      {"most moves of a run", "5", std::to_string(ours.most_moves), target,
       ours.most_moves <= kPublishedMoves && ours.settled == count,
       fmt::format("moves of at most 0.5 m; {} of {} runs settled within 0.13 m of the centroid", ours.settled, count),
       ours.most_moves},
      {"fewest cells that pass both tests", "about 1100, 1.6 % of 256 x 256", share_of_paper(main.least_cells),
       Aim::reported, false, "m(empty) > 0.8 and Con <= 1, over all sensings; share of 256 x 256 cells",
       main.least_cells},
      {"averaging: farthest end from the station", "up to 1.5 m (5 ft), or not settled after ten moves",
       fmt::format("{}; {} of {} not settled", metres(theirs.largest_m), count - theirs.settled, count), target,
       theirs.largest_m > kStation_m || theirs.settled < count,
       "vector sum of the readings, each the mean of three, from the same starts; ended after ten moves",
       theirs.largest_m},
  };
  if (agrees && paper_room) {
    for (Finding& f : agreement("map of run 1", *agrees, kFloors)) out.findings.push_back(std::move(f));
  }
  if (paper_room) {
    out.findings.push_back({"rooms drawn at random in which all of this holds",
                            "",
                            fmt::format("{} of {}", rooms.sound, rooms.all.size()),
                            Aim::fact,
                            false,
                            fmt::format("{} runs a room: all within 0.457 m, settled, at most five moves", count),
                            {rooms.sound, rooms.all.size()}});
    gymnasium(o, out, pictures);
  }
  Page& page = out.page;
  page.paragraph(
      "A robot with a ring of 24 sonars is put somewhere in a room of which it knows nothing. It senses, "
      "fuses the readings "
      "into a grid by Dempster's rule, and moves towards the centroid of the cells that are surely empty and little "
      "disputed, until it "
      "stands there. The paper asks how well it comes back to the same place.");
  page.findings(out.findings);
  page.heading("Where the runs end");
  page.raw(
      svg_plot({"ends of all runs", "x, m", "y, m"}, {ends("belief", main.runs), ends("averaging", averaged)}, false));
  page.heading("The map as it grows");
  page.paragraph(
      "m(empty), m(occupied), m(unknown), the darker the surer, and the grey composite; the line is the robot's way.");
  for (const PaperFile& p : pictures) page.picture(p.bytes, p.name);  // wide already
  if (paper_room) {
    page.heading("The room, or the behaviour?");
    page.paragraph(
        fmt::format("Of its room the paper gives the size, a doorway, and one number: as few as 1100 cells pass both "
                    "tests. So rooms "
                    "are drawn at random (30 boxes, {:g} m around the middle left free) and the one whose fewest cells "
                    "come nearest "
                    "to that number is taken for the paper's, wherever its runs end. Below: all of them, and the two "
                    "rooms drawn by "
                    "hand before: a cramped one with an open corner, and a roomy one with three times as many cells.",
                    kFree_m));
    std::vector<std::vector<std::string>> rows;
    for (std::size_t k = 0; k < rooms.all.size(); ++k)
      rows.push_back(room_row(fmt::format("drawn {}{}", k + 1, k == rooms.nearest ? " (taken)" : ""), rooms.all[k]));
    for (const char* scene : {"hughes1992_tool_room", "hughes1992"}) {
      const PaperWorld by_hand(paper_scene({.seed = o.seed}, scene, kRobot));
      const raycast::Point middle = place(scenes::drive(by_hand.scene.trajectory).back());
      rows.push_back(room_row(scene, experiment(by_hand, middle, count, options)));
    }
    page.table(
        {"room", "runs within 0.457 m", "farthest end, m", "most moves", "settled", "fewest cells", "as published"},
        rows);
  }
  if (agrees) {
    page.heading("How the map of run 1 agrees with the room");
    const MetricTable metrics = metric_table({{"run 1", *agrees, conflict}});
    page.table(metrics.head, metrics.rows);
  }
  page.heading("What the text leaves open");
  page.list(
      {"The width of the occupied arc: 0.15 m on either side of the reading.",
       paper_room
           ? "What stands in the room of 10 x 10 m, and that it throws sound away beyond critical incidences of 65 "
             "to 75 degrees; noise of 1 cm + 0.5 % of the range."
           : "Where it starts: within 0.9 m of where a first run from the widest place ends.",
       "A sonar that hears nothing: its cone counts as empty up to the full range of 7.62 m, as a transducer that "
       "returns its largest range would have it; without that nothing would draw the robot into the gymnasium.",
       "Averaging: three readings a sonar; no echo counts as the full range of 7.62 m.",
       "The paper's example masses (.8113, .8012) do not follow from its formula, which gives .5742 and .5729; "
       "their combination is right. "
       "The formula is used."});
  out.files = std::move(pictures);
  return out;
}

}  // namespace evigrid::driver
