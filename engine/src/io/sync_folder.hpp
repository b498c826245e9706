// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>

namespace evigrid::io {

/// Brings the name of a file to the disk, as fsync does its bytes. Some file systems cannot; the file is whole either
/// way.
void sync_folder_of(const std::filesystem::path& file) noexcept;

}  // namespace evigrid::io
