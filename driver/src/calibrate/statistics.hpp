// SPDX-License-Identifier: Apache-2.0
// How a range finder errs, from readings beside the true range: bias and robust spread over range, outliers, missing
// echoes, and what follows for a map (reliability) and a simulation (noise). Metres; error = reading − truth.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "log/log.hpp"

namespace evigrid::driver {

struct Sample {
  double truth_m = 0, reading_m = 0;
};

struct ErrorStats {
  std::uint64_t samples = 0;       ///< with or without an echo
  std::uint64_t no_return = 0;     ///< at or above the sensor's no_return_m
  std::uint64_t unusable = 0;      ///< not a number, or nearer than the sensor measures
  std::uint64_t outliers = 0;      ///< echoes whose error is beyond the outlier limit
  std::uint64_t off = 0;           ///< samples of any kind whose error is, or that are no number
  double bias_m = 0, sigma_m = 0;  ///< of all echoes: median, and 1.4826 × median absolute deviation from it

  [[nodiscard]] std::uint64_t echoes() const { return samples - no_return - unusable; }
  [[nodiscard]] double outlier_share() const;    ///< of the echoes
  [[nodiscard]] double no_return_share() const;  ///< of the samples
  [[nodiscard]] double off_share() const;        ///< of the samples: what a user without any gate meets
};

struct RangeBin {
  double from_m = 0, to_m = 0;  ///< of the true range
  ErrorStats stats;
};

/// σ(R) = sigma_m + ratio · R, as scenes have it.
struct NoiseFit {
  std::size_t bins = 0;  ///< it rests on; 0: too few samples for any
  double sigma_m = 0, ratio = 0;
};

struct Calibration {
  std::string sensor;
  ErrorStats all;
  std::vector<RangeBin> bins;
  NoiseFit noise;
  std::optional<double> reliability;  ///< the share of echoes within the outlier limit; none without an echo
  std::vector<Sample> samples;        ///< the echoes, for the picture
};

struct CalibrationLimits {
  double bin_m = 0.25, outlier_m = 0.2;
};

/// One entry a sensor. Throws InputError when the log holds no true ranges.
std::vector<Calibration> calibrate(const Log& log, const CalibrationLimits& limits);

/// Median of values; 0 when there are none. Reorders them.
double median(std::vector<double>& values);

}  // namespace evigrid::driver
