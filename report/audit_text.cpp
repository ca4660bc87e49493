// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <utility>

#include "report/append_format.h"
#include "report/audit_report.h"
#include "report/audit_words.h"
#include "report/shown_number.h"
#include "report/wrapped_text.h"

namespace navcal::report {
namespace {

using analysis::Certainty;
using analysis::Finding;

constexpr std::array<std::pair<std::string_view, std::string_view>, 21> kAuditTitles{
    {{"sampling.rate", "Rate"},
     {"sampling.gaps", "Gaps"},
     {"sampling.irregular", "Irregular readings"},
     {"sampling.repeated", "Repeated readings"},
     {"sampling.order", "Times in disorder"},
     {"sampling.lost", "Lost frames"},
     {"compass.iron", "Iron at the compass"},
     {"compass.step", "Step of the field"},
     {"compass.motor", "Field of the motor"},
     {"compass.heading", "Stated heading"},
     {"compass.pair", "Two compasses"},
     {"gyro.bias", "Bias of the gyro"},
     {"gyro.scale", "Scale of the gyro"},
     {"gyro.rest", "Bias of the gyro at rest"},
     {"force.vibration", "Vibration"},
     {"force.clipping", "Clipped forces"},
     {"depth.surface", "Depth at the surface"},
     {"altimeter.zeros", "Zeros of the altimeter"},
     {"gps.jumps", "Jumps of the receiver"},
     {"dvl.zeros", "Zeros of the Doppler log"},
     {"dvl.scale", "Scale of the Doppler log"}}};

void append_finding(std::string& out, const Finding& finding) {
  constexpr std::size_t kIndent = 4;
  std::string head = std::string(audit_title(finding)) + ", " + finding.channel;
  if (const std::string value = audit_value(finding); !value.empty()) head += ": " + value;
  if (const std::string cost = audit_cost(finding); !cost.empty()) head += "; " + cost;
  append_format(out, "  {}\n", printable(head));
  for (const std::string& text : {finding.sentence, finding.todo}) {
    if (text.empty()) continue;
    out.append(kIndent, ' ');
    append_wrapped(out, kIndent, words_of(printable(text)), " ");
  }
}

}  // namespace

std::string_view audit_title(const Finding& finding) {
  for (const auto& [name, title] : kAuditTitles) {
    if (name == finding.name) return title;
  }
  if (finding.name.starts_with("delay.")) return "Delay";
  return finding.name;
}

std::string audit_value(const Finding& finding) {
  if (!finding.value) return {};
  const double half = (*finding.high - *finding.low) / 2;
  const int decimals = std::max(decimals_for(*finding.value, half > 0 ? half : 0), 0);
  const std::string unit = finding.unit.empty() ? "" : " " + finding.unit;
  if (!(half > 0)) return fmt::format("{:.4g}{}", *finding.value, unit);
  return fmt::format("{:.{}f} ({:.{}f} to {:.{}f}){}", *finding.value, decimals, *finding.low, decimals,
                     *finding.high, decimals, unit);
}

std::string audit_cost(const Finding& finding) {
  std::string cost;
  if (finding.heading_deg) append_format(cost, "{:.2g} deg of heading", *finding.heading_deg);
  if (finding.position_m)
    append_format(cost, "{}{:.0f} m in ten minutes", cost.empty() ? "" : ", ", *finding.position_m);
  return cost;
}

std::vector<const Finding*> audit_findings(const analysis::AuditedFile& file, Certainty certainty) {
  std::vector<const Finding*> chosen;
  for (const Finding& finding : file.findings) {
    if (finding.certainty == certainty) chosen.push_back(&finding);
  }
  return chosen;
}

std::string audit_summary(const analysis::AuditedFile& file) {
  const std::size_t found = audit_findings(file, Certainty::found).size(),
                    likely = audit_findings(file, Certainty::likely).size(),
                    open = audit_findings(file, Certainty::cannot_say).size(),
                    right = audit_findings(file, Certainty::nothing).size();
  std::string text = found + likely == 0 ? "Nothing found" : fmt::format("{} found, {} likely", found, likely);
  return text + fmt::format("; {} checked without a finding, {} cannot be said.", right, open);
}

std::string audit_text(const analysis::Audit& audit) {
  std::string out;
  for (const analysis::AuditedFile& file : audit.files) {
    append_format(out, "{}: {}{}\n{} Costs are at {:.1f} m/s.\n", printable(file.file),
                  duration_text(file.duration_s), file.is_partial ? ", read in part" : "", audit_summary(file),
                  file.speed_m_s);
    constexpr std::array kTitles{std::pair{Certainty::found, "Found"}, std::pair{Certainty::likely, "Likely"},
                                 std::pair{Certainty::cannot_say, "Cannot be said"},
                                 std::pair{Certainty::nothing, "Nothing found"}};
    for (const auto& [certainty, title] : kTitles) {
      const auto findings = audit_findings(file, certainty);
      if (!findings.empty()) append_format(out, "\n{}\n", title);
      for (const Finding* finding : findings) append_finding(out, *finding);
    }
    out += '\n';
  }
  if (audit.files.size() > 1) {
    append_format(out, "Changes against {}\n", printable(audit.files.front().file));
    if (audit.changes.empty()) out += "  Nothing changed beyond the intervals.\n";
    for (const auto& change : audit.changes)
      append_format(out, "  {}: {}\n", printable(change.file), printable(change.sentence));
  }
  return out;
}

}  // namespace navcal::report
