// SPDX-License-Identifier: Apache-2.0
// Names and sets of a frame of discernment.
#include "evigrid/frame.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace evigrid {
namespace {

constexpr std::size_t kMostHypotheses = 8;

[[noreturn]] void bad(const std::string& why) { throw std::invalid_argument("frame: " + why); }

std::string quoted(std::string_view text) {
  std::string out(1, '\'');
  out.append(text);
  out.push_back('\'');
  return out;
}

std::vector<Subset> singles(std::size_t n) {
  std::vector<Subset> out(n);
  for (std::size_t i = 0; i < n; ++i) out[i] = Subset{1} << i;
  return out;
}

}  // namespace

Frame::Frame(std::vector<std::string> names, std::vector<Subset> sets, unsigned parts)
    : names_(std::move(names)), sets_(std::move(sets)), parts_(parts) {
  if (names_.empty() || names_.size() > kMostHypotheses) {
    bad(std::to_string(names_.size()) + " hypotheses, must be 1 to " + std::to_string(kMostHypotheses));
  }
  for (auto name = names_.begin(); name != names_.end(); ++name) {
    if (name->empty() || *name == "*" || *name == "{}") bad(quoted(*name) + " cannot be the name of a hypothesis");
    if (name->find_first_of("|&") != std::string::npos) bad(quoted(*name) + " has | or & in it");
    if (std::find(names_.begin(), name, *name) != name) bad(quoted(*name) + " is there twice");
  }
}
Frame::Frame(std::vector<std::string> hypotheses) : Frame(std::move(hypotheses), {}, 0) {
  sets_ = singles(names_.size());
  parts_ = static_cast<unsigned>(names_.size());
}
Frame Frame::free_model(std::string first, std::string second) {
  return {{std::move(first), std::move(second)}, {0b101, 0b110}, 3};
}

bool Frame::has(Subset x) const noexcept {
  if (x == 0 || x > everything()) return false;
  return parts_ == names_.size() || x == 0b100 || x == 0b101 || x == 0b110 || x == 0b111;
}

Subset Frame::parse(std::string_view text) const {
  if (text == "*") return everything();
  if (text == "{}") return 0;
  const auto one = [&](std::string_view name) {
    const auto at = std::find(names_.begin(), names_.end(), name);
    if (at == names_.end()) bad("no hypothesis " + quoted(name) + " in " + quoted(text));
    return sets_[static_cast<std::size_t>(at - names_.begin())];
  };
  Subset out = 0;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find('|', from), text.size());
    const std::string_view term = text.substr(from, to - from);
    const std::size_t cut = term.find('&');
    Subset set = one(term.substr(0, cut));
    if (cut != std::string_view::npos) set &= one(term.substr(cut + 1));
    if (set == 0) bad(quoted(term) + " is empty: these hypotheses exclude each other");
    out |= set;
    from = to + 1;
  }
  return out;
}

std::string Frame::text(Subset x) const {
  if (x == 0) return "{}";
  if (x == everything() && names_.size() > 1) return "*";
  std::string out;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if ((sets_[i] & ~x) == 0) out += (out.empty() ? "" : "|") + names_[i];
  }
  return out.empty() ? names_[0] + "&" + names_[1]
                     : out;  // a set without a whole hypothesis: the free model's third part
}

Belief vacuous(const Frame& frame) {
  Belief b{std::vector<double>(frame.subsets())};
  b.m[frame.everything()] = 1;
  return b;
}

Belief make_belief(const Frame& frame, std::initializer_list<std::pair<std::string_view, double>> masses) {
  Belief b{std::vector<double>(frame.subsets())};
  double sum = 0;
  for (const auto& [name, mass] : masses) {
    if (!(mass >= 0)) bad("the mass of " + quoted(name) + " is negative or no number");
    b.m[frame.parse(name)] += mass;
    sum += mass;
  }
  if (sum > 1 + 1e-12) bad("the masses add up to " + std::to_string(sum) + ", more than 1");
  b.m[frame.everything()] += std::max(0.0, 1 - sum);
  return b;
}

}  // namespace evigrid
