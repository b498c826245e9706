// SPDX-License-Identifier: Apache-2.0
#include "paper/page.hpp"

#include <fmt/format.h>

#include <array>

namespace evigrid::driver {
namespace {

constexpr std::string_view kStyle = R"(
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, sans-serif; color: #1c2430; background: #fff; max-width: 68rem; margin: 2rem auto; padding: 0 1.2rem; }
h1 { font-size: 1.7rem; line-height: 1.2; margin-bottom: .2rem; } h2 { font-size: 1.25rem; margin-top: 2.2rem; }
p.source { color: #5a6675; margin-top: 0; }
table { border-collapse: collapse; margin: 1rem 0; font-size: .92rem; } th, td { text-align: left; vertical-align: top; padding: .35rem .7rem; border-bottom: 1px solid #d9dee5; }
th { background: #f3f5f8; font-weight: 600; } td.number { text-align: right; font-variant-numeric: tabular-nums; }
.met { color: #17703a; font-weight: 600; white-space: nowrap; } .missed { color: #b3261e; font-weight: 600; white-space: nowrap; }
figure { margin: 1rem 0; } figure img, figure svg { max-width: 100%; height: auto; border: 1px solid #d9dee5; } figcaption { color: #5a6675; font-size: .88rem; }
.wide { overflow-x: auto; }
.row { display: flex; flex-wrap: wrap; gap: 1rem; } .row figure { flex: 1 1 18rem; margin: .5rem 0; }
)";

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? std::to_integer<unsigned>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) {
      out += i + k <= bytes.size() ? kLetters[word >> (18 - 6 * k) & 63] : '=';
    }
  }
  return out;
}

nlohmann::ordered_json to_json(const std::vector<Finding>& findings) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const Finding& f : findings) {
    nlohmann::ordered_json row{{"name", f.name}, {"published", f.published}, {"ours", f.ours}};
    constexpr std::array kAims{"target", "floor", "reported", "fact"};
    row["aim"] = kAims[static_cast<std::size_t>(f.aim)];
    if (asks(f.aim)) row["met"] = f.met;
    if (!f.value.is_null()) row["value"] = f.value;
    row["obtained"] = f.obtained;
    if (f.timed) row["timed"] = true;
    out.push_back(std::move(row));
  }
  return out;
}

Page::Page(std::string title, std::string source) : title_(std::move(title)), source_(std::move(source)) {}

void Page::heading(std::string_view text) { body_ += fmt::format("<h2>{}</h2>\n", escaped(text)); }
void Page::paragraph(std::string_view text) { body_ += fmt::format("<p>{}</p>\n", escaped(text)); }
void Page::links(const std::vector<std::pair<std::string, std::string>>& links) {
  body_ += "<ul>\n";
  for (const auto& [to, text] : links)
    body_ += fmt::format("<li><a href=\"{}\">{}</a></li>\n", escaped(to), escaped(text));
  body_ += "</ul>\n";
}
void Page::list(const std::vector<std::string>& items) {
  body_ += "<ul>\n";
  for (const std::string& item : items) body_ += fmt::format("<li>{}</li>\n", escaped(item));
  body_ += "</ul>\n";
}

void Page::findings(const std::vector<Finding>& all) {
  body_ += "<table>\n<tr><th>figure</th><th>published</th><th>ours</th><th></th><th>how obtained</th></tr>\n";
  for (const Finding& f : all) {
    const char* css = asks(f.aim) ? (f.met ? "met" : "missed") : "";
    body_ += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"{}\">{}</td><td>{}</td></tr>\n",
                         escaped(f.name), escaped(f.published), escaped(f.ours), css, verdict(f), escaped(f.obtained));
  }
  body_ += "</table>\n";
}

void Page::table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows) {
  body_ += "<div class=\"wide\"><table>\n<tr>";
  for (const std::string& cell : head) body_ += fmt::format("<th>{}</th>", escaped(cell));
  body_ += "</tr>\n";
  for (const auto& row : rows) {
    body_ += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) {
      const bool number = !row[i].empty() && row[i].find_first_not_of("0123456789+-.,e%±× ") == std::string::npos;
      body_ += fmt::format("<td{}>{}</td>", number ? " class=\"number\"" : "", escaped(row[i]));
    }
    body_ += "</tr>\n";
  }
  body_ += "</table></div>\n";
}

void Page::picture(std::span<const std::byte> png_bytes, std::string_view caption) {
  body_ +=
      fmt::format("<figure><img alt=\"{}\" src=\"data:image/png;base64,{}\"><figcaption>{}</figcaption></figure>\n",
                  escaped(caption), base64(png_bytes), escaped(caption));
}
void Page::begin_row() { body_ += "<div class=\"row\">\n"; }
void Page::end_row() { body_ += "</div>\n"; }
void Page::raw(std::string_view markup, std::string_view caption) {
  body_ += fmt::format("<figure>{}{}</figure>\n", markup,
                       caption.empty() ? "" : fmt::format("<figcaption>{}</figcaption>", escaped(caption)));
}

std::string Page::html() const {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>{0}</title><style>{1}</style></head>\n<body>\n<h1>{0}</h1>\n<p "
      "class=\"source\">{2}</p>\n{3}</body></html>\n",
      escaped(title_), kStyle, escaped(source_), body_);
}

}  // namespace evigrid::driver
