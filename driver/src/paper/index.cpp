// SPDX-License-Identifier: Apache-2.0
#include "paper/index.hpp"

#include <fmt/format.h>

#include "evigrid/version.hpp"

namespace evigrid::driver {

Tally tally(const std::vector<Finding>& findings) {
  Tally t;
  for (const Finding& f : findings) {
    if (f.aim == Aim::target) {
      ++(f.met ? t.met : t.missed);
    } else if (f.aim == Aim::floor) {
      ++t.floors;
      t.below += !f.met;
    } else {
      ++t.others;
    }
  }
  return t;
}

std::string index_page(const std::vector<PaperRun>& runs) {
  Page page("Papers, run again", "evigrid paper all: the behaviours of each paper, its published figures beside ours.");
  std::vector<std::vector<std::string>> rows;
  std::vector<std::pair<std::string, std::string>> links;
  std::vector<std::string> misses;
  for (const PaperRun& run : runs) {
    const Tally t = tally(run.findings);
    rows.push_back({std::string(run.paper->name), std::string(run.paper->title),
                    fmt::format("{} of {}", t.met, t.met + t.missed),
                    fmt::format("{} of {}", t.floors - t.below, t.floors), std::to_string(t.others),
                    fmt::format("{:.1f}", run.wall_s)});
    links.emplace_back(fmt::format("{}/report.html", run.paper->name),
                       fmt::format("{}: {}", run.paper->name, run.paper->title));
    for (const Finding& f : run.findings) {
      if (asks(f.aim) && !f.met)
        misses.push_back(fmt::format("{}: {}: {}, ours {}", run.paper->name, f.name, f.published, f.ours));
    }
  }
  page.table({"paper", "title", "published outcomes met", "floors of our own held", "further figures", "run, s"}, rows);
  page.links(links);
  if (!misses.empty()) {
    page.heading("What does not come out");
    page.list(misses);
  }
  return page.html();
}

nlohmann::ordered_json index_json(const std::vector<PaperRun>& runs) {
  nlohmann::ordered_json out{{"version", EVIGRID_VERSION}, {"papers", nlohmann::ordered_json::array()}};
  for (const PaperRun& run : runs) {
    const Tally t = tally(run.findings);
    out["papers"].push_back({{"paper", run.paper->name},
                             {"report", fmt::format("{}/report.json", run.paper->name)},
                             {"outcomes_met", t.met},
                             {"outcomes_missed", t.missed},
                             {"floors", t.floors},
                             {"floors_failed", t.below},
                             {"wall_s", run.wall_s}});
  }
  return out;
}

}  // namespace evigrid::driver
