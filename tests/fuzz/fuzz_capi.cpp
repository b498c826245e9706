// SPDX-License-Identifier: Apache-2.0
// Any sequence of C calls, sensible or not: none crashes, each says what was wrong, and masses stay masses. The input
// is a program: an operation a byte, its arguments behind it. What C cannot know (freed handles, arrays shorter than
// said) is left to the caller and not tried.
#include <evigrid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

[[noreturn]] void broken() { __builtin_trap(); }

class Program {
 public:
  Program(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
  [[nodiscard]] bool ended() const { return at_ == end_; }
  std::uint8_t byte() { return ended() ? std::uint8_t{0} : *at_++; }
  template <class T>
  T raw() {
    T v{};
    const auto n = std::min(sizeof v, static_cast<std::size_t>(end_ - at_));
    std::memcpy(&v, at_, n);
    at_ += n;
    return v;
  }
  /// Mostly small numbers, sometimes any.
  double number() {
    const std::uint8_t kind = byte();
    if (kind >= 0xf0) return raw<double>();
    return static_cast<double>(raw<std::int16_t>()) * std::array{1e-4, 1e-2, 1.0, 100.0}[kind % 4];
  }
  std::int64_t whole() {
    const std::uint8_t kind = byte();
    return kind >= 0xf0 ? raw<std::int64_t>() : raw<std::int8_t>();
  }
  evigrid_pose pose() { return {number(), number(), number()}; }
  evigrid_rect rect() { return {whole(), whole(), whole(), whole()}; }

 private:
  const std::uint8_t *at_, *end_;
};

void check(evigrid_status status) {
  if (status < EVIGRID_OK || status > EVIGRID_MEMORY) broken();  // EVIGRID_INTERNAL is a defect
  if (status != EVIGRID_OK && evigrid_last_error()[0] == '\0') broken();
}

constexpr const char* kNumbers[] = {"cell_m",
                                    "keep_con",
                                    "keep_last_conflict",
                                    "decay_s",
                                    "false_reflection_m",
                                    "aperture_rad",
                                    "min_range_m",
                                    "max_range_m",
                                    "reliability",
                                    "beams",
                                    "beam_step_rad",
                                    "first_beam_rad",
                                    "rho_e",
                                    "epsilon_m",
                                    "no_return_m",
                                    "clear_no_return",
                                    "yaw_rad",
                                    "bayes.least_p",
                                    "nonsense",
                                    "weight_exponent"};
constexpr const char* kDependence[] = {"independent", "cautious", "once_per_scan", "weighted", "?"};

struct Machine {
  std::array<evigrid_map*, 2> maps{};
  std::array<evigrid_view*, 2> views{};
  std::array<evigrid_sensor*, 2> sensors{};
  evigrid_params* params = nullptr;
  std::array<float, 512> floats{};
  std::array<std::int8_t, 512> bytes{};
  std::array<evigrid_mass, 64> masses{};

  ~Machine() {
    for (auto* m : maps) evigrid_map_destroy(m);
    for (auto* v : views) evigrid_view_destroy(v);
    for (auto* s : sensors) evigrid_sensor_destroy(s);
    evigrid_params_destroy(params);
  }

  void make_map(Program& p, std::size_t i) {
    if (params == nullptr) check(evigrid_params_create(&params));
    check(evigrid_params_set_number(params, "memory_cap_bytes", 4 << 20));
    check(evigrid_params_set_text(params, "executor", "serial"));
    const char* rule = evigrid_rule_name(p.byte() % 24u);
    check(evigrid_params_set_text(params, "rule", rule));
    evigrid_map* made = nullptr;
    check(evigrid_map_create(params, &made));
    if (made == nullptr) return;
    evigrid_map_destroy(maps[i]);
    maps[i] = made;
  }
  void integrate(Program& p, std::size_t i, bool undo) {
    std::array<evigrid_reading, 4> readings{};
    const std::size_t n = p.byte() % 5u;
    for (std::size_t r = 0; r < n; ++r) {
      readings[r] = {p.byte() % 4u, floats.data() + p.byte(), p.byte() % 9u};
      if (p.byte() > 250) readings[r].ranges_m = nullptr;
    }
    evigrid_report report;
    check((undo ? evigrid_map_undo : evigrid_map_integrate)(maps[i], p.whole(), p.pose(), readings.data(), n, &report));
  }
  void read(Program& p, std::size_t i) {
    evigrid_mass m{};
    const evigrid_cell cell{p.whole(), p.whole()};
    if (evigrid_view_mass(views[i], cell, &m) != EVIGRID_OK) return;
    for (const float v : {m.e, m.o, m.u, m.c}) {
      if (!(v >= 0 && v <= 1)) broken();
    }
  }

  void step(Program& p) {
    const std::uint8_t op = p.byte();
    const std::size_t i = op & 1;
    std::uint64_t number = 0;
    switch ((op >> 1) % 24) {
      case 0:
        return make_map(p, i);
      case 1: {
        evigrid_sensor* made = nullptr;
        check(evigrid_sensor_create(evigrid_model_name(p.byte() % 9u), &made));
        if (made == nullptr) return;
        evigrid_sensor_destroy(sensors[i]);
        sensors[i] = made;
        return;
      }
      case 2:
        return check(evigrid_sensor_set_number(sensors[i], kNumbers[p.byte() % std::size(kNumbers)], p.number()));
      case 3:
        if (params == nullptr) check(evigrid_params_create(&params));
        return check(evigrid_params_set_number(params, kNumbers[p.byte() % std::size(kNumbers)], p.number()));
      case 4:
        return check(evigrid_sensor_set_text(sensors[i], "dependence", kDependence[p.byte() % std::size(kDependence)]));
      case 5:
        return check(evigrid_map_add_sensor(maps[i], sensors[p.byte() & 1], nullptr));
      case 6:
      case 7:
      case 8:
        return integrate(p, i, false);
      case 9:
        return integrate(p, i, true);
      case 10: {
        evigrid_view* made = nullptr;
        check(evigrid_map_view(maps[i], &made));
        if (made == nullptr) return;
        evigrid_view_destroy(views[i]);
        views[i] = made;
        return;
      }
      case 11:
        return read(p, i);
      case 12: {
        const auto area = p.rect();
        return check(evigrid_view_render(views[i], evigrid_layer_name(p.byte() % 22u), area, floats.data(),
                                         floats.size(), p.whole()));
      }
      case 13:
        return check(evigrid_view_render_occupancy(views[i], p.number(), p.number(), p.number(), p.rect(), bytes.data(),
                                                   bytes.size(), p.whole()));
      case 14:
        return check(evigrid_map_clear_rect(maps[i], p.rect()));
      case 15:
        return check(evigrid_map_set_window(maps[i], p.rect()));
      case 16:
        return check(evigrid_map_protect(maps[i], p.rect()));
      case 17:
        check(evigrid_map_unprotect(maps[i]));
        return check(evigrid_map_advance_to(maps[i], p.whole()));
      case 18:
        for (auto& m : masses) m = {p.byte() / 255.0f, p.byte() / 255.0f, p.byte() / 255.0f, 0};
        return check(evigrid_map_write(maps[i], p.rect(), masses.data(), masses.size(), p.whole()));
      case 19:
        return check(evigrid_map_write_occupancy(maps[i], p.rect(), bytes.data(), bytes.size(), p.whole(), p.number()));
      case 20:
        return check(evigrid_map_merge(maps[i], views[p.byte() & 1], p.pose(), p.number(), &number));
      case 21: {
        std::array<evigrid_rect, 8> rects;
        std::size_t count = 0;
        return check(
            evigrid_view_changes(views[i], p.raw<std::uint8_t>(), rects.data(), rects.size(), &count, nullptr));
      }
      case 22: {  // a view is what its map was
        evigrid_view* now = nullptr;
        std::uint64_t a = 0, b = 1;
        if (evigrid_map_view(maps[i], &now) != EVIGRID_OK) return;
        check(evigrid_map_hash(maps[i], &a));
        check(evigrid_view_hash(now, &b));
        evigrid_view_destroy(now);
        if (a != b) broken();
        return;
      }
      default:
        for (float& f : floats) f = static_cast<float>(p.number());
    }
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Program program(data, size);
  Machine machine;
  machine.floats.fill(1.5f);
  for (int steps = 0; !program.ended() && steps < 200; ++steps) machine.step(program);
  return 0;
}
