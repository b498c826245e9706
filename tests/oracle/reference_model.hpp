// SPDX-License-Identifier: Apache-2.0
// The sensor models of the slow reference, by libm in double, in metres and radians: what one reading says of one
// point.
#pragma once
#include "evigrid/sensor.hpp"

namespace oracle {

/// Masses of one reading at one point; z = m(empty and occupied). Vacuous unless said otherwise.
struct Source {
  double x = 0, y = 0, z = 0, v = 1;
};

/// Where a point lies on the reading's way: before the occupied zone, in it, or in neither.
enum class Zone { empty, occupied, none };

/// Angles of a point to the two edges of its cone.
struct EdgeAngles {
  double left_rad = 0, right_rad = 0;
};

Source hughes1992(const evigrid::Hughes1992&, double d_m, EdgeAngles, Zone);
Source li2014(const evigrid::Li2014&, double range_m, double d_m, EdgeAngles);
Source beam(const evigrid::Sensor&, double d_m, Zone);

/// Shafer's discount.
Source discount(const Source&, double reliability);
/// Contextual discounting by its definition: the disjunctive rule with, for each hypothesis, mass β on nothing and 1 − β
/// on the hypothesis.
Source contextual(const Source&, double reliability_if_empty, double reliability_if_occupied);

}  // namespace oracle
