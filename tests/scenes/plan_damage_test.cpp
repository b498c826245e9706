// SPDX-License-Identifier: Apache-2.0
// A file cut short is never taken for a whole one, whatever the place of the cut; bytes changed at random are read or
// refused, never more; and absurd sizes are refused before memory is asked for.
#include <gtest/gtest.h>

#include <random>
#include <sstream>
#include <utility>

#include "plan_files.hpp"

namespace evigrid::scenes {
namespace {

using std::string;

const ImageScale kScale{.resolution_m = 1};

string noise(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  string s;
  for (std::size_t i = 0; i < count; ++i) s += static_cast<char>(random());
  return s;
}

string png(int colour_type, int depth, int interlace = 0) {
  const std::size_t channels = colour_type == 2 ? 3 : colour_type == 6 ? 4 : colour_type == 4 ? 2 : 1;
  const std::size_t stride = (5 * channels * static_cast<std::size_t>(depth) + 7) / 8;
  string lines;
  for (unsigned y = 0; y < 4; ++y) lines.append(1, '\0').append(noise(stride, y));
  return Png{5, 4, depth, colour_type, interlace, lines, colour_type == 3 ? noise(3 << depth, 9) : ""}.file();
}

std::vector<std::pair<string, string>> good_files() {
  string p5 = "P5\n# a comment\n5 4\n255\n" + noise(20, 1);
  Bmp bmp{.width = 5, .height = 4, .bits = 24, .pixels = noise(64, 2)};
  Bmp v4{.width = 5,
         .height = -4,
         .bits = 32,
         .pixels = noise(80, 3),
         .masks = {0xff, 0xff00, 0xff0000, 0xff000000},
         .compression = 3,
         .header = 108};
  Bmp small{.width = 5, .height = 4, .bits = 4, .pixels = noise(16, 4), .palette = noise(64, 5)};
  return {{"a.pgm", p5},
          {"b.pgm", "P5 3 2 65535\n" + noise(12, 6)},
          {"c.pgm", "P2\n2 3 # size\n15\n0 1 2\n# more\n13 14 15"},
          {"d.png", png(0, 1)},
          {"e.png", png(0, 16)},
          {"f.png", png(2, 8)},
          {"g.png", png(3, 4)},
          {"h.png", png(6, 8)},
          {"i.bmp", bmp.file()},
          {"j.bmp", v4.file()},
          {"k.bmp", small.file()},
          {"l.map", "type octile\nheight 2\nwidth 3\nmap\n@.@\nTWS\n"}};
}

TEST(PlanDamage, CutAnywhere) {
  for (const auto& [name, bytes] : good_files()) {
    ASSERT_EQ(refusal(bytes, name, kScale), "loaded") << name;
    const string whole = rows_of(load_text(bytes, name, kScale));
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      const string message = refusal(bytes.substr(0, n), name, kScale);
      if (message == "loaded") {
        // Nothing was lost: the last line's end, or digits of a plain sample that is whole without them.
        EXPECT_TRUE(name == "l.map" || name == "c.pgm") << name << " cut to " << n;
        EXPECT_EQ(n + 1, bytes.size()) << name;
        if (name == "l.map") {
          EXPECT_EQ(rows_of(load_text(bytes.substr(0, n), name, kScale)), whole);
        }
      } else {
        EXPECT_EQ(message.rfind(name + ":", 0), 0u) << message;
      }
    }
  }
}

TEST(PlanDamage, Messages) {
  EXPECT_EQ(refusal("P5 5 4 255\nabc", "a.pgm", kScale), "a.pgm: pixels: the file ends early: 3 bytes of at least 20");
  EXPECT_EQ(refusal("P5 5", "a.pgm", kScale), "a.pgm:1: height: is missing: the file ends here");
  EXPECT_EQ(refusal("P5\n5\nx", "a.pgm", kScale), "a.pgm:3: height: must be a whole number");
  EXPECT_EQ(refusal("P5\n5\n-4 255\n", "a.pgm", kScale), "a.pgm:3: height: must be a whole number");
  EXPECT_EQ(refusal("P5\n5 4 65536\n", "a.pgm", kScale), "a.pgm:2: maxval: is greater than 65535");
  EXPECT_EQ(refusal("P5\n5 4 0\n", "a.pgm", kScale), "a.pgm:3: maxval: is 0, must be within [1, 65535]");
  EXPECT_EQ(refusal("P2\n2 1 9\n4\n10", "a.pgm", kScale), "a.pgm:4: pixel 1: is greater than 9");
  EXPECT_EQ(refusal("P2\n2 1 9\n4\n1.5", "a.pgm", kScale), "a.pgm:4: pixel 1: must be a whole number");
  const string image = png(2, 8);
  EXPECT_EQ(refusal(image.substr(0, image.size() - 1), "a.png", kScale),
            "a.png: pixels: the file ends early, after " + std::to_string(image.size() - 1) + " bytes");
  string bad = image;
  bad[60] = static_cast<char>(~bad[60]);
  EXPECT_EQ(refusal(bad, "a.png", kScale).rfind("a.png: png: ", 0), 0u) << refusal(bad, "a.png", kScale);
  Bmp bmp{.width = 5, .height = 4, .bits = 24, .pixels = noise(64, 2)};
  const string whole = bmp.file();
  EXPECT_EQ(refusal(whole.substr(0, 100), "a.bmp", kScale),
            "a.bmp: pixels: the file ends early: 100 bytes of at least 118");
  EXPECT_EQ(refusal(whole.substr(0, 20), "a.bmp", kScale),
            "a.bmp: header: the file ends early: 20 bytes of at least 22");
  bmp.compression = 1;
  EXPECT_EQ(refusal(bmp.file(), "a.bmp", kScale), "a.bmp: compression: is 1; only uncompressed bitmaps are read");
  bmp.compression = 0;
  bmp.bits = 2;
  EXPECT_EQ(refusal(bmp.file(), "a.bmp", kScale), "a.bmp: bits: is 2 a pixel, must be 1, 4, 8, 16, 24 or 32");
}

TEST(PlanDamage, DataThatAreShorterThanTheHeaderSays) {
  // Well-formed chunks with right check sums, but one row too few.
  Png p{5, 4, 8, 0, 0, string(18, '\0')};
  EXPECT_EQ(refusal(p.file(), "a.png", kScale).rfind("a.png: png: Not enough image data", 0), 0u)
      << refusal(p.file(), "a.png", kScale);
  EXPECT_EQ(refusal(p.header() + Png::chunk("IEND", ""), "a.png", kScale).rfind("a.png: png: ", 0), 0u);
  // Data whole, end mark missing.
  p.scanlines.assign(24, '\0');
  const string whole = p.file();
  EXPECT_EQ(refusal(whole, "a.png", kScale), "loaded");
  EXPECT_EQ(refusal(whole.substr(0, whole.size() - 12), "a.png", kScale).rfind("a.png: pixels: the file ends early", 0),
            0u);
}

TEST(PlanDamage, AbsurdSizes) {
  const string most = "a plan has at most 268435456 pixels";
  EXPECT_EQ(refusal("P5 999999999 999999999 255\n", "a.pgm", kScale), "a.pgm: size: is 999999999 x 999999999, " + most);
  EXPECT_EQ(refusal("P5 16385 16384 255\n", "a.pgm", kScale), "a.pgm: size: is 16385 x 16384, " + most);
  EXPECT_EQ(refusal("P5 0 5 255\n", "a.pgm", kScale), "a.pgm: size: is 0 x 5, both must be positive");
  EXPECT_EQ(refusal("P5 16384 16384 255\n", "a.pgm", kScale),
            "a.pgm: pixels: the file ends early: 0 bytes of at least 268435456");
  EXPECT_EQ(refusal("P2 16384 16384 255\n", "a.pgm", kScale),
            "a.pgm: pixels: the file ends early: 0 bytes of at least 536870911");
  Png p{2'000'000'000, 2'000'000'000, 8, 2, 0, ""};
  EXPECT_EQ(refusal(p.file(), "a.png", kScale), "a.png: size: is 2000000000 x 2000000000, " + most);
  p.width = p.height = 16384;
  EXPECT_EQ(refusal(p.file(), "a.png", kScale),
            "a.png: pixels: " + std::to_string(p.file().size()) + " bytes cannot hold 16384 x 16384 pixels");
  Bmp b{.width = 2'000'000'000, .height = INT32_MIN, .bits = 1, .pixels = "", .palette = string(8, '\0')};
  EXPECT_EQ(refusal(b.file(), "a.bmp", kScale), "a.bmp: size: is 2000000000 x 2147483648, " + most);
  b.width = -5;
  EXPECT_EQ(refusal(b.file(), "a.bmp", kScale), "a.bmp: size: is -5 x 2147483648, both must be positive");
}

TEST(PlanDamage, RandomBytesChanged) {
  std::mt19937 random(7);
  std::size_t loaded = 0, refused = 0;
  for (const auto& [name, bytes] : good_files())
    for (int i = 0; i < 2000; ++i) {
      string bad = bytes;
      for (unsigned k = 0, count = 1 + random() % 4; k < count; ++k) {
        const std::size_t at = random() % bad.size();
        if (random() % 4 == 0)
          bad.erase(at, 1 + random() % 4);
        else
          bad[at] = static_cast<char>(random());
        if (bad.empty()) bad.assign(1, 'x');
      }
      const string message = refusal(bad, name, kScale);
      (message == "loaded" ? loaded : refused) += 1;
    }
  EXPECT_GT(loaded, 500u);
  EXPECT_GT(refused, 5000u);
}

TEST(PlanDamage, RandomBytesOfAYamlChanged) {
  PlanFolder folder;
  folder.write("p.pgm", "P2 1 1 1 1");
  const string good =
      "image: p.pgm\nresolution: 0.05\norigin: [1, 2, 0.5]\nnegate: 0\noccupied_thresh: 0.65\n"
      "free_thresh: 0.2\nmode: raw\n";
  const string name = folder.at("m.yaml");
  ASSERT_EQ(refusal(good, name), "loaded");
  for (std::size_t n = 0; n < good.size(); ++n) (void)refusal(good.substr(0, n), name);
  EXPECT_EQ(refusal(good.substr(0, good.find("free_thresh")), name), name + ":1: free_thresh: is missing");
  std::mt19937 random(8);
  const string marks = "{}[]:,&*!|>'\"%@`#?-\n\t 0x~\xff";
  std::size_t refused = 0;
  for (int i = 0; i < 5000; ++i) {
    string bad = good;
    for (int k = 0; k < 3; ++k) bad[random() % bad.size()] = marks[random() % marks.size()];
    refused += refusal(bad, name) != "loaded";
  }
  EXPECT_GT(refused, 2000u);
  // Deep nesting and references to references must neither crash nor take for ever.
  EXPECT_NE(refusal(string(100'000, '['), name), "loaded");
  EXPECT_NE(refusal(string(100'000, '{'), name), "loaded");
  std::ostringstream bomb;
  bomb << "a0: &a0 [x, x]\n";
  for (int i = 1; i < 60; ++i) bomb << "a" << i << ": &a" << i << " [*a" << i - 1 << ", *a" << i - 1 << "]\n";
  EXPECT_EQ(refusal(bomb.str() + good, name), "loaded");
}

}  // namespace
}  // namespace evigrid::scenes
