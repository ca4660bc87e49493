// SPDX-License-Identifier: Apache-2.0
#include "base/append_format.h"
#include "report/noise_report.h"
#include "report/shown_number.h"
#include "report/wrapped_text.h"

namespace navcal::report {
std::string noise_text(const analysis::NoiseReport& report) {
  std::string out;
  base::append_format(out, "{}: {}\n{}\n", report.file, duration_text(report.duration_s), rest_sentence(report));
  if (report.channels.empty()) return out + "The recording has no readings.\n";
  if (report.quiet.empty()) return out;
  out += '\n';
  std::vector<std::vector<std::string>> rows{noise_heads()};
  for (const auto& recorded : report.channels) rows.push_back(noise_row(recorded, "+-"));
  // Two texts to the left, numbers to the right.
  const std::vector<std::string> lines = table_lines(rows, 2);
  out += lines[0];
  for (std::size_t i = 0; i < report.channels.size(); ++i) {
    out += lines[i + 1];
    for (const auto& remark : noise_remarks(report.channels[i])) base::append_format(out, "    {}\n", remark);
  }
  return out;
}

}  // namespace navcal::report
