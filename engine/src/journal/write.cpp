// SPDX-License-Identifier: Apache-2.0
// One write() a record: what it has taken is the system's, whatever becomes of the process.
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "io/header.hpp"
#include "io/layout.hpp"
#include "io/sync_folder.hpp"
#include "journal/record.hpp"

namespace evigrid {

struct Journal::Impl {
  std::string name;
  int file = -1;
  std::uint64_t bytes = 0;
  JournalOptions options;

  ~Impl() {
    if (file >= 0) ::close(file);
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw MapFileError(name, what + ": " + std::strerror(errno));
  }
  /// All of it, or none.
  void write(std::span<const std::byte> all) {
    if (file < 0) throw MapFileError(name, "takes no more: what failed could not be cut off");
    std::span<const std::byte> left = all;
    while (!left.empty()) {
      const ssize_t n = ::write(file, left.data(), left.size());
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail_without(left.size() < all.size(), "cannot be written");
      left = left.subspan(static_cast<std::size_t>(n));
    }
    if (options.sync_each && ::fsync(file) != 0) fail_without(true, "cannot be brought to the disk");
    bytes += all.size();
  }
  /// What a failed call wrote must not stay: neither half of a record before the next one, nor all of one that its
  /// caller was not told of.
  [[noreturn]] void fail_without(bool something, const std::string& what) {
    const int error = errno;
    if (something) cut(bytes);
    errno = error;
    fail(what);
  }
  /// Where even that fails nothing more can be written.
  void cut(std::uint64_t to) noexcept {
    if (file < 0) return;
    if (::ftruncate(file, static_cast<off_t>(to)) != 0) {
      ::close(file), file = -1;
      return;
    }
    bytes = to;
    if (options.sync_each) ::fsync(file);
  }
  void record(JournalEvent::Kind kind, ScanId id, std::span<const std::byte> payload) {
    write(journal::encode(kind, id, payload, options.compress && kind == JournalEvent::Kind::scan));
  }
};

Journal::Journal(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Journal::~Journal() = default;
Journal::Journal(Journal&&) noexcept = default;
Journal& Journal::operator=(Journal&&) noexcept = default;

Journal Journal::create(const std::filesystem::path& path, const MapParams& params, std::span<const Sensor> sensors,
                        JournalOptions options) {
  MapFileInfo info;
  info.maths_version = kMathsVersion;
  info.params = params;
  info.sensors.assign(sensors.begin(), sensors.end());
  const std::string text = io::header_text(info);
  const auto text_bytes = std::as_bytes(std::span(text));
  io::Bytes head;
  head.put_raw(journal::kMagic);
  head.put(journal::kVersion);
  head.put(static_cast<std::uint32_t>(text.size()));
  head.put(io::crc32(text_bytes));
  head.put(io::crc32(head.get()));
  std::vector<std::byte> all(head.get().begin(), head.get().end());
  all.insert(all.end(), text_bytes.begin(), text_bytes.end());
  auto impl = std::make_unique<Impl>();
  impl->name = path.string();
  impl->options = options;
  impl->file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
  if (impl->file < 0) impl->fail("cannot be made");
  try {
    impl->write(all);
  } catch (...) {
    ::unlink(path.c_str());
    throw;
  }
  io::sync_folder_of(path);
  return Journal(std::move(impl));
}

Journal Journal::append(const std::filesystem::path& path, const JournalContents& read, JournalOptions options) {
  auto impl = std::make_unique<Impl>();
  impl->name = path.string();
  impl->options = options;
  impl->bytes = read.bytes;
  impl->file = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (impl->file < 0) impl->fail("cannot be opened");
  if (::ftruncate(impl->file, static_cast<off_t>(read.bytes)) != 0) impl->fail("cannot be cut");
  return Journal(std::move(impl));
}

void Journal::add(ScanId id, const Scan& scan) {
  impl_->record(JournalEvent::Kind::scan, id, journal::scan_payload(scan));
}
void Journal::remove(ScanId id) { impl_->record(JournalEvent::Kind::remove, id, {}); }
void Journal::move(ScanId id, const Pose2& pose) {
  impl_->record(JournalEvent::Kind::move, id, journal::pose_payload(pose));
}
void Journal::cut(std::uint64_t bytes) noexcept {
  if (bytes < impl_->bytes) impl_->cut(bytes);
}
void Journal::sync() {
  if (::fsync(impl_->file) != 0) impl_->fail("cannot be brought to the disk");
}
std::uint64_t Journal::bytes() const noexcept { return impl_->bytes; }

}  // namespace evigrid
