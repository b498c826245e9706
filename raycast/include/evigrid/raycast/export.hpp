// SPDX-License-Identifier: Apache-2.0
// What a shared library shows: raycast is compiled with hidden symbols, and what these headers declare is visible.
#pragma once

/// Of a namespace block: everything declared in it is part of the library's interface.
#define EVIGRID_RAYCAST_API [[gnu::visibility("default")]]
