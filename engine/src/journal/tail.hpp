// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <span>

namespace evigrid::journal {

/// Whether the bytes of a file from a record on that cannot be read are what a process or a machine that died was
/// writing: a record that was cut short, or of which the rest never reached the disk. Otherwise they are damage.
bool is_torn_tail(std::span<const std::byte> left);

}  // namespace evigrid::journal
