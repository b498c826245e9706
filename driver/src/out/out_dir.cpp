// SPDX-License-Identifier: Apache-2.0
// POSIX does the rest: rename() within a folder replaces a file in one step.
#include "out/out_dir.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <system_error>

#include "error.hpp"

namespace evigrid::driver {
namespace {

namespace fs = std::filesystem;

fs::path temporary_beside(const fs::path& target) {
  return target.parent_path() / fmt::format(".{}.tmp-{}", target.filename().string(), ::getpid());
}

/// Where bytes for `path` really go: a link is followed, so that what it points to is replaced and not the link.
fs::path followed(fs::path path) {
  std::error_code error;
  for (int links = 0; links < 40 && fs::is_symlink(path, error); ++links) {
    const fs::path to = fs::read_symlink(path, error);
    path = to.is_absolute() ? to : path.parent_path() / to;
  }
  return path.lexically_normal();
}

/// A pipe, a terminal, /dev/null: written to, never replaced.
bool is_special(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw InputError(fmt::format("{}: cannot be written: {}", path.string(), why));
}

/// The bytes, or an InputError and no file.
void write_all(const fs::path& path, const fs::path& named, std::span<const std::byte> head,
               std::span<const std::byte> body) {
  errno = 0;
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) fail(named, std::strerror(errno));
  bool good = true;
  for (const auto part : {head, body}) {  // an empty part may have no address
    good = good && (part.empty() || std::fwrite(part.data(), 1, part.size(), file) == part.size());
  }
  int error = errno;
  if (std::fclose(file) != 0 && good) {
    good = false;
    error = errno;
  }
  if (!good) {
    std::error_code ignored;
    if (!is_special(path)) fs::remove(path, ignored);
    fail(named, std::strerror(error));
  }
}

/// What the writer writes, or an exception; the file stays as far as it came.
void write_stream(const fs::path& path, const fs::path& named, const std::function<void(std::ostream&)>& writer) {
  std::ofstream out(path, std::ios::binary);
  try {
    if (out) writer(out);
  } catch (const std::exception&) {
    if (out) throw;  // else the writer complains of the stream, which has no name
  }
  out.close();
  if (!out) fail(named, "the disk may be full");
}

void rename_into_place(const fs::path& temporary, const fs::path& target, const fs::path& named) {
  std::error_code error, ignored;
  fs::rename(temporary, target, error);
  if (!error) return;
  fs::remove(temporary, ignored);
  fail(named, error.message());
}

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

}  // namespace

OutDir::OutDir(const std::string& path) {
  if (path.empty()) throw InputError("-o: the output folder has no name");
  path_ = fs::absolute(path).lexically_normal();
  if (path_.filename().empty()) path_ = path_.parent_path();  // "out/" is "out"
  std::vector<fs::path> missing;                              // innermost first
  std::error_code error;
  for (fs::path at = path_; !fs::exists(at, error) && at.has_relative_path(); at = at.parent_path())
    missing.push_back(at);
  try {
    for (auto at = missing.rbegin(); at != missing.rend(); ++at) {
      if (!fs::create_directory(*at, error) && error) fail(path, error.message());
      made_.push_back(*at);
    }
    if (!fs::is_directory(path_, error)) fail(path, "it is no folder");
    const fs::path probe = temporary_beside(path_ / "probe");
    write_all(probe, path, {}, {});
    fs::remove(probe, error);
  } catch (...) {
    for (auto at = made_.rbegin(); at != made_.rend(); ++at) fs::remove(*at, error);
    throw;
  }
}

OutDir::~OutDir() {
  std::error_code ignored;
  for (const Staged& s : staged_) fs::remove(s.temporary, ignored);
  for (auto at = made_.rbegin(); at != made_.rend(); ++at) fs::remove(*at, ignored);  // only when empty
}

void OutDir::stage(const fs::path& named, std::span<const std::byte> head, std::span<const std::byte> body) {
  std::error_code error;
  const fs::path target = followed(named);
  if (fs::is_directory(target, error)) fail(named, "a folder has that name");
  if (is_special(target)) fail(named, "it is a device or a pipe");
  const fs::path temporary = temporary_beside(target);
  write_all(temporary, target, head, body);
  const auto same = [&](const Staged& s) { return s.target == target; };  // --json may name a file of the folder
  std::erase_if(staged_, same);
  staged_.push_back({temporary, target, fs::exists(target, error)});
}

void OutDir::write(const std::string& name, std::string_view bytes) { stage(path_ / name, bytes_of(bytes), {}); }

void OutDir::write(const std::string& name, std::span<const std::byte> head, std::span<const std::byte> body) {
  stage(path_ / name, head, body);
}

void OutDir::write_by(const std::string& name, const std::function<void(std::ostream&)>& writer) {
  stage(path_ / name, {}, {});
  write_stream(staged_.back().temporary, staged_.back().target, writer);
}

void OutDir::write_at(const std::string& name, const std::function<void(const fs::path&)>& writer) {
  stage(path_ / name, {}, {});
  writer(staged_.back().temporary);
}

void OutDir::write_outside(const std::string& path, std::string_view bytes) {
  const fs::path target = followed(fs::absolute(path));
  if (is_special(target)) {  // nothing to be renamed: written when all else is in place
    special_.emplace_back(target, std::string(bytes));
  } else {
    stage(target, bytes_of(bytes), {});
  }
}

void OutDir::commit() {
  std::size_t done = 0;
  std::error_code error;
  for (; done < staged_.size() && !error; ++done) fs::rename(staged_[done].temporary, staged_[done].target, error);
  if (error) {  // the last one failed: a part of new results is worse than none
    const fs::path named = staged_[done - 1].target;
    std::error_code ignored;
    for (std::size_t i = 0; i + 1 < done; ++i) {
      if (!staged_[i].replaces) fs::remove(staged_[i].target, ignored);
    }
    staged_.erase(staged_.begin(), staged_.begin() + static_cast<std::ptrdiff_t>(done - 1));
    fail(named, error.message());
  }
  staged_.clear();
  made_.clear();
  for (const auto& [target, bytes] : special_) write_all(target, target, bytes_of(bytes), {});
  special_.clear();
}

void write_file(const std::string& path, std::string_view bytes) { write_file(path, bytes_of(bytes)); }

void write_file(const std::string& path, std::span<const std::byte> bytes) {
  const fs::path target = followed(fs::absolute(path));
  if (is_special(target)) return write_all(target, path, bytes, {});
  const fs::path temporary = temporary_beside(target);
  write_all(temporary, path, bytes, {});
  rename_into_place(temporary, target, path);
}

void write_file_by(const std::string& path, const std::function<void(std::ostream&)>& writer) {
  const fs::path target = followed(fs::absolute(path));
  if (is_special(target)) return write_stream(target, path, writer);
  const fs::path temporary = temporary_beside(target);
  try {
    write_stream(temporary, path, writer);
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
  rename_into_place(temporary, target, path);
}

void require_writable(const std::string& path) {
  const fs::path target = followed(fs::absolute(path));
  std::error_code error;
  if (fs::is_directory(target, error)) fail(path, "a folder has that name");
  if (is_special(target)) return;
  const fs::path probe = temporary_beside(target);
  write_all(probe, path, {}, {});
  fs::remove(probe, error);
}

}  // namespace evigrid::driver
