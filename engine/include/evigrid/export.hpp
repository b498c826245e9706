// SPDX-License-Identifier: Apache-2.0
// What a shared library shows: the engine is compiled with hidden symbols, and what these headers declare is visible.
#pragma once

/// Of a namespace block: everything declared in it is part of the library's interface.
#define EVIGRID_API [[gnu::visibility("default")]]
/// Takes one class of such a block out again: it is the library's own.
#define EVIGRID_LOCAL [[gnu::visibility("hidden")]]
