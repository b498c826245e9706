// SPDX-License-Identifier: Apache-2.0
// Whether the loops over long arrays fetch ahead by instruction. No bit of a result depends on it.
#pragma once

namespace evigrid::kernels {

/// True on Intel's processors, whose prefetchers leave a seventh of the memory's speed unused over six streams; on
/// AMD's (Zen 5) the same instructions cost a tenth of it. Measured: docs/decisions.md.
bool fetches_ahead() noexcept;

}  // namespace evigrid::kernels
