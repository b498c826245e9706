// SPDX-License-Identifier: Apache-2.0
// Hughes & Murphy 1992, section 4: move-to-station. Sense, update the map by Dempster's rule, take the centroid of what
// is surely empty and little disputed, move towards it, at most 0.5 m at a time; done within 13 cm of it. And what the
// paper sets against it: the vector sum of averaged readings.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "error.hpp"
#include "evigrid/scenes/simulate.hpp"
#include "options.hpp"
#include "paper/agreement.hpp"
#include "paper/paper_world.hpp"
#include "paper/plot.hpp"
#include "paper/robot_map.hpp"
#include "paper/runs.hpp"
#include "picture/map_picture.hpp"
#include "progress.hpp"
#include "score/truth.hpp"

namespace evigrid::driver {
namespace {

constexpr double kDone_m = 0.13, kStep_m = 0.5;            // section 4
constexpr float kSurelyEmpty = 0.8f, kLittleConflict = 1;  // the two tests of section 4
constexpr int kMostMoves = 10;                             // where the paper ends a run that does not settle
constexpr double kStation_m = 0.457, kApart_m = 1.8;       // 1.5 feet, 6 feet
constexpr double kPaperCells = 256 * 256;
constexpr Floors kFloors{.precision = 0.3, .recall = 0.25, .mistaken_rate = 0.15};  // wide arcs, few places

struct Station {
  raycast::Point centre{};
  std::size_t cells = 0;  ///< that pass both tests
};

/// Equation (4) over the cells of both tests.
std::optional<Station> centroid(const Map& map) {
  const CellRect rect = map.bounds();
  const auto n = static_cast<std::size_t>(rect.width * rect.height);
  std::vector<float> empty(n), con(n);
  map.render(Layer::empty, rect, empty, rect.width);
  map.render(Layer::con, rect, con, rect.width);
  double x = 0, y = 0, sum = 0;
  Station out;
  for (std::size_t i = 0; i < n; ++i) {
    if (!(empty[i] > kSurelyEmpty) || con[i] > kLittleConflict) continue;
    const double m = empty[i];
    const auto w = static_cast<std::size_t>(rect.width);
    x += m * (static_cast<double>(rect.x) + static_cast<double>(i % w) + 0.5);
    y += m * (static_cast<double>(rect.y) + static_cast<double>(i / w) + 0.5);
    sum += m;
    ++out.cells;
  }
  if (out.cells == 0) return std::nullopt;
  const double cell_m = map.params().cell_m;
  out.centre = {x / sum * cell_m, y / sum * cell_m};
  return out;
}

struct Run {
  std::vector<scenes::Pose> poses;     ///< where the robot sensed
  std::vector<raycast::Point> aims;    ///< what it then took for the station
  std::size_t least_cells = SIZE_MAX;  ///< that passed both tests, over the run
  bool settled = false;
  [[nodiscard]] int moves() const { return static_cast<int>(poses.size()) - 1; }
  [[nodiscard]] raycast::Point end() const { return {poses.back().x_m, poses.back().y_m}; }
};

double distance(raycast::Point a, raycast::Point b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }
raycast::Point place(const scenes::Pose& p) { return {p.x_m, p.y_m}; }

void move_towards(scenes::LiveRobot& robot, raycast::Point aim) {
  const scenes::Pose at = robot.believed();
  const double heading = std::atan2(aim.y_m - at.y_m, aim.x_m - at.x_m);
  robot.move(std::remainder(heading - at.yaw_rad, 2 * std::numbers::pi), std::min(kStep_m, distance(place(at), aim)));
}

/// The behaviour. `after`: called with the map after each sensing.
template <class After>
Run move_to_station(const PaperWorld& w, const scenes::Pose& start, std::uint64_t seed, int most_moves,
                    const PaperOptions& o, const After& after) {
  scenes::Scene scene = w.scene;
  scene.trajectory.seed = seed;
  scenes::LiveRobot robot(*w.floor, *w.caster, scene, start);
  MapParams params;
  params.cell_m = scene.map.cell_m;
  params.rule = Rule::dempster;
  params.keep_con = true;
  RobotMap mapped(scene, params, make_executor("tbb", o.threads));
  Run run;
  for (int move = 0;; ++move) {
    mapped.fuse(robot.sense(), robot.believed(), move);
    run.poses.push_back(robot.pose());
    const auto station = centroid(mapped.map);
    if (station) {
      run.aims.push_back(station->centre);
      run.least_cells = std::min(run.least_cells, station->cells);
    }
    after(mapped.map, run);
    run.settled = station && distance(place(robot.believed()), station->centre) <= kDone_m;
    if (!station || run.settled || move == most_moves) return run;
    move_towards(robot, station->centre);
  }
}

/// Section 5.2: the vector sum of readings, each averaged over three consecutive ones; no echo counts as the full
/// range.
Run average_to_station(const PaperWorld& w, const scenes::Pose& start, std::uint64_t seed) {
  constexpr int kReadings = 3;
  scenes::Scene scene = w.scene;
  scene.trajectory.seed = seed;
  scenes::LiveRobot robot(*w.floor, *w.caster, scene, start);
  Run run;
  for (int move = 0;; ++move) {
    raycast::Point sum{};
    for (int n = 0; n < kReadings; ++n) {
      const scenes::Sensed s = robot.sense();
      for (std::size_t i = 0; i < s.ranges_m.size(); ++i) {
        const scenes::SonarSpec& sonar = scene.sonars[i];
        const double r = std::clamp<double>(s.ranges_m[i], sonar.min_range_m, sonar.max_range_m);
        const double bearing = robot.believed().yaw_rad + sonar.T_robot_sensor.yaw_rad;
        sum.x_m += r * std::cos(bearing), sum.y_m += r * std::sin(bearing);
      }
    }
    const double share = 1.0 / (kReadings * static_cast<double>(scene.sonars.size()));
    const raycast::Point aim{robot.believed().x_m + share * sum.x_m, robot.believed().y_m + share * sum.y_m};
    run.poses.push_back(robot.pose());
    run.aims.push_back(aim);
    run.settled = distance(place(robot.believed()), aim) <= kDone_m;
    if (run.settled || move == kMostMoves) return run;
    move_towards(robot, aim);
  }
}

/// Starts within a circle of diameter kApart_m around `around`, where the robot has room; any heading.
std::vector<scenes::Pose> starts(const PaperWorld& w, raycast::Point around, std::size_t count, std::uint64_t seed) {
  std::vector<scenes::Pose> out;
  const auto unit = [&](std::uint32_t draw, std::uint64_t n) {
    return static_cast<double>(raycast::random_bits({seed, 0, 0, n}, draw) >> 11) * 0x1p-53;
  };
  for (std::uint64_t n = 0; out.size() < count && n < 100'000; ++n) {
    const double r = kApart_m / 2 * std::sqrt(unit(0, n)), angle = 2 * std::numbers::pi * unit(1, n);
    const scenes::Pose p{around.x_m + r * std::cos(angle), around.y_m + r * std::sin(angle),
                         2 * std::numbers::pi * unit(2, n)};
    if (w.floor->stands(place(p), w.scene.radius_m + 0.02)) out.push_back(p);
  }
  if (out.size() < count)
    throw InputError(fmt::format("no room for a robot around ({:.2f}, {:.2f})", around.x_m, around.y_m));
  return out;
}

/// Centre of the smallest circle around the ends, by Bădoiu & Clarkson's iteration (2003).
raycast::Point enclosing_centre(const std::vector<Run>& runs) {
  raycast::Point c = runs.front().end();
  for (int i = 1; i <= 20000; ++i) {
    const Run* far = &runs.front();
    for (const Run& r : runs)
      if (distance(c, r.end()) > distance(c, far->end())) far = &r;
    c.x_m += (far->end().x_m - c.x_m) / (i + 1), c.y_m += (far->end().y_m - c.y_m) / (i + 1);
  }
  return c;
}

struct Spread {
  raycast::Point centre{};
  double largest_m = 0;
  std::size_t within = 0, settled = 0;
  int most_moves = 0;
};
Spread spread(const std::vector<Run>& runs, raycast::Point centre) {
  Spread s{centre};
  for (const Run& r : runs) {
    const double d = distance(centre, r.end());
    s.largest_m = std::max(s.largest_m, d);
    s.within += d <= kStation_m;
    s.settled += r.settled;
    s.most_moves = std::max(s.most_moves, r.moves());
  }
  return s;
}

Canvas panels(const Map& map, const Run& run, const std::string& title, const std::string& file) {
  std::vector<Pose2> way;
  for (const scenes::Pose& p : run.poses) way.push_back(to_engine(p));
  PictureText text;
  text.title = title;
  return draw_panels(render_layers(map, 512), way, text, {.name = file});
}

std::string metres(double m) { return fmt::format("{:.2f} m", m); }

PlotSeries ends(const char* name, const std::vector<Run>& runs) {
  PlotSeries s{name, {}, false};
  for (const Run& r : runs) s.points.emplace_back(r.end().x_m, r.end().y_m);
  return s;
}

}  // namespace

PaperResult run_hughes1992(const PaperOptions& o) {
  const bool paper_room = o.world.empty();
  const PaperWorld room(paper_scene(o, "hughes1992", "hughes24"));
  const std::uint64_t seed = room.scene.trajectory.seed;
  const std::size_t count = o.quick ? 6 : 20;
  PaperResult out{
      Page("Move to station by Dempster–Shafer theory",
           "K. Hughes, R. Murphy: Ultrasonic robot localization using Dempster-Shafer theory. SPIE 1766, 1992."),
      {}};

  // The expected station: where a first run from inside the room ends, as the authors found it before their
  // experiments.
  const auto nothing = [](const Map&, const Run&) {};
  const raycast::Point first =
      paper_room ? raycast::Point{4.0, 3.6} : place(scenes::drive(room.scene.trajectory).front());
  const Run scout = move_to_station(room, {first.x_m, first.y_m, 0}, seed, kMostMoves, o, nothing);
  const std::vector<scenes::Pose> from = starts(room, scout.end(), count, seed);
  std::vector<Run> runs, averaged;
  std::vector<PaperFile> pictures;
  std::optional<Score> agrees;
  const SceneTruth truth = scene_truth(room.scene, room.scene.map.cell_m);
  Progress progress("moving to station");
  for (std::size_t i = 0; i < count; ++i) {
    runs.push_back(move_to_station(room, from[i], seed + 1 + i, kMostMoves, o, [&](const Map& map, const Run& run) {
      if (i != 0) return;
      if (truth.grid) agrees = score(render_layers(map, 512), *truth.grid);
      const std::string file = fmt::format("run1_move{}.png", run.moves());
      pictures.push_back({file, png(panels(map, run, fmt::format("run 1 after {} moves", run.moves()), file))});
    }));
    averaged.push_back(average_to_station(room, from[i], seed + 1001 + i));
    progress.show(i + 1, count);
  }
  const Spread ours = spread(runs, enclosing_centre(runs)), theirs = spread(averaged, ours.centre);
  std::size_t least_cells = SIZE_MAX;
  for (const Run& r : runs) least_cells = std::min(least_cells, r.least_cells);
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
       ours.most_moves <= 5 && ours.settled == count,
       fmt::format("moves of at most 0.5 m; {} of {} runs settled within 0.13 m of the centroid", ours.settled, count),
       ours.most_moves},
      {"fewest cells that pass both tests", "about 1100, 1.6 % of 256 x 256",
       fmt::format("{}, {:.1f} %", least_cells, 100.0 * static_cast<double>(least_cells) / kPaperCells), Aim::reported,
       false, "m(empty) > 0.8 and Con <= 1, over all sensings; share of 256 x 256 cells", least_cells},
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
    const PaperWorld gym(paper_scene({.seed = o.seed}, "hughes1992_gymnasium", "hughes24"));
    const scenes::Pose door = scenes::drive(gym.scene.trajectory).front();
    std::optional<Canvas> last;
    const int most = o.quick ? 15 : 60;
    const Run drift = move_to_station(gym, door, seed, most, o, [&](const Map& map, const Run& run) {
      if (run.moves() % 5 == 0)
        last = panels(map, run, fmt::format("gymnasium after {} moves", run.moves()), "gymnasium.png");
    });
    const raycast::Point middle{15, 10};
    out.findings.push_back(
        {"gymnasium of 30 x 20 m: where the robot ends", "drifts on to the far wall, not to the centre",
         fmt::format("{} from the door, {} from the centre after {} moves{}",
                     metres(distance(place(door), drift.end())), metres(distance(middle, drift.end())), drift.moves(),
                     drift.settled ? "" : ", still moving"),
         target, drift.moves() > 5 && distance(middle, drift.end()) > kStation_m,
         "the same behaviour from the door, ended after " + std::to_string(most) + " moves", drift.moves()});
    if (last) pictures.push_back({"gymnasium.png", png(*last)});
  }
  Page& page = out.page;
  page.paragraph(
      "A robot with a ring of 24 sonars is put somewhere in a cluttered room of which it knows nothing. It senses, "
      "fuses the readings "
      "into a grid by Dempster's rule, and moves towards the centroid of the cells that are surely empty and little "
      "disputed, until it "
      "stands there. The paper asks how well it comes back to the same place.");
  page.findings(out.findings);
  page.heading("Where the runs end");
  page.raw(svg_plot({"ends of all runs", "x, m", "y, m"}, {ends("belief", runs), ends("averaging", averaged)}, false));
  page.heading("The map as it grows");
  page.paragraph(
      "m(empty), m(occupied), m(unknown), the darker the surer, and the grey composite; the line is the robot's way.");
  page.begin_row();
  for (const PaperFile& p : pictures) page.picture(p.bytes, p.name);
  page.end_row();
  page.heading("What the text leaves open");
  page.list({"The width of the occupied arc: 0.15 m on either side of the reading.",
             "The room: 10 x 10 m with what a tool room holds; sonars throw sound away beyond critical incidences of "
             "65 to 75 degrees; noise "
             "of 1 cm + 0.5 % of the range.",
             "Averaging: three readings a sonar; no echo counts as the full range of 7.62 m.",
             "The paper's example masses (.8113, .8012) do not follow from its formula, which gives .5742 and .5729; "
             "their combination is right. "
             "The formula is used."});
  out.files = std::move(pictures);
  return out;
}

}  // namespace evigrid::driver
