// SPDX-License-Identifier: Apache-2.0
// Li, Huang, Wang & Dezert 2014: a robot as a society of agents. Its maps by DSmT and by Dempster's rule of a room in
// which a person walks, its heading held by the map, its way out of a U-shaped trap; and the paper's tables.
#include "paper/li2014/report.hpp"
#include "paper/runs.hpp"

namespace evigrid::driver {

PaperResult run_li2014(const PaperOptions& o) {
  if (!o.world.empty()) return li2014_in_building(o);
  const auto page = [] {
    return Page("A robot of agents in a dynamic room",
                "P. Li, X. Huang, S. Wang, J. Dezert: SLAM and path planning of mobile robot using DSmT. 2014.");
  };
  PaperResult out{page(), {}};
  add_dynamic_room(out, o, PaperWorld(paper_scene({.seed = o.seed}, "li2014", "pioneer16")));
  add_heading(out, o, PaperWorld(paper_scene({.seed = o.seed}, "li2014_drift", "pioneer16")));
  add_trap(out, o);
  add_tables(out, o);
  add_revision(out, o);
  Page whole = page();
  whole.paragraph(
      "A Pioneer with 16 sonars in a field of 4.84 x 3.10 m, cells of 1 cm, a cycle of 100 ms: perception, "
      "localization, "
      "path planning, behaviour (goto, avoid) and actuator are agents, and a monitor keeps the map by GERM: DSmT's "
      "hybrid "
      "rule, the conflict redistributed by PCR2 in every cycle.");
  whole.findings(out.findings);
  whole.append(out.page);
  whole.heading("What the text leaves open");
  whole.list(
      {"Where A, B, the person's way and the board lie and how large they are, speeds and noise: ours (the scenes).",
       "Readings count in full (reliability 1), as in the paper; the reliability floor is shown beside it.",
       "Dempster's rule gets the same masses without m(empty and occupied), divided by their sum.",
       "Heading: a match is of two occupied cells or of two empty ones (the text says theta_j); eta in steps of 0.25 "
       "degrees; of equal ones the smallest; taken when it has a twentieth more matches "
       "than no turn.",
       "A* plans on the newest map; unknown cells are held for free, obstacles grow by the radius and 5 cm, where "
       "there is "
       "less room by less; a step near them costs more. The cells under the robot are free.",
       "The guard district: the radius and 2 cm on either side of the way that is left; a reading is the point on its "
       "beam's "
       "axis.",
       "Negotiation: the avoid agent wins when the goto agent's wish would within half a second bring the rim nearer "
       "than 1 cm "
       "to an echo, and when there is no way.",
       "The potential field: Khatib's, of the goal and of echoes within 0.35 m of the rim; the same one alone and in "
       "the avoid "
       "agent."});
  out.page = std::move(whole);
  return out;
}

}  // namespace evigrid::driver
