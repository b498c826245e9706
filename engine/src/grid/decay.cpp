// SPDX-License-Identifier: Apache-2.0
#include "grid/decay.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "kernels/row/portable_math.hpp"

namespace evigrid {
namespace {

constexpr int kCells = kernels::kMicroCells;
using kernels::kLeastMass;

/// exp(−Δt/τ), or what there is to remember of it: neighbours mostly heard the same readings.
class Shares {
 public:
  float operator()(const CellAge& age, std::int64_t now_ns) noexcept {
    if (age.tau_s <= 0 || now_ns <= age.stamp_ns) return 1;
    const std::uint64_t elapsed = static_cast<std::uint64_t>(now_ns) - static_cast<std::uint64_t>(age.stamp_ns);
    Known& k = known_[(elapsed * 0x9E3779B97F4A7C15ull) >> 58];
    if (k.elapsed != elapsed || k.tau_s != age.tau_s)
      k = {elapsed, age.tau_s, kernels::portable_share_left(age.stamp_ns, age.tau_s, now_ns)};
    return k.share;
  }

 private:
  struct Known {
    std::uint64_t elapsed = 0;
    float tau_s = 0, share = 1;
  };
  Known known_[64];
};

inline CellAge read_age(const float* p) noexcept {
  const auto low = std::bit_cast<std::uint32_t>(p[0]), high = std::bit_cast<std::uint32_t>(p[kCells]);
  return {static_cast<std::int64_t>(static_cast<std::uint64_t>(high) << 32 | low), p[2 * kCells]};
}

void write_age(float* p, const CellAge& age) noexcept {
  const auto bits = static_cast<std::uint64_t>(age.stamp_ns);
  p[0] = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
  p[kCells] = std::bit_cast<float>(static_cast<std::uint32_t>(bits >> 32));
  p[2 * kCells] = age.tau_s;
}

/// All cells of a micro-tile have the age of the first.
bool one_age(const float* age) noexcept {
  std::uint32_t differ = 0;
  for (int plane = 0; plane < 3; ++plane, age += kCells) {
    const auto first = std::bit_cast<std::uint32_t>(age[0]);
    for (int i = 0; i < kCells; ++i) differ |= std::bit_cast<std::uint32_t>(age[i]) ^ first;
  }
  return differ == 0;
}

/// Keeps share[i] of each cell's masses (kernels/cell/fade.hpp has it for one); what they give up becomes unknown. A
/// cell that keeps all is left as it is, whatever its neighbours do. Loops over plain arrays: vectors.
void fade(const CellLayout& l, const float* __restrict share, float* __restrict micro) noexcept {
  float given_up[kCells] = {}, left[kCells] = {};
  const auto keep = [&](float* __restrict mass) {
    for (int i = 0; i < kCells; ++i) {
      const float kept = mass[i] * share[i], now = share[i] == 1 ? mass[i] : kept < kLeastMass ? 0.0f : kept;
      given_up[i] += mass[i] - now;
      left[i] += now;
      mass[i] = now;
    }
  };
  keep(micro);
  keep(micro + kCells);
  if (l.paradox >= 0) keep(micro + l.paradox * kCells);
  float* __restrict u = micro + 2 * kCells;
  for (int i = 0; i < kCells; ++i) u[i] = share[i] != 1 && left[i] == 0 ? 1.0f : u[i] + given_up[i];
}

void age_micro(const CellLayout& l, std::int64_t now_ns, float* micro, Shares& share_of) noexcept {
  const float* const age = micro + l.age * kCells;
  float share[kCells];
  bool any = false;
  if (one_age(age)) {
    std::fill_n(share, kCells, share_of(read_age(age), now_ns));
    any = share[0] != 1;
  } else {
    for (int i = 0; i < kCells; ++i) {
      share[i] = share_of(read_age(age + i), now_ns);
      any |= share[i] != 1;
    }
  }
  if (any) fade(l, share, micro);
}

int mass_planes(const CellLayout& l) noexcept { return l.paradox >= 0 ? 4 : 3; }

}  // namespace

CellAge age_of(const CellLayout& l, const float* cell) noexcept { return read_age(cell + l.age * kCells); }
void set_age(const CellLayout& l, float* cell, const CellAge& age) noexcept { write_age(cell + l.age * kCells, age); }

void age_masses(const CellLayout& l, int planes, std::int64_t now_ns, float* cells, int micros) noexcept {
  Shares share_of;
  for (int m = 0; m < micros; ++m) age_micro(l, now_ns, cells + m * planes * kCells, share_of);
}

void DecayedUpdate::age(const TileStore& store, std::int64_t now_ns) {
  const CellLayout& l = store.layout();
  const std::size_t bytes = sizeof(float) * static_cast<std::size_t>(mass_planes(l) * kCells);
  before_.resize(micros_.size());
  aged_.resize(micros_.size());
  Shares share_of;
  for (std::size_t m = 0; m < micros_.size(); ++m) {
    std::memcpy(before_[m].mass, micros_[m], bytes);
    age_micro(l, now_ns, micros_[m], share_of);
    std::memcpy(aged_[m].mass, micros_[m], bytes);
  }
}

void DecayedUpdate::settle(const TileStore& store, const CellAge& reading) noexcept {
  const CellLayout& l = store.layout();
  const int floats = mass_planes(l) * kCells;
  for (std::size_t m = 0; m < micros_.size(); ++m) {
    float* __restrict micro = micros_[m];
    const float* __restrict before = before_[m].mass, * __restrict aged = aged_[m].mass;
    std::uint32_t told[kCells] = {};  // 0: not a bit changed
    for (int p = 0; p < floats; p += kCells) {
      for (int i = 0; i < kCells; ++i)
        told[i] |= std::bit_cast<std::uint32_t>(micro[p + i]) ^ std::bit_cast<std::uint32_t>(aged[p + i]);
    }
    for (int p = 0; p < floats; p += kCells) {
      for (int i = 0; i < kCells; ++i) micro[p + i] = told[i] != 0 ? micro[p + i] : before[p + i];
    }
    float* const ages = micro + l.age * kCells;
    for (int i = 0; i < kCells; ++i) {
      if (told[i] == 0) continue;
      const CellAge old = read_age(ages + i);
      const bool first = old.tau_s == 0;
      write_age(ages + i, {first ? reading.stamp_ns : std::max(old.stamp_ns, reading.stamp_ns), reading.tau_s});
    }
  }
  micros_.clear();
}

}  // namespace evigrid
