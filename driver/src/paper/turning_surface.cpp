// SPDX-License-Identifier: Apache-2.0
// The same projection as picture/surface.cpp. A height field in parallel projection needs no sorting: quads are drawn
// from the far corner to the near one.
#include "paper/turning_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "paper/page.hpp"
#include "picture/heights.hpp"
#include "picture/ramp.hpp"

namespace evigrid::driver {
namespace {

constexpr int kMostBlocks = 120;  // 14 400 quads: a turn stays smooth
constexpr std::byte kNeverSeen{255};
constexpr int kTop = 250;  // of bel = 1 in the data

constexpr std::string_view kScript = R"JS(
(function () {
  'use strict';
  const root = document.getElementById(spec.id), canvas = root.querySelector('canvas'), pen = canvas.getContext('2d');
  const nx = spec.x.length, ny = spec.y.length, bytes = atob(spec.z), halfX = spec.x[nx - 1], halfY = spec.y[ny - 1];
  const start = { azimuth: -0.61, elevation: 0.66, zoom: 1 };
  let view = Object.assign({}, start), grip = null;
  const height = i => { const v = bytes.charCodeAt(i); return v === 255 ? 0 : v / 250; };
  function projector(w, h) {
    const ca = Math.cos(view.azimuth), sa = Math.sin(view.azimuth), ce = Math.cos(view.elevation), se = Math.sin(view.elevation);
    const scale = 0.78 * Math.min(w, 1.6 * h) * view.zoom / Math.max(1, 0.9 * (halfX + halfY) * 1.41);
    return (x, y, z) => [w / 2 + (x * ca - y * sa) * scale,
                         h / 2 + 0.04 * h - ((x * sa + y * ca) * se + z * spec.up * ce) * scale];
  }
  function shade(colour, light) { return 'rgb(' + colour.map(v => Math.round(v * light)).join(',') + ')'; }
  function draw() {
    const ratio = window.devicePixelRatio || 1, w = canvas.clientWidth, h = canvas.clientHeight;
    if (canvas.width !== Math.round(w * ratio) || canvas.height !== Math.round(h * ratio)) {
      canvas.width = Math.round(w * ratio), canvas.height = Math.round(h * ratio);
    }
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.fillStyle = '#fff', pen.fillRect(0, 0, w, h);
    const at = projector(w, h), ca = Math.cos(view.azimuth), sa = Math.sin(view.azimuth);
    const farX = sa > 0 ? halfX : -halfX, farY = ca > 0 ? halfY : -halfY;  // the corner away from the eye
    const path = (points, fill, line) => {
      pen.beginPath();
      points.forEach((p, i) => i ? pen.lineTo(p[0], p[1]) : pen.moveTo(p[0], p[1]));
      pen.closePath();
      if (fill) pen.fillStyle = fill, pen.fill();
      pen.strokeStyle = line || fill, pen.lineWidth = line ? 1 : 0.6, pen.stroke();
    };
    path([at(-halfX, farY, 0), at(halfX, farY, 0), at(halfX, farY, 1), at(-halfX, farY, 1)], '#f3f3f3', '#d0d0d0');
    path([at(farX, -halfY, 0), at(farX, halfY, 0), at(farX, halfY, 1), at(farX, -halfY, 1)], '#f3f3f3', '#d0d0d0');
    path([at(-halfX, farY, 0.5), at(halfX, farY, 0.5)], null, '#d0d0d0');
    path([at(farX, -halfY, 0.5), at(farX, halfY, 0.5)], null, '#d0d0d0');
    const light = [-0.45, -0.35, 0.82];
    for (let a = 0; a + 1 < ny; ++a) {
      const j = ca > 0 ? ny - 2 - a : a;
      for (let b = 0; b + 1 < nx; ++b) {
        const i = sa > 0 ? nx - 2 - b : b, k = [j * nx + i, j * nx + i + 1, (j + 1) * nx + i + 1, (j + 1) * nx + i];
        const z = k.map(height), seen = k.some(n => bytes.charCodeAt(n) !== 255);
        const gx = -0.5 * spec.up * (z[1] + z[2] - z[0] - z[3]) / (spec.x[i + 1] - spec.x[i]);
        const gy = -0.5 * spec.up * (z[2] + z[3] - z[0] - z[1]) / (spec.y[j + 1] - spec.y[j]);
        const lit = (gx * light[0] + gy * light[1] + light[2]) / Math.sqrt(gx * gx + gy * gy + 1) / light[2];
        const mean = (z[0] + z[1] + z[2] + z[3]) / 4, t = Math.round(mean * (spec.ramp.length - 1));
        path([at(spec.x[i], spec.y[j], z[0]), at(spec.x[i + 1], spec.y[j], z[1]), at(spec.x[i + 1], spec.y[j + 1], z[2]),
              at(spec.x[i], spec.y[j + 1], z[3])],
             shade(seen ? spec.ramp[t] : [196, 196, 196], 0.62 + 0.38 * Math.max(0, Math.min(1, lit))));
      }
    }
    pen.fillStyle = '#1c2430', pen.font = '13px system-ui, sans-serif', pen.textAlign = 'center', pen.textBaseline = 'middle';
    const label = (x, y, z, text, dx, dy) => { const p = at(x, y, z); pen.fillText(text, p[0] + dx, p[1] + dy); };
    const px = 1.09 * -farX, py = 1.09 * -farY;
    label(-0.9 * halfX, py, 0, spec.from[0], 0, 8), label(0.9 * halfX, py, 0, spec.to[0], 0, 8), label(0, py, 0, 'x, m', 0, 10);
    label(px, -0.9 * halfY, 0, spec.from[1], 0, 8), label(px, 0.9 * halfY, 0, spec.to[1], 0, 8), label(px, 0, 0, 'y, m', 0, 10);
    const left = at(farX, -farY, 0)[0] < at(-farX, farY, 0)[0] ? [farX, -farY] : [-farX, farY];
    [0, 0.5, 1].forEach(z => label(left[0], left[1], z, String(z), -16, 0));
    label(left[0], left[1], 1, 'bel(occupied)', 0, -18);
  }
  let waiting = false;
  const redraw = () => { if (!waiting) waiting = true, requestAnimationFrame(() => { waiting = false; draw(); }); };
  const turn = (dx, dy) => {
    view.azimuth += dx, view.elevation = Math.max(0.05, Math.min(Math.PI / 2, view.elevation + dy)), redraw();
  };
  const zoom = by => { view.zoom = Math.max(0.4, Math.min(6, view.zoom * by)), redraw(); };
  canvas.addEventListener('pointerdown', e => { grip = [e.clientX, e.clientY]; canvas.setPointerCapture(e.pointerId); });
  canvas.addEventListener('pointermove', e => {
    if (!grip) return;
    turn((e.clientX - grip[0]) * 0.008, (e.clientY - grip[1]) * 0.006), grip = [e.clientX, e.clientY];
  });
  ['pointerup', 'pointercancel'].forEach(n => canvas.addEventListener(n, () => { grip = null; }));
  canvas.addEventListener('wheel', e => { e.preventDefault(), zoom(Math.exp(-e.deltaY * 0.001)); }, { passive: false });
  canvas.addEventListener('dblclick', () => { view = Object.assign({}, start), redraw(); });
  canvas.addEventListener('keydown', e => {
    const step = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.06], ArrowDown: [0, 0.06] }[e.key];
    if (step) e.preventDefault(), turn(step[0], step[1]);
    if (e.key === '+') zoom(1.15);
    if (e.key === '-') zoom(1 / 1.15);
  });
  window.addEventListener('resize', redraw);
  draw();
})();
)JS";

std::string numbers(const std::vector<double>& v) {
  std::string out;
  for (const double x : v) out += fmt::format("{}{:.5g}", out.empty() ? "" : ",", x);
  return out;
}

}  // namespace

std::string turning_surface(const Layers& layers, const std::string& id) {
  const Heights h = heights_of(layers, kMostBlocks);
  std::vector<std::byte> z(h.bel.size());
  for (std::size_t i = 0; i < z.size(); ++i) {
    z[i] = h.seen[i] ? static_cast<std::byte>(std::lround(kTop * std::clamp(h.bel[i], 0.0F, 1.0F))) : kNeverSeen;
  }
  std::string ramp;
  for (int i = 0; i <= 32; ++i) {
    const Rgb c = colour_of(Ramp::viridis, i / 32.0);
    ramp += fmt::format("{}[{},{},{}]", i == 0 ? "" : ",", c.r, c.g, c.b);
  }
  const auto edge = [&](std::int64_t cells) {
    return fmt::format("{:.4g}", static_cast<double>(cells) * layers.cell_m);
  };
  const CellRect& r = layers.rect;
  return fmt::format(
      "<div id=\"{0}\"><canvas tabindex=\"0\" role=\"img\" aria-label=\"surface of bel(occupied); arrow keys turn it\" "
      "style=\"width:100%;height:30rem;touch-action:none;cursor:grab;border:1px solid #d9dee5\"></canvas></div>"
      "<script>(function () {{ const spec = {{id: '{0}', up: 0.22, x: [{1}], y: [{2}], z: '{3}', ramp: [{4}], "
      "from: ['{5}', '{6}'], to: ['{7}', '{8}']}};{9}}})();</script>",
      id, numbers(h.x), numbers(h.y), base64(z), ramp, edge(r.x), edge(r.y), edge(r.x + r.width), edge(r.y + r.height),
      kScript);
}

}  // namespace evigrid::driver
