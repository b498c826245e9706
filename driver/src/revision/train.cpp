// SPDX-License-Identifier: Apache-2.0
#include "revision/train.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>
#include <unsupported/Eigen/LevenbergMarquardt>

#include "error.hpp"

namespace evigrid::driver {
namespace {

constexpr double kScale = 1000;  // "magnified 1000 times"
constexpr double kRate = 0.1;    // learning rate: the step bound of Levenberg–Marquardt
constexpr double kGoal = 1e-3;   // of the sum of squared errors
constexpr int kMostSteps = 150;
constexpr int kAlong = 8;         // cells along the axis, a reading
constexpr std::size_t kRun = 20;  // readings held out or trained on together: neighbours in time are alike
constexpr std::size_t kFewest = 100;

class Errors : public Eigen::DenseFunctor<double> {
 public:
  explicit Errors(const std::vector<Example>& examples)
      : DenseFunctor<double>(Network::kWeights, static_cast<int>(4 * examples.size())), examples_(examples) {}

  int operator()(const InputType& w, ValueType& error) const {
    const Network net = network(w);
    for (std::size_t k = 0; k < examples_.size(); ++k) {
      const Gbba out = net.raw(net.hidden(examples_[k].modelled));
      for (std::size_t o = 0; o < 4; ++o)
        error[static_cast<Eigen::Index>(4 * k + o)] = kScale * (out[o] - examples_[k].truth[o]);
    }
    return 0;
  }
  int df(const InputType& w, JacobianType& j) const {
    constexpr int kIn = Network::kIn, kHidden = Network::kHidden, kFirst = kHidden * (kIn + 1);
    const Network net = network(w);
    j.setZero();
    for (std::size_t k = 0; k < examples_.size(); ++k) {
      const auto hidden = net.hidden(examples_[k].modelled);
      const Gbba out = net.raw(hidden);
      for (int o = 0; o < 4; ++o) {
        const auto row = static_cast<Eigen::Index>(4 * k) + o;
        const double slope = kScale * out[static_cast<std::size_t>(o)] * (1 - out[static_cast<std::size_t>(o)]);
        const int at = kFirst + o * (kHidden + 1);
        for (int h = 0; h < kHidden; ++h) {
          const double value = hidden[static_cast<std::size_t>(h)];
          j(row, at + h) = slope * value;
          const double back = slope * w[at + h] * value * (1 - value);
          for (int i = 0; i < kIn; ++i)
            j(row, h * (kIn + 1) + i) = back * examples_[k].modelled[static_cast<std::size_t>(i)];
          j(row, h * (kIn + 1) + kIn) = back;
        }
        j(row, at + kHidden) = slope;
      }
    }
    return 0;
  }
  static Network network(const InputType& w) {
    Network net;
    std::copy_n(w.data(), Network::kWeights, net.weight.begin());
    return net;
  }

 private:
  const std::vector<Example>& examples_;
};

double between(std::mt19937_64& random, double least, double most) {  // the same on every standard library
  return least + (most - least) * static_cast<double>(random() >> 11) * 0x1p-53;
}

/// One start; answers the sum of squared errors.
double fit(const std::vector<Example>& examples, std::mt19937_64& random, Network& network) {
  Errors errors(examples);
  Eigen::VectorXd w(Network::kWeights);
  for (double& one : w) one = between(random, -1, 1);
  Eigen::LevenbergMarquardt<Errors> lm(errors);
  lm.setFactor(kRate);
  if (lm.minimizeInit(w) == Eigen::LevenbergMarquardtSpace::ImproperInputParameters) return INFINITY;
  for (int step = 0; step < kMostSteps && lm.fnorm() * lm.fnorm() > kGoal; ++step) {
    if (lm.minimizeOneStep(w) != Eigen::LevenbergMarquardtSpace::Running) break;
  }
  if (!(w.cwiseAbs().maxCoeff() <= Network::kMostWeight)) return INFINITY;  // no file could hold it
  network = Errors::network(w);
  return lm.fnorm() * lm.fnorm();
}

template <class Predict>
Judgement judge(const std::vector<Example>& held_out, Predict&& predict) {
  Judgement out;
  for (const Example& one : held_out) {
    const Gbba m = predict(one.modelled);
    for (std::size_t i = 0; i < 4; ++i) {
      const double error = m[i] - one.truth[i];
      out.rms += error * error, out.mean += std::abs(error);
    }
    const auto largest = [](const Gbba& g) { return std::max_element(g.begin(), g.end()) - g.begin(); };
    out.right += largest(m) == largest(one.truth) ? 1 : 0;
  }
  const auto n = static_cast<double>(held_out.size());
  return {std::sqrt(out.rms / (4 * n)), out.mean / (4 * n), out.right / n};
}

bool kept_for_judgement(std::size_t reading, const TrainOptions& o) {
  std::mt19937_64 run(o.seed * 0x9E3779B97F4A7C15ULL + reading / kRun);
  return between(run, 0, 1) < o.held_out;
}

}  // namespace

std::vector<Example> examples_of(const Sensor& sensor, const Sample& s, double cell_m) {
  std::vector<Example> out;
  const auto add = [&](double d_m) {
    const ModelMass m = evaluate(sensor, s.reading_m, d_m, 0, cell_m);
    if (m.u == 1) return;
    const double behind_m = d_m - s.truth_m;
    const std::size_t is = behind_m < -cell_m / 2 ? 0 : behind_m <= cell_m / 2 ? 1 : 2;
    Example one{gbba(m), {}};
    one.truth[is] = 1;
    out.push_back(one);
  };
  const double most_m = std::max(s.reading_m, s.truth_m) + 2 * cell_m;  // beyond its support a model says nothing
  for (int i = 0; i < kAlong; ++i) add(sensor.min_range_m + (most_m - sensor.min_range_m) * (i + 0.5) / kAlong);
  add(s.truth_m);
  add(s.reading_m);
  return out;
}

Trained train(const Sensor& sensor, const std::vector<Sample>& samples, const TrainOptions& o) {
  Trained out;
  std::vector<Example> all, held_out;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::vector<Example> some = examples_of(sensor, samples[i], o.cell_m);
    auto& into = kept_for_judgement(i, o) ? held_out : all;
    into.insert(into.end(), some.begin(), some.end());
  }
  out.readings = samples.size();
  if (all.size() < kFewest || held_out.size() < kFewest) {
    throw InputError("too few readings with an echo: " + std::to_string(all.size()) + " cells to train on and " +
                     std::to_string(held_out.size()) + " to judge by, at least " + std::to_string(kFewest) + " each");
  }
  std::vector<Example> examples;
  const std::size_t n = std::min(all.size(), o.examples);
  for (std::size_t i = 0; i < n; ++i) examples.push_back(all[i * all.size() / n]);
  out.trained_on = n;
  std::mt19937_64 random(o.seed);
  out.sse = INFINITY;
  for (int i = 0; i < o.tries; ++i) {
    Network one;
    if (const double sse = fit(examples, random, one); sse < out.sse) out.sse = sse, out.network = one;
  }
  if (!std::isfinite(out.sse)) throw InputError("no start of the training led to a finite error");
  for (const Example& e : examples) {
    for (std::size_t i = 0; i < 4; ++i) out.constant_says[i] += e.truth[i] / static_cast<double>(n);
  }
  for (const Example& e : held_out) ++out.held_out[e.truth[0] > 0 ? 0 : e.truth[1] > 0 ? 1 : 2];
  out.modelled = judge(held_out, [](const Gbba& m) { return m; });
  out.revised = judge(held_out, [&](const Gbba& m) { return revise(out.network, m); });
  out.constant = judge(held_out, [&](const Gbba&) { return out.constant_says; });
  out.always_occupied = judge(held_out, [](const Gbba&) { return Gbba{0, 1, 0, 0}; });
  return out;
}

}  // namespace evigrid::driver
