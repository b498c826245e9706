// SPDX-License-Identifier: Apache-2.0
// A reading as the kernels see it: compiled once in double on the lattice of docs/maths.md, then plain floats. Lengths
// in cells, offsets from the quantised apex.
#pragma once
#include <cstdint>

namespace evigrid::kernels {

/// T² of a ring as two floats: exact.
struct Ring {
  float hi = 0, lo = 0;
};
inline constexpr int kOuter = 0, kInner = 1, kEdge = 2;

/// Models of a cone, in the order of the tables' columns.
enum ConeModel : int {
  kHughes1992,
  kLi2014,
  kOriolo1997,
  kLi2006,
  kProbability,
  kFuzzyModel,
  kMoravec1985,
  kConeModels
};

struct LiConstants {
  float lambda[4], shell[4];
  float empty_rate, empty_rate_rest, occupied_rate, occupied_rate_rest, peak_inverse, peak_offset, paradox_scale;
  float range, range_twice, range_twice_inverse, shell_slope, shell_offset;
};
struct HughesConstants {
  float margin[4];
  float slope, max_occupied;
};

/// oriolo1997, fuzzy and probability (tanh_cone.hpp).
struct TanhConstants {
  float lambda[4];
  float gamma, gamma_slope;                // γ = gamma + gamma_slope·λ
  float range, reach, gap, width_inverse;  // R, L, R + Δ − L, 1/Δ
  float decay, decay_offset;               // log2 of (1 − ρ)/ρ = decay·d + decay_offset
  float k_empty, k_occupied;
  bool as_printed;
};
struct Li2006Constants {
  float lambda[4], off_axis[4];
  float rest;  // 0; 1, with no λ: as printed
  float range, range_twice, range_inverse_square, occupied_rate, occupied_rate_rest, both_slope, both_offset,
      unknown_rate;
};
struct MoravecConstants {
  float lambda[4];
  float border, border_shift, reach;  // R − ε (at least 0), what was added for that, R + ε
  float depth_inverse, occupied;      // 1/(R − ε − Rmin); 1/(ε²·N)
};

/// Reliability by what is true of the cell; doubt = 1 − it, rounded from double.
struct Contextual {
  bool used = false;
  float if_empty = 1, if_occupied = 1, doubt_if_empty = 0, doubt_if_occupied = 0;
};

struct ConeReading {
  std::int64_t i0 = 0, j0 = 0;           // cell whose centre the apex offset counts from
  float fx = 0, fy = 0;                  // apex = (i0 + fx, j0 + fy) in cell centres
  float lx = 0, ly = 0, rx = 0, ry = 0;  // directions of the left and right edge, multiples of 2^-24
  Ring ring[3];                          // farthest, nearest, and the model's own edge
  float outer = 0, inner = 0;            // farthest and nearest distance
  float within_radius = -1;              // cells so near lie before the model's edge and inside the outer ring
  float free_radius = -1;                // cells so near are certain to be empty (before the discount)
  float reliability = 1, doubt = 0;      // doubt = 1 − reliability
  Contextual contextual{};
  union {                                // of the sensor's model
    LiConstants li{};
    HughesConstants hughes;
    TanhConstants tanh;
    Li2006Constants li2006;
    MoravecConstants moravec;
  };
};

struct FanReading {
  std::int64_t i0 = 0, j0 = 0;
  float fx = 0, fy = 0;
  int beams = 0;
  bool full_circle = false;
  const float* range = nullptr;     // per beam, quantised; kNoBeam where refused and for kFanPad beams on both sides
  const float* border_x = nullptr;  // beams + 1 directions between the beams
  const float* border_y = nullptr;
  float mid_cos = 1, mid_sin = 0;                            // middle of the fan, only to find candidates
  float beams_per_rad = 0, half_beams = 0, angle_slack = 0;  // slack in beams
  float half_angle = 0;                                      // half of the fan's opening, radians
  // Extreme ranges over 2^l beams from i at reach[l · stride + i]: the largest (rounded up) in the high and the
  // smallest (rounded down) in the low 16 bits, in units of reach_unit cells. A whole turn is stored twice over.
  const std::uint32_t* reach = nullptr;
  int reach_stride = 0, reach_levels = 0;
  float reach_unit = 1;
  float near = 0, far = 0;  // closed limits of d
  float empty_margin = 0, half_width = 0;
  float empty = 0, occupied = 0, fall = 0;  // masses at d = 0 after discount; share lost per cell
};
inline constexpr float kNoBeam = -1e6f;
inline constexpr int kFanPad = 72;

}  // namespace evigrid::kernels
