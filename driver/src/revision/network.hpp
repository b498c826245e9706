// SPDX-License-Identifier: Apache-2.0
// Revision of a reading's masses by a learned network in place of a fixed discount (Li et al. 2014): 4 inputs, 5 hidden
// and 4 output neurons, all sigmoid, one network a sensor.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "evigrid/sensor.hpp"

namespace evigrid::driver {

/// m(empty), m(occupied), m(unknown), m(empty ∩ occupied).
using Gbba = std::array<double, 4>;
[[nodiscard]] Gbba gbba(const ModelMass& m);

struct Network {
  static constexpr int kIn = 4, kHidden = 5, kOut = 4;
  static constexpr int kWeights = kHidden * (kIn + 1) + kOut * (kHidden + 1);
  /// Training drives saturated neurons far out; beyond this, products and sums of them could overflow.
  static constexpr double kMostWeight = 1e100;
  /// Row by row, the bias last: those of the hidden neurons, then those of the outputs.
  std::array<double, kWeights> weight{};

  [[nodiscard]] std::array<double, kHidden> hidden(const Gbba& in) const;
  [[nodiscard]] Gbba raw(const std::array<double, kHidden>& hidden) const;  ///< each in (0, 1), not normalised
};

/// The masses that the network makes of modelled ones, divided by their sum.
[[nodiscard]] Gbba revise(const Network& network, const Gbba& modelled);

/// What a revision file holds of one sensor.
struct Revision {
  std::size_t sensor = 0;  ///< its number in the calibration data
  std::string model;       ///< whose masses it revises
  Network network;
};
[[nodiscard]] std::string to_text(const std::vector<Revision>& revisions);
/// Throws InputError naming the file and what is wrong.
[[nodiscard]] std::vector<Revision> read_revisions(const std::string& path);

}  // namespace evigrid::driver
