// SPDX-License-Identifier: Apache-2.0
// Li, Huang & Dezert 2006, chapter 14, section 14.5: one drive around a box, mapped by probability theory, by fuzzy
// sets, by Dempster-Shafer theory and by DSmT with PCR5. Table 14.1 orders them by precision and by mistaken rate.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "error.hpp"
#include "evigrid/combine.hpp"
#include "mapping.hpp"
#include "paper/agreement.hpp"
#include "paper/five_readings.hpp"
#include "paper/paper_world.hpp"
#include "paper/plot.hpp"
#include "paper/runs.hpp"
#include "paper/turning_surface.hpp"
#include "picture/look.hpp"
#include "picture/map_picture.hpp"
#include "picture/sheet.hpp"
#include "score/truth.hpp"
#include "simulated.hpp"

namespace evigrid::driver {
namespace {

struct Method {
  const char* name;
  Rule rule;
  Model model;
  Look shown;                                   ///< what the chapter draws
  const char *shown_as, *precision, *mistaken;  ///< Table 14.1
  double time_ms;                               ///< Table 14.1
};
constexpr std::array<Method, 4> kMethods{
    {{"probability", Rule::bayes, Model::probability, Look::betp, "P(occupied)", "very low", "high", 18146},
     {"fuzzy", Rule::fuzzy, Model::fuzzy, Look::fuzzy_map, "M", "very high", "low", 35823},
     {"DST", Rule::dempster, Model::li2006, Look::bel, "bel(occupied)", "high", "medium", 19673},
     {"DSmT + PCR5", Rule::pcr5, Model::li2006, Look::bel, "bel(occupied)", "very high", "very low", 19016}}};
enum : std::size_t { kProbability, kFuzzy, kDst, kDsmt };

constexpr std::array<Floors, 4> kFloors{{{.precision = 0.8, .recall = 0.9, .mistaken_rate = 0.1},
                                         {.precision = 0.8, .recall = 0.9, .mistaken_rate = 0.1},
                                         {.precision = 0.4, .recall = 0.9, .mistaken_rate = 0.4},
                                         {.precision = 0.4, .recall = 0.9, .mistaken_rate = 0.4}}};
constexpr std::array kRhoV{1.0, 3.0, 10.0, 30.0, 100.0};

struct Mapped {
  Layers layers;
  Score score;
  double fusion_s = INFINITY;
};

struct Drive {
  Log log;
  double cell_m = 0;
  scenes::TruthGrid truth;
  CellRect rect{};
};

Log as(const Log& log, Model model, double rho_v) {
  Log out = log;
  for (LogSensor& s : out.sensors) {
    s.sensor.model = model;
    s.sensor.reliability = 1;  // "all the sonar sensors have the same reliability": none is discounted
    s.sensor.li2006.rho_v = rho_v;
  }
  return out;
}

Mapped mapped(const Drive& drive, Rule rule, Model model, double rho_v, int threads) {
  MappingOptions options;
  options.cell_m = drive.cell_m;
  Plan plan{{.cell_m = drive.cell_m, .rule = rule}, parse_executor("tbb", threads)};
  const Fused f = fuse(as(drive.log, model, rho_v), options, std::move(plan));
  Mapped out{render_layers(f.map, drive.rect, "map", options.max_image_mb), {}, f.fusion_s};
  out.score = score(out.layers, drive.truth);
  return out;
}

/// Agreement when a cell counts as occupied where what the chapter draws is above ½; cells never seen are unknown.
Agreement as_drawn(const Mapped& map, Look look, const scenes::TruthGrid& truth) {
  Overlay over = overlay(map.layers, truth);
  const CellRect& r = map.layers.rect;
  for (std::size_t i = 0; i < map.layers.cells(); ++i) {
    const auto x = r.x + static_cast<std::int64_t>(i) % r.width - over.rect.x;
    const auto y = r.y + static_cast<std::int64_t>(i) / r.width - over.rect.y;
    over.map[static_cast<std::size_t>(y * over.rect.width + x)] = never_seen(map.layers, i) ? Decision::unknown
                                                                  : value_of(look, map.layers, i) > 0.5
                                                                      ? Decision::occupied
                                                                      : Decision::empty;
  }
  return score(map.layers, truth, over).strict;
}

bool precision_as_published(const std::array<double, 4>& p) {
  return p[kProbability] < p[kDst] && p[kDst] < std::min(p[kFuzzy], p[kDsmt]);
}
bool mistaken_as_published(const std::array<double, 4>& m) {
  return m[kProbability] > m[kDst] && m[kDst] > m[kFuzzy] && m[kFuzzy] > m[kDsmt];
}

std::string listed(const std::array<double, 4>& v, const char* format) {
  std::string out;
  for (std::size_t i = 0; i < v.size(); ++i)
    out += fmt::format("{}{} {}", i == 0 ? "" : ", ", kMethods[i].name, fmt::format(fmt::runtime(format), v[i]));
  return out;
}

/// What the chapter's figures 14.13 to 14.16 show, beside the true room: grey, black = 1.
Canvas draw_methods(const std::array<Mapped, 4>& maps, const Drive& drive) {
  const SheetScale scale = sheet_scale(drive.rect, 360);
  std::vector<Panel> panels{{"truth", {"dark: surfaces  pale: free"}, thumbnail(drive.truth, scale)}};
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const Layers& l = maps[i].layers;
    panels.push_back({kMethods[i].name,
                      {fmt::format("grey: {}", kMethods[i].shown_as),
                       fmt::format("precision {:.3f}  mistaken {:.3f}", maps[i].score.strict.precision,
                                   maps[i].score.strict.mistaken_rate)},
                      thumbnail_of(scale, [&](std::int64_t x, std::int64_t y) -> std::pair<float, Rgb> {
                        x -= l.rect.x, y -= l.rect.y;
                        if (x < 0 || y < 0 || x >= l.rect.width || y >= l.rect.height) return {-1, kPaper};
                        const double v = value_of(kMethods[i].shown, l, static_cast<std::size_t>(y * l.rect.width + x));
                        return {static_cast<float>(v), colour_of(Ramp::greys, v)};
                      })});
  }
  return draw_sheet("one drive, four methods", panels, 3);
}

/// How many opposite readings turn a cell after 20 agreeing ones, each of mass 0.6 (P = 0.2 and 0.8, which matches by
/// BetP): what a rule makes of a change in the world.
Finding flips() {
  constexpr int kAgreeing = 20, kMost = 1000;
  std::array<int, 4> count{};
  std::string ours;
  for (std::size_t i = 0; i < count.size(); ++i) {
    const bool p = kMethods[i].rule == Rule::bayes;
    const std::array<double, 3> empty = p ? std::array{0.8, 0.2, 0.0} : std::array{0.6, 0.0, 0.4},
                                occupied{empty[1], empty[0], empty[2]};
    std::array<double, 3> cell = p ? std::array{0.5, 0.5, 0.0} : std::array{0.0, 0.0, 1.0};
    const auto add = [&](const std::array<double, 3>& reading) {
      combine(kMethods[i].rule, Planes<const double>{&cell[0], &cell[1], &cell[2]},
              Planes<const double>{&reading[0], &reading[1], &reading[2]}, Planes<double>{&cell[0], &cell[1], &cell[2]},
              nullptr, 1);
    };
    for (int n = 0; n < kAgreeing; ++n) add(empty);
    while (cell[1] <= cell[0] && count[i] < kMost) add(occupied), ++count[i];
    ours += fmt::format("{}{} {}", i == 0 ? "" : ", ", kMethods[i].name,
                        count[i] == kMost ? "never" : std::to_string(count[i]));
  }
  return {"readings to flip a cell after 20 agreeing ones",
          "",
          ours,
          Aim::fact,
          false,
          "readings of m = 0.6 (P = 0.2, 0.8), until m(occupied) is above m(empty); in double, without a map's limits",
          count};
}

Drive make_drive(const PaperOptions& o) {
  const scenes::Scene scene = paper_scene(o, "li2006", "pioneer16");
  SceneTruth truth = scene_truth(scene, scene.map.cell_m);
  if (!truth.grid) throw InputError("the true room: " + truth.why_not);
  Drive d{simulate(scene, {.threads = o.threads}).log, scene.map.cell_m, std::move(*truth.grid)};
  d.rect = {d.truth.x, d.truth.y, d.truth.width, d.truth.height};
  return d;
}

}  // namespace

PaperResult run_li2006(const PaperOptions& o) {
  const Drive drive = make_drive(o);
  const bool paper_room = o.world.empty();
  std::array<Mapped, 4> maps;
  const int rounds = o.quick ? 1 : 10;
  for (int round = 0; round < rounds; ++round) {  // in turns, the fastest of each counts
    for (std::size_t i = 0; i < maps.size(); ++i) {
      Mapped m = mapped(drive, kMethods[i].rule, kMethods[i].model, 1, o.threads);
      m.fusion_s = std::min(m.fusion_s, maps[i].fusion_s);
      maps[i] = std::move(m);
    }
  }
  std::array<double, 4> precision{}, mistaken{}, recall{}, ratio{}, drawn_precision{}, drawn_mistaken{};
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const Agreement& a = maps[i].score.strict;
    precision[i] = a.precision, mistaken[i] = a.mistaken_rate, recall[i] = a.recall;
    ratio[i] = maps[i].fusion_s / maps[kProbability].fusion_s;
    const Agreement drawn = as_drawn(maps[i], kMethods[i].shown, drive.truth);
    drawn_precision[i] = drawn.precision, drawn_mistaken[i] = drawn.mistaken_rate;
  }

  PaperResult out{Page("Four methods on one drive",
                       "X. Li, X. Huang, J. Dezert et al.: chapter 14 of Advances and Applications of DSmT for "
                       "Information Fusion, vol. 2, 2006."),
                  {}};
  const Aim target = paper_room ? Aim::target : Aim::reported;
  const char* how = "cells decided by m(unknown) < 0.5 and the larger of m(occupied), m(empty); Bayes: by P";
  out.findings = {
      {"order of precision", "probability (very low) < DST (high) < fuzzy, DSmT (very high)",
       listed(precision, "{:.3f}"), target, precision_as_published(precision),
       fmt::format("of the cells called occupied: share that is wall; {}", how), precision},
      {"order of the mistaken rate", "probability (high) > DST (medium) > fuzzy (low) > DSmT (very low)",
       listed(mistaken, "{:.3f}"), target, mistaken_as_published(mistaken),
       "of the decided cells: called what they are not", mistaken},
      {"times, as multiples of probability's", "1, fuzzy 1.97, DST 1.08, DSmT 1.05 (18146, 35823, 19673, 19016 ms)",
       listed(ratio, "{:.2f}"), Aim::reported, false,
       fmt::format("fusion of the whole log, the fastest of {} rounds in turns; probability took {:.1f} ms", rounds,
                   1e3 * maps[kProbability].fusion_s),
       ratio, true},
      {"recall", "", listed(recall, "{:.3f}"), Aim::fact, false,
       "of the true walls that border free space: share called occupied", recall},
      {"precision of what the chapter draws", "the same order", listed(drawn_precision, "{:.3f}"), Aim::reported, false,
       "occupied where P, M (eq. 14.18), bel(occupied) is above 0.5; cells never seen left out", drawn_precision},
      {"mistaken rate of what the chapter draws", "the same order", listed(drawn_mistaken, "{:.3f}"), Aim::reported,
       false, "the same", drawn_mistaken},
  };

  // One model for all rules, and sharper ones: how much of the order is the model's and how much the rule's.
  std::vector<std::vector<std::string>> sharper;
  std::array<PlotSeries, 3> by_rule{{{"Bayes by BetP", {}}, {"DST", {}}, {"DSmT + PCR5", {}}}};
  for (const double rho_v : kRhoV) {
    if (o.quick && rho_v != 1 && rho_v != 100) continue;
    std::vector<std::string> row{fmt::format("{:g}", rho_v), fmt::format("{:.2f}", 1 / std::sqrt(6 * rho_v))};
    for (std::size_t r = 0; r < by_rule.size(); ++r) {
      constexpr std::array kRules{Rule::bayes, Rule::dempster, Rule::pcr5};
      const Agreement a = mapped(drive, kRules[r], Model::li2006, rho_v, o.threads).score.strict;
      row.push_back(fmt::format("{:.3f}", a.precision));
      row.push_back(fmt::format("{:.3f}", a.mistaken_rate));
      by_rule[r].points.emplace_back(std::log10(rho_v), a.precision);
    }
    sharper.push_back(std::move(row));
  }
  std::array<double, 3> same_model{};
  for (std::size_t r = 0; r < by_rule.size(); ++r) same_model[r] = by_rule[r].points.front().second;
  out.findings.push_back(
      {"precision with one model for all rules", "",
       fmt::format("Bayes by BetP {:.3f}, DST {:.3f}, DSmT {:.3f}", same_model[0], same_model[1], same_model[2]),
       Aim::fact, false, "model li2006 at rho_v = 1 for all; Bayes' likelihoods match the masses by BetP", same_model});

  out.findings.push_back(flips());
  if (paper_room) {  // the slow second opinion
    const FiveReadings five = fuse_by_fives(as(drive.log, Model::li2006, 1), Rule::pcr5, drive.cell_m, drive.rect);
    const Agreement a = score(five.layers, drive.truth).strict;
    std::size_t few = 0, other = 0;
    const Layers& l = maps[kDsmt].layers;
    for (std::size_t i = 0; i < five.read.size(); ++i) {
      few += five.read[i] > 0 && five.read[i] < 5;
      other +=
          decide(five.layers.e()[i], five.layers.o()[i], five.layers.u()[i]) != decide(l.e()[i], l.o()[i], l.u()[i]);
    }
    out.findings.push_back(
        {"cells fused by fives, as the flowchart says",
         "five readings a cell",
         fmt::format("precision {:.3f}, mistaken rate {:.3f}; {} cells with fewer than five readings, "
                     "{} of {} decide otherwise",
                     a.precision, a.mistaken_rate, few, other, five.read.size()),
         Aim::reported,
         false,
         "cell by cell in double precision, apart from the engine's map; ours fuses each reading when it comes",
         {a.precision, a.mistaken_rate, few, other}});
    for (std::size_t i = 0; i < maps.size(); ++i)
      for (Finding& f : agreement(kMethods[i].name, maps[i].score, kFloors[i])) out.findings.push_back(std::move(f));
  }
  out.files.push_back({"methods.png", png(draw_methods(maps, drive))});
  out.files.push_back({"surface.png", png(draw_surface(maps[kDsmt].layers, {"DSmT + PCR5", "one drive, 16 sonars"}))});

  Page& page = out.page;
  page.paragraph(fmt::format(
      "A robot with 16 sonars drives {}: {} scans. The same log is fused by probability theory (eq. 14.13, Bayes), by "
      "fuzzy sets (eq. 14.15 to 14.17), by Dempster's rule and by DSmT with PCR5, the latter two from the same masses "
      "(eq. 14.6 to 14.10).",
      paper_room ? "once around a box in a room of 5 x 5 m and senses every 100 ms" : "through the plan " + o.world,
      drive.log.scans.size()));
  page.findings(out.findings);
  page.heading("The maps");
  page.picture(out.files[0].bytes, "What the chapter's figures 14.13 to 14.16 show of each method.");
  page.heading("bel(occupied) of DSmT with PCR5");
  page.paragraph("Drag to turn it, wheel to zoom, double click to put it back; arrow keys, + and - do the same.");
  page.raw(turning_surface(maps[kDsmt].layers, "surface"));
  page.picture(out.files[1].bytes, "The same as a picture.");
  page.heading("Model or rule?");
  page.paragraph(
      "With rho_v = 1, as the chapter sets it, m(occupied) of equation (14.7) is a Gaussian of 0.41 m: half a metre "
      "before a wall it still outweighs m(empty), so walls come out thick under every rule, while the arcs of the "
      "other "
      "two models are 0.1 m. That, and not the rule, makes the two methods of masses the least precise here. With one "
      "model for all, the rules lie close together, and PCR5, which never lets one opinion win for good, is a little "
      "below Dempster's rule in a room without false readings. Sharper models move all of them alike.");
  page.raw(svg_plot({"precision against rho_v, one model for all rules", "log10 of rho_v", "precision"},
                    {by_rule.begin(), by_rule.end()}));
  page.table({"rho_v, 1/m2", "Gaussian, m", "Bayes: precision", "mistaken", "DST: precision", "mistaken",
              "DSmT: precision", "mistaken"},
             sharper);
  page.heading("How the maps agree with the room");
  std::vector<ScoredMap> scored;
  for (std::size_t i = 0; i < maps.size(); ++i)
    scored.push_back(
        {kMethods[i].name, maps[i].score, mean_conflict(maps[i].layers), rerender(maps[i].layers, drive.log)});
  const MetricTable metrics = metric_table(scored);
  page.table(metrics.head, metrics.rows);
  page.heading("What the text leaves open");
  page.list(
      {"The box's place and size, the robot's way, the noise (5 mm + 1 % of the range): ours.",
       "Precision and mistaken rate are words in Table 14.1; here they are counted against the true room.",
       "eps = 0.10 m, rho_v of eq. (14.12) = 1.2 m, kE = 0.1, kO = 0.5: ours, within what the literature uses.",
       "In the printed equations all four masses carry lambda, so that normalising would cancel it: they are "
       "normalised first and discounted by lambda then.",
       "m(empty and occupied) of the model: DST drops it and renormalises, as the chapter says; PCR5 gives it back "
       "to empty and occupied in proportion.",
       "The printed f of occupied (fuzzy) is occupied where it should be empty: Oriolo's is used."});
  return out;
}

}  // namespace evigrid::driver
