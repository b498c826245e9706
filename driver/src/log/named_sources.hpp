// SPDX-License-Identifier: Apache-2.0
// The files that a user names, so that they can be looked at before they are read: what can be read only once (a pipe)
// is read here and kept.
#pragma once
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "log/source.hpp"

namespace evigrid::driver {

class NamedSources {
 public:
  /// Throws InputError as LineReader does when a pipe holds no text or too much of it; files and folders are not opened.
  explicit NamedSources(std::span<const std::string> paths);
  NamedSources(const NamedSources&) = delete;
  NamedSources& operator=(const NamedSources&) = delete;

  /// In their order; for as long as this lives.
  [[nodiscard]] std::span<const Source> all() const { return sources_; }

 private:
  std::deque<std::string> texts_;
  std::vector<Source> sources_;
};

}  // namespace evigrid::driver
