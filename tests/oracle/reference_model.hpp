// SPDX-License-Identifier: Apache-2.0
// The sensor models of the slow reference, by libm in double, in metres and radians: what one reading says of one
// point.
#pragma once
#include "evigrid/sensor.hpp"

namespace oracle {

/// Masses of one reading at one point; z = m(empty and occupied). Vacuous unless said otherwise.
struct Source {
  double x = 0, y = 0, z = 0, v = 1;
  bool yields = false;  ///< memberships whose y is cancelled by what the cell knows of empty
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

/// A point and its reading on the axis, in cells: comparisons are exact there. width: half the arc, Δ or ε.
struct Along {
  double d = 0, range = 0, width = 0, nearest = 0, cell_m = 1;
};
Source oriolo1997(const evigrid::Oriolo1997&, const Along&, EdgeAngles);
Source li2006(const evigrid::Li2006&, const Along&, EdgeAngles);
Source probability(const evigrid::Probability&, const Along&, EdgeAngles);
Source fuzzy(const evigrid::Fuzzy&, const Along&, EdgeAngles);
Source moravec1985(const Along&, EdgeAngles);
/// What the sensor's cone model says; for moravec1985 the occupied membership is not cancelled yet.
Source cone_model(const evigrid::Sensor&, const Along&, EdgeAngles, Zone);

/// Shafer's discount.
Source discount(const Source&, double reliability);
/// Contextual discounting by its definition: the disjunctive rule with, for each hypothesis, mass β on nothing and 1 −
/// β on the hypothesis.
Source contextual(const Source&, double reliability_if_empty, double reliability_if_occupied);

}  // namespace oracle
