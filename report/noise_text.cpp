// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "report/append_format.h"
#include "report/noise_report.h"
#include "report/noise_words.h"
#include "report/shown_number.h"

namespace navcal::report {
namespace {

/// Two texts to the left, numbers to the right.
void append_cells(std::string& out, const std::vector<std::string>& cells,
                  const std::vector<std::size_t>& widths) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool left = i < 2;
    if (i > 0) out += "  ";
    if (left)
      append_format(out, "{:<{}}", cells[i], widths[i]);
    else
      append_format(out, "{:>{}}", cells[i], widths[i]);
  }
  out += '\n';
}

}  // namespace

std::string noise_text(const analysis::NoiseReport& report) {
  std::string out;
  append_format(out, "{}: {}\n{}\n", report.file, duration_text(report.duration_s), rest_sentence(report));
  if (report.channels.empty()) return out + "The recording has no readings.\n";
  if (report.quiet.empty()) return out;
  out += '\n';
  std::vector<std::vector<std::string>> rows{noise_heads()};
  for (const auto& recorded : report.channels) rows.push_back(noise_row(recorded, "+-"));
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  append_cells(out, rows[0], widths);
  for (std::size_t i = 0; i < report.channels.size(); ++i) {
    append_cells(out, rows[i + 1], widths);
    for (const auto& remark : noise_remarks(report.channels[i])) append_format(out, "    {}\n", remark);
  }
  return out;
}

}  // namespace navcal::report
