// SPDX-License-Identifier: Apache-2.0
#include "report/html_page.h"

#include <algorithm>
#include <utility>

#include "base/printable.h"

namespace navcal::report {

const char* page_style();  // page.css, which the build puts into the program

namespace {

/// Long cells break anywhere: digests and file names have no spaces.
constexpr std::size_t kLongCell = 40;

std::string id_attribute(std::string_view id) {
  return id.empty() ? std::string() : " id=\"" + escaped(id) + "\"";
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = base::utf8_length(text);
    if (length != 1) {
      out += length == 0 ? "?" : text.substr(0, length);
      text.remove_prefix(std::max<std::size_t>(length, 1));
      continue;
    }
    const char c = text.front();
    text.remove_prefix(1);
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
    }
  }
  return out;
}

HtmlPage::HtmlPage(std::string_view title) {
  const std::string name = escaped(title);
  html_ =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
      name + "</title>\n<style>";
  html_.append(page_style()).append("</style>\n</head>\n<body>\n<main>\n<h1>").append(name).append("</h1>\n");
}

void HtmlPage::section(std::string_view title) {
  if (std::exchange(in_section_, true)) html_ += "</section>\n";
  html_ += "<section>\n<h2>" + escaped(title) + "</h2>\n";
}

void HtmlPage::index(std::string_view title, const std::vector<Link>& links) {
  html_ += "<nav class=\"index\"><b>" + escaped(title) + "</b>";
  for (const Link& link : links) html_ += " <a href=\"#" + escaped(link.id) + "\">" + escaped(link.text) + "</a>";
  html_ += "</nav>\n";
}

void HtmlPage::heading(std::string_view title, std::string_view id) {
  html_ += "<h3" + id_attribute(id) + ">" + escaped(title) + "</h3>\n";
}

void HtmlPage::paragraph(std::string_view text) { html_ += "<p>" + escaped(text) + "</p>\n"; }

void HtmlPage::fact(std::string_view kind, std::string_view word, std::string_view sentence) {
  html_ += "<div class=\"fact\"><b class=\"" + escaped(kind) + "\">" + escaped(word) + "</b><span>" +
           escaped(sentence) + "</span></div>\n";
}

void HtmlPage::figures(const std::vector<Figure>& figures) {
  html_ += "<div class=\"figures\">\n";
  for (const Figure& figure : figures) append(figure);
  html_ += "</div>\n";
}

void HtmlPage::wide_figures(const std::vector<Figure>& figures) {
  html_ += "<div class=\"wide\">\n";
  for (const Figure& figure : figures) append(figure);
  html_ += "</div>\n";
}

void HtmlPage::append(const Figure& figure) {
  html_ += "<figure" + id_attribute(figure.id) + ">\n<h3>" + escaped(figure.title) + "</h3>\n" + figure.html +
           "<figcaption>" + escaped(figure.caption) + "</figcaption>\n</figure>\n";
}

void HtmlPage::folded_figures(std::string_view title, const std::vector<Figure>& hidden) {
  html_ += "<details>\n<summary>" + escaped(title) + "</summary>\n";
  figures(hidden);
  html_ += "</details>\n";
}

void HtmlPage::table(const std::vector<std::string>& heads, const std::vector<std::vector<std::string>>& rows) {
  html_ += "<div class=\"scroll\"><table>\n<thead><tr>";
  for (const auto& head : heads) html_ += "<th>" + escaped(head) + "</th>";
  html_ += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) {
    html_ += "<tr>";
    for (const auto& cell : row)
      html_ += (cell.size() > kLongCell ? "<td class=\"long\">" : "<td>") + escaped(cell) + "</td>";
    html_ += "</tr>\n";
  }
  html_ += "</tbody>\n</table></div>\n";
}

std::string HtmlPage::finish() && {
  if (in_section_) html_ += "</section>\n";
  html_ += "</main>\n</body>\n</html>\n";
  return std::move(html_);
}

}  // namespace navcal::report
