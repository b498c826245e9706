// SPDX-License-Identifier: Apache-2.0
// Nothing is believed before its checksum, no size before it is compared with the file and the memory cap. The parts of
// a file lie without gaps, so every byte is under a checksum.
#include <algorithm>
#include <limits>

#include "evigrid/combine.hpp"
#include "evigrid/io.hpp"
#include "io/header.hpp"
#include "io/layout.hpp"
#include "io/map_access.hpp"
#include "io/region.hpp"
#include "io/source.hpp"
#include "io/tile_codec.hpp"

namespace evigrid {
namespace {

using io::Source;

constexpr std::size_t kBatch = 256;  // tiles held compressed at a time

struct Opened {
  MapFileInfo info;
  io::Tail tail;
  std::uint64_t first_block = 0;
};

std::uint64_t tile_bytes(const MapFileInfo& info) noexcept {
  return info.planes.size() * sizeof(float) * kernels::kTileSide * kernels::kTileSide;
}

Opened open(Source& in) {
  Opened out;
  if (in.size() < io::kMagic.size()) in.fail(in.size() == 0 ? "is empty" : "is not an evigrid map");
  const auto magic = in.read(0, io::kMagic.size());
  if (!std::equal(magic.begin(), magic.end(), std::as_bytes(std::span(io::kMagic)).begin()))
    in.fail("is not an evigrid map");
  if (in.size() < io::kHeadBytes + io::kTailBytes) in.fail("is truncated");
  const auto head = in.read(0, io::kHeadBytes);
  if (io::crc32(head.first(20)) != io::number_at<std::uint32_t>(head, 20)) in.fail("checksum of the head is wrong");
  out.info.format_version = io::number_at<std::uint32_t>(head, 8);
  if (out.info.format_version == 0 || out.info.format_version > kMapFileVersion) {
    in.fail("has format version " + std::to_string(out.info.format_version) + ", newer than " +
            std::to_string(kMapFileVersion) + " that this program knows");
  }
  const std::size_t text_bytes = io::number_at<std::uint32_t>(head, 12);
  const std::uint32_t text_crc = io::number_at<std::uint32_t>(head, 16);
  out.first_block = io::kHeadBytes + text_bytes;

  const auto tail = in.read(in.size() - io::kTailBytes, io::kTailBytes);
  if (!std::equal(tail.end() - 8, tail.end(), std::as_bytes(std::span(io::kEndMagic)).begin()))
    in.fail("is truncated: it has no end mark");
  if (io::crc32(tail.first(28)) != io::number_at<std::uint32_t>(tail, 28)) in.fail("checksum of the tail is wrong");
  out.tail = {io::number_at<std::uint64_t>(tail, 0), io::number_at<std::uint64_t>(tail, 8),
              io::number_at<std::uint64_t>(tail, 16), io::number_at<std::uint32_t>(tail, 24)};
  const std::uint64_t room = in.size() - io::kTailBytes;
  if (out.tail.file_bytes != in.size()) in.fail("is truncated or has bytes that do not belong to it");
  if (text_bytes > io::kMaxHeaderBytes || out.first_block > out.tail.directory_offset ||
      out.tail.directory_offset > room || (room - out.tail.directory_offset) % io::kEntryBytes != 0 ||
      (room - out.tail.directory_offset) / io::kEntryBytes != out.tail.tiles) {
    in.fail("its parts do not fit together");
  }
  const auto text = in.read(io::kHeadBytes, text_bytes);
  if (io::crc32(text) != text_crc) in.fail("checksum of the header is wrong");
  const std::uint32_t version = out.info.format_version;
  try {
    out.info = io::parse_header({reinterpret_cast<const char*>(text.data()), text.size()});
  } catch (const std::invalid_argument& bad) {
    in.fail(bad.what());
  }
  std::vector<std::string> planes;
  for (const Plane& plane : planes_of(out.info.params)) planes.emplace_back(plane.name);
  if (out.info.planes != planes) in.fail("header: 'planes' are not those of its parameters");
  out.info.format_version = version;
  out.info.tiles = out.tail.tiles;
  out.info.file_bytes = in.size();
  out.info.memory_bytes = out.tail.tiles * tile_bytes(out.info);
  return out;
}

std::vector<io::Entry> read_directory(Source& in, const Opened& file) {
  const auto bytes = in.read(file.tail.directory_offset, static_cast<std::size_t>(file.tail.tiles) * io::kEntryBytes);
  if (io::crc32(bytes) != file.tail.directory_crc) in.fail("checksum of the directory is wrong");
  std::vector<io::Entry> out(static_cast<std::size_t>(file.tail.tiles));
  std::uint64_t next = file.first_block;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::size_t at = i * io::kEntryBytes;
    io::Entry& e = out[i];
    e = {io::number_at<std::int64_t>(bytes, at),       io::number_at<std::int64_t>(bytes, at + 8),
         io::number_at<std::uint64_t>(bytes, at + 16), io::number_at<std::uint32_t>(bytes, at + 24),
         io::number_at<std::uint32_t>(bytes, at + 28), i};
    const bool ordered = i == 0 || TileIndex{out[i - 1].y, out[i - 1].x} < TileIndex{e.y, e.x};
    const bool inside = std::max({e.x, e.y}) <= io::kMaxTile && std::min({e.x, e.y}) >= -io::kMaxTile;
    if (!ordered || !inside || e.offset != next || e.bytes > file.tail.directory_offset - next)
      in.fail("directory: entry of tile " + std::to_string(i) + " is wrong");
    next += e.bytes;
  }
  if (next != file.tail.directory_offset) in.fail("directory: bytes before it belong to no tile");
  return out;
}

struct Batch {
  const TileSource& store;
  std::span<const io::Entry> entries;
  std::vector<Tile*> tiles;
  std::span<const std::byte> bytes;  // of all entries
  std::vector<const char*> wrong;
  std::vector<io::TileDecoder>& decoders;
};

void decode_one(Batch& b, std::size_t i, std::size_t worker) noexcept {
  const io::Entry& e = b.entries[i];
  const auto block = b.bytes.subspan(static_cast<std::size_t>(e.offset - b.entries.front().offset), e.bytes);
  b.wrong[i] =
      io::crc32(block) != e.crc ? "has a wrong checksum" : b.decoders[worker].decode(b.store, block, b.tiles[i]->cells);
}

/// A tile that was read is new to every consumer.
void note_all(ChangeLog& changes, Tile& tile) {
  tile.buffer->marks.mark(~BlockMask{0}, changes.next());
  changes.moved(tile);
}

/// How many entries from the first on lie one behind the other in the file, at most so many.
std::size_t together(std::span<const io::Entry> entries, std::size_t most) {
  std::size_t n = 1;
  while (n < std::min(most, entries.size()) && entries[n].offset == entries[n - 1].offset + entries[n - 1].bytes) ++n;
  return n;
}

void read_tiles(Source& in, std::span<const io::Entry> entries, Map& map) {
  TileStore& store = MapAccess::store(map);
  ChangeLog& changes = MapAccess::changes(map);
  Executor& executor = MapAccess::executor(map);
  std::vector<io::TileDecoder> decoders(static_cast<std::size_t>(executor.concurrency()));
  const std::size_t most = std::clamp(map.params().memory_cap_bytes / store.tile_bytes(), std::size_t{1}, kBatch);
  for (std::size_t first = 0, count = 0; first < entries.size(); first += count) {
    count = together(entries.subspan(first), most);
    store.begin_operation();
    store.reserve(count);
    Batch batch{store, entries.subspan(first, count), {}, {}, {}, decoders};
    for (const io::Entry& e : batch.entries) batch.tiles.push_back(&store.get_or_make({e.y, e.x}));
    const io::Entry& last = batch.entries.back();
    const std::uint64_t from = batch.entries.front().offset;
    batch.bytes = in.read(from, static_cast<std::size_t>(last.offset + last.bytes - from));
    batch.wrong.assign(batch.entries.size(), nullptr);
    executor.run(
        static_cast<std::int64_t>(batch.entries.size()),
        [](void* context, std::int64_t index, int worker) {
          decode_one(*static_cast<Batch*>(context), static_cast<std::size_t>(index), static_cast<std::size_t>(worker));
        },
        &batch);
    for (std::size_t i = 0; i < batch.wrong.size(); ++i) {
      if (batch.wrong[i] != nullptr) in.fail("tile " + std::to_string(batch.entries[i].number) + " " + batch.wrong[i]);
    }
    for (Tile* tile : batch.tiles) note_all(changes, *tile);
  }
  if (!entries.empty()) changes.commit();
}

Map read_map(Source& in, const LoadOptions& options) {
  Opened file = open(in);
  MapParams params = file.info.params;
  if (options.memory_cap_bytes) params.memory_cap_bytes = *options.memory_cap_bytes;
  params.kernel = options.kernel.value_or(kernel_available(params.kernel) ? params.kernel : Kernel::automatic);
  const auto require_fits = [&](std::uint64_t tiles) {  // bounded by the file's size: no overflow
    const std::uint64_t bytes = tiles * tile_bytes(file.info);
    if (bytes <= params.memory_cap_bytes || options.page_directory) return;
    in.fail("its " + std::to_string(tiles) + " tiles need " + std::to_string(bytes) +
            " bytes, more than the memory cap of " + std::to_string(params.memory_cap_bytes));
  };
  if (!options.region) require_fits(file.info.tiles);
  std::vector<io::Entry> entries = read_directory(in, file);
  if (options.region) {
    io::keep_region(entries, *options.region);
    require_fits(entries.size());
  }
  try {
    Map map(params, options.executor);
    if (options.page_directory) map.page_to(*options.page_directory);
    for (const Sensor& sensor : file.info.sensors) map.add(sensor);
    read_tiles(in, entries, map);
    if (options.region) io::clear_around(map, entries, *options.region);
    Admission& admission = MapAccess::admission(map);  // as it was: protected cells are in the file as they were frozen
    if (file.info.window) admission.window = tiles_of(*file.info.window);
    admission.guarded = file.info.protected_areas;
    if (file.info.last_stamp_ns) MapAccess::last_stamp_ns(map) = *file.info.last_stamp_ns;
    // The definition of the hash may change with the maths; within one version it proves the whole way.
    if (!options.region && file.info.maths_version == kMathsVersion && map.hash() != file.info.hash)
      in.fail("its cells do not have the hash that its header names");
    if (options.bytes_read != nullptr) *options.bytes_read = in.bytes_read();
    return map;
  } catch (const std::invalid_argument& bad) {  // parameters or sensors that no map accepts
    in.fail(std::string("header: ") + bad.what());
  }
}

}  // namespace

Map load(const std::filesystem::path& path, const LoadOptions& options) {
  Source in(path);
  return read_map(in, options);
}
Map load(std::span<const std::byte> bytes, const LoadOptions& options, std::string_view name) {
  Source in(bytes, name);
  return read_map(in, options);
}

MapFileInfo inspect(const std::filesystem::path& path) {
  Source in(path);
  return open(in).info;
}
MapFileInfo inspect(std::span<const std::byte> bytes, std::string_view name) {
  Source in(bytes, name);
  return open(in).info;
}

}  // namespace evigrid
