// SPDX-License-Identifier: Apache-2.0
#include "navigate/distance_transform.hpp"

#include <algorithm>

namespace evigrid::driver {
namespace {

constexpr std::int64_t kFar = -1;  // no marked cell

std::int64_t square(std::int64_t x) { return x * x; }
/// ⌊a / b⌋ for b > 0.
std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

/// Lower envelope of the parabolas f[q] + (x − q)² over one row or column; `out` may not be `f`.
class Envelope {
 public:
  explicit Envelope(int n) : at_(static_cast<std::size_t>(n)), first_(static_cast<std::size_t>(n)) {}
  void run(const std::vector<std::int64_t>& f, std::vector<std::int64_t>& out) {
    const auto n = static_cast<std::int64_t>(f.size());
    std::size_t count = 0;
    for (std::int64_t q = 0; q < n; ++q) {
      if (f[static_cast<std::size_t>(q)] == kFar) continue;
      std::int64_t from = 0;  // first x where q is the lowest
      while (count > 0) {
        const std::int64_t p = at_[count - 1];
        // q is not above p from x on where 2x(q − p) ≥ (f[q] + q²) − (f[p] + p²).
        const std::int64_t lead =
            (f[static_cast<std::size_t>(q)] + square(q)) - (f[static_cast<std::size_t>(p)] + square(p));
        from = -floor_div(-lead, 2 * (q - p));  // rounded up
        if (from > first_[count - 1]) break;
        --count;
        from = 0;
      }
      if (from >= n) continue;
      at_[count] = q;
      first_[count] = count == 0 ? 0 : std::max<std::int64_t>(from, 0);
      ++count;
    }
    if (count == 0) return void(std::fill(out.begin(), out.end(), kFar));
    for (std::size_t k = 0; k < count; ++k) {
      const std::int64_t end = k + 1 < count ? first_[k + 1] : n;
      for (std::int64_t x = first_[k]; x < end; ++x) {
        out[static_cast<std::size_t>(x)] = f[static_cast<std::size_t>(at_[k])] + square(x - at_[k]);
      }
    }
  }

 private:
  std::vector<std::int64_t> at_, first_;  // the parabolas of the envelope, and where each begins
};

}  // namespace

std::vector<std::int64_t> squared_distances(const std::vector<std::uint8_t>& marked, int width, int height) {
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  std::vector<std::int64_t> d(w * h);
  std::vector<std::int64_t> line(h), out(h);
  Envelope columns(height);
  for (std::size_t x = 0; x < w; ++x) {
    for (std::size_t y = 0; y < h; ++y) line[y] = marked[y * w + x] != 0 ? 0 : kFar;
    columns.run(line, out);
    for (std::size_t y = 0; y < h; ++y) d[y * w + x] = out[y];
  }
  line.resize(w), out.resize(w);
  Envelope rows(width);
  for (std::size_t y = 0; y < h; ++y) {
    std::copy_n(d.begin() + static_cast<std::ptrdiff_t>(y * w), w, line.begin());
    rows.run(line, out);
    std::copy(out.begin(), out.end(), d.begin() + static_cast<std::ptrdiff_t>(y * w));
  }
  return d;
}

}  // namespace evigrid::driver
