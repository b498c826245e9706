// SPDX-License-Identifier: Apache-2.0
// Where the bytes of a map file come from: memory, or a file of which only the part asked for is read.
#pragma once
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "evigrid/io.hpp"

namespace evigrid::io {

class Source {
 public:
  Source(std::span<const std::byte> bytes, std::string_view source_name)
      : name_(source_name), size_(bytes.size()), memory_(bytes) {}
  explicit Source(const std::filesystem::path& path) : name_(path.string()) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) fail("is a folder, not a map");
    errno = 0;
    file_.open(path, std::ios::binary | std::ios::ate);
    if (!file_) fail(std::string("cannot be opened: ") + std::strerror(errno));
    size_ = static_cast<std::uint64_t>(file_.tellg());
  }
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
  /// The caller has checked the range against size(). Valid until the next call.
  std::span<const std::byte> read(std::uint64_t at, std::size_t n) {
    taken_ += n;
    if (!file_.is_open()) return memory_.subspan(static_cast<std::size_t>(at), n);
    buffer_.resize(n);
    file_.seekg(static_cast<std::streamoff>(at));
    file_.read(reinterpret_cast<char*>(buffer_.data()), static_cast<std::streamsize>(n));
    if (!file_) fail("cannot be read");
    return buffer_;
  }
  [[nodiscard]] std::uint64_t bytes_read() const noexcept { return taken_; }
  [[noreturn]] void fail(const std::string& reason) const { throw MapFileError(name_, reason); }

 private:
  std::string name_;
  std::uint64_t size_ = 0, taken_ = 0;
  std::span<const std::byte> memory_;
  std::ifstream file_;
  std::vector<std::byte> buffer_;
};

}  // namespace evigrid::io
