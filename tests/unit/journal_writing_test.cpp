// SPDX-License-Identifier: Apache-2.0
// What a journal leaves behind when the disk takes no more: all of a record or none, and no file without its header.
#include <gtest/gtest.h>

#include <stdexcept>

#include "equivalence/random_scans.hpp"
#include "evigrid/evigrid.hpp"
#include "temp_folder.hpp"
#include "unit/fsync_probe.hpp"
#include "unit/full_disk.hpp"

namespace evigrid {
namespace {

using testing::FsyncProbe;

TEST(JournalWriting, AScanThatNoReaderWouldTakeIsRefused) {
  const TempFolder dir;
  const std::vector<float> ranges(1 << 20, 1.0f);  // 65 times 4 MiB of them, which zstd makes small
  const std::vector<Reading> readings(65, Reading{0, ranges});
  for (const bool compress : {false, true}) {
    Journal j = Journal::create(dir.at(compress ? "z" : "j"), {}, {}, {.compress = compress});
    const std::uint64_t before = j.bytes();
    EXPECT_THROW(j.add(1, Scan{0, {}, readings}), std::invalid_argument);
    EXPECT_EQ(j.bytes(), before);
  }
}

TEST(JournalWriting, AJournalThatCannotBeBegunLeavesNoFile) {
  const TempFolder dir;
  for (const std::uint64_t room : {0u, 30u}) {
    const testing::FullDisk full(room);
    EXPECT_THROW(Journal::create(dir.at("j"), {}, {}), MapFileError);
    EXPECT_FALSE(std::filesystem::exists(dir.at("j")));
  }
  EXPECT_NO_THROW(Journal::create(dir.at("j"), {}, {}));
}

TEST(JournalWriting, ANewJournalsNameIsBroughtToTheDisk) {
  const TempFolder dir;
  FsyncProbe::folders = 0;
  (void)Journal::create(dir.at("j"), {}, {});
  EXPECT_EQ(FsyncProbe::folders, 1);
}

TEST(JournalWriting, WhatWasCutOffIsNotThere) {
  const auto d = testing::drive(Model::li2014, 3, 4);
  const TempFolder dir;
  Journal j = Journal::create(dir.at("j"), {}, d->sensors);
  j.add(1, d->scans[0]);
  const std::uint64_t one = j.bytes();
  j.add(2, d->scans[1]);
  j.cut(j.bytes());
  EXPECT_GT(j.bytes(), one);
  j.cut(one);
  EXPECT_EQ(j.bytes(), one);
  j.move(1, {});
  const JournalContents c = read_journal(dir.at("j"));
  ASSERT_EQ(c.events.size(), 2u);
  EXPECT_EQ(c.events[1].kind, JournalEvent::Kind::move);
}

TEST(JournalWriting, ARecordThatFailedIsNotThere) {
  const auto d = testing::drive(Model::li2014, 3, 4);
  const TempFolder dir;
  Journal j = Journal::create(dir.at("j"), {}, d->sensors, {.sync_each = true});
  j.add(1, d->scans[0]);
  const std::uint64_t one = j.bytes();
  FsyncProbe::failing_from = 0;
  EXPECT_THROW(j.add(2, d->scans[1]), MapFileError);
  FsyncProbe::failing_from = -1;
  EXPECT_EQ(j.bytes(), one);
  EXPECT_EQ(read_journal(dir.at("j")).bytes, one);
  {
    const testing::FullDisk full(one + 40);
    EXPECT_THROW(j.add(2, d->scans[1]), MapFileError);
  }
  j.add(2, d->scans[2]);
  const JournalContents c = read_journal(dir.at("j"));
  ASSERT_EQ(c.events.size(), 2u);
  EXPECT_EQ(c.dropped, 0u);
  EXPECT_EQ(c.events[1].scan.stamp_ns, d->scans[2].stamp_ns);
}

}  // namespace
}  // namespace evigrid
