// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace navcal::report {

/// Characters of a page, in UTF-8.
inline constexpr std::string_view kPlusMinus = "\u00b1", kArrow = "\u2192";

/// Text with the special characters of HTML and XML escaped; control characters become spaces.
[[nodiscard]] std::string escaped(std::string_view text);

struct Figure {
  std::string title, html, caption;  ///< the picture itself as HTML or SVG
  std::string id{};                  ///< for a link of the index; empty: none leads here
};

/// A report as one self-contained file: style and plots are inside; it has light, dark and print styles. It is
/// XML, too, so that a test can verify that it is well-formed. Texts are escaped, except members named html.
class HtmlPage {
 public:
  explicit HtmlPage(std::string_view title);

  void section(std::string_view title);
  /// Links to the parts of this page with these ids.
  struct Link {
    std::string id, text;
  };
  void index(std::string_view title, const std::vector<Link>& links);
  /// A title within a section, with an id for the index or none.
  void heading(std::string_view title, std::string_view id = {});
  void paragraph(std::string_view text);
  /// One of several facts: its kind, which the style colours (`good`, `bad`, `plain`), and a sentence.
  void fact(std::string_view kind, std::string_view word, std::string_view sentence);
  /// Figures side by side; they wrap if the page is narrow.
  void figures(const std::vector<Figure>& figures);
  /// Figures one below the other, each as wide as the page.
  void wide_figures(const std::vector<Figure>& figures);
  /// The same as figures(), collapsed until the reader opens it.
  void folded_figures(std::string_view title, const std::vector<Figure>& figures);
  void table(const std::vector<std::string>& heads, const std::vector<std::vector<std::string>>& rows);

  [[nodiscard]] std::string finish() &&;

 private:
  void append(const Figure& figure);

  std::string html_;
  bool in_section_ = false;
};

}  // namespace navcal::report
