// SPDX-License-Identifier: Apache-2.0
// Reading a log of any known format, from files or from memory. The formats themselves: formats.hpp.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "log/bag_options.hpp"
#include "log/log.hpp"

namespace evigrid::driver {

/// Names of --format, "auto" first.
const std::vector<std::string>& log_formats();

/// One line a format, for help texts: "  name  what it is".
std::string describe_formats();

/// Reads one or more paths of a format ("auto" looks). Throws InputError naming the file for anything unreadable, and
/// when no record of it can be used.
Log read_log(const std::vector<std::string>& paths, const std::string& format, const BagOptions& bag = {});

class NamedSources;
/// The same of files that are no bag, already looked at.
Log read_text_log(const NamedSources& named, const std::string& format);

/// The same from memory: plain text, one span for each file of the log (ring8: poses, then measurements).
Log read_log_bytes(const std::string& format, std::span<const std::string_view> files);

}  // namespace evigrid::driver
