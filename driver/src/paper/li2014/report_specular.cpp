// SPDX-License-Identifier: Apache-2.0
// What the surfaces decide: those that throw sound away at a slant let a sonar hear what lies behind a thing, and the
// thing's place is called empty. The room states its own; here all of it is of one, from echoing to a mirror.
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
    cover_all(scene.world, angle);
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
  out.page.heading("What the surfaces decide");
  const auto beyond = [](const raycast::Material& m) { return m.critical_incidence_rad / kDegree; };
  out.page.paragraph(fmt::format(
      "The paper's field is a real one; what its surfaces were, it does not say. Ours are those of the embedded "
      "furnished room, by what each thing is: plaster around (sound is thrown away beyond {:g} degrees to the normal), "
      "A and B of wood ({:g}), the person in cloth ({:g}). A sonar whose sound is thrown away hears what lies behind, "
      "and the thing's place is called empty, dogmatically (the model leaves nothing unknown before the reading), so "
      "that one such reading outweighs several that hear the thing. DSmT is brought back by the next of those, "
      "Dempster's rule is not. Here everything that stands is of one critical incidence; 90: it echoes at every slant.",
      beyond(room.world.polygons.at(0).material), beyond(room.world.boxes.at(0).material),
      beyond(room.movers.at(0).shape.circles.at(0).material)));
  out.page.table({"critical incidence, degrees", "A: DSmT / Dempster", "B: DSmT / Dempster", "person: DSmT / Dempster"},
                 rows);
}

}  // namespace evigrid::driver
