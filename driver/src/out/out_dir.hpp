// SPDX-License-Identifier: Apache-2.0
// An output folder that never shows half a file: everything is written under temporary names beside its place and
// renamed when all of it is complete. Dropped without commit(), it takes its files away again, and the folders that it
// made as far as they are empty.
#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace evigrid::driver {

class OutDir {
 public:
  /// Makes the folder and tries that a file can be written there: throws InputError before any work is done.
  explicit OutDir(const std::string& path);
  ~OutDir();
  OutDir(const OutDir&) = delete;
  OutDir& operator=(const OutDir&) = delete;

  /// Writes a whole file under a temporary name. `name` is a plain file name.
  void write(const std::string& name, std::string_view bytes);
  void write(const std::string& name, std::span<const std::byte> head, std::span<const std::byte> body);
  /// The same, by something that writes into a stream piece by piece.
  void write_by(const std::string& name, const std::function<void(std::ostream&)>& writer);

  /// The same, by something that opens the temporary file by its path.
  void write_at(const std::string& name, const std::function<void(const std::filesystem::path&)>& writer);

  /// Also takes a file outside the folder (--json FILE) into the same commit.
  void write_outside(const std::string& path, std::string_view bytes);

  /// Renames everything into place. Throws InputError when that fails, with nothing left that was not there before.
  void commit();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  void stage(const std::filesystem::path& named, std::span<const std::byte> head, std::span<const std::byte> body);
  std::filesystem::path path_;
  struct Staged {
    std::filesystem::path temporary, target;
    bool replaces;  // a file of that name was there
  };
  std::vector<std::filesystem::path> made_;  // folders, outermost first
  std::vector<Staged> staged_;
  std::vector<std::pair<std::filesystem::path, std::string>> special_;  // devices and pipes, and what they get
};

/// One file, written beside and renamed; throws InputError. For commands whose only output is a file.
void write_file(const std::string& path, std::string_view bytes);
void write_file(const std::string& path, std::span<const std::byte> bytes);
/// The same, by something that writes into a stream piece by piece; it may end early when the stream has failed.
void write_file_by(const std::string& path, const std::function<void(std::ostream&)>& writer);

/// Throws InputError when `path` cannot become a file: to be asked before long work.
void require_writable(const std::string& path);

}  // namespace evigrid::driver
