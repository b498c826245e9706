// SPDX-License-Identifier: Apache-2.0
// map --journal: each scan is recorded before it is fused; --resume: the scans of a run that ended early are proved to
// be the log's first ones, and what follows is recorded behind them.
#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "evigrid/journal.hpp"
#include "mapping.hpp"

namespace evigrid::driver {

class MapJournal {
 public:
  /// Throws InputError.
  MapJournal(const JournalFile&, const Map&, std::span<const Scan> log);
  /// Scans `first` … of the log, about to be fused.
  void record(std::size_t first, std::span<const Scan>);
  [[nodiscard]] nlohmann::ordered_json facts() const;  ///< null without a journal

 private:
  std::string path_;
  std::optional<Journal> journal_;
  std::size_t known_ = 0;  // scans of the log that it held already
  std::uint64_t dropped_ = 0;
};

}  // namespace evigrid::driver
