// SPDX-License-Identifier: Apache-2.0
// The file that cold tiles are paged to: without a name, so that it goes with the process however that ends. A tile's
// bytes are written to it, then mapped from it over the memory where they lay: whoever reads there, views in other
// threads among them, goes on reading the same bytes at the same place, and the system may drop and fetch them.
// A forked child shares the file with its parent: it may read, and frees what it likes, but the file is its parent's.
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
  /// changed then; so it does in a forked child.
  void page_out(void* at, std::size_t bytes, std::uint64_t offset);
  /// Memory again at `at`, not set, and the file's part of it given back. False when the system refuses: what is there
  /// stays mapped and must not be used again.
  bool take_back(void* at, std::size_t bytes, std::uint64_t offset) noexcept;
  /// Whether the system can do this with pieces of so many bytes.
  [[nodiscard]] static bool possible(std::size_t bytes) noexcept;

 private:
  /// Whether this process made the file, and so may change it: no forked child.
  [[nodiscard]] bool ours() const noexcept;
  void punch(std::uint64_t offset, std::size_t bytes) noexcept;
  [[noreturn]] void fail(const char* what, int error) const;
  std::string directory_;
  int file_ = -1;
  long maker_ = 0;  // process
  std::uint64_t end_ = 0;
  std::vector<std::uint64_t> free_;
};

}  // namespace evigrid
