// SPDX-License-Identifier: Apache-2.0
// Every reader against every kind of damage: what can be used is used and the rest is counted by reason; what cannot be
// read ends with a message that names the file; nothing but InputError is ever thrown.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <thread>

#include "error.hpp"
#include "log/line_reader.hpp"
#include "log/readers.hpp"
#include "log_samples.hpp"
#include "program.hpp"

namespace evigrid::driver {
namespace {

struct Damage : ::testing::TestWithParam<FormatSample> {
  TempDir dir;
  const FormatSample& good = GetParam();

  /// Reads the sample with its middle row replaced.
  Log with_middle(const std::string& row) {
    FormatSample bad = good;
    bad.rows[1] = row;
    return read_log({bad.write(dir, bad.text())}, good.format);
  }
  std::string error_of(const std::string& path) {
    try {
      (void)read_log({path}, good.format);
    } catch (const InputError& error) {
      return error.what();
    }
    return "(no error)";
  }
  static void expect_same(const Log& a, const Log& b) {
    EXPECT_EQ(a.ranges_m, b.ranges_m);
    ASSERT_EQ(a.scans.size(), b.scans.size());
    for (std::size_t i = 0; i < a.scans.size(); ++i) {
      EXPECT_EQ(a.scans[i].stamp_ns, b.scans[i].stamp_ns);
      EXPECT_EQ(a.scans[i].T_map_robot.x_m, b.scans[i].T_map_robot.x_m);
    }
    EXPECT_EQ(a.malformed, b.malformed);
  }
};

TEST_P(Damage, TheUndamagedLogIsFoundAndWhole) {
  const Log log = read_log({good.write(dir, good.text())}, "auto");
  EXPECT_EQ(log.format, good.format);
  EXPECT_EQ(log.scans.size(), 3u);
  EXPECT_TRUE(log.malformed.empty());
  expect_same(log, read_log({dir.at(good.file)}, good.format));
}

TEST_P(Damage, TooFewFields) {
  const Log log = with_middle(first_half(good.rows[1], good.separator));
  EXPECT_EQ(log.scans.size(), 2u);
  EXPECT_EQ(log.malformed.at("too short"), 1u);
  ASSERT_EQ(log.warnings.size(), 1u);
  const auto heads = std::count(good.head.begin(), good.head.end(), '\n') + (good.head.empty() ? 0 : 1);
  const auto line = heads + 2;
  EXPECT_TRUE(contains(log.warnings[0], fmt::format("{}:{}: too short", good.file, line)));
}

TEST_P(Damage, TruncatedInTheMiddleOfTheLastRecord) {
  const std::string text = good.text();
  const Log log = read_log({good.write(dir, text.substr(0, text.size() - good.rows[2].size() / 2))}, good.format);
  EXPECT_EQ(log.scans.size(), 2u);
  EXPECT_EQ(log.malformed.at("too short"), 1u);
}

TEST_P(Damage, TooManyFields) {
  const Log log = with_middle(good.rows[1] + good.separator + "7");
  EXPECT_EQ(log.scans.size(), 2u);
  EXPECT_EQ(log.malformed.at("wrong count"), 1u);
}

TEST_P(Damage, NoNumber) {
  const Log log = with_middle(with_field(good.rows[1], good.separator, good.range_at, "3.x\x01"));
  EXPECT_EQ(log.scans.size(), 2u);
  EXPECT_EQ(log.malformed.at("bad number"), 1u);
  EXPECT_TRUE(contains(log.warnings.at(0), fmt::format("field {} is '3.x?'", good.range_at + 1)));
}

TEST_P(Damage, OddRangesReachTheEngineToBeCounted) {
  const auto odd = [&](const std::string& value) {
    const Log log = with_middle(with_field(good.rows[1], good.separator, good.range_at, value));
    EXPECT_EQ(log.scans.size(), 3u);
    std::size_t nans = 0;
    for (const float r : log.ranges_m) nans += std::isnan(r) ? 1 : 0;
    return std::pair{nans, log.absurd_ranges};
  };
  EXPECT_EQ(odd("nan"), (std::pair<std::size_t, std::uint64_t>{1, 0}));
  EXPECT_EQ(odd("inf"), (std::pair<std::size_t, std::uint64_t>{0, 0}));
  EXPECT_EQ(odd("-5"), (std::pair<std::size_t, std::uint64_t>{0, 0}));
  EXPECT_EQ(odd("9e9"), (std::pair<std::size_t, std::uint64_t>{1, 1}));
  EXPECT_EQ(odd("1e300"), (std::pair<std::size_t, std::uint64_t>{1, 1}));  // beyond what a float holds
}

TEST_P(Damage, TimeBackwardsKeepsTheLineOrder) {
  if (!good.timed) return;  // the format holds no time
  FormatSample swapped = good;
  std::swap(swapped.rows[0], swapped.rows[2]);
  const Log log = read_log({swapped.write(dir, swapped.text())}, good.format);
  ASSERT_EQ(log.scans.size(), 3u);
  EXPECT_GT(log.scans[0].stamp_ns, log.scans[1].stamp_ns);
  EXPECT_GT(log.scans[1].stamp_ns, log.scans[2].stamp_ns);
}

TEST_P(Damage, LineEndsOfWindowsAByteOrderMarkAndCommentsChangeNothing) {
  const Log plain = read_log({good.write(dir, good.text())}, "auto");
  std::string windows = "\xEF\xBB\xBF";
  for (const char c : good.text()) windows += c == '\n' ? "\r\n" : std::string(1, c);
  expect_same(plain, read_log({good.write(dir, windows)}, "auto"));
  expect_same(plain, read_log({good.write(dir, "\n# a note\n" + good.text() + "  \n")}, "auto"));
  std::string no_end = good.text();
  no_end.pop_back();
  expect_same(plain, read_log({good.write(dir, no_end)}, "auto"));
}

TEST_P(Damage, GzipIsTheSameLog) {
  const Log plain = read_log({good.write(dir, good.text())}, good.format);
  expect_same(plain, read_log({dir.write_gz(good.file, good.text())}, "auto"));
}

TEST_P(Damage, APipeIsTheSameLog) {  // it can be read once, and holds more than one look at it takes
  FormatSample many = good;
  const std::size_t rows = good.format == "ring8" ? 0 : (std::size_t{1} << 19) / good.rows[0].size();  // one a pose
  for (std::size_t i = 0; i < rows; ++i) many.rows.push_back(good.rows[i % 3]);
  const Log whole = read_log({many.write(dir, many.text())}, good.format);
  for (const std::string& bytes : {many.text(), slurp(dir.write_gz("packed", many.text()))}) {
    std::vector<std::string> paths, texts;
    for (const auto& [name, text] : many.beside) paths.push_back(dir.at(name)), texts.push_back(text);
    paths.push_back(dir.at(many.file)), texts.push_back(bytes);
    for (const std::string& path : paths) {
      std::filesystem::remove(path);
      ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
    }
    std::thread writer([&] {
      for (std::size_t i = 0; i < paths.size(); ++i) std::ofstream(paths[i], std::ios::binary) << texts[i];
    });
    expect_same(whole, read_log(paths, "auto"));
    writer.join();
    for (const std::string& path : paths) std::filesystem::remove(path);
  }
}

TEST_P(Damage, MemoryIsTheSameLog) {
  std::vector<std::string> texts;
  for (const auto& [name, text] : good.beside) texts.push_back(text);
  texts.push_back(good.text());
  const std::vector<std::string_view> spans(texts.begin(), texts.end());
  expect_same(read_log({good.write(dir, good.text())}, good.format), read_log_bytes(good.format, spans));
}

TEST_P(Damage, ALongLineIsCountedAndALongerOneRefused) {
  std::string text = good.text(), line;
  while (line.size() < (std::size_t{12} << 20)) line += good.rows[0] + good.separator;
  const Log log = read_log({good.write(dir, text + line + "\n" + good.rows[0] + "\n")}, good.format);
  EXPECT_GE(log.scans.size(), 3u);
  EXPECT_EQ(log.malformed.at("wrong count"), 1u);
  line += line;
  EXPECT_TRUE(contains(error_of(good.write(dir, text + line)), "over 16 MiB"));
}

TEST_P(Damage, RandomDamageThrowsNothingButInputError) {
  std::vector<std::string> texts;
  for (const auto& [name, text] : good.beside) texts.push_back(text);
  texts.push_back(good.text());
  std::mt19937 random(7);
  const std::string alphabet = "0123456789.,- \nenafLSMPOR\r\t#\xff";
  for (int round = 0; round < 400; ++round) {
    std::vector<std::string> bad = texts;
    std::string& text = bad[random() % bad.size()];
    for (unsigned edits = 1 + random() % 6; edits > 0; --edits) {
      const std::size_t at = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[at] = alphabet[random() % alphabet.size()];
          break;
        case 1:
          text.insert(at, 1, alphabet[random() % alphabet.size()]);
          break;
        default:
          text.erase(at, 1 + random() % 9);
      }
      if (text.empty()) text = "x";
    }
    const std::vector<std::string_view> spans(bad.begin(), bad.end());
    for (const std::string& format : {good.format, std::string("auto")}) {
      try {
        const Log log = read_log_bytes(format, spans);
        for (const LogScan& scan : log.scans) ASSERT_LE(scan.first + scan.count, log.readings.size());
        for (const LogReading& r : log.readings) ASSERT_LE(r.first + r.count, log.ranges_m.size());
      } catch (const InputError&) {
      }
    }
  }
}

// What a user meets: exit code 2, the file named, nothing left behind.
TEST_P(Damage, UnreadableFilesEndTheProgramWithTwo) {
  FormatSample broken = good;
  for (std::string& row : broken.rows) row = first_half(row, good.separator);
  std::string junk(5000, ' ');
  std::mt19937 random(1);
  for (char& c : junk) c = static_cast<char>(random());
  const std::string packed = slurp([&] {
    std::string many = good.head.empty() ? "" : good.head + "\n";
    for (int i = 0; i < 300; ++i) many += good.rows[static_cast<std::size_t>(i % 3)] + "\n";
    return dir.write_gz("packed", many);
  }());
  const auto expect_two = [&](const std::string& message, const std::string& format) {
    const std::set<std::string> before = dir.names();
    const Ran ran = evigrid({"map", dir.at(good.file), "-o", dir.at("out"), "--format", format});
    EXPECT_EQ(ran.code, 2) << message;
    EXPECT_TRUE(contains(ran.err, message));
    EXPECT_TRUE(contains(ran.err, good.file));
    EXPECT_EQ(dir.names(), before);
  };
  for (const std::string& format : {good.format, std::string("auto")}) {
    (void)good.write(dir, "x");
    std::filesystem::remove(dir.at(good.file));
    expect_two("no such file", format);
    (void)good.write(dir, "");
    expect_two("no usable record", format);
    (void)good.write(dir, junk);
    expect_two("not a text log: it holds binary data", format);
    (void)good.write(dir, packed.substr(0, packed.size() / 2));
    expect_two("truncated: the gzip stream ends too early", format);
  }
  (void)good.write(dir, broken.text());
  expect_two("no usable record", good.format);
  const int alone = good.format == "ring8" ? 3 : 0;  // poses that have lost their measurements count too
  expect_two(fmt::format("{} malformed", 3 + alone), good.format);
  expect_two(": too short: ", good.format);
  if (good.beside.empty()) {
    (void)good.write(dir, "hello world\nI am no log\n");
    expect_two("looks like none of: carmen, ring8", "auto");
    expect_two("first line is 'hello world'", "auto");
    std::filesystem::remove(dir.at(good.file));
    std::filesystem::create_directory(dir.at(good.file));
    expect_two("is a folder, not a log file", good.format);
    expect_two("is a folder without a log that is one", "auto");
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, Damage, ::testing::ValuesIn(format_samples()),
                         [](const auto& one) { return one.param.format; });

TEST(LogFormats, EveryFormatIsDamagedAbove) {
  std::vector<std::string> covered{"auto"};
  for (const FormatSample& sample : format_samples()) covered.push_back(sample.format);
  covered.emplace_back("bag");  // no lines: bag_test.cpp
  EXPECT_EQ(covered, log_formats());
}

TEST(LogFormats, TooManyFilesAreRefused) {
  const TempDir dir;
  const std::string a = dir.write("a", wean_scan("300", 1) + "\n"), b = dir.write("b", wean_scan("300", 2) + "\n");
  EXPECT_THROW((void)read_log({a, b}, "auto"), InputError);
}

TEST(LineReader, FieldsBeyondTheMostAreNotKept) {
  std::vector<std::string_view> tokens;
  const std::string blanks(100000, ' '), commas(100000, ',');
  std::string ones;
  for (int i = 0; i < 1000; ++i) ones += "1 ";
  split(ones, tokens, 10);
  EXPECT_EQ(tokens.size(), 11u);
  split(blanks, tokens, 10);
  EXPECT_EQ(tokens.size(), 0u);
  split_commas(commas, tokens, 10);
  EXPECT_EQ(tokens.size(), 11u);
  split_commas(" a ,\t, b", tokens);
  EXPECT_EQ(tokens, (std::vector<std::string_view>{"a", "", "b"}));
}

TEST(LineReader, MemoryHoldsTheSameLinesAsAFile) {
  const TempDir dir;
  std::string text = "\xEF\xBB\xBF";
  for (int i = 0; i < 40000; ++i) text += fmt::format("line {}\n", i);  // larger than one buffer
  LineReader file(dir.write("a", text)), memory(Source{"m", text});
  std::string_view a, b;
  while (file.next(a)) {
    ASSERT_TRUE(memory.next(b));
    ASSERT_EQ(a, b);
  }
  EXPECT_FALSE(memory.next(b));
  EXPECT_EQ(memory.line_number(), 40000u);
  LineReader binary(Source{"m", std::string_view("a\0b\n", 4)});
  EXPECT_THROW((void)binary.next(b), InputError);
}

TEST(LineReader, APackedTextOrAPipeHasAnEnd) {
  const TempDir dir;
  const std::string text(100000, '\n');
  const auto lines_of = [&](const std::string& path, std::uint64_t most) {
    LineReader lines(Source{path}, most);
    std::size_t count = 0;
    for (std::string_view line; lines.next(line);) ++count;
    return count;
  };
  EXPECT_EQ(lines_of(dir.write("plain", text), 10), text.size());
  EXPECT_EQ(lines_of(dir.write_gz("packed", text), text.size()), text.size());
  EXPECT_THROW((void)lines_of(dir.at("packed"), text.size() - 1), InputError);
  const std::string pipe = dir.at("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::uint64_t most : {text.size(), text.size() - 1}) {
    std::thread writer([&] { std::ofstream(pipe, std::ios::binary) << text; });
    if (most == text.size()) {
      EXPECT_EQ(lines_of(pipe, most), text.size());
    } else {
      EXPECT_THROW((void)lines_of(pipe, most), InputError);
    }
    writer.join();
  }
}

}  // namespace
}  // namespace evigrid::driver
