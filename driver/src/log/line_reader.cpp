// SPDX-License-Identifier: Apache-2.0
// zlib reads plain files as they are and gzip files unpacked; what it does not do is to treat an early end as an error
// on its own, so the end of the file asks for it.
#include "log/line_reader.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>

#include "error.hpp"

namespace evigrid::driver {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 18;
constexpr std::size_t kMaxLine = std::size_t{1} << 24;  // 16 MiB: a fan of a million beams
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

}  // namespace

struct LineReader::Impl {
  gzFile file = nullptr;
  bool regular = false;
  std::string_view memory;  ///< what is left of it
};

LineReader::LineReader(const Source& source, std::uint64_t most_unpacked)
    : impl_(std::make_unique<Impl>()), path_(source.name), buffer_(kChunk), left_(most_unpacked) {
  if (source.bytes) {
    impl_->memory = *source.bytes;
    return;
  }
  const std::string& path = path_;
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw InputError(fmt::format("{}: no such file", path));
  if (std::filesystem::is_directory(status)) throw InputError(fmt::format("{}: is a folder, not a log file", path));
  impl_->regular = std::filesystem::is_regular_file(status);
  errno = 0;
  impl_->file = gzopen(path.c_str(), "rb");
  if (impl_->file == nullptr) throw InputError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
}

LineReader::~LineReader() {
  if (impl_->file != nullptr) gzclose_r(impl_->file);
}

bool LineReader::fill() {
  if (ended_) return false;
  if (begin_ > 0) {  // keep only the unfinished line
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (end_ == buffer_.size()) {
    if (buffer_.size() >= kMaxLine)
      throw InputError(fmt::format("{}:{}: not a text log: a line of over 16 MiB", path_, line_ + 1));
    buffer_.resize(buffer_.size() * 2);
  }
  const std::size_t got = read_some(buffer_.data() + end_, buffer_.size() - end_);
  if (got == 0) ended_ = true;
  if (std::memchr(buffer_.data() + end_, '\0', got) != nullptr) {
    throw InputError(fmt::format("{}: not a text log: it holds binary data", path_));
  }
  end_ += got;
  return got > 0;
}

std::size_t LineReader::read_some(char* to, std::size_t most) {
  if (impl_->file == nullptr) {
    const std::size_t n = impl_->memory.copy(to, most);
    impl_->memory.remove_prefix(n);
    return n;
  }
  errno = 0;
  const int got = gzread(impl_->file, to, static_cast<unsigned>(most));
  int code = Z_OK;
  const char* message = gzerror(impl_->file, &code);
  if (code == Z_BUF_ERROR) throw InputError(fmt::format("{}: truncated: the gzip stream ends too early", path_));
  if (got < 0 || (code != Z_OK && code != Z_STREAM_END)) {
    throw InputError(fmt::format("{}: cannot be read: {}", path_, code == Z_ERRNO ? std::strerror(errno) : message));
  }
  const auto bytes = static_cast<std::size_t>(got);
  if (impl_->regular && gzdirect(impl_->file) != 0) return bytes;
  if (bytes > left_) {
    throw InputError(
        fmt::format("{}: too long a text to come packed or through a pipe: put it into a plain file", path_));
  }
  left_ -= bytes;
  return bytes;
}

bool LineReader::next(std::string_view& line) {
  std::size_t searched = begin_;
  while (true) {
    const char* from = buffer_.data() + searched;
    if (const void* hit = std::memchr(from, '\n', end_ - searched)) {
      const std::size_t at = static_cast<std::size_t>(static_cast<const char*>(hit) - buffer_.data());
      line = {buffer_.data() + begin_, at - begin_};
      begin_ = at + 1;
      break;
    }
    const std::size_t seen = end_ - begin_;
    if (!fill()) {
      if (begin_ == end_) return false;
      line = {buffer_.data() + begin_, end_ - begin_};  // a last line without an end
      begin_ = end_;
      break;
    }
    searched = begin_ + seen;
  }
  ++line_;
  if (line_ == 1 && line.starts_with(kByteOrderMark)) line.remove_prefix(kByteOrderMark.size());
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return true;
}

void split(std::string_view line, std::vector<std::string_view>& tokens, std::size_t most) {
  tokens.clear();
  std::size_t at = 0;
  while (tokens.size() <= most && (at = line.find_first_not_of(" \t", at)) != std::string_view::npos) {
    const std::size_t stop = std::min(line.find_first_of(" \t", at), line.size());
    tokens.push_back(line.substr(at, stop - at));
    at = stop;
  }
}

void split_commas(std::string_view line, std::vector<std::string_view>& tokens, std::size_t most) {
  tokens.clear();
  for (std::size_t at = 0; tokens.size() <= most;) {
    const std::size_t comma = std::min(line.find(',', at), line.size());
    std::string_view field = line.substr(at, comma - at);
    const std::size_t from = std::min(field.find_first_not_of(" \t"), field.size());
    field.remove_prefix(from);
    field.remove_suffix(field.size() - (field.find_last_not_of(" \t") + 1));
    tokens.push_back(field);
    if (comma == line.size()) break;
    at = comma + 1;
  }
}

bool parse_number(std::string_view token, double& value) {
  if (!token.empty() && token.front() == '+') token.remove_prefix(1);
  const auto [stop, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  return error == std::errc() && stop == token.data() + token.size() && !token.empty();
}

}  // namespace evigrid::driver
