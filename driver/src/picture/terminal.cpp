// SPDX-License-Identifier: Apache-2.0
#include "picture/terminal.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "error.hpp"
#include "picture/map_picture.hpp"

namespace evigrid::driver {
namespace {

constexpr std::string_view kSteps = ".:-=+*#%@";  // nine, from nothing to all

Rgb colour_at(Look look, const Layers& l, std::size_t i, double top) {
  if (look == Look::mixed) return cell_colour(l.e()[i], l.o()[i], l.u()[i], l.conflict()[i]);
  if (look == Look::composite) return composite_grey(l.e()[i], l.o()[i], l.u()[i]);
  return never_seen(l, i) ? kNeverSeen : colour_of(*row_of(look).ramp, value_of(look, l, i) / top);
}

char letter_at(Look look, const Layers& l, std::size_t i, double top) {
  if (never_seen(l, i)) return ' ';
  if (!row_of(look).ramp) {
    const float e = l.e()[i], o = l.o()[i];
    return std::min(e, o) > 0.25F ? '?' : o > 0.5F ? '#' : e > 0.5F ? '.' : ':';
  }
  const double part = std::clamp(value_of(look, l, i) / top, 0.0, 1.0);
  return kSteps[static_cast<std::size_t>(std::lround(part * static_cast<double>(kSteps.size() - 1)))];
}

std::string key_of(Look look, double top) {
  if (!row_of(look).ramp) return "# occupied  . empty  : undecided  ? conflict  (blank) never seen";
  return fmt::format("{}: 0 '{}' to {:g} '{}', (blank) never seen", row_of(look).title, kSteps, top, kSteps.back());
}

std::string letters(Look look, const Layers& l, double top) {
  std::string out;
  for (std::int64_t y = l.rect.height - 1; y >= 0; y -= 2) {  // a letter is twice as high as wide
    std::string line;
    for (std::int64_t x = 0; x < l.rect.width; ++x) {
      const auto at = [&](std::int64_t row) { return static_cast<std::size_t>(row * l.rect.width + x); };
      const std::size_t upper = at(y), lower = at(std::max<std::int64_t>(y - 1, 0));
      line += letter_at(look, l, l.o()[lower] > l.o()[upper] || never_seen(l, upper) ? lower : upper, top);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
  }
  return out + key_of(look, top) + '\n';
}

std::string half_blocks(Look look, const Layers& l, double top) {
  fmt::memory_buffer out;
  auto to = std::back_inserter(out);
  for (std::int64_t y = l.rect.height - 1; y >= 0; y -= 2) {
    std::optional<Rgb> front, back;  // what the terminal paints with: sent again only when it changes
    for (std::int64_t x = 0; x < l.rect.width; ++x) {
      const Rgb up = colour_at(look, l, static_cast<std::size_t>(y * l.rect.width + x), top);
      if (front != up) fmt::format_to(to, "\x1b[38;2;{};{};{}m", up.r, up.g, up.b);
      front = up;
      if (y > 0) {
        const Rgb low = colour_at(look, l, static_cast<std::size_t>((y - 1) * l.rect.width + x), top);
        if (back != low) fmt::format_to(to, "\x1b[48;2;{};{};{}m", low.r, low.g, low.b);
        back = low;
      }
      fmt::format_to(to, "\u2580");
    }
    fmt::format_to(to, "\x1b[0m\n");
  }
  const auto swatch = [&](Rgb c, std::string_view label) {
    fmt::format_to(to, "\x1b[48;2;{};{};{}m  \x1b[0m {}  ", c.r, c.g, c.b, label);
  };
  if (row_of(look).ramp) {
    for (int i = 0; i <= 4; ++i) swatch(colour_of(*row_of(look).ramp, i / 4.0), fmt::format("{:.3g}", top * i / 4));
    swatch(kNeverSeen, fmt::format("never seen   {}", row_of(look).title));
  } else {
    const auto pure = [&](float e, float o, float u, float k) {
      return look == Look::composite ? composite_grey(e, o, u) : cell_colour(e, o, u, k);
    };
    swatch(pure(1, 0, 0, 0), "empty");
    swatch(pure(0, 1, 0, 0), "occupied");
    swatch(pure(0, 0, 1, 0), "unknown");
    if (look == Look::mixed) swatch(pure(0.5F, 0.5F, 0, 3), "conflict");
  }
  out.push_back('\n');
  return fmt::to_string(out);
}

}  // namespace

Layers coarse(const Layers& in, std::int64_t block) {
  Layers out;
  out.rect = {0, 0, (in.rect.width + block - 1) / block, (in.rect.height + block - 1) / block};
  out.cell_m = in.cell_m * static_cast<double>(block);
  const std::size_t n = out.cells();
  out.paradox = in.paradox, out.con = in.con, out.last_conflict = in.last_conflict;
  out.planes.resize(in.count() * n);
  for (std::int64_t y = 0; y < out.rect.height; ++y) {
    for (std::int64_t x = 0; x < out.rect.width; ++x) {
      double sum[4] = {0, 0, 0, 0}, cells = 0;
      float most[4] = {0, 0, 1, 0}, history[3] = {0, 0, 0};
      bool first = true;
      for (std::int64_t j = y * block; j < std::min((y + 1) * block, in.rect.height); ++j) {
        for (std::int64_t i = x * block; i < std::min((x + 1) * block, in.rect.width); ++i) {
          const auto at = static_cast<std::size_t>(j * in.rect.width + i);
          const Mass m = in.mass(at);
          const float masses[4] = {m.e, m.o, m.u, m.c};
          for (int k = 0; k < 4; ++k) sum[k] += masses[k];
          if (first || masses[1] > most[1]) std::copy(masses, masses + 4, most);
          first = false;
          const float met[3] = {in.conflict()[at], in.optional(in.con, at), in.optional(in.last_conflict, at)};
          for (int k = 0; k < 3; ++k) history[k] = std::max(history[k], met[k]);
          cells += 1;
        }
      }
      const auto to = static_cast<std::size_t>(y * out.rect.width + x);
      const int mass_planes[4] = {0, 1, 2, in.paradox}, history_planes[3] = {3, in.con, in.last_conflict};
      const auto put = [&](int plane, float value) {
        if (plane >= 0) out.planes[static_cast<std::size_t>(plane) * n + to] = value;
      };
      for (int k = 0; k < 4; ++k)
        put(mass_planes[k], most[1] > 0.5F ? most[k] : static_cast<float>(sum[k] / cells));
      for (int k = 0; k < 3; ++k) put(history_planes[k], history[k]);
    }
  }
  return out;
}

std::string terminal_picture(Look look, const Layers& layers, int columns, bool colour) {
  if (look == Look::panels || look == Look::surface)
    throw InputError(fmt::format("{}: is a picture only: name a file with -o", row_of(look).name));
  const std::int64_t room = std::max(columns, 10);
  const std::int64_t block = std::max<std::int64_t>(1, (layers.rect.width + room - 1) / room);
  const Layers small = coarse(layers, block);
  const double top = top_of(look, small);
  const double x_m = static_cast<double>(layers.rect.x) * layers.cell_m,
               y_m = static_cast<double>(layers.rect.y) * layers.cell_m;
  return (colour ? half_blocks(look, small, top) : letters(look, small, top)) +
         fmt::format("x {:.2f} to {:.2f} m, y {:.2f} to {:.2f} m; a character is {:.3g} x {:.3g} m\n", x_m,
                     x_m + static_cast<double>(layers.rect.width) * layers.cell_m, y_m,
                     y_m + static_cast<double>(layers.rect.height) * layers.cell_m, small.cell_m, 2 * small.cell_m);
}

int terminal_columns() {
  winsize size{};
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

bool on_terminal() { return ::isatty(STDOUT_FILENO) == 1; }

}  // namespace evigrid::driver
