// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "paper/runs.hpp"

namespace evigrid::driver {
namespace {

constexpr std::array kPapers{
    Paper{"hughes1992", "Ultrasonic robot localization using Dempster-Shafer theory", run_hughes1992},
    Paper{"asharif2001", "Environment mapping by Dempster-Shafer reasoning, for path planning", run_asharif2001},
    Paper{"li2006", "Sonar grid maps with DSmT and PCR5", run_li2006},
    Paper{"delafosse2007", "Incremental mapping by beacons, with a Dempster-Shafer fusion architecture",
          run_delafosse2007},
    Paper{"li2014", "SLAM and path planning of a mobile robot using DSmT", run_li2014},
};

}  // namespace

std::span<const Paper> papers() noexcept { return kPapers; }

}  // namespace evigrid::driver
