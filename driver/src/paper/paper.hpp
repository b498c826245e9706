// SPDX-License-Identifier: Apache-2.0
// What `evigrid paper` asks of a paper's run, and gets. One file a paper: a client of the public engine, the caster and
// the scenes; repeatable from its seed.
#pragma once
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "paper/finding.hpp"
#include "paper/page.hpp"

namespace evigrid::driver {

struct PaperOptions {
  std::uint64_t seed = 0;                ///< 0: the scene's own
  bool quick = false;                    ///< shortened, same code: fewer runs, fewer steps
  int threads = 0;                       ///< 0: as many as the machine has; results do not depend on it
  std::string world{};                   ///< a floor plan instead of the paper's room; empty: the paper's
  std::string start{};                   ///< "x,y" or "x,y,yaw_deg" in it; empty: in its widest place
  std::optional<double> resolution_m{};  ///< m per pixel of a plan that does not say
};

struct PaperFile {
  std::string name;  ///< a plain file name
  std::vector<std::byte> bytes;
};

struct PaperResult {
  Page page;
  std::vector<Finding> findings{};
  nlohmann::ordered_json details{};  ///< further numbers for report.json
  std::vector<PaperFile> files{};    ///< pictures and tables beside the page
};

struct Paper {
  std::string_view name, title;
  PaperResult (*run)(const PaperOptions&);
};

/// In order of publication.
[[nodiscard]] std::span<const Paper> papers() noexcept;

}  // namespace evigrid::driver
