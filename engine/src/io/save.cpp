// SPDX-License-Identifier: Apache-2.0
// Tiles are compressed in parallel, a batch at a time, and written in their row-major order: the same map gives the
// same file on any executor.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <functional>
#include <limits>
#include <ostream>

#include "evigrid/io.hpp"
#include "io/header.hpp"
#include "io/layout.hpp"
#include "io/map_access.hpp"
#include "io/sync_folder.hpp"
#include "io/tile_codec.hpp"

namespace evigrid {
namespace {

using Sink = std::function<void(std::span<const std::byte>)>;
constexpr std::size_t kBatch = 256;  // tiles held compressed at a time

struct Batch {
  const TileSource& store;
  std::span<const TileRef> tiles;
  std::vector<std::vector<std::byte>> blocks;
  std::vector<io::TileEncoder>& encoders;
};

void encode(Batch& batch, Executor& executor) {
  batch.blocks.assign(batch.tiles.size(), {});
  executor.run(
      static_cast<std::int64_t>(batch.tiles.size()),
      [](void* context, std::int64_t index, int worker) {
        Batch& b = *static_cast<Batch*>(context);
        const auto i = static_cast<std::size_t>(index);
        b.blocks[i] = b.encoders[static_cast<std::size_t>(worker)].encode(b.store, b.tiles[i].cells);
      },
      &batch);
  for (const auto& block : batch.blocks) {
    if (block.empty()) throw std::bad_alloc();
  }
}

/// A map or a view of one.
template <class MapOrView>
std::string header_of(const MapOrView& map) {
  MapFileInfo info;
  info.maths_version = kMathsVersion;
  info.params = map.params();
  info.sensors.assign(map.sensors().begin(), map.sensors().end());
  for (const Plane& plane : planes_of(info.params)) info.planes.emplace_back(plane.name);
  const std::int64_t stamp = MapAccess::last_stamp_ns(map);
  if (stamp != std::numeric_limits<std::int64_t>::min()) info.last_stamp_ns = stamp;
  const Admission& admission = MapAccess::admission(map);
  if (admission.window) info.window = cells_of(*admission.window);
  info.protected_areas = admission.guarded;
  info.hash = map.hash();
  return io::header_text(info);
}

template <class MapOrView>
void write_map(const MapOrView& map, Executor& executor, std::string_view name, const Sink& sink) {
  const std::string text = header_of(map);
  if (text.size() > io::kMaxHeaderBytes) throw MapFileError(name, "too many sensors or protected areas for a map file");
  const auto text_bytes = std::as_bytes(std::span(text));
  io::Bytes head;
  head.put_raw(io::kMagic);
  head.put(kMapFileVersion);
  head.put(static_cast<std::uint32_t>(text.size()));
  head.put(io::crc32(text_bytes));
  head.put(io::crc32(head.get()));
  sink(head.get());
  sink(text_bytes);

  const TileSource& store = MapAccess::source(map);
  const std::vector<TileRef> tiles = store.in_order();
  std::vector<io::TileEncoder> encoders(static_cast<std::size_t>(executor.concurrency()));
  Batch batch{store, {}, {}, encoders};
  std::uint64_t offset = io::kHeadBytes + text.size();
  io::Bytes directory;
  for (std::size_t first = 0; first < tiles.size(); first += kBatch) {
    batch.tiles = std::span(tiles).subspan(first, std::min(kBatch, tiles.size() - first));
    encode(batch, executor);
    for (std::size_t i = 0; i < batch.tiles.size(); ++i) {
      const auto& block = batch.blocks[i];
      directory.put(batch.tiles[i].at.x);
      directory.put(batch.tiles[i].at.y);
      directory.put(offset);
      directory.put(static_cast<std::uint32_t>(block.size()));
      directory.put(io::crc32(block));
      sink(block);
      offset += block.size();
    }
  }
  sink(directory.get());
  io::Bytes tail;
  tail.put(offset);
  tail.put(static_cast<std::uint64_t>(tiles.size()));
  tail.put(offset + directory.get().size() + io::kTailBytes);
  tail.put(io::crc32(directory.get()));
  tail.put(io::crc32(tail.get()));
  tail.put_raw(io::kEndMagic);
  sink(tail.get());
}

/// A file under a temporary name that becomes the real one in commit(), or goes away. No two have one name, however
/// many threads save to one path.
class NewFile {
 public:
  explicit NewFile(const std::filesystem::path& target) : target_(target), temporary_(target) {
    static std::atomic<unsigned> last{0};
    std::string name(1, '.');
    name.append(target.filename().string()).append(".tmp-").append(std::to_string(::getpid())).push_back('-');
    do {  // one may be there of a process that was killed
      temporary_.replace_filename(name + std::to_string(++last));
      descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && errno == EEXIST);
    if (descriptor_ < 0) fail();
  }
  ~NewFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!done_) ::unlink(temporary_.c_str());
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  void write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const ssize_t n = ::write(descriptor_, bytes.data(), bytes.size());
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail();
      bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
  }
  void commit() {
    if (::fsync(descriptor_) != 0) fail();
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0 || ::rename(temporary_.c_str(), target_.c_str()) != 0) fail();
    done_ = true;
    io::sync_folder_of(target_);
  }

 private:
  [[noreturn]] void fail() const {
    throw MapFileError(target_.string(), std::string("cannot be written: ") + std::strerror(errno));
  }
  std::filesystem::path target_, temporary_;
  int descriptor_ = -1;
  bool done_ = false;
};

template <class MapOrView>
void save_to(const MapOrView& map, Executor& executor, const std::filesystem::path& path) {
  NewFile file(path);
  write_map(map, executor, path.string(), [&](std::span<const std::byte> bytes) { file.write(bytes); });
  file.commit();
}

template <class MapOrView>
void save_to(const MapOrView& map, Executor& executor, std::ostream& out) {
  write_map(map, executor, "map", [&](std::span<const std::byte> bytes) {
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!out) throw MapFileError("map", "the stream cannot be written");
  });
  if (!out.flush()) throw MapFileError("map", "the stream cannot be written");
}

std::shared_ptr<Executor> or_serial(Executor* executor) {
  if (executor == nullptr) return make_serial_executor();
  return {std::shared_ptr<Executor>{}, executor};
}

}  // namespace

void save(const Map& map, const std::filesystem::path& path) { save_to(map, MapAccess::executor(map), path); }
void save(const Map& map, std::ostream& out) { save_to(map, MapAccess::executor(map), out); }
void save(const MapView& view, const std::filesystem::path& path, Executor* executor) {
  save_to(view, *or_serial(executor), path);
}
void save(const MapView& view, std::ostream& out, Executor* executor) { save_to(view, *or_serial(executor), out); }

}  // namespace evigrid
