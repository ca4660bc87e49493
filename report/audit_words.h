// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/audit/audit.h"

// Words for findings, shared by text and page of `navcal audit`.
namespace navcal::report {

/// "Iron at the compass" of "compass.iron".
[[nodiscard]] std::string_view audit_title(const analysis::Finding& finding);
/// Value with its interval and unit: "12.1 (10.9 to 13.3) deg"; empty without a value.
[[nodiscard]] std::string audit_value(const analysis::Finding& finding);
/// "12 deg of heading, 126 m in ten minutes"; empty without a cost.
[[nodiscard]] std::string audit_cost(const analysis::Finding& finding);
/// What the audit found in all: one sentence.
[[nodiscard]] std::string audit_summary(const analysis::AuditedFile& file);
/// Findings with this certainty, in their order.
[[nodiscard]] std::vector<const analysis::Finding*> audit_findings(const analysis::AuditedFile& file,
                                                                   analysis::Certainty certainty);

}  // namespace navcal::report
