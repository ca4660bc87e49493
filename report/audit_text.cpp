// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/append_format.h"
#include "report/audit_report.h"
#include "report/shown_number.h"
#include "report/wrapped_text.h"

namespace navcal::report {
namespace {

using analysis::Certainty;
using analysis::Finding;

void append_finding(std::string& out, const Finding& finding) {
  constexpr std::size_t kIndent = 4;
  base::append_format(out, "  {}\n", printable(headline_of(finding)));
  for (const std::string& text : {finding.sentence, finding.todo}) {
    if (text.empty()) continue;
    out.append(kIndent, ' ');
    append_wrapped(out, kIndent, words_of(printable(text)), " ");
  }
}

}  // namespace

std::string headline_of(const Finding& finding) {
  std::string text = fmt::format("{} ({})", finding.title, finding.channel);
  if (finding.value) {
    const double half = (*finding.high - *finding.low) / 2;
    const int decimals = std::max(decimals_for(*finding.value, half), 0);
    text += half > 0 ? fmt::format(": {:.{}f} ({:.{}f} to {:.{}f})", *finding.value, decimals, *finding.low,
                                   decimals, *finding.high, decimals)
                     : fmt::format(": {:.4g}", *finding.value);
    if (!finding.unit.empty()) text += " " + finding.unit;
  }
  if (finding.heading_deg) base::append_format(text, "; costs {:.2g} deg of heading", *finding.heading_deg);
  if (finding.position_m)
    base::append_format(text, "{} {:.0f} m in ten minutes", finding.heading_deg ? "," : "; costs",
                        *finding.position_m);
  return text;
}

std::string summary_of(const analysis::AuditedFile& file) {
  const auto count = [&](Certainty certainty) {
    return std::ranges::count_if(file.findings,
                                 [&](const Finding& finding) { return finding.certainty == certainty; });
  };
  return fmt::format(
      "{} found, {} likely; {} checked without a finding, {} cannot be said. Costs are for a speed of {:.1f} "
      "m/s.{}",
      count(Certainty::found), count(Certainty::likely), count(Certainty::nothing), count(Certainty::cannot_say),
      file.speed_m_s, file.is_partial ? " Reading was ended before the end of the file." : "");
}

std::string audit_text(const analysis::Audit& audit) {
  std::string out;
  for (const analysis::AuditedFile& file : audit.files) {
    base::append_format(out, "{}: {}\n{}\n", printable(file.file), duration_text(file.duration_s),
                        summary_of(file));
    std::string_view title;
    for (const Finding& finding : file.findings) {
      if (name_of(finding.certainty) != title) base::append_format(out, "\n{}\n", name_of(finding.certainty));
      title = name_of(finding.certainty);
      append_finding(out, finding);
    }
    out += '\n';
  }
  if (audit.files.size() < 2) return out;
  const auto changes = audit.changes();
  base::append_format(out, "changes against {}\n", printable(audit.files.front().file));
  for (const auto& change : changes)
    base::append_format(out, "  {}: {}\n", printable(change.file), printable(change.sentence));
  return changes.empty() ? out + "  nothing changed beyond the intervals\n" : out;
}

}  // namespace navcal::report
