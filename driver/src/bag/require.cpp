// SPDX-License-Identifier: Apache-2.0
#include "bag/bag.hpp"
#include "error.hpp"

namespace evigrid::driver {

void require_bags(const std::string& what) {
  if (bags_are_built()) return;
  throw InputError(what +
                   ": this evigrid was built without ROS bags; install librosbag-storage-dev, libtf2-dev, "
                   "libnav-msgs-dev and libsensor-msgs-dev and build again");
}

void refuse_bag_options(const BagOptions& given) {
  const BagOptions none;
  const char* const option = given.base_frame != none.base_frame     ? "--base-frame"
                             : given.fixed_frame != none.fixed_frame ? "--fixed-frame"
                             : given.topics != none.topics           ? "--topics"
                                                                     : nullptr;
  if (option != nullptr) throw InputError(std::string(option) + ": is for ROS bags");
}

}  // namespace evigrid::driver
