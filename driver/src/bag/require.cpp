// SPDX-License-Identifier: Apache-2.0
#include "bag/bag.hpp"
#include "error.hpp"

namespace evigrid::driver {

void require_bags(const std::string& what) {
  if (bags_are_built()) return;
  throw InputError(what +
                   ": this evigrid was built without ROS bags; install librosbag-storage-dev, libnav-msgs-dev, "
                   "libsensor-msgs-dev and libtf2-msgs-dev and build again");
}

}  // namespace evigrid::driver
