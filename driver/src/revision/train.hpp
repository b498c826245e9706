// SPDX-License-Identifier: Apache-2.0
// Training a sensor's revision on readings beside true ranges: what the model says of cells on the axis of its cone,
// and what is true of them: empty before the true range, occupied at it, unknown behind.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "calibrate/statistics.hpp"
#include "revision/network.hpp"

namespace evigrid::driver {

struct Example {
  Gbba modelled{}, truth{};
};

struct TrainOptions {
  double cell_m = 0.05;         ///< a cell is occupied when the true range lies in it
  double held_out = 0.3;        ///< share of the readings, in runs of 20 consecutive ones, kept for the judgement
  std::size_t examples = 3000;  ///< at most so many are trained on
  int tries = 4;                ///< random starts; the one with the least training error stays
  std::uint64_t seed = 1;
};

/// Errors over the held-out examples: root of the mean square and mean of the absolute value, a mass; and the share
/// whose largest mass is the true one.
struct Judgement {
  double rms = 0, mean = 0, right = 0;
};

struct Trained {
  Network network;
  std::size_t readings = 0, trained_on = 0;
  std::array<std::size_t, 3> held_out{};  ///< examples by truth: empty, occupied, unknown
  double sse = 0;                         ///< of the training examples, of masses times 1000
  Judgement modelled, revised, constant, always_occupied;
  Gbba constant_says{};  ///< the mean truth of the training examples: the best answer that looks at nothing
};

/// Examples of one reading, none where the model says nothing.
[[nodiscard]] std::vector<Example> examples_of(const Sensor& sensor, const Sample& sample, double cell_m);
/// Levenberg–Marquardt on the sum of squared errors of the masses times 1000. Throws InputError when there are too few
/// examples to train on and to judge by.
[[nodiscard]] Trained train(const Sensor& sensor, const std::vector<Sample>& samples, const TrainOptions& options);

/// Readings beside true ranges, and the records that could not be read, as a Log tells them.
struct Samples {
  std::vector<std::vector<Sample>> by_sensor;
  std::map<std::string, std::uint64_t> malformed;
  std::vector<std::string> warnings;
};

/// From the CSV of `evigrid cast --truth` or a log that holds true ranges. Without an echo nothing can be learned: left
/// out. Throws InputError.
[[nodiscard]] Samples read_samples(const std::string& path);

}  // namespace evigrid::driver
