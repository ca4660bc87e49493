// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "analysis/audit/audited_log.h"
#include "analysis/audit/finding.h"

namespace navcal::analysis {

/// The audit of one log.
struct AuditedFile {
  std::string file;
  double duration_s = 0;
  double speed_m_s = 1;  ///< by which costs count
  bool is_partial = false;
  std::vector<std::string> remarks;
  std::vector<Finding> findings;  ///< sorted; also what was not found and what cannot be said
};

/// The audit of one or more logs.
struct Audit {
  std::vector<AuditedFile> files;
  std::vector<AuditChange> changes;  ///< of each further log against the first
  [[nodiscard]] bool nothing_found() const;
};

/// All findings of a log; `more` are of other rooms.
[[nodiscard]] AuditedFile audited(const AuditedLog& log, std::vector<Finding> more = {});

/// Compares the logs with the first of them.
void compare(Audit& audit);

}  // namespace navcal::analysis
