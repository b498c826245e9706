// SPDX-License-Identifier: Apache-2.0
// The file that cold tiles are paged to: without a name, so that it goes with the process however that ends. A tile's
// bytes are written to it, then mapped from it over the memory where they lay: whoever reads there, views in other
// threads among them, goes on reading the same bytes at the same place, and the system may drop and fetch them.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace evigrid {

class PageFile {
 public:
  /// Throws std::system_error naming the directory.
  explicit PageFile(const std::filesystem::path& directory);
  ~PageFile();
  PageFile(const PageFile&) = delete;
  PageFile& operator=(const PageFile&) = delete;

  static constexpr std::size_t kExtent = std::size_t{2} << 20;  ///< bytes: one block of tile memory
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};
  /// Where an extent begins in the file. Throws std::bad_alloc.
  std::uint64_t take_extent();
  void give_back_extent(std::uint64_t) noexcept;

  /// What lies at `at` is from now on the file's at `offset`, read-only; both and bytes are multiples of the system's
  /// page. Throws std::system_error, naming the directory, when the file cannot be written or mapped: nothing has
  /// changed then.
  void page_out(void* at, std::size_t bytes, std::uint64_t offset);
  /// Memory again at `at`, not set, and the file's part of it given back. False when the system refuses: what is there
  /// stays mapped and must not be used again.
  bool take_back(void* at, std::size_t bytes, std::uint64_t offset) noexcept;
  /// Whether the system can do this with pieces of so many bytes.
  [[nodiscard]] static bool possible(std::size_t bytes) noexcept;

 private:
  [[noreturn]] void fail(const char* what, int error) const;
  std::string directory_;
  int file_ = -1;
  std::uint64_t end_ = 0;
  std::vector<std::uint64_t> free_;
};

}  // namespace evigrid
