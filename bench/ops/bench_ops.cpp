// SPDX-License-Identifier: Apache-2.0
// Operations of one cell update, counted by running the kernels' text on lane_count.hpp: rows of no time, counters
// `flop` and `slow` (quotients and roots among them). The roofline takes them. Only what a cell inside the footprint
// needs: not the lanes that lie outside, not what a reading or a micro-tile is prepared with; of a cone a cell between
// the rings, as nearly all are.
#include <benchmark/benchmark.h>

#include <string>

#include "bench/ops/lane_count.hpp"
// After the lane.
#include "kernels/cell/mass.hpp"
#include "kernels/cell/model_hughes1992.hpp"
#include "kernels/cell/model_li2014.hpp"
#include "kernels/cell/one_sided.hpp"
#include "kernels/cell/polar.hpp"
#include "kernels/cell/poly.hpp"
#include "kernels/cell/rule_batch.hpp"
#include "kernels/cell/rule_dempster.hpp"
#include "kernels/cell/rule_pcr.hpp"
#include "kernels/cell/rule_pcr14.hpp"
#include "kernels/cell/rule_yager.hpp"
#include "kernels/row/compile_reading.hpp"
#include "kernels/row/cone_cells.hpp"

namespace {

namespace counted = evigrid::kernels::counted;
using counted::Number;

template <class Work>
void report(benchmark::State& state, Work work) {
  counted::counter = {};
  for (auto _ : state) work();
  state.counters["flop"] = counted::counter.flop;
  state.counters["slow"] = counted::counter.slow;
}
template <class Work>
void add(const std::string& name, Work work) {
  benchmark::RegisterBenchmark(("ops/" + name).c_str(), [work](benchmark::State& s) {
    report(s, work);
  })->Iterations(1);
}

const counted::Cell<Number> kCell{Number(0.3f), Number(0.25f), Number(0.45f)};
const counted::PlainSource<Number> kSource{Number(0.5f), Number(0.1f), Number(0.4f)};

template <class Rule>
void dense(const char* name) {
  add(std::string("dense/") + name, [] {
    auto r = Rule::template combine<counted::Exact>(kCell, kSource);
    benchmark::DoNotOptimize(r);
  });
}
template <class Rule>
void fan(const char* name) {  // distance, the mass that falls with it, the rest, the rule; one-sided
  add(std::string("fan/") + name, [] {
    const Number dx(20.0f), dy(7.0f), one(1.0f);
    const Number f = counted::neg_mul_add(counted::root(counted::mul_add(dx, dx, dy * dy)), Number(0.001f), one);
    const Number x = Number(0.6f) * f;
    auto r = Rule::template combine<counted::MapState>(kCell, counted::OneSided<Number>{x, {}, one - x});
    benchmark::DoNotOptimize(r);
  });
}
template <class Model, class Rule>
void cone(const char* name, int model) {
  add(std::string("cone/") + name, [model] {
    evigrid::kernels::ConeSpec spec{};
    spec.model = model;
    spec.cell_m = 0.05, spec.aperture_rad = 0.5, spec.min_range_m = 0.1, spec.max_range_m = 5, spec.reliability = 0.9;
    spec.r_max_m = 7.62, spec.max_occupied = 0.98, spec.tolerance_m = 0.15;
    spec.rho_e = 0.35, spec.rho_o = 0.1, spec.rho_c = 80, spec.rho_i = 10, spec.epsilon_ratio = 0.01;
    const auto q = compile_cone(evigrid::kernels::ConeType(spec), {0, 0, 0.3}, 2.5);
    const counted::ConeLanes lanes(q);
    counted::FirstCells first;
    const float x = 38, y = 12;
    first.fill<counted::kAsksExcess<Model>>(q, &x, &y, 1);
    counted::counter = {};  // what a micro-tile is prepared with is shared by its cells
    counted::Polar<Number> at;
    (void)counted::locate<evigrid::kernels::kWithin, counted::kAsksExcess<Model>>(q, lanes, first, &x, &y, 0, 0, at);
    const auto source = counted::source_of<counted::paradox_of<Rule>(), Model, evigrid::kernels::kWithin>(q, at);
    auto r = Rule::template combine<counted::MapState>(kCell, source);
    benchmark::DoNotOptimize(r);
  });
}

const bool registered = [] {
  dense<counted::Dempster>("dempster");
  dense<counted::Yager>("yager");
  dense<counted::Pcr1>("pcr1");
  dense<counted::Pcr2>("pcr2");
  dense<counted::Pcr4>("pcr4");
  dense<counted::Pcr5>("pcr5");
  dense<counted::GermPcr2>("germ_pcr2");
  dense<counted::Disjunctive>("disjunctive");
  dense<counted::Murphy>("murphy");
  dense<counted::Cautious>("cautious");
  dense<counted::Bayes>("bayes");
  fan<counted::Pcr5>("pcr5");
  cone<counted::ModelLi2014, counted::Pcr5>("li2014_pcr5", 1);
  cone<counted::ModelLi2014, counted::GermPcr2>("li2014_germ_pcr2", 1);
  cone<counted::ModelHughes1992, counted::Dempster>("hughes1992_dempster", 0);
  return true;
}();

}  // namespace
