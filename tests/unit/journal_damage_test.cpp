// SPDX-License-Identifier: Apache-2.0
// What is the tail of a run that ended and what is damage: a tail is dropped, and never with a whole record in it.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "equivalence/random_scans.hpp"
#include "evigrid/evigrid.hpp"
#include "temp_folder.hpp"

namespace evigrid {
namespace {

JournalContents parse(const std::string& bytes) { return read_journal(std::as_bytes(std::span(bytes)), "j"); }
std::string with_flip(std::string bytes, std::size_t at, int bits) {
  bytes[at] = static_cast<char>(bytes[at] ^ bits);
  return bytes;
}

struct Recorded {
  std::string bytes;
  std::vector<std::size_t> ends;  // of the header, then of each record
};
Recorded recorded(std::size_t scans) {
  const auto d = testing::drive(Model::li2014, 4, 4);
  const TempFolder dir;
  Recorded out;
  {
    Journal j = Journal::create(dir.at("j"), {.rule = Rule::pcr5}, d->sensors);
    out.ends.push_back(j.bytes());
    for (std::size_t i = 0; i < scans; ++i) {
      j.add(i + 1, d->scans[i % 4]);
      out.ends.push_back(j.bytes());
    }
  }
  std::ifstream in(dir.at("j"), std::ios::binary);
  out.bytes = {std::istreambuf_iterator<char>(in), {}};
  return out;
}

TEST(JournalDamage, ALengthThatGrewIsNoTailWhileRecordsLieBehindIt) {
  const Recorded r = recorded(1000);
  for (const std::size_t record : {std::size_t{0}, std::size_t{500}, std::size_t{998}}) {
    for (std::size_t byte = 0; byte < 4; ++byte) {
      for (int bit = 0; bit < 8; ++bit) {
        const std::string bad = with_flip(r.bytes, r.ends[record] + byte, 1 << bit);
        try {
          (void)parse(bad);
          FAIL() << record << ' ' << byte << ' ' << bit;
        } catch (const MapFileError& e) {
          EXPECT_NE(std::string(e.what()).find("record at byte " + std::to_string(r.ends[record])), std::string::npos);
          EXPECT_NE(std::string(e.what()).find(std::to_string(record) + " scans come before"), std::string::npos);
        }
      }
    }
  }
  // The last one may have been cut short, unless it is longer than any record.
  EXPECT_EQ(parse(with_flip(r.bytes, r.ends[999] + 2, 0x40)).events.size(), 999u);
  EXPECT_THROW(parse(with_flip(r.bytes, r.ends[999] + 3, 0x40)), MapFileError);
}

TEST(JournalDamage, ARecordThatTurnsToZerosIsATailWhenNothingFollows) {
  const Recorded r = recorded(3);
  for (std::size_t n = r.ends[1]; n < r.bytes.size(); ++n) {
    for (const std::size_t behind : {std::size_t{0}, std::size_t{7}, std::size_t{4096}}) {
      std::string torn = r.bytes;
      std::fill(torn.begin() + static_cast<std::ptrdiff_t>(n), torn.end(), '\0');
      torn.append(behind, '\0');
      const JournalContents c = parse(torn);
      // Where only zeros were lost the record is whole.
      const std::size_t most = r.bytes.find_last_not_of('\0') < n ? 3 : n >= r.ends[2] ? 2 : 1;
      ASSERT_LE(c.events.size(), most) << n;
      ASSERT_GE(c.events.size(), n >= r.ends[2] ? 2u : 1u) << n;
      ASSERT_EQ(c.bytes, r.ends[c.events.size()]) << n;
      ASSERT_EQ(c.bytes + c.dropped, torn.size()) << n;
    }
  }
  std::string hole = r.bytes;  // a page that was lost between two that were not
  std::fill(hole.begin() + static_cast<std::ptrdiff_t>(r.ends[1] + 30),
            hole.begin() + static_cast<std::ptrdiff_t>(r.ends[2]), '\0');
  EXPECT_THROW(parse(hole), MapFileError);
  std::fill(hole.begin() + static_cast<std::ptrdiff_t>(r.ends[1]),
            hole.begin() + static_cast<std::ptrdiff_t>(r.ends[2]), '\0');
  EXPECT_THROW(parse(hole), MapFileError);
}

/// Heads of records without number, each with a length that reaches to the end: whoever tries each checksum is busy
/// for the square of the file.
TEST(JournalDamage, LookingForRecordsInATailEnds) {
  const Recorded r = recorded(1);
  std::string bad = r.bytes;
  const std::uint32_t length = 4'000'000;
  for (std::size_t i = 0; i < 500'000; ++i) {
    const std::uint32_t head[3]{length, 1, static_cast<std::uint32_t>(i + 1)};
    bad.append(reinterpret_cast<const char*>(head), sizeof(head));
  }
  const std::uint32_t beyond = 100'000'000;
  std::memcpy(bad.data() + r.ends[1], &beyond, sizeof(beyond));
  EXPECT_THROW(parse(bad), MapFileError);
}

}  // namespace
}  // namespace evigrid
