// SPDX-License-Identifier: Apache-2.0
// The tests' folder with gzip files and listings.
#pragma once
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "temp_folder.hpp"
#include "text.hpp"

namespace evigrid::driver {

class TempDir : public TempFolder {
 public:
  std::string write_gz(const std::string& name, const std::string& bytes) const {
    gzFile file = gzopen(at(name).c_str(), "wb");
    gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(file);
    return at(name);
  }

  /// Names of everything below the folder, hidden files too.
  [[nodiscard]] std::set<std::string> names() const {
    std::set<std::string> out;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path())) {
      out.insert(std::filesystem::relative(entry.path(), path()).string());
    }
    return out;
  }
};

inline std::string slurp(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace evigrid::driver
