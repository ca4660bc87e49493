// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "analysis/audit/audit.h"

namespace navcal::report {

/// Findings for a terminal, the most costly first.
[[nodiscard]] std::string audit_text(const analysis::Audit& audit);

/// One JSON object in a line (docs/audit.md describes the keys).
[[nodiscard]] std::string audit_json(const analysis::Audit& audit);

/// The page of `navcal audit`: three findings, then each with its evidence, then what was looked for in vain.
[[nodiscard]] std::string audit_page(const analysis::Audit& audit);

}  // namespace navcal::report
