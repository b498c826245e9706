// SPDX-License-Identifier: Apache-2.0
// Versions, names and the message of the last failure.
#include <cstdio>

#include "handles.hpp"

namespace {

thread_local char last_error[512] = "";

// Names are string literals: their views end with a zero.
template <class List>
const char* nth(const List& list, std::size_t i) noexcept {
  return i < list.size() ? evigrid::name(list[i]).data() : nullptr;
}

}  // namespace

evigrid_status evigrid::capi::fail(evigrid_status status, const char* message) noexcept {
  std::snprintf(last_error, sizeof last_error, "%s", message);
  return status;
}

const char* evigrid_last_error(void) { return last_error; }
const char* evigrid_version(void) { return EVIGRID_VERSION; }
int evigrid_maths_version(void) { return evigrid::kMathsVersion; }

const char* evigrid_status_name(evigrid_status status) {
  switch (status) {
    case EVIGRID_OK:
      return "ok";
    case EVIGRID_INVALID:
      return "invalid argument";
    case EVIGRID_LIMIT:
      return "memory cap";
    case EVIGRID_FILE:
      return "file";
    case EVIGRID_UNSUPPORTED:
      return "unsupported";
    case EVIGRID_MEMORY:
      return "out of memory";
    case EVIGRID_INTERNAL:
      return "internal error";
  }
  return "no status";
}

const char* evigrid_rule_name(size_t index) { return nth(evigrid::all_rules(), index); }
const char* evigrid_model_name(size_t index) { return nth(evigrid::all_models(), index); }
const char* evigrid_layer_name(size_t index) { return nth(evigrid::all_layers(), index); }
const char* evigrid_refusal_name(size_t index) {
  return index < evigrid::kRefusalCount ? evigrid::name(static_cast<evigrid::Refusal>(index)).data() : nullptr;
}
