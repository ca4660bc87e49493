// SPDX-License-Identifier: Apache-2.0
#include "report/svg_matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>

#include "report/html_page.h"

namespace navcal::report {
namespace {

constexpr double kCell = 24, kLetter = 6.6, kGap = 8;

double longest_of(const std::vector<std::string>& names) {
  std::size_t longest = 0;
  for (const std::string& name : names) longest = std::max(longest, name.size());
  return kLetter * static_cast<double>(longest);
}

}  // namespace

std::string SvgMatrix::svg(std::string_view title) const {
  const double left = longest_of(rows) + kGap, top = longest_of(columns) + kGap;
  const double width = kCell * static_cast<double>(columns.size());
  const double height = kCell * static_cast<double>(rows.size());
  std::string out, grid;
  const auto add = [&]<class... A>(fmt::format_string<A...> format, A&&... arguments) {
    fmt::format_to(std::back_inserter(out), format, std::forward<A>(arguments)...);
  };
  add("<svg role=\"img\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\">\n<title>{2}</title>\n",
      left + width + 1, top + height + 1, escaped(title));
  for (std::size_t column = 0; column < columns.size(); ++column) {
    const double x = left + kCell * static_cast<double>(column);
    add("<text class=\"tick\" transform=\"translate({:.0f} {:.0f}) rotate(-90)\">{}</text>\n", x + kCell / 2 + 4,
        top - kGap / 2, escaped(columns[column]));
    fmt::format_to(std::back_inserter(grid), "M{:.0f} {:.0f}v{:.0f}", x, top, height);
  }
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const double y = top + kCell * static_cast<double>(row);
    fmt::format_to(std::back_inserter(grid), "M{:.0f} {:.0f}h{:.0f}", left, y, width);
    add("<text class=\"tick\" text-anchor=\"end\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n", left - kGap / 2,
        y + kCell / 2 + 4, escaped(rows[row]));
    const double sum = std::accumulate(counts[row].begin(), counts[row].end(), 0);
    for (std::size_t column = 0; column < columns.size(); ++column) {
      const int count = counts[row][column];
      if (count == 0) continue;
      const double x = left + kCell * static_cast<double>(column);
      add("<path class=\"area {}\" style=\"fill-opacity:{:.2f}\" d=\"M{:.0f} {:.0f}h{}v{}h-{}Z\"/>\n",
          agreeing[row][column] ? "after" : "before", 0.15 + 0.5 * count / sum, x, y, kCell, kCell, kCell);
      add("<text text-anchor=\"middle\" style=\"fill:var(--ink)\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n",
          x + kCell / 2, y + kCell / 2 + 4, count);
    }
  }
  add("<path class=\"grid\" d=\"{}\"/>\n<path class=\"frame\" d=\"M{:.1f} "
      "{:.1f}h{:.0f}v{:.0f}h-{:.0f}Z\"/>\n</svg>\n",
      grid, left, top, width, height, width);
  return out;
}

}  // namespace navcal::report
