// SPDX-License-Identifier: Apache-2.0
// The layers, one row each: name and formula. Logarithms are ours: a picture must not depend on the processor either.
#include <array>
#include <cmath>

#include "evigrid/readout.hpp"
#include "kernels/row/portable_math.hpp"

namespace evigrid {
namespace {

double log2_of(double x) noexcept { return kernels::portable_log(x) * 1.44269504088896340736; }
double part_of_entropy(double p, double q) noexcept { return p > 0 && q > 0 ? -p * log2_of(q) : 0; }

/// The masses without c, divided by their sum where there was one.
struct Closed {
  double e, o, u;
};
Closed closed(const Mass& m) noexcept {
  const double e = m.e, o = m.o, u = m.u;
  if (m.c == 0) return {e, o, u};
  const double s = e + o + u;
  return s > 0 ? Closed{e / s, o / s, u / s} : Closed{0, 0, 1};
}

double betp(const Closed& m) noexcept { return m.o + 0.5 * m.u; }
double half_for(Decision d) noexcept { return d == Decision::occupied ? 1 : d == Decision::empty ? 0 : 0.5; }

using Formula = double (*)(const Mass&, const Closed&, const ReadOutParams&);
struct Row {
  Layer layer;
  std::string_view name;
  Formula of;
};
constexpr Formula kHistory = [](const Mass&, const Closed&, const ReadOutParams&) { return 0.0; };
#define EVIGRID_LAYER(word, expression)                                                         \
  Row {                                                                                         \
    Layer::word, #word,                                                                         \
        []([[maybe_unused]] const Mass& raw, [[maybe_unused]] const Closed& m,                  \
           [[maybe_unused]] const ReadOutParams& p) { return static_cast<double>(expression); } \
  }
constexpr auto kRows = std::to_array<Row>({
    EVIGRID_LAYER(betp, betp(m)),
    EVIGRID_LAYER(bel, raw.o),
    EVIGRID_LAYER(pl, m.o + m.u),
    EVIGRID_LAYER(empty, raw.e),
    EVIGRID_LAYER(unknown, raw.u),
    EVIGRID_LAYER(paradox, raw.c),
    EVIGRID_LAYER(ignorance, m.u),
    EVIGRID_LAYER(commonality, static_cast<double>(raw.o) + raw.u),
    EVIGRID_LAYER(plp, (m.o + m.u) / (m.e + m.o + 2 * m.u)),
    EVIGRID_LAYER(dsmp, m.e + m.o + p.dsmp_epsilon > 0
                            ? m.o + m.u * (m.o + p.dsmp_epsilon) / (m.e + m.o + 2 * p.dsmp_epsilon)
                            : 0.5),
    EVIGRID_LAYER(free_betp, raw.o + static_cast<double>(raw.c) + 0.5 * raw.e + 2.0 / 3 * raw.u),
    EVIGRID_LAYER(free_both, raw.c + 0.5 * (static_cast<double>(raw.e) + raw.o) + 1.0 / 3 * raw.u),
    EVIGRID_LAYER(specificity, m.e + m.o + 0.5 * m.u),
    EVIGRID_LAYER(internal_conflict, part_of_entropy(m.e, m.e + m.u) + part_of_entropy(m.o, m.o + m.u)),
    EVIGRID_LAYER(entropy, part_of_entropy(betp(m), betp(m)) + part_of_entropy(1 - betp(m), 1 - betp(m))),
    EVIGRID_LAYER(decision, half_for(decide(raw))),
    EVIGRID_LAYER(decision_betp, half_for(decide_by_betp(raw, p.betp_at_least))),
    EVIGRID_LAYER(fuzzy_map,
                  1 - raw.e * raw.e * (1.0 - raw.o) * (1.0 - raw.e * raw.o) * (1 - (1.0 - raw.e) * (1.0 - raw.o))),
    Row{Layer::conflict, "conflict", kHistory},
    Row{Layer::con, "con", kHistory},
    Row{Layer::last_conflict, "last_conflict", kHistory},
});
#undef EVIGRID_LAYER

constexpr bool in_order() {
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    if (static_cast<std::size_t>(kRows[i].layer) != i) return false;
  }
  return true;
}
static_assert(kRows.size() == kLayerCount && in_order());

constexpr auto kAll = [] {
  std::array<Layer, kRows.size()> out{};
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = kRows[i].layer;
  return out;
}();

}  // namespace

std::span<const Layer> all_layers() noexcept { return kAll; }
std::string_view name(Layer l) noexcept {
  const auto i = static_cast<std::size_t>(l);
  return i < kRows.size() ? kRows[i].name : "?";
}
std::optional<Layer> layer_from_name(std::string_view text) noexcept {
  for (const Row& row : kRows) {
    if (row.name == text) return row.layer;
  }
  return std::nullopt;
}

double value_of(Layer l, const Mass& m, const ReadOutParams& p) noexcept {
  const auto i = static_cast<std::size_t>(l);
  return i < kRows.size() ? kRows[i].of(m, closed(m), p) : 0;
}

Decision decide(const Mass& m) noexcept {
  if (!(m.u < 0.5f) || m.o == m.e) return Decision::unknown;
  return m.o > m.e ? Decision::occupied : Decision::empty;
}
Decision decide_by_betp(const Mass& m, double at_least) noexcept {
  const double p = betp(closed(m));
  if (p >= at_least && p > 0.5) return Decision::occupied;
  return 1 - p >= at_least && p < 0.5 ? Decision::empty : Decision::unknown;
}

}  // namespace evigrid
