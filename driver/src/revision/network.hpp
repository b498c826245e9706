// SPDX-License-Identifier: Apache-2.0
// Revision of a reading's masses by a learned network (evigrid/revision.hpp): its file, and which sensor gets which.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "evigrid/revision.hpp"

namespace evigrid::driver {

/// m(empty), m(occupied), m(unknown), m(empty ∩ occupied).
using Gbba = std::array<double, 4>;
[[nodiscard]] Gbba gbba(const ModelMass& m);

using Network = RevisionNetwork;
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
/// Sensor number `index` of a log or scene gets the revision of its number, or the only one there is. Fans are left
/// alone. Throws InputError naming the file where it holds none for the sensor, or one of another model.
void apply_revision(const std::vector<Revision>& all, const std::string& path, std::size_t index, Sensor& sensor);

}  // namespace evigrid::driver
