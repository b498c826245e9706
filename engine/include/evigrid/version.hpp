// SPDX-License-Identifier: Apache-2.0
#pragma once
#define EVIGRID_VERSION_MAJOR 0
#define EVIGRID_VERSION_MINOR 1
#define EVIGRID_VERSION_PATCH 0
#define EVIGRID_VERSION "0.1.0"
