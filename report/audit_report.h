// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "analysis/audit/audit.h"

namespace navcal::report {

/// Findings for a terminal, the most costly first.
[[nodiscard]] std::string audit_text(const analysis::Audit& audit);

/// One JSON object in a line (docs/audit.md describes the keys).
[[nodiscard]] std::string audit_json(const analysis::Audit& audit);

/// The page of `navcal audit`: the three most costly findings, each with its evidence, then the rest.
[[nodiscard]] std::string audit_page(const analysis::Audit& audit);

// Words for findings, shared by text and page.
/// "Iron at the compass, compass: 12.1 (10.9 to 13.3) deg; 12 deg of heading, 126 m in ten minutes".
[[nodiscard]] std::string headline_of(const analysis::Finding& finding);
/// "2 found, 0 likely; 14 checked without a finding, 3 cannot be said. Costs are at 1.0 m/s."
[[nodiscard]] std::string summary_of(const analysis::AuditedFile& file);

}  // namespace navcal::report
