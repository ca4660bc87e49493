// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace navcal::report {

/// Characters of a page, in UTF-8.
inline constexpr std::string_view kPlusMinus = "\u00b1", kArrow = "\u2192";

/// Text with the characters that mean something in HTML or XML written out; control characters become spaces.
[[nodiscard]] std::string escaped(std::string_view text);

struct Figure {
  std::string title, html, caption;  ///< the picture itself as HTML or SVG
};

/// A report as one file that needs no other: style and pictures within it; light, dark and on paper. It is XML,
/// too, so that a test can tell whether it is whole. Texts are escaped, but for what says HTML.
class HtmlPage {
 public:
  explicit HtmlPage(std::string_view title);

  void section(std::string_view title);
  void paragraph(std::string_view text);
  /// One of several facts: a word for its kind, which the style colours (`good`, `bad`, `plain`), and a sentence.
  void fact(std::string_view kind, std::string_view word, std::string_view sentence);
  /// Figures in a row break into the next line where the page is narrow.
  void figures(const std::vector<Figure>& figures);
  /// The same, out of sight until somebody wants to see them.
  void folded_figures(std::string_view title, const std::vector<Figure>& figures);
  void table(const std::vector<std::string>& heads, const std::vector<std::vector<std::string>>& rows);

  [[nodiscard]] std::string finish() &&;

 private:
  std::string html_;
  bool in_section_ = false;
};

}  // namespace navcal::report
