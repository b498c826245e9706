// SPDX-License-Identifier: Apache-2.0
// Nothing half-written stays behind, whatever fails.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <thread>

#include "error.hpp"
#include "out/out_dir.hpp"
#include "temp_dir.hpp"

namespace evigrid::driver {
namespace {

using Names = std::set<std::string>;

TEST(OutDir, CommitPutsEverythingInPlace) {
  const TempDir dir;
  OutDir out(dir.at("a/b"));
  out.write("one", "1");
  out.write_outside(dir.at("two"), "22");
  EXPECT_FALSE(dir.names().contains("a/b/one"));  // only under its temporary name so far
  out.commit();
  EXPECT_EQ(dir.names(), (Names{"a", "a/b", "a/b/one", "two"}));
  EXPECT_EQ(slurp(dir.at("a/b/one")), "1");
  EXPECT_EQ(slurp(dir.at("two")), "22");
}

TEST(OutDir, WithoutCommitNothingStays) {
  const TempDir dir;
  {
    OutDir out(dir.at("a/b/"));
    out.write("one", "1");
  }
  EXPECT_EQ(dir.names(), Names{});
}

TEST(OutDir, AFolderThatWasThereAndItsOldFilesStay) {
  const TempDir dir;
  dir.write("a/one", "old");
  {
    OutDir out(dir.at("a"));
    out.write("one", "new");
  }
  EXPECT_EQ(dir.names(), (Names{"a", "a/one"}));
  EXPECT_EQ(slurp(dir.at("a/one")), "old");
}

TEST(OutDir, AFolderThatCannotBeMadeIsNamedAtOnce) {
  const TempDir dir;
  dir.write("file", "");
  for (const std::string& bad : {dir.at("file/out"), dir.at("file"), dir.at("x/") + std::string(300, 'n')}) {
    try {
      OutDir out(bad);
      FAIL() << bad;
    } catch (const InputError& error) {
      EXPECT_TRUE(contains(error.what(), "cannot be written"));
    }
  }
  EXPECT_THROW(OutDir(""), InputError);
  EXPECT_EQ(dir.names(), Names{"file"});
}

TEST(OutDir, AFolderInAFilesPlaceUndoesTheCommit) {
  const TempDir dir;
  std::filesystem::create_directory(dir.at("two"));
  {
    OutDir out(dir.at("a"));
    out.write("one", "1");
    EXPECT_THROW(out.write_outside(dir.at("two"), "2"), InputError);
  }
  EXPECT_EQ(dir.names(), Names{"two"});
}

TEST(OutDir, AFailingCommitTakesBackWhatItMoved) {
  const TempDir dir;
  {
    OutDir out(dir.at("a"));
    out.write("one", "1");
    out.write("two", "2");
    dir.write("a/two/inside", "x");  // now a folder stands there: the second rename fails
    EXPECT_THROW(out.commit(), InputError);
  }
  EXPECT_EQ(dir.names(), (Names{"a", "a/two", "a/two/inside"}));
}

TEST(OutDir, APieceByPieceWriterIsStagedToo) {
  const TempDir dir;
  {
    OutDir out(dir.at("a"));
    out.write_by("one", [](std::ostream& to) { to << "1" << 2; });
    EXPECT_FALSE(dir.names().contains("a/one"));
    out.commit();
  }
  EXPECT_EQ(slurp(dir.at("a/one")), "12");
  {
    OutDir out(dir.at("a"));
    EXPECT_THROW(out.write_by("two", [](std::ostream& to) { to.setstate(std::ios::badbit); }), InputError);
    EXPECT_THROW(out.write_by("three", [](std::ostream&) { throw std::runtime_error("x"); }), std::runtime_error);
  }
  EXPECT_EQ(dir.names(), (Names{"a", "a/one"}));
}

TEST(OutDir, ASingleFile) {
  const TempDir dir;
  require_writable(dir.at("f"));
  EXPECT_EQ(dir.names(), Names{});
  write_file(dir.at("f"), "abc");
  EXPECT_EQ(slurp(dir.at("f")), "abc");
  EXPECT_THROW(require_writable(dir.at("no/f")), InputError);
  EXPECT_THROW(write_file(dir.at("no/f"), "x"), InputError);
}

TEST(WriteFile, PieceByPieceOrNotAtAll) {
  const TempDir dir;
  dir.write("kept", "old");
  for (const char* name : {"kept", "new"}) {
    EXPECT_THROW(write_file_by(dir.at(name), [](std::ostream& to) { to.setstate(std::ios::badbit); }), InputError);
    EXPECT_THROW(write_file_by(dir.at(name), [](std::ostream&) { throw std::runtime_error("x"); }), std::runtime_error);
  }
  EXPECT_THROW(write_file_by(dir.at("no/f"), [](std::ostream&) {}), InputError);
  EXPECT_EQ(dir.names(), Names{"kept"});
  EXPECT_EQ(slurp(dir.at("kept")), "old");
  std::filesystem::create_symlink("kept", dir.at("link"));
  write_file_by(dir.at("link"), [](std::ostream& to) { to << "n" << "ew"; });
  EXPECT_EQ(slurp(dir.at("kept")), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(dir.at("link")));
}

TEST(WriteFile, FollowsALinkAndKeepsIt) {
  const TempDir dir;
  dir.write("real.csv", "old");
  std::filesystem::create_symlink("real.csv", dir.at("link.csv"));
  write_file(dir.at("link.csv"), std::string_view("new"));
  EXPECT_TRUE(std::filesystem::is_symlink(dir.at("link.csv")));
  EXPECT_EQ(slurp(dir.at("real.csv")), "new");
}

TEST(WriteFile, WritesIntoAPipeAndLeavesIt) {
  const TempDir dir;
  ASSERT_EQ(::mkfifo(dir.at("pipe").c_str(), 0600), 0);
  std::string got;
  std::thread reader([&] { got = slurp(dir.at("pipe")); });
  require_writable(dir.at("pipe"));
  write_file(dir.at("pipe"), std::string_view("through"));
  reader.join();
  EXPECT_EQ(got, "through");
  EXPECT_TRUE(std::filesystem::is_fifo(dir.at("pipe")));
}

TEST(OutDir, ADeviceBesideTheFolderIsWrittenToAndStays) {
  const TempDir dir;
  OutDir out(dir.at("out"));
  out.write("a", "a");
  out.write_outside("/dev/null", "b");
  out.commit();
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_EQ(slurp(dir.at("out/a")), "a");
}

TEST(OutDir, AFailingCommitKeepsWhatWasThereBefore) {
  const TempDir dir;
  dir.write("a/one", "old");
  {
    OutDir out(dir.at("a"));
    out.write("one", "1");
    out.write("new", "1");
    out.write("two", "2");
    dir.write("a/two/inside", "x");
    EXPECT_THROW(out.commit(), InputError);
  }
  EXPECT_EQ(dir.names(), (Names{"a", "a/one", "a/two", "a/two/inside"}));
}

TEST(OutDir, AFileWrittenTwiceIsTheLastOne) {
  const TempDir dir;
  dir.write("a/report.json", "old");
  {
    OutDir out(dir.at("a"));
    out.write("report.json", "1");
    out.write("map", "m");
    out.write_outside(dir.at("a/report.json"), "2");
    out.commit();
  }
  EXPECT_EQ(slurp(dir.at("a/report.json")), "2");
  EXPECT_EQ(dir.names(), (Names{"a", "a/map", "a/report.json"}));
}

TEST(OutDir, AWriterThatComplainsOfItsStreamIsTheDisk) {
  const TempDir dir;
  OutDir out(dir.at("a"));
  try {
    out.write_by("map", [](std::ostream& to) {
      to.setstate(std::ios::badbit);
      throw std::runtime_error("the stream cannot be written");
    });
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("a/map"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace evigrid::driver
