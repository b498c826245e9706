// SPDX-License-Identifier: Apache-2.0
// How the arrays of a batch lie in memory: floats, three planes a side; or 16 bits (unorm16), e and o in steps of
// 1/65535, the unknown being the rest. A sum above 1, which two roundings upwards can make, leaves the unknown at 0;
// every rule divides by its own sum.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "kernels/cell/mass.hpp"
#include "kernels/row/kernel_table.hpp"

EVIGRID_CELL_BEGIN

inline constexpr std::size_t kLineBytes = 64;

/// Cells from i to the next border of a cache line.
template <class T>
EVIGRID_FN std::size_t cells_to_border(const T* plane, std::size_t i) {
  const std::size_t past = reinterpret_cast<std::uintptr_t>(plane + i) % kLineBytes;
  return past == 0 ? 0 : (kLineBytes - past) / sizeof(T);
}

struct FloatArrays {
  using Planes = DensePlanes;
  static EVIGRID_FN Cell<Lanes::V> first(const Planes& p, std::size_t i) {
    return {Lanes::load_flat(p.ae + i), Lanes::load_flat(p.ao + i), Lanes::load_flat(p.au + i)};
  }
  static EVIGRID_FN Cell<Lanes::V> second(const Planes& p, std::size_t i) {
    return {Lanes::load_flat(p.be + i), Lanes::load_flat(p.bo + i), Lanes::load_flat(p.bu + i)};
  }
  static EVIGRID_FN void put(const Planes& p, std::size_t i, const Cell<Lanes::V>& m) {
    Lanes::store_flat(p.ce + i, m.a);
    Lanes::store_flat(p.co + i, m.b);
    Lanes::store_flat(p.cu + i, m.u);
  }
  static EVIGRID_FN void put_paradox(const Planes& p, std::size_t i, const Lanes::V& c) {
    if (p.cc != nullptr) Lanes::store_flat(p.cc + i, c);
  }
  static EVIGRID_FN std::size_t cells_to_line(const Planes& p, std::size_t i) { return cells_to_border(p.ce, i); }
  /// Asks for `count` cells of both operands from cell i on.
  static EVIGRID_FN void fetch(const Planes& p, std::size_t i, std::size_t count) {
    for (const float* plane : {p.ae, p.ao, p.au, p.be, p.bo, p.bu}) {
      for (std::size_t j = 0; j < count; j += kLineBytes / sizeof(float)) __builtin_prefetch(plane + i + j);
    }
  }

  struct Pads {
    alignas(64) float in[6][Lanes::kLanes], out[5][Lanes::kLanes] = {};
    Planes copy_of(const Planes& p, std::size_t i, std::size_t count) {
      const float* const from[6] = {p.ae, p.ao, p.au, p.be, p.bo, p.bu};
      for (int f = 0; f < 6; ++f) {
        for (std::size_t c = 0; c < Lanes::kLanes; ++c) in[f][c] = c < count ? from[f][i + c] : f % 3 == 2 ? 1.0f : 0.0f;
      }
      return {in[0], in[1], in[2], in[3], in[4], in[5], out[0], out[1], out[2], out[3], out[4]};
    }
    void copy_back(const Planes& p, std::size_t i, std::size_t count) const {
      float* const to[5] = {p.ce, p.co, p.cu, p.k, p.cc};
      for (int f = 0; f < 5; ++f) {
        if (to[f] != nullptr) std::copy_n(out[f], count, to[f] + i);
      }
    }
  };
};

struct Unorm16Arrays {
  using Planes = Dense16Planes;
  static constexpr float kOne = 65535;
  static EVIGRID_FN Cell<Lanes::V> masses(const std::uint16_t* e, const std::uint16_t* o) {
    const Lanes::V one(kOne), unit(1 / kOne), zero(0.0f);
    const Lanes::V a = Lanes::load_unorm16(e), b = Lanes::load_unorm16(o);
    return {a * unit, b * unit, max_of(one - (a + b), zero) * unit};  // whole numbers: the rest is exact
  }
  static EVIGRID_FN Cell<Lanes::V> first(const Planes& p, std::size_t i) { return masses(p.ae + i, p.ao + i); }
  static EVIGRID_FN Cell<Lanes::V> second(const Planes& p, std::size_t i) { return masses(p.be + i, p.bo + i); }
  static EVIGRID_FN void put(const Planes& p, std::size_t i, const Cell<Lanes::V>& m) {
    const Lanes::V one(kOne);
    Lanes::store_unorm16(p.ce + i, m.a * one);
    Lanes::store_unorm16(p.co + i, m.b * one);
  }
  static EVIGRID_FN void put_paradox(const Planes&, std::size_t, const Lanes::V&) {}
  static EVIGRID_FN std::size_t cells_to_line(const Planes& p, std::size_t i) { return cells_to_border(p.ce, i); }

  struct Pads {
    alignas(64) std::uint16_t in[4][Lanes::kLanes], out[2][Lanes::kLanes] = {};
    alignas(64) float k[Lanes::kLanes] = {};
    Planes copy_of(const Planes& p, std::size_t i, std::size_t count) {
      const std::uint16_t* const from[4] = {p.ae, p.ao, p.be, p.bo};
      for (int f = 0; f < 4; ++f) {
        for (std::size_t c = 0; c < Lanes::kLanes; ++c) in[f][c] = c < count ? from[f][i + c] : std::uint16_t{0};
      }
      return {in[0], in[1], in[2], in[3], out[0], out[1], k};
    }
    void copy_back(const Planes& p, std::size_t i, std::size_t count) const {
      std::copy_n(out[0], count, p.ce + i);
      std::copy_n(out[1], count, p.co + i);
      if (p.k != nullptr) std::copy_n(k, count, p.k + i);
    }
  };
};

EVIGRID_CELL_END
