// SPDX-License-Identifier: Apache-2.0
// Lines of a text file, plain or gzip, or of text in memory, in bounded memory. Damage is an error and never a short
// file: a gzip stream cut off in the middle or with a wrong checksum throws InputError naming the file, as do binary
// contents. A byte-order mark of UTF-8 is no part of the first line.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "log/source.hpp"

namespace evigrid::driver {

/// Most bytes of text that a gzip file may unpack to, or that may come through a pipe: nothing but the text itself
/// shows how long it is, and a small file must not fill the memory. A plain file may hold any number.
inline constexpr std::uint64_t kMostUnpacked = std::uint64_t{2} << 30;

class LineReader {
 public:
  /// Throws InputError when the file is missing, a folder, or cannot be opened.
  explicit LineReader(const std::string& path) : LineReader(Source{path}) {}
  explicit LineReader(const Source& source, std::uint64_t most_unpacked = kMostUnpacked);
  ~LineReader();
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  /// The next line without its end (\n or \r\n); false at the end of the file. The view lives until the next call.
  bool next(std::string_view& line);
  [[nodiscard]] std::size_t line_number() const { return line_; }  ///< of the line last returned, from 1
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  bool fill();
  std::size_t read_some(char* to, std::size_t most);
  struct Impl;
  std::unique_ptr<Impl> impl_;
  std::string path_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0, line_ = 0;
  std::uint64_t left_;  ///< of most_unpacked
  bool ended_ = false;
};

/// More fields than any record has: a line of millions of them must not become millions of views.
inline constexpr std::size_t kMostFields = (std::size_t{1} << 21) + 64;

/// Splits at blanks and tabs into `tokens`, which is reused. Fields beyond `most` + 1 are left out: enough to see that
/// there are too many.
void split(std::string_view line, std::vector<std::string_view>& tokens, std::size_t most = kMostFields);

/// Splits at commas; blanks and tabs around a field are no part of it, an empty field is one.
void split_commas(std::string_view line, std::vector<std::string_view>& tokens, std::size_t most = kMostFields);

/// The whole token as a number ("nan" and "inf" are numbers), locale-independent; false otherwise.
bool parse_number(std::string_view token, double& value);

}  // namespace evigrid::driver
