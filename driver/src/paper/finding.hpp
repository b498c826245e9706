// SPDX-License-Identifier: Apache-2.0
// A published figure beside ours: what report.json and report.html of `evigrid paper` are made of.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace evigrid::driver {

/// target: the published outcome is to be met. reported: shown beside ours, nothing is asked of it. fact: ours alone.
enum class Aim { target, reported, fact };

struct Finding {
  std::string name;       ///< what is counted or measured
  std::string published;  ///< as printed, or what the paper claims; empty: the paper gives none
  std::string ours;
  Aim aim = Aim::reported;
  bool met = false;                ///< of a target
  std::string obtained;            ///< how ours came about, in a sentence
  nlohmann::ordered_json value{};  ///< ours as numbers, for programs
};

[[nodiscard]] inline const char* verdict(const Finding& f) {
  return f.aim == Aim::target ? (f.met ? "met" : "not met") : f.aim == Aim::reported ? "reported" : "";
}

/// For report.json.
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<Finding>& findings);

}  // namespace evigrid::driver
