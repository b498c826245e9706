// SPDX-License-Identifier: Apache-2.0
// Map files whose checksums are right and whose content is not: made by someone who knows the format.
#include <gtest/gtest.h>

#include <cstdint>
#include <sstream>
#include <string>

#include "evigrid/io.hpp"

namespace evigrid {
namespace {

std::string saved() {
  Map map({.cell_m = 0.1, .rule = Rule::dempster}, make_serial_executor());
  const SensorId id = map.add(Sensor{});
  const float range_m = 2;
  const Reading reading{id, {&range_m, 1}};
  map.integrate(Scan{7, {-1, -1, 0.5}, {&reading, 1}});
  std::ostringstream out;
  save(map, out);
  return out.str();
}

std::uint64_t number(const std::string& s, std::size_t at, int bytes) {
  std::uint64_t v = 0;
  for (int i = bytes - 1; i >= 0; --i) v = v << 8 | static_cast<unsigned char>(s[at + static_cast<std::size_t>(i)]);
  return v;
}
void put(std::string& s, std::size_t at, std::uint64_t v, int bytes) {
  for (int i = 0; i < bytes; ++i) s[at + static_cast<std::size_t>(i)] = static_cast<char>(v >> (8 * i));
}
/// Bit by bit, from the definition.
std::uint32_t crc(const std::string& s) {
  std::uint32_t c = ~0u;
  for (const char byte : s) {
    c ^= static_cast<unsigned char>(byte);
    for (int i = 0; i < 8; ++i) c = (c >> 1) ^ ((c & 1) != 0 ? 0xEDB88320u : 0u);
  }
  return ~c;
}

/// Every checksum of head, header, directory and tail made right again.
std::string sealed(std::string s) {
  const std::size_t text = number(s, 12, 4), tail = s.size() - 40, directory = number(s, tail, 8);
  put(s, 16, crc(s.substr(24, text)), 4);
  put(s, 20, crc(s.substr(0, 20)), 4);
  put(s, tail + 24, crc(s.substr(directory, tail - directory)), 4);
  put(s, tail + 28, crc(s.substr(tail, 28)), 4);
  return s;
}

std::string message_of(const std::string& bytes) {
  try {
    (void)load(std::as_bytes(std::span(bytes)), {.executor = make_serial_executor(), .memory_cap_bytes = 1 << 24});
  } catch (const MapFileError& error) {
    return error.what();
  }
  return "no error";
}

TEST(HostileMap, TheSealIsTheWritersOwn) { EXPECT_EQ(message_of(sealed(saved())), "no error"); }

TEST(HostileMap, HeadersThatNoMapHas) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string s = saved();
    s.replace(s.find(from), to.size(), to);
    return message_of(sealed(s));
  };
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  EXPECT_TRUE(has(with("cell_m=0.1", "cell_m=nan"), "cell_m"));
  EXPECT_TRUE(has(with("cell_m=0.1", "cell_m=-.1"), "cell_m"));
  EXPECT_TRUE(has(with("rule=dempster", "rule=dempstes"), "'rule' has the bad value"));
  EXPECT_TRUE(has(with("keep_conflict=1", "keep_conflict=2"), "'keep_conflict' has the bad value"));
  EXPECT_TRUE(has(with("keep_conflict=1", "keep_conflict=0"), "'planes'"));
  EXPECT_TRUE(has(with("aperture_rad=0", "aperture_rad=9"), "sensor.aperture_rad"));
  EXPECT_TRUE(has(with("reliability=1", "reliability=0"), "sensor.reliability"));
  EXPECT_TRUE(has(with("[sensor]", "[sensoR]"), "is unknown: a newer program"));
  EXPECT_TRUE(has(with("map_hash=", "map_hasg="), "is unknown"));
  const std::string s = saved();
  const std::size_t digit = s.find("map_hash=") + 9;
  std::string other = s;
  other[digit] = other[digit] == '1' ? '2' : '1';
  EXPECT_TRUE(has(message_of(sealed(other)), "do not have the hash"));
}

TEST(HostileMap, SizesAreCheckedBeforeAnythingIsAllocated) {
  const std::string whole = saved();
  const std::size_t tail = whole.size() - 40, directory = number(whole, tail, 8);
  for (const std::uint64_t absurd :
       {std::uint64_t{0}, std::uint64_t{1} << 40, ~std::uint64_t{0}, ~std::uint64_t{0} - 31}) {
    for (const std::size_t field : {tail, tail + 8, tail + 16, directory + 16}) {
      std::string s = whole;
      put(s, field, absurd, 8);
      const std::uint64_t from = number(s, tail, 8);
      if (from <= tail) {
        EXPECT_NE(message_of(sealed(s)), "no error") << field - directory << ' ' << absurd;
      }
      put(s, tail + 28, crc(s.substr(tail, 28)), 4);
      EXPECT_NE(message_of(s), "no error");
    }
  }
  std::string newer = whole;
  put(newer, 8, kMapFileVersion + 1, 4);
  EXPECT_NE(message_of(sealed(newer)).find("format version 3, newer than 2"), std::string::npos);
  std::string longer = whole;
  put(longer, 12, 0xFFFFFFFF, 4);
  put(longer, 20, crc(longer.substr(0, 20)), 4);
  EXPECT_NE(message_of(longer).find("do not fit together"), std::string::npos);
}

TEST(HostileMap, TilesInTheWrongPlace) {
  const std::string whole = saved();
  const std::size_t directory = number(whole, whole.size() - 40, 8);
  std::string s = whole;
  put(s, directory, number(s, directory, 8) - 1, 8);  // another column: the hash does not agree
  EXPECT_NE(message_of(sealed(s)), "no error");
  put(s, directory, std::uint64_t{1} << 62, 8);
  EXPECT_NE(message_of(sealed(s)).find("entry of tile 0 is wrong"), std::string::npos);
}

TEST(HostileMap, AreasThatNoMapHas) {
  const auto with = [](const std::string& line) {
    std::string s = saved();
    const std::size_t at = s.find("cell_m=");
    s.insert(at, line);
    put(s, 12, number(s, 12, 4) + line.size(), 4);
    const std::size_t tail = s.size() - 40, directory = number(s, tail, 8) + line.size();
    put(s, tail, directory, 8);
    put(s, tail + 16, number(s, tail + 16, 8) + line.size(), 8);
    for (std::size_t e = directory; e < tail; e += 32) put(s, e + 16, number(s, e + 16, 8) + line.size(), 8);
    return message_of(sealed(s));
  };
  EXPECT_EQ(with("window=0,0,64,64\nprotected=1,2,3,4\nprotected=-1,2,3,4\n"), "no error");
  for (const char* bad :
       {"window=0,0,64\n", "window=0,0,64,64,1\n", "window=0,0,0,64\n", "protected=0,0,-1,1\n", "protected=\n",
        "protected=1e3,0,1,1\n", "window=9223372036854775807,0,64,64\n", "protected=0,0,9223372036854775807,1\n"}) {
    EXPECT_NE(with(bad).find("has the bad value"), std::string::npos) << bad << with(bad);
  }
}

}  // namespace
}  // namespace evigrid
