// SPDX-License-Identifier: Apache-2.0
// Bag format 2.0 (wiki.ros.org/Bags/Format/2.0): records of a header, fields NAME=VALUE with their lengths, and data.
#include "check.hpp"

#include <bzlib.h>
#include <roslz4/lz4s.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <vector>

#include "bag.hpp"

namespace evigrid::ros_bag {
namespace {

using Bytes = std::vector<char>;
constexpr std::uint32_t kMostChunk = 1u << 28, kMostHeader = 1u << 16;
enum : std::uint8_t { kMessage = 2, kBagHeader, kIndex, kChunk, kChunkInfo, kConnection };

[[noreturn]] void fail(std::uint64_t at, const std::string& why) {
  throw Error("damaged at byte " + std::to_string(at) + ": " + why);
}

template <class T>
T number(const char* from) {
  T out;
  std::memcpy(&out, from, sizeof out);
  return out;
}

/// The fields of a record's header.
class Fields {
 public:
  Fields(const char* at, std::size_t size, std::uint64_t place) : place_(place) {
    while (size > 0) {
      const std::uint32_t length = size < 4 ? 0 : number<std::uint32_t>(at);
      if (size < 4 || length > size - 4) fail(place, "a field is longer than its header");
      const char *const begin = at + 4, *const end = begin + length, *const equals = std::find(begin, end, '=');
      if (equals == end) fail(place, "a field without '='");
      fields_[std::string(begin, equals)] = std::string(equals + 1, end);
      at = end;
      size -= 4 + length;
    }
  }
  [[nodiscard]] std::string text(const char* name) const {
    const auto found = fields_.find(name);
    if (found == fields_.end()) fail(place_, std::string("field '") + name + "' is missing");
    return found->second;
  }
  template <class T>
  [[nodiscard]] T get(const char* name) const {
    const std::string bytes = text(name);
    if (bytes.size() != sizeof(T)) fail(place_, std::string("field '") + name + "' has a wrong length");
    return number<T>(bytes.data());
  }
  [[nodiscard]] std::uint8_t op() const { return get<std::uint8_t>("op"); }
  [[nodiscard]] bool has(const char* name) const { return fields_.count(name) != 0; }

 private:
  std::uint64_t place_;
  std::map<std::string, std::string> fields_;
};

class Checker {
 public:
  explicit Checker(const std::string& file) : in_(file, std::ios::binary | std::ios::ate) {
    if (!in_) throw Error("cannot be opened");
    size_ = static_cast<std::uint64_t>(in_.tellg());
  }

  void run() {
    const std::string magic = "#ROSBAG V2.0\n";
    if (size_ < magic.size() || std::string(read(0, magic.size()).data(), magic.size()) != magic)
      throw Error("is no bag of version 2.0");
    std::uint64_t index_pos = 0;
    for (std::uint64_t at = magic.size(); at < size_;) {
      starts_.insert(at);
      const std::uint64_t begin = at;
      const Bytes head = part(at, kMostHeader);
      const Fields fields(head.data(), head.size(), begin);
      const std::uint64_t data_at = at + 4;
      const std::uint32_t data = skip(at);
      if (begin == magic.size()) {
        if (fields.op() != kBagHeader) fail(begin, "the bag's header is missing");
        if (fields.has("encryptor") && !fields.text("encryptor").empty()) throw Error("is encrypted");
        index_pos = fields.get<std::uint64_t>("index_pos");
        if (index_pos == 0) throw Error("has no index: it was not closed; `rosbag reindex` makes one");
        continue;
      }
      record(fields, begin, data_at, data);
    }
    if (starts_.count(index_pos) == 0 && index_pos != size_) fail(index_pos, "the index is no record");
    for (const std::uint64_t chunk : chunks_told_) {
      if (chunks_.count(chunk) == 0) fail(chunk, "no chunk is there");
    }
  }

 private:
  Bytes read(std::uint64_t at, std::size_t n) {
    if (n > size_ || at > size_ - n) fail(at, "the bag ends within a record");
    Bytes out(n);
    in_.seekg(static_cast<std::streamoff>(at));
    in_.read(out.data(), static_cast<std::streamsize>(n));
    if (!in_) throw Error("cannot be read");
    return out;
  }
  std::uint32_t length_at(std::uint64_t at) { return number<std::uint32_t>(read(at, 4).data()); }
  /// The length at `at` and so many bytes after it; goes on behind them.
  Bytes part(std::uint64_t& at, std::uint32_t most) {
    const std::uint32_t n = length_at(at);
    if (n > most) fail(at, "a header of " + std::to_string(n) + " bytes");
    Bytes out = read(at + 4, n);
    at += 4 + std::uint64_t{n};
    return out;
  }
  std::uint32_t skip(std::uint64_t& at) {
    const std::uint32_t n = length_at(at);
    if (n > size_ - at - 4) fail(at, "the bag ends within a record");
    at += 4 + std::uint64_t{n};
    return n;
  }

  void record(const Fields& fields, std::uint64_t begin, std::uint64_t data_at, std::uint32_t data) {
    switch (fields.op()) {
      case kChunk:
        chunks_.insert(begin);
        look_into(fields, begin, data_at, data);
        break;
      case kIndex: {
        if (fields.get<std::uint32_t>("count") != data / 12 || data % 12 != 0)
          fail(begin, "an index of a wrong length");
        const Bytes entries = read(data_at, data);
        for (std::size_t i = 0; i < entries.size(); i += 12) {  // time 8, offset 4
          if (messages_.count(number<std::uint32_t>(entries.data() + i + 8)) == 0)
            fail(begin, "an index points at no message");
        }
        break;
      }
      case kChunkInfo:
        if (fields.get<std::uint32_t>("count") != data / 8 || data % 8 != 0)
          fail(begin, "the list of a chunk has a wrong length");
        chunks_told_.push_back(fields.get<std::uint64_t>("chunk_pos"));
        break;
      case kConnection: {
        const Bytes of_it = read(data_at, std::min(data, kMostChunk));
        (void)Fields(of_it.data(), of_it.size(), begin);
        break;
      }
      default:
        fail(begin, "a record of kind " + std::to_string(fields.op()));
    }
  }

  /// Where the messages of a chunk begin.
  void look_into(const Fields& fields, std::uint64_t begin, std::uint64_t data_at, std::uint32_t data) {
    const std::uint32_t size = fields.get<std::uint32_t>("size");
    if (data > kMostChunk || size > kMostChunk) fail(begin, "a chunk of " + std::to_string(size) + " bytes");
    Bytes inside = read(data_at, data);
    const std::string how = fields.text("compression");
    if (how == "none") {
      if (size != data) fail(begin, "a chunk of a wrong length");
    } else {
      Bytes plain(size);
      unsigned int n = size;
      const bool good = how == "bz2" ? BZ2_bzBuffToBuffDecompress(plain.data(), &n, inside.data(), data, 0, 0) == BZ_OK
                                     : how == "lz4" && roslz4_buffToBuffDecompress(inside.data(), data, plain.data(),
                                                                                   &n) == ROSLZ4_OK;
      if (!good || n != size) fail(begin, "a chunk cannot be decompressed");
      inside = std::move(plain);
    }
    messages_.clear();
    const auto length = [&](std::size_t at) {
      if (inside.size() - at < 4) fail(begin, "a chunk ends within a record");
      const std::uint32_t n = number<std::uint32_t>(inside.data() + at);
      if (n > inside.size() - at - 4) fail(begin, "a chunk ends within a record");
      return n;
    };
    for (std::size_t at = 0; at < inside.size();) {
      const std::uint32_t header = length(at), body = length(at + 4 + header);
      const std::uint8_t op = Fields(inside.data() + at + 4, header, begin).op();
      if (op == kMessage) messages_.insert(static_cast<std::uint32_t>(at));
      if (op == kConnection) (void)Fields(inside.data() + at + 8 + header, body, begin);
      if (op != kMessage && op != kConnection) fail(begin, "a chunk holds a record of kind " + std::to_string(op));
      at += 8 + std::size_t{header} + body;
    }
  }

  std::ifstream in_;
  std::uint64_t size_ = 0;
  std::set<std::uint64_t> starts_, chunks_;
  std::vector<std::uint64_t> chunks_told_;
  std::set<std::uint32_t> messages_;  // of the last chunk
};

/// Reads on in a message.
class Walk {
 public:
  Walk(const std::uint8_t* bytes, std::size_t size) : at_(bytes), left_(size) {}
  bool skip(std::uint64_t n) {
    if (n > left_) return false;
    at_ += n;
    left_ -= static_cast<std::size_t>(n);
    return true;
  }
  /// A count of elements of so many bytes each, at least.
  bool count(std::uint64_t each, std::uint32_t& n) {
    const std::uint8_t* const from = at_;
    if (!skip(4)) return false;
    std::memcpy(&n, from, 4);
    return n * each <= left_;
  }
  bool header() {  // seq, stamp, frame
    std::uint32_t n = 0;
    return skip(12) && count(1, n) && skip(n);
  }

 private:
  const std::uint8_t* at_;
  std::size_t left_;
};

}  // namespace

void check_structure(const std::string& file) { Checker(file).run(); }

bool counts_fit(const std::string& type, const std::uint8_t* bytes, std::size_t size) {
  constexpr std::uint64_t kTransform = 12 + 4 + 4 + 7 * 8;  // header and child without letters, seven doubles
  Walk walk(bytes, size);
  std::uint32_t n = 0;
  if (type == "tf2_msgs/TFMessage" || type == "tf/tfMessage") return walk.count(kTransform, n);
  if (type == "sensor_msgs/LaserScan") {
    return walk.header() && walk.skip(7 * 4) && walk.count(4, n) && walk.skip(std::uint64_t{n} * 4) && walk.count(4, n);
  }
  return true;  // Range and Odometry hold no arrays but of a fixed length
}

}  // namespace evigrid::ros_bag
