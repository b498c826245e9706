// SPDX-License-Identifier: Apache-2.0
// Learned revision of what a sensor's model says, in place of a fixed discount (Li, Huang, Wang & Dezert 2014): a
// network of 4 inputs, 5 hidden and 4 output neurons, all logistic. `evigrid train` makes one.
#pragma once
#include <array>

#include "evigrid/sensor.hpp"

namespace EVIGRID_API evigrid {

struct RevisionNetwork {
  static constexpr int kIn = 4, kHidden = 5, kOut = 4;
  static constexpr int kWeights = kHidden * (kIn + 1) + kOut * (kHidden + 1);
  /// Training drives saturated neurons far out; beyond this, products and sums of them could overflow.
  static constexpr double kMostWeight = 1e100;
  /// Row by row, the bias last: those of the hidden neurons, then those of the outputs.
  std::array<double, kWeights> weight{};

  /// In and out: masses of empty, occupied, unknown, empty ∩ occupied.
  [[nodiscard]] std::array<double, kHidden> hidden(const std::array<double, kIn>& in) const noexcept;
  /// Each in (0, 1), not normalised.
  [[nodiscard]] std::array<double, kOut> raw(const std::array<double, kHidden>& hidden) const noexcept;
};

/// The masses that the network makes of modelled ones, divided by their sum. Same bits on every machine.
[[nodiscard]] ModelMass revise(const RevisionNetwork&, const ModelMass& modelled) noexcept;

}  // namespace evigrid
