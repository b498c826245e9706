// SPDX-License-Identifier: Apache-2.0
// The public face: parameters checked, kernels chosen once, everything else handed on.
#include "evigrid/map.hpp"

#include <stdexcept>

#include "combine_blocks.hpp"
#include "device/device_map.hpp"
#include "evigrid/combine.hpp"
#include "evigrid/view.hpp"
#include "grid/readout.hpp"
#include "grid/rect.hpp"
#include "grid/tile_catalog.hpp"
#include "grid/view_state.hpp"
#include "integrate.hpp"
#include "io/map_access.hpp"
#include "life/edit.hpp"
#include "life/known_areas.hpp"
#include "params/table.hpp"
#include "scratch.hpp"

namespace evigrid {

struct Map::Impl {
  MapParams params;
  const kernels::KernelTable* table;
  std::shared_ptr<Executor> executor;
  TileStore store;
  ChangeLog changes;
  Cataloguer cataloguer;
  std::vector<CompiledSensor> compiled;
  std::shared_ptr<const std::vector<Sensor>> sensors = std::make_shared<const std::vector<Sensor>>();  // views keep it
  std::vector<std::uint64_t> tiles_per_worker;
  Scratch scratch;
  Admission admission;
  std::unique_ptr<DeviceMap> device;  // kernel cuda alone
  std::string kernel_note;

  Impl(const MapParams& p, std::shared_ptr<Executor> e)
      : params(p),
        table(&table_of(p.kernel)),
        executor(e ? std::move(e) : std::shared_ptr<Executor>(make_tbb_executor())),
        store(cell_layout(p, *table), p.memory_cap_bytes),
        tiles_per_worker(static_cast<std::size_t>(executor->concurrency())) {
    if (p.kernel != Kernel::cuda) return;
    try {
      device = std::make_unique<DeviceMap>(kernels::make_cuda_device());
    } catch (const kernels::DeviceError& failed) {
      kernel_note = std::string(failed.what()) + "; the map is made on the processor";
    }
  }
  [[nodiscard]] Pipeline pipeline() noexcept {
    return {params,           *table,    compiled, store,   changes,     *executor,
            tiles_per_worker, admission, false,    &device, &kernel_note};
  }
  // Cells that a device alone knows come home to who reads them, or changes them on the host.
  [[nodiscard]] const TileStore& whole() {
    if (device) device->come_home(store, nullptr);
    return store;
  }
  [[nodiscard]] const TileStore& part(const CellRect& rect) {
    if (!device || !device->any_away() || rect.empty() || !is_near(rect)) return store;
    const TileRect tiles = tiles_of(rect);
    device->come_home(store, &tiles);
    return store;
  }
  [[nodiscard]] CellState cell(CellIndex c) { return read_cell(part({c.x, c.y, 1, 1}), c); }
  [[nodiscard]] TileStore& to_be_changed() {
    if (device) device->come_home(store, *executor);
    return store;
  }
  [[nodiscard]] Grid grid() { return {params, to_be_changed(), changes}; }

  template <class T>
  void render(const kernels::CostArgs& args, CellRect rect, std::span<T> out, std::ptrdiff_t stride) {
    if (device && device->any_away()) {
      if (const auto known = device->costs(store, args))
        return render_costmap(store, args, rect, out, stride, known.get());
    }
    render_costmap(part(rect), args, rect, out, stride);
  }
};

Map::Map(const MapParams& params, std::shared_ptr<Executor> executor) {
  if (const auto errors = check(params); !errors.empty()) throw std::invalid_argument(describe(errors));
  if (!kernel_available(params.kernel)) {
    throw std::invalid_argument("map.kernel " + std::string(name(params.kernel)) + " cannot run here" +
                                (params.kernel == Kernel::cuda ? ": " + kernels::why_no_cuda() : ""));
  }
  impl_ = std::make_unique<Impl>(params, std::move(executor));
}
Map::~Map() = default;
Map::Map(Map&&) noexcept = default;
Map& Map::operator=(Map&&) noexcept = default;

SensorId Map::add(const Sensor& sensor) {
  auto errors = check(sensor);
  if (errors.empty()) errors = check_pair(impl_->params.rule, sensor);
  if (errors.empty()) errors = check_reach(sensor, impl_->params.cell_m);
  if (!errors.empty()) throw std::invalid_argument(describe(errors));
  auto all = std::make_shared<std::vector<Sensor>>(*impl_->sensors);
  all->push_back(sensor);
  impl_->compiled.emplace_back(sensor, impl_->params.cell_m);  // the last that may throw
  impl_->sensors = std::move(all);
  return static_cast<SensorId>(impl_->sensors->size() - 1);
}

Report Map::integrate(const Scan& scan) { return integrate(std::span<const Scan>(&scan, 1)); }
Report Map::integrate(std::span<const Scan> scans) {
  return evigrid::integrate(impl_->pipeline(), impl_->scratch, scans);
}

Report Map::undo(const Scan& scan) { return undo(std::span<const Scan>(&scan, 1)); }
Report Map::undo(std::span<const Scan> scans) {
  Impl& m = *impl_;
  if (!state_is_sum(m.params.rule)) {
    throw std::logic_error("undo: a map of the rule " + std::string(name(m.params.rule)) +
                           " cannot take a scan back: its cells are no sums (a RevisableMap can)");
  }
  Pipeline back = m.pipeline();
  back.undo = true;
  return evigrid::integrate(back, m.scratch, scans);
}

void Map::advance_to(std::int64_t stamp_ns) noexcept {
  if (impl_->params.decay_s > 0 && stamp_ns > impl_->store.now_ns) impl_->store.now_ns = stamp_ns;
}

Mass Map::mass(CellIndex c) const { return impl_->cell(c).mass; }
float Map::conflict(CellIndex c) const { return impl_->cell(c).conflict; }
float Map::con(CellIndex c) const { return impl_->cell(c).con; }
float Map::last_conflict(CellIndex c) const { return impl_->cell(c).last_conflict; }
CellIndex Map::cell_at(double x_m, double y_m) const noexcept { return cell_of(x_m, y_m, impl_->params.cell_m); }
CellRect Map::bounds() const { return occupied_bounds(impl_->whole()); }
void Map::render(Layer layer, CellRect rect, std::span<float> out, std::ptrdiff_t stride,
                 const ReadOutParams& params) const {
  render_layer(impl_->part(rect), layer, params, rect, out, stride);
}
void Map::render(const Costmap& c, CellRect rect, std::span<std::int8_t> out, std::ptrdiff_t stride) const {
  impl_->render(occupancy_args(c), rect, out, stride);
}
void Map::render(const Costmap& c, CellRect rect, std::span<std::uint8_t> out, std::ptrdiff_t stride) const {
  impl_->render(cost_args(c), rect, out, stride);
}
std::uint64_t Map::version() const noexcept { return impl_->changes.version(); }
Changes Map::changes(std::uint64_t since) const { return impl_->changes.since(since); }
std::uint64_t Map::hash() const { return hash_cells(impl_->whole()); }

MapView Map::view() {
  Impl& m = *impl_;
  auto catalog = m.cataloguer.bring_up_to_date(m.to_be_changed(), m.changes);
  return MapView(std::make_shared<const ViewState>(
      m.store, std::move(catalog), ViewState::Facts{m.params, m.sensors, m.changes.losses(), m.admission}));
}

void Map::page_to(const std::filesystem::path& directory) { impl_->to_be_changed().page_to(directory); }
std::size_t Map::paged_bytes() const noexcept { return impl_->store.paged_bytes(); }

void Map::clear() {
  impl_->store.clear();
  if (impl_->device) impl_->device->forget();
  impl_->changes.clear();
}
void Map::clear(CellRect rect) {
  require_near("clear", rect);
  forget(impl_->grid(), rect);
}
void Map::set_window(CellRect window) {
  require_near("set_window", window);
  impl_->admission.window.reset();
  if (window.empty()) return;
  impl_->admission.window = tiles_of(window);
  drop_outside({impl_->params, impl_->store, impl_->changes}, *impl_->admission.window);  // which reads no cell
}
void Map::protect(CellRect area) {
  require_near("protect", area);
  if (area.empty()) return;
  freeze(impl_->grid(), area);
  impl_->admission.guarded.push_back(area);
}
void Map::unprotect() { impl_->admission.guarded.clear(); }
std::span<const CellRect> Map::protected_areas() const noexcept { return impl_->admission.guarded; }
void Map::write(CellRect rect, std::span<const Mass> masses, std::ptrdiff_t stride) {
  write_masses(impl_->grid(), rect, masses, stride);
}
void Map::write(CellRect rect, std::span<const std::int8_t> occupancy, std::ptrdiff_t stride, double certainty) {
  write_occupancy(impl_->grid(), rect, occupancy, stride, certainty);
}
void Map::write(std::span<const Point2> polygon, const Mass& mass) { write_polygon(impl_->grid(), polygon, mass); }

const MapParams& Map::params() const noexcept { return impl_->params; }
std::span<const Sensor> Map::sensors() const noexcept { return *impl_->sensors; }
std::string_view Map::kernel_name() const noexcept { return impl_->device ? "cuda" : impl_->table->name; }
std::string_view Map::kernel_note() const noexcept { return impl_->kernel_note; }
std::string_view Map::executor_name() const noexcept { return impl_->executor->name(); }
std::span<const std::uint64_t> Map::tiles_per_worker() const noexcept { return impl_->tiles_per_worker; }
std::size_t Map::tiles() const noexcept { return impl_->store.size(); }
std::size_t Map::memory_bytes() const noexcept { return impl_->store.bytes(); }

const TileSource& MapAccess::source(const Map& m) { return m.impl_->whole(); }
TileStore& MapAccess::store(Map& m) { return m.impl_->to_be_changed(); }
ChangeLog& MapAccess::changes(Map& m) noexcept { return m.impl_->changes; }
Admission& MapAccess::admission(Map& m) noexcept { return m.impl_->admission; }
const Admission& MapAccess::admission(const Map& m) noexcept { return m.impl_->admission; }
Scratch& MapAccess::scratch(Map& m) noexcept { return m.impl_->scratch; }
const Scratch& MapAccess::scratch(const Map& m) noexcept { return m.impl_->scratch; }
Pipeline MapAccess::pipeline(Map& m) noexcept { return m.impl_->pipeline(); }
std::int64_t& MapAccess::last_stamp_ns(Map& m) noexcept { return m.impl_->store.now_ns; }
std::int64_t MapAccess::last_stamp_ns(const Map& m) noexcept { return m.impl_->store.now_ns; }
void MapAccess::use_device(Map& m, std::unique_ptr<DeviceMap> device) { m.impl_->device = std::move(device); }
DeviceMap* MapAccess::device(Map& m) noexcept { return m.impl_->device.get(); }
Executor& MapAccess::executor(const Map& m) noexcept { return *m.impl_->executor; }

}  // namespace evigrid
