// SPDX-License-Identifier: Apache-2.0
// What the opaque handles are, and the one place where exceptions become status codes.
#pragma once
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "evigrid.h"
#include "evigrid/evigrid.hpp"

struct evigrid_params {
  evigrid::MapParams map{};
  std::string executor = "tbb";
  int threads = 0;
  bool kernel_asked = false, cap_asked = false;  // what load() takes instead of the file's

  [[nodiscard]] std::shared_ptr<evigrid::Executor> make_executor() const {
    return evigrid::make_executor(executor, threads);
  }
};
struct evigrid_sensor {
  evigrid::Sensor sensor;
};
struct evigrid_map {
  evigrid::Map map;
};
struct evigrid_view {
  evigrid::MapView view;
};

namespace evigrid::capi {

/// Keeps the message for evigrid_last_error(); never throws.
evigrid_status fail(evigrid_status, const char* message) noexcept;

/// Runs f and turns what it throws into a status and a message.
template <class F>
evigrid_status guarded(F&& f) noexcept {
  try {
    std::forward<F>(f)();
    return EVIGRID_OK;
  } catch (const MapFileError& e) {
    return fail(EVIGRID_FILE, e.what());
  } catch (const std::invalid_argument& e) {
    return fail(EVIGRID_INVALID, e.what());
  } catch (const std::length_error& e) {
    return fail(EVIGRID_LIMIT, e.what());
  } catch (const std::logic_error& e) {
    return fail(EVIGRID_UNSUPPORTED, e.what());
  } catch (const std::system_error& e) {  // of a page file
    return fail(EVIGRID_FILE, e.what());
  } catch (const std::bad_alloc&) {
    return fail(EVIGRID_MEMORY, "the system gave no memory");
  } catch (const std::exception& e) {
    return fail(EVIGRID_INTERNAL, e.what());
  } catch (...) {
    return fail(EVIGRID_INTERNAL, "an exception that is none of ours");
  }
}

/// Throws std::invalid_argument naming the parameter.
template <class T>
T& need(T* p, const char* name) {
  if (p == nullptr) throw std::invalid_argument(std::string(name) + " is NULL");
  return *p;
}

inline Pose2 pose(const evigrid_pose& p) noexcept { return {p.x_m, p.y_m, p.yaw_rad}; }
inline CellRect rect(const evigrid_rect& r) noexcept { return {r.x, r.y, r.width, r.height}; }
inline evigrid_rect rect(const CellRect& r) noexcept { return {r.x, r.y, r.width, r.height}; }

}  // namespace evigrid::capi
