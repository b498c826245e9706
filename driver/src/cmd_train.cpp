// SPDX-License-Identifier: Apache-2.0
// evigrid train: the learned revision of a sensor's masses (Li et al. 2014), judged on readings that it has not seen.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "commands.hpp"
#include "error.hpp"
#include "model_options.hpp"
#include "options.hpp"
#include "out/out_dir.hpp"
#include "progress.hpp"
#include "revision/train.hpp"

namespace evigrid::driver {
namespace {

struct Args {
  std::string data, out, json, model = "li2014";
  double aperture_deg = 25, min_range_m = 0.1, max_range_m = 5;
  std::vector<std::string> params;
  bool together = false;
  TrainOptions options;
};

nlohmann::ordered_json to_json(const Judgement& j) {
  return {{"rms_error", j.rms}, {"mean_error", j.mean}, {"largest_mass_right", j.right}};
}

std::string row(const char* what, const Judgement& j) {
  return fmt::format("  {:<28}{:>10.4f}{:>12.4f}{:>12.1f} %\n", what, j.rms, j.mean, 100 * j.right);
}

std::string table(std::size_t sensor, const Trained& t) {
  std::string out = fmt::format(
      "sensor {}: {} readings, {} cells trained on; judged on held-out readings: {} empty, {} occupied, {} unknown\n",
      sensor, t.readings, t.trained_on, t.held_out[0], t.held_out[1], t.held_out[2]);
  out += fmt::format("  {:<28}{:>10}{:>12}{:>14}\n", "", "rms", "mean |err|", "largest right");
  out += row("as modelled", t.modelled) + row("revised", t.revised);
  out +=
      row(fmt::format("constant ({:.3f}, {:.3f}, {:.3f})", t.constant_says[0], t.constant_says[1], t.constant_says[2])
              .c_str(),
          t.constant);
  out += row("constant (0, 1, 0)", t.always_occupied);
  return out + (t.revised.rms < t.constant.rms ? "  the revision beats the constant\n"
                                               : "  the revision does NOT beat the constant\n");
}

/// What could not be read of the data, if anything.
std::string left_out(const Samples& samples) {
  std::string out;
  for (const auto& [reason, times] : samples.malformed)
    out += fmt::format("{} {} {}", out.empty() ? "records_malformed:" : ",", reason, times);
  if (!out.empty()) out += "\n";
  for (const std::string& warning : samples.warnings) out += "  " + warning + "\n";
  return out;
}

void run_train(const Args& args) {
  Sensor s;
  s.model = parse_model(args.model);
  if (s.model == Model::beam) throw InputError("--model: beam is for lasers; a revision is of a sonar's masses");
  s.aperture_rad = args.aperture_deg * std::numbers::pi / 180;
  s.min_range_m = args.min_range_m;
  s.max_range_m = args.max_range_m;
  const auto settings = parse_settings(args.params, s.model);
  require_used(settings, {args.model});
  apply_settings(settings, s);
  if (const auto errors = check(s); !errors.empty())
    throw InputError(errors.front().field + " " + errors.front().reason);
  if (!(args.options.cell_m >= 1e-3 && args.options.cell_m <= 10))
    throw InputError("--cell: must be within [0.001, 10] m");
  if (!(args.options.held_out >= 0.05 && args.options.held_out <= 0.95))
    throw InputError("--held-out: must be within [0.05, 0.95]");
  if (args.options.examples < 100) throw InputError("--examples: must be at least 100");
  require_writable(args.out);
  if (!args.json.empty() && args.json != "-") require_writable(args.json);
  Samples read = read_samples(args.data);
  std::vector<std::vector<Sample>>& samples = read.by_sensor;
  for (auto& one : samples) {
    std::erase_if(one, [&](const Sample& x) { return x.reading_m < s.min_range_m || x.reading_m > s.max_range_m; });
  }
  if (args.together) {
    for (std::size_t i = 1; i < samples.size(); ++i)
      samples[0].insert(samples[0].end(), samples[i].begin(), samples[i].end());
    samples.resize(1);
  }
  std::vector<Revision> revisions;
  nlohmann::ordered_json report{{"data", args.data},
                                {"model", args.model},
                                {"records_malformed", read.malformed},
                                {"warnings", read.warnings},
                                {"sensors", nlohmann::ordered_json::array()}};
  std::string text = left_out(read);
  Progress progress("training");
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].empty()) continue;
    Trained t;
    try {
      t = train(s, samples[i], args.options);
    } catch (const InputError& bad) {
      throw InputError(fmt::format("{}: sensor {}: {}{}", args.data, i, bad.what(),
                                   samples.size() > 1 ? "; --together trains one network for all" : ""));
    }
    revisions.push_back({i, args.model, t.network});
    report["sensors"].push_back({{"sensor", i},
                                 {"readings", t.readings},
                                 {"trained_on", t.trained_on},
                                 {"held_out", t.held_out},
                                 {"training_sse_of_masses_times_1000", t.sse},
                                 {"modelled", to_json(t.modelled)},
                                 {"revised", to_json(t.revised)},
                                 {"constant", to_json(t.constant)},
                                 {"constant_says", t.constant_says},
                                 {"always_occupied", to_json(t.always_occupied)}});
    text += table(i, t);
    progress.show(i + 1, samples.size());
  }
  if (revisions.empty())
    throw InputError(fmt::format("{}: no reading within [{}, {}] m with an echo{}", args.data, s.min_range_m,
                                 s.max_range_m,
                                 read.warnings.empty() ? "" : "; first record left out: " + read.warnings.front()));
  write_file(args.out, to_text(revisions));
  const std::string bytes = report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  if (!args.json.empty() && args.json != "-") write_file(args.json, bytes);
  std::cout << (args.json == "-" ? bytes : text);
}

}  // namespace

void add_train(CLI::App& app) {
  auto args = std::make_shared<Args>();
  CLI::App* command =
      app.add_subcommand("train", "a learned revision of a sensor's masses, from readings beside true ranges");
  command->add_option("DATA", args->data, "CSV of `evigrid cast --truth`, or a log that holds true ranges")->required();
  command
      ->add_option("-o,--out", args->out,
                   "the revision, a small JSON file, for --revision of `evigrid map`, run and model")
      ->required();
  command->add_option("--model", args->model, "sensor model whose masses are revised")->capture_default_str();
  command->add_option("--param", args->params, "NAME=VALUE: a parameter of the model, repeatable")
      ->allow_extra_args(false);
  command->add_option("--aperture", args->aperture_deg, "full opening of the cones, degrees")->capture_default_str();
  command->add_option("--min-range", args->min_range_m, "m: nearer readings are left out")->capture_default_str();
  command->add_option("--max-range", args->max_range_m, "m: farther readings are left out")->capture_default_str();
  command->add_option("--cell", args->options.cell_m, "m: a cell is occupied when the true range lies in it")
      ->capture_default_str();
  command->add_option("--held-out", args->options.held_out, "share of the readings kept for the judgement")
      ->capture_default_str();
  command->add_option("--examples", args->options.examples, "most cells to train on, spread over the readings")
      ->capture_default_str();
  command->add_option("--seed", args->options.seed, "of the split and of the starts")->capture_default_str();
  command->add_flag("--together", args->together, "one network for all sensors of DATA, not one each");
  command->add_option("--json", args->json, "also write the judgement to this file; - for standard output instead");
  command->footer(
      "A network of 4 inputs, 5 hidden and 4 output neurons, all sigmoid, trained by Levenberg-Marquardt on the sum "
      "of\n"
      "squared errors of the masses times 1000 (Li et al. 2014). Cells on the axis of the cone: empty before the true\n"
      "range, occupied at it, unknown behind it. Judged on held-out runs of readings beside the masses as modelled, "
      "the\n"
      "best constant answer and the constant (0, 1, 0).\n\n"
      "Examples:\n"
      "  evigrid cast --truth -o readings.csv\n"
      "  evigrid train readings.csv --together -o revision.json\n"
      "  evigrid model li2014 --reading 1.493 --at 1.5,0 --revision revision.json\n"
      "  evigrid run -o out --revision revision.json\n");
  command->callback([args] { run_train(*args); });
}

}  // namespace evigrid::driver
