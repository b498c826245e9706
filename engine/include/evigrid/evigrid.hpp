// SPDX-License-Identifier: Apache-2.0
// Everything a robot includes (but bounded_queue.hpp, for hosts whose scans wait).
#pragma once
#include "evigrid/combine.hpp"
#include "evigrid/executor.hpp"
#include "evigrid/frame.hpp"
#include "evigrid/io.hpp"
#include "evigrid/joint.hpp"
#include "evigrid/journal.hpp"
#include "evigrid/map.hpp"
#include "evigrid/merge.hpp"
#include "evigrid/readout.hpp"
#include "evigrid/revisable.hpp"
#include "evigrid/revision.hpp"
#include "evigrid/scan.hpp"
#include "evigrid/sensor.hpp"
#include "evigrid/types.hpp"
#include "evigrid/version.hpp"
#include "evigrid/view.hpp"
