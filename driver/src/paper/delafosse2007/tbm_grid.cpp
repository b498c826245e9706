// SPDX-License-Identifier: Apache-2.0
#include "paper/delafosse2007/tbm_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "evigrid/combine.hpp"

namespace evigrid::driver {
namespace {

double cross(raycast::Point o, raycast::Point a, raycast::Point b) {
  return (a.x_m - o.x_m) * (b.y_m - o.y_m) - (a.y_m - o.y_m) * (b.x_m - o.x_m);
}

/// Is p in the triangle, either way round?
bool in_triangle(raycast::Point p, raycast::Point a, raycast::Point b, raycast::Point c) {
  const double u = cross(a, b, p), v = cross(b, c, p), w = cross(c, a, p);
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

}  // namespace

TbmGrid::TbmGrid(const CellRect& rect, double cell_m) : rect_(rect), cell_m_(cell_m) {
  const auto n = static_cast<std::size_t>(rect.width * rect.height);
  e_.assign(n, 0), o_.assign(n, 0), u_.assign(n, 1), c_.assign(n, 0), k_.assign(n, 0);
}

void TbmGrid::fuse(const std::vector<std::size_t>& cells, float occupied, float empty, float nothing) {
  const std::size_t n = cells.size();
  if (n == 0) return;
  std::array<std::vector<float>, 5> a;
  for (auto& plane : a) plane.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    a[0][i] = e_[cells[i]], a[1][i] = o_[cells[i]], a[2][i] = u_[cells[i]], a[3][i] = c_[cells[i]];
  const std::vector<float> x(n, empty), y(n, occupied), v(n, 1 - empty - occupied - nothing), z(n, nothing);
  combine(Rule::conjunctive, Planes<const float>{a[0].data(), a[1].data(), a[2].data(), a[3].data()},
          Planes<const float>{x.data(), y.data(), v.data(), z.data()},
          Planes<float>{a[0].data(), a[1].data(), a[2].data(), a[3].data()}, a[4].data(), n);
  for (std::size_t i = 0; i < n; ++i) {
    e_[cells[i]] = a[0][i], o_[cells[i]] = a[1][i], u_[cells[i]] = a[2][i], c_[cells[i]] = a[3][i];
    k_[cells[i]] += a[4][i];
  }
}

void TbmGrid::fuse_box(Interval x, Interval y, const Existence& m) {
  const auto cell = [&](double v) { return static_cast<std::int64_t>(std::floor(v / cell_m_)); };
  std::vector<std::size_t> cells;
  for (std::int64_t iy = std::max(cell(y.low), rect_.y); iy <= std::min(cell(y.high), rect_.y + rect_.height - 1);
       ++iy) {
    for (std::int64_t ix = std::max(cell(x.low), rect_.x); ix <= std::min(cell(x.high), rect_.x + rect_.width - 1);
         ++ix)
      cells.push_back(index(ix, iy));
  }
  fuse(cells, static_cast<float>(m.yes), static_cast<float>(m.no), static_cast<float>(m.empty));
}

void TbmGrid::fuse_free(raycast::Point from, Interval x, Interval y, const Existence& m) {
  if (x.has(from.x_m) && y.has(from.y_m)) return;
  const std::array<raycast::Point, 4> corner{{{x.low, y.low}, {x.high, y.low}, {x.high, y.high}, {x.low, y.high}}};
  const double low_x = std::min(x.low, from.x_m), high_x = std::max(x.high, from.x_m),
               low_y = std::min(y.low, from.y_m), high_y = std::max(y.high, from.y_m);
  std::vector<std::size_t> cells;
  const auto cell = [&](double v) { return static_cast<std::int64_t>(std::floor(v / cell_m_)); };
  for (std::int64_t iy = std::max(cell(low_y), rect_.y); iy <= std::min(cell(high_y), rect_.y + rect_.height - 1);
       ++iy) {
    for (std::int64_t ix = std::max(cell(low_x), rect_.x); ix <= std::min(cell(high_x), rect_.x + rect_.width - 1);
         ++ix) {
      const bool meets = ix >= cell(x.low) && ix <= cell(x.high) && iy >= cell(y.low) && iy <= cell(y.high);
      if (meets) continue;
      const raycast::Point p{(static_cast<double>(ix) + 0.5) * cell_m_, (static_cast<double>(iy) + 0.5) * cell_m_};
      // The hull of a point and a box: the triangles from the point to the box's sides.
      bool inside = false;
      for (std::size_t k = 0; k < 4 && !inside; ++k) inside = in_triangle(p, from, corner[k], corner[(k + 1) % 4]);
      if (inside) cells.push_back(index(ix, iy));
    }
  }
  fuse(cells, static_cast<float>(m.no), static_cast<float>(m.yes), static_cast<float>(m.empty));
}

raycast::Point TbmGrid::gravity(raycast::Point at) const {
  const auto cx = static_cast<std::int64_t>(std::floor(at.x_m / cell_m_)),
             cy = static_cast<std::int64_t>(std::floor(at.y_m / cell_m_));
  double sum = 0, x = 0, y = 0;
  for (std::int64_t iy = cy - 2; iy <= cy + 2; ++iy) {
    for (std::int64_t ix = cx - 2; ix <= cx + 2; ++ix) {
      if (ix < rect_.x || iy < rect_.y || ix >= rect_.x + rect_.width || iy >= rect_.y + rect_.height) continue;
      const double m = o_[index(ix, iy)];
      sum += m, x += m * (static_cast<double>(ix) + 0.5), y += m * (static_cast<double>(iy) + 0.5);
    }
  }
  return sum > 0 ? raycast::Point{x / sum * cell_m_, y / sum * cell_m_} : at;
}

Layers TbmGrid::layers() const {
  Layers out;
  out.rect = rect_, out.cell_m = cell_m_;
  const std::size_t n = e_.size();
  out.planes.resize(4 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const float sum = e_[i] + o_[i] + u_[i];
    const bool vacuous = !(sum > 1e-6F);  // nothing but conflict is left: no opinion
    out.planes[i] = vacuous ? 0 : e_[i] / sum, out.planes[n + i] = vacuous ? 0 : o_[i] / sum;
    out.planes[2 * n + i] = vacuous ? 1 : u_[i] / sum, out.planes[3 * n + i] = k_[i];
  }
  return out;
}

}  // namespace evigrid::driver
