// SPDX-License-Identifier: Apache-2.0
// Why Dempster's rule shows A and B in our room and not in the paper's: real surfaces throw sound away that meets them
// at a slant, so that a sonar hears what lies behind a thing and calls the thing's place empty.
#include <fmt/format.h>

#include "paper/li2014/dynamic_room.hpp"
#include "paper/li2014/report.hpp"
#include "progress.hpp"

namespace evigrid::driver {

void add_specular(PaperResult& out, const PaperOptions& o, const scenes::Scene& room) {
  const std::vector<double> angles = o.quick ? std::vector<double>{35} : std::vector<double>{90, 60, 45, 35, 25, 15};
  std::vector<std::vector<std::string>> rows;
  nlohmann::ordered_json values = nlohmann::ordered_json::array();
  std::string ours;
  Progress progress("slanting surfaces");
  for (const double angle : angles) {
    scenes::Scene scene = room;
    const raycast::Material material{angle * kDegree, 0};
    for (raycast::Polygon& p : scene.world.polygons) p.material = material;
    for (raycast::Box& b : scene.world.boxes) b.material = material;
    const RoomRun run =
        map_dynamic_room(PaperWorld(std::move(scene)), {{Rule::germ_pcr2, 1}, {Rule::dempster, 1}}, o.quick, o.threads);
    const RoomResult &dsmt = run.results[0], &dst = run.results[1];
    const auto both = [](double a, double b) { return fmt::format("{:.0f} / {:.0f} %", 100 * a, 100 * b); };
    const double person = ratio(dsmt.person_shown, dsmt.person_seen), by_dst = ratio(dst.person_shown, dst.person_seen);
    rows.push_back({fmt::format("{:g}", angle), both(dsmt.object_shown.at(0), dst.object_shown.at(0)),
                    both(dsmt.object_shown.at(1), dst.object_shown.at(1)), both(person, by_dst)});
    ours += fmt::format("{}{:g} degrees: A {}, B {}", ours.empty() ? "" : "; ", angle, rows.back()[1], rows.back()[2]);
    values.push_back({angle, dsmt.object_shown[0], dst.object_shown[0], dsmt.object_shown[1], dst.object_shown[1]});
    progress.show(rows.size(), angles.size());
  }
  out.findings.push_back({"A and B where surfaces throw sound away beyond a critical incidence: DSmT / Dempster", "",
                          ours, Aim::fact, false,
                          "the same drive, walls and things of one critical incidence; share of the outline", values});
  out.page.heading("Why Dempster's rule shows A and B here");
  out.page.paragraph(
      "In the room above every surface echoes at every slant. Real ones throw sound away that meets them beyond a "
      "critical "
      "incidence: the sonar then hears what lies behind, and the thing's place is called empty, dogmatically (the "
      "model "
      "leaves nothing unknown before the reading), so that one such reading outweighs several that hear the thing. "
      "DSmT is "
      "brought back by the next of those, Dempster's rule is not: it loses B wholly, and most of A, and that is what "
      "the "
      "paper shows. What the surfaces of its room were, it does not say.");
  out.page.table({"critical incidence, degrees", "A: DSmT / Dempster", "B: DSmT / Dempster", "person: DSmT / Dempster"},
                 rows);
}

}  // namespace evigrid::driver
