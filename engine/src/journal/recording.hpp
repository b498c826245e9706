// SPDX-License-Identifier: Apache-2.0
// A call is recorded before it is done; of one that throws, only what was done stays in the journal.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "evigrid/journal.hpp"

namespace evigrid {

class Recording {
 public:
  /// Of one call; without a journal it does nothing.
  explicit Recording(std::optional<Journal>& journal) : journal_(journal ? &*journal : nullptr) { note(); }
  ~Recording() {
    if (journal_ != nullptr) journal_->cut(ends_[done_]);
  }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  /// One record: f writes it.
  template <class F>
  void record(F&& f) {
    if (journal_ == nullptr) return;
    f(*journal_);
    note();
  }
  /// What the first so many records tell was done.
  void done(std::size_t records) noexcept { done_ = records; }

 private:
  void note() {
    if (journal_ != nullptr) ends_.push_back(journal_->bytes());
  }
  Journal* journal_;
  std::vector<std::uint64_t> ends_;  // of the journal before the call, and after each record
  std::size_t done_ = 0;
};

}  // namespace evigrid
