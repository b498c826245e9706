// SPDX-License-Identifier: Apache-2.0
// Is there time for another slice of scans in this cycle? Judged by measured time: the slowest of the last slices, and
// the rendering that fused scans entail, as the worst of the last cycles had it. The first slice of a cycle is always
// fused, or a cast that takes the whole cycle would stop the map for ever.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

namespace evigrid::driver {

class Budget {
 public:
  explicit Budget(double deadline_s) : limit_s_(kPart * deadline_s) {}

  void begin_cycle() {
    fused_s_ = 0;
    slices_ = 0;
  }
  [[nodiscard]] bool has_time(double elapsed_s) const {
    if (slices_ == 0) return true;
    const double slice_s = slice_costs_.most();
    return elapsed_s + slice_s + render_ratio_.most() * (fused_s_ + slice_s) <= limit_s_;
  }
  /// About how many scans the rest of the cycle has time for, at the mean cost of the last slices; `most` when no slice
  /// was measured yet.
  [[nodiscard]] std::size_t scans_in_time(double elapsed_s, std::size_t most) const {
    const double scan_s = scan_costs_.mean() * (1 + render_ratio_.most());
    const double scans = scan_s > 0 ? std::max(limit_s_ - elapsed_s, 0.0) / scan_s : static_cast<double>(most);
    return scans < static_cast<double>(most) ? static_cast<std::size_t>(scans) : most;
  }
  void fused(double took_s, std::size_t scans) {
    ++slices_;
    fused_s_ += took_s;
    slice_costs_.add(took_s);
    scan_costs_.add(took_s / static_cast<double>(scans));
  }
  void rendered(double took_s) {
    if (fused_s_ > 0) render_ratio_.add(took_s / fused_s_);
  }

 private:
  static constexpr double kPart = 0.95;  // of the deadline: the rest is for what no past cycle foretells

  template <std::size_t N>
  class Recent {
   public:
    void add(double v) { values_[count_++ % N] = v; }
    [[nodiscard]] double most() const { return *std::max_element(values_.begin(), values_.end()); }
    [[nodiscard]] double mean() const {
      double sum = 0;
      for (const double v : values_) sum += v;
      return count_ == 0 ? 0 : sum / static_cast<double>(std::min(count_, N));
    }

   private:
    std::array<double, N> values_{};
    std::size_t count_ = 0;
  };

  double limit_s_, fused_s_ = 0;
  std::size_t slices_ = 0;
  Recent<16> slice_costs_, scan_costs_;
  Recent<8> render_ratio_;
};

}  // namespace evigrid::driver
