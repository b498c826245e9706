// SPDX-License-Identifier: Apache-2.0
// The list of formats, in the order in which a file is tried.
#include "log/formats.hpp"

namespace evigrid::driver {

std::span<const Format* const> all_formats() {
  static constexpr const Format* kAll[] = {&kCarmen,   &kRing8, &kWean,    &kLego, &kBigWheelBot,
                                           &kRoomba12, &kUci24, &kEnmt482, &kCast};
  return kAll;
}

}  // namespace evigrid::driver
