// SPDX-License-Identifier: Apache-2.0
// Median and median absolute deviation, because a tenth of the readings of a sonar is off by metres and would rule any
// mean. 1.4826 makes the latter the standard deviation of a normal distribution (Rousseeuw & Croux 1993).
#include "calibrate/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "error.hpp"

namespace evigrid::driver {
namespace {

constexpr double kMadToSigma = 1.4826;
constexpr std::uint64_t kLeastEchoes = 20;  // a bin with fewer says nothing about spread
constexpr double kMostOutliers = 0.25;      // a bin with more has lost its MAD to them
constexpr double kLeastReliability = 0.01;  // the engine wants it above 0
constexpr std::size_t kMostBins = 10000;

/// Sorts one sample into the counters; its error joins `errors` when it is an echo.
void count(const Sample& s, const Sensor& sensor, double outlier_m, ErrorStats& stats, std::vector<double>& errors) {
  ++stats.samples;
  stats.off += std::abs(s.reading_m - s.truth_m) <= outlier_m ? 0 : 1;
  if (!std::isfinite(s.reading_m) ? !(s.reading_m > 0) : s.reading_m < sensor.min_range_m) {
    ++stats.unusable;
  } else if (s.reading_m >= sensor.no_return_m) {
    ++stats.no_return;
  } else {
    errors.push_back(s.reading_m - s.truth_m);
    stats.outliers += std::abs(errors.back()) > outlier_m ? 1 : 0;
  }
}

void finish(ErrorStats& stats, std::vector<double>& errors) {
  stats.bias_m = median(errors);
  for (double& e : errors) e = std::abs(e - stats.bias_m);
  stats.sigma_m = kMadToSigma * median(errors);
}

/// Least squares of σ over the middles of the bins, weighted by their echoes, neither part below 0.
NoiseFit fit_noise(const std::vector<RangeBin>& bins) {
  NoiseFit fit;
  double w = 0, wr = 0, wrr = 0, ws = 0, wrs = 0;
  for (const RangeBin& bin : bins) {
    if (bin.stats.echoes() < kLeastEchoes || bin.stats.outlier_share() > kMostOutliers) continue;
    const auto n = static_cast<double>(bin.stats.echoes());
    const double r = (bin.from_m + bin.to_m) / 2, s = bin.stats.sigma_m;
    ++fit.bins;
    w += n;
    wr += n * r;
    wrr += n * r * r;
    ws += n * s;
    wrs += n * r * s;
  }
  if (fit.bins == 0) return fit;
  const double determinant = w * wrr - wr * wr;
  fit.ratio = fit.bins > 1 && determinant > 0 ? (w * wrs - wr * ws) / determinant : 0;
  fit.sigma_m = (ws - fit.ratio * wr) / w;
  if (fit.ratio < 0) {
    fit.ratio = 0;
    fit.sigma_m = ws / w;
  } else if (fit.sigma_m < 0) {
    fit.sigma_m = 0;
    fit.ratio = wrs / wrr;
  }
  return fit;
}

Calibration calibrate_sensor(const Log& log, std::size_t sensor, const CalibrationLimits& limits) {
  const LogSensor& declared = log.sensors[sensor];
  Calibration out;
  out.sensor = declared.name.empty() ? fmt::format("{} {}", declared.kind, sensor) : declared.name;
  std::vector<double> errors;
  std::map<std::int64_t, std::pair<ErrorStats, std::vector<double>>> bins;
  for (const LogReading& r : log.readings) {
    if (r.sensor != sensor) continue;
    for (std::size_t i = r.first; i < r.first + r.count; ++i) {
      const Sample s{static_cast<double>(log.truth_m[i]), static_cast<double>(log.ranges_m[i])};
      const double at = std::floor(s.truth_m / limits.bin_m);
      if (!std::isfinite(s.truth_m) || std::abs(at) > 1e15) continue;
      const std::size_t before = errors.size();
      count(s, declared.sensor, limits.outlier_m, out.all, errors);
      if (errors.size() > before) out.samples.push_back(s);
      auto& [stats, own] = bins[static_cast<std::int64_t>(at)];
      count(s, declared.sensor, limits.outlier_m, stats, own);
      if (bins.size() > kMostBins) {
        throw InputError(fmt::format("--bin: {:g} m makes more than {} bins of these ranges", limits.bin_m, kMostBins));
      }
    }
  }
  finish(out.all, errors);
  for (auto& [at, bin] : bins) {
    finish(bin.first, bin.second);
    out.bins.push_back({static_cast<double>(at) * limits.bin_m, static_cast<double>(at + 1) * limits.bin_m, bin.first});
  }
  out.noise = fit_noise(out.bins);
  if (out.all.echoes() > 0) out.reliability = std::max(kLeastReliability, 1 - out.all.outlier_share());
  return out;
}

double share(std::uint64_t part, std::uint64_t of) {
  return of == 0 ? 0 : static_cast<double>(part) / static_cast<double>(of);
}

}  // namespace

double ErrorStats::outlier_share() const { return share(outliers, echoes()); }
double ErrorStats::no_return_share() const { return share(no_return, samples); }
double ErrorStats::off_share() const { return share(off, samples); }

double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

std::vector<Calibration> calibrate(const Log& log, const CalibrationLimits& limits) {
  for (const auto& [name, value] : {std::pair{"--bin", limits.bin_m}, {"--outlier", limits.outlier_m}}) {
    if (!(value > 0)) throw InputError(fmt::format("{}: {} is not above 0 m", name, value));
    if (value > kAbsurdRange_m) throw InputError(fmt::format("{}: {} is above {:g} m", name, value, kAbsurdRange_m));
  }
  if (log.truth_m.empty()) {
    throw InputError(fmt::format("format {} holds no true ranges: there is nothing to calibrate against", log.format));
  }
  std::vector<Calibration> out;
  for (std::size_t i = 0; i < log.sensors.size(); ++i) out.push_back(calibrate_sensor(log, i, limits));
  return out;
}

}  // namespace evigrid::driver
