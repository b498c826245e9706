// SPDX-License-Identifier: Apache-2.0
// evigrid calibrate LOG: how each range finder of a log errs against the true range beside it, and what to write into a
// sensor's declaration because of it.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "calibrate/scatter.hpp"
#include "calibrate/statistics.hpp"
#include "commands.hpp"
#include "log/readers.hpp"
#include "out/out_dir.hpp"

namespace evigrid::driver {
namespace {

using Json = nlohmann::ordered_json;

struct Args {
  std::vector<std::string> logs;
  std::string format = "auto", out_dir, json;
  CalibrationLimits limits;
};

Json stats_json(const ErrorStats& s) {
  return {{"samples", s.samples},
          {"echoes", s.echoes()},
          {"no_return", s.no_return},
          {"unusable", s.unusable},
          {"outliers", s.outliers},
          {"off", s.off},
          {"bias_m", s.bias_m},
          {"sigma_m", s.sigma_m},
          {"outlier_share", s.outlier_share()},
          {"no_return_share", s.no_return_share()},
          {"off_share", s.off_share()}};
}

Json to_json(const std::vector<Calibration>& all, const Log& log, const Args& args) {
  Json out;
  out["input"] = args.logs;
  out["format"] = log.format;
  out["bin_m"] = args.limits.bin_m;
  out["outlier_m"] = args.limits.outlier_m;
  out["sensors"] = Json::array();
  for (const Calibration& c : all) {
    Json one{{"sensor", c.sensor}, {"all", stats_json(c.all)}};
    one["bins"] = Json::array();
    for (const RangeBin& bin : c.bins) {
      Json b{{"from_m", bin.from_m}, {"to_m", bin.to_m}};
      b.update(stats_json(bin.stats));
      one["bins"].push_back(b);
    }
    one["suggested"] = nullptr;
    if (c.reliability) {
      one["suggested"] = {{"reliability", *c.reliability},
                          {"noise_sigma_m", c.noise.sigma_m},
                          {"noise_ratio", c.noise.ratio},
                          {"fitted_bins", c.noise.bins}};
    }
    out["sensors"].push_back(one);
  }
  out["records_malformed"] = log.malformed;
  out["warnings"] = log.warnings;
  return out;
}

std::string row(const std::string& label, const ErrorStats& s) {
  return fmt::format("  {:<16}{:>8}{:>8}{:>10.4f}{:>10.4f}{:>11.1f} %{:>11.1f} %\n", label, s.samples, s.echoes(),
                     s.bias_m, s.sigma_m, 100 * s.outlier_share(), 100 * s.no_return_share());
}

std::string table(const std::vector<Calibration>& all, const CalibrationLimits& limits) {
  std::string out;
  for (const Calibration& c : all) {
    out += fmt::format("{}: error = reading - truth; outlier: beyond {:g} m\n", c.sensor, limits.outlier_m);
    out += fmt::format("  {:<16}{:>8}{:>8}{:>10}{:>10}{:>13}{:>13}\n", "true range, m", "samples", "echoes", "bias, m",
                       "sigma, m", "outliers", "no return");
    for (const RangeBin& bin : c.bins) out += row(fmt::format("{:.2f} - {:.2f}", bin.from_m, bin.to_m), bin.stats);
    out += row("all", c.all);
    out += fmt::format("  off by more than {:g} m, missing echoes and error codes included: {:.1f} % of all samples\n",
                       limits.outlier_m, 100 * c.all.off_share());
    if (!c.reliability) {
      out += "  not a single echo: nothing can be suggested\n\n";
      continue;
    }
    out += fmt::format("  suggested: reliability = {:.3f}", *c.reliability);
    out += c.noise.bins == 0 ? std::string(", too few samples for the noise\n\n")
                             : fmt::format(", noise_sigma_m = {:.4f}, noise_ratio = {:.4f}  (of {} bins)\n\n",
                                           c.noise.sigma_m, c.noise.ratio, c.noise.bins);
  }
  return out;
}

void run_calibrate(const Args& args) {
  const bool to_stdout = args.json == "-";
  std::optional<OutDir> out;
  if (!args.out_dir.empty()) out.emplace(args.out_dir);
  if (!args.json.empty() && !to_stdout) require_writable(args.json);
  const Log log = read_log(args.logs, args.format);
  const std::vector<Calibration> all = calibrate(log, args.limits);
  const std::string json = to_json(all, log, args).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  if (out) {
    out->write("calibration.png", png(draw_scatter(all, args.limits)), {});
    out->write("calibration.json", json);
    if (!args.json.empty() && !to_stdout) out->write_outside(args.json, json);
    out->commit();
  } else if (!args.json.empty() && !to_stdout) {
    write_file(args.json, json);
  }
  std::cout << (to_stdout ? json : table(all, args.limits));
}

}  // namespace

void add_calibrate(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command =
      app.add_subcommand("calibrate", "errors of range finders from a log that holds the true ranges too");
  command->add_option("LOG", args->logs, "a log with true ranges, plain or .gz")->required();
  command->add_option("--format", args->format, fmt::format("{}", fmt::join(log_formats(), ", ")))
      ->capture_default_str();
  command->add_option("-o,--out", args->out_dir, "folder for calibration.png and calibration.json");
  command->add_option("--bin", args->limits.bin_m, "width of a bin of true range, m")->capture_default_str();
  command->add_option("--outlier", args->limits.outlier_m, "an error beyond this is an outlier, m")
      ->capture_default_str();
  command->add_option("--json", args->json, "also write the figures to this file; - for standard output instead");
  command->footer(
      "bias: median error; sigma: 1.4826 x median absolute deviation from it. Suggested: reliability, the share of "
      "echoes\nthat are no outliers; noise_sigma_m and noise_ratio of sigma(R) = noise_sigma_m + noise_ratio R, fitted "
      "to the bins with\nat least 20 echoes and at most 25 % outliers.\n\n"
      "Examples:\n"
      "  evigrid calibrate training1.csv\n"
      "  evigrid calibrate calibration.csv -o out/sonars --bin 0.5 --json -\n");
  command->callback([args] { run_calibrate(*args); });
}

}  // namespace evigrid::driver
