// SPDX-License-Identifier: Apache-2.0
// A report as one self-contained HTML page: text, tables, pictures (PNG inside), plots (SVG inside). No script but what
// a section brings along, nothing fetched from anywhere.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "paper/finding.hpp"

namespace evigrid::driver {

class Page {
 public:
  /// @param source the paper, as one would cite it.
  Page(std::string title, std::string source);
  void heading(std::string_view text);
  void paragraph(std::string_view text);
  void list(const std::vector<std::string>& items);
  /// (address relative to the page, text).
  void links(const std::vector<std::pair<std::string, std::string>>& links);
  void findings(const std::vector<Finding>& findings);
  void table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows);
  /// A PNG file's bytes. Several of one row side by side: begin_row() … end_row().
  void picture(std::span<const std::byte> png_bytes, std::string_view caption);
  void begin_row();
  void end_row();
  /// Markup as it is: an SVG plot, or a section of its own with its script.
  void raw(std::string_view markup, std::string_view caption = {});
  /// What another page says below its title: sections that are made before what comes above them.
  void append(const Page& sections) { body_ += sections.body_; }
  [[nodiscard]] std::string html() const;

 private:
  std::string title_, source_, body_;
};

[[nodiscard]] std::string escaped(std::string_view text);
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

}  // namespace evigrid::driver
