// SPDX-License-Identifier: Apache-2.0
#include "analysis/audit/audit.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "analysis/audit/findings.h"

namespace navcal::analysis {

bool Audit::nothing_found() const {
  return std::all_of(files.begin(), files.end(), [](const AuditedFile& file) {
    return std::all_of(file.findings.begin(), file.findings.end(), [](const Finding& finding) {
      return finding.certainty != Certainty::found && finding.certainty != Certainty::likely;
    });
  });
}

AuditedFile audited(const AuditedLog& log, std::vector<Finding> more) {
  AuditedFile file{log.file, log.duration_s, log.speed_m_s(), log.is_partial, log.remarks, std::move(more)};
  for (const auto group :
       {sampling_findings, compass_findings, inertial_findings, water_findings, delay_findings}) {
    auto findings = group(log);
    std::move(findings.begin(), findings.end(), std::back_inserter(file.findings));
  }
  for (Finding& finding : file.findings) finding.file = log.file;
  sort_findings(file.findings);
  return file;
}

void compare(Audit& audit) {
  for (std::size_t i = 1; i < audit.files.size(); ++i) {
    auto changes = changes_between(audit.files.front().findings, audit.files[i].findings);
    for (AuditChange& change : changes) change.file = audit.files[i].file;
    std::move(changes.begin(), changes.end(), std::back_inserter(audit.changes));
  }
}

}  // namespace navcal::analysis
