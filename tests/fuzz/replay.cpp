// SPDX-License-Identifier: Apache-2.0
// Runs a fuzz target without a fuzzer: every seed as it is, cut short, and with random damage, the same each time.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr int kMutationsPerSeed = 2000, kCutsPerSeed = 200;
constexpr std::size_t kChanges = 6;

void damage(Bytes& bytes, const Bytes& other, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return random() % n; };
  for (std::size_t n = 1 + below(kChanges); n > 0 && !bytes.empty(); --n) {
    const std::size_t at = below(bytes.size());
    switch (below(6)) {
      case 0:
        bytes[at] ^= static_cast<std::uint8_t>(1u << below(8));
        break;
      case 1:
        bytes[at] = static_cast<std::uint8_t>(random());
        break;
      case 2:
        bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                    bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), at + 1 + below(8))));
        break;
      case 3:
        bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), 1 + below(4),
                     static_cast<std::uint8_t>("09-.e\n \xff"[below(8)]));
        break;
      case 4: {  // a piece of another seed
        if (other.empty()) break;
        const std::size_t from = below(other.size()), count = std::min(other.size() - from, 1 + below(64));
        bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), other.begin() + static_cast<std::ptrdiff_t>(from),
                     other.begin() + static_cast<std::ptrdiff_t>(from + count));
        break;
      }
      default:  // a large number where a size may be
        for (std::size_t i = at; i < std::min(bytes.size(), at + 4); ++i) bytes[i] = 0xff;
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Bytes> seeds;
  for (int i = 1; i < argc; ++i) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(argv[i])) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) {
      std::ifstream in(file, std::ios::binary);
      seeds.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
  }
  if (seeds.empty()) {
    std::fprintf(stderr, "no seeds\n");
    return 1;
  }
  std::mt19937 random(1);
  std::size_t runs = 0;
  const auto run = [&](const Bytes& bytes) {
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    ++runs;
  };
  for (const Bytes& seed : seeds) {
    run(seed);
    for (int cut = 0; cut < kCutsPerSeed; ++cut) {
      run(Bytes(seed.begin(), seed.begin() + static_cast<std::ptrdiff_t>(random() % (seed.size() + 1))));
    }
    for (int m = 0; m < kMutationsPerSeed; ++m) {
      Bytes bytes = seed;
      damage(bytes, seeds[random() % seeds.size()], random);
      run(bytes);
    }
  }
  std::printf("%zu inputs from %zu seeds, none crashed\n", runs, seeds.size());
}
