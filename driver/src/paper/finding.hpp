// SPDX-License-Identifier: Apache-2.0
// A published figure beside ours: what report.json and report.html of `evigrid paper` are made of.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace evigrid::driver {

/// target: the published outcome is to be met. floor: a bound of our own that a sound map holds. reported: shown beside
/// ours, nothing is asked of it. fact: ours alone.
enum class Aim { target, floor, reported, fact };

struct Finding {
  std::string name;       ///< what is counted or measured
  std::string published;  ///< as printed, or what the paper claims; empty: the paper gives none
  std::string ours;
  Aim aim = Aim::reported;
  bool met = false;                ///< of a target or a floor
  std::string obtained;            ///< how ours came about, in a sentence
  nlohmann::ordered_json value{};  ///< ours as numbers, for programs
  bool timed = false;              ///< a time or made of times: another run gives another one
};

[[nodiscard]] inline bool asks(Aim aim) { return aim == Aim::target || aim == Aim::floor; }
[[nodiscard]] inline const char* verdict(const Finding& f) {
  if (f.aim == Aim::target) return f.met ? "met" : "not met";
  if (f.aim == Aim::floor) return f.met ? "holds" : "fails";
  return f.aim == Aim::reported ? "reported" : "";
}

/// For report.json.
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<Finding>& findings);

}  // namespace evigrid::driver
