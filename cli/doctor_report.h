// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/doctor_finding.h"

namespace navcal::cli {

/// One screen for people.
[[nodiscard]] std::string doctor_text(const Findings& findings);
/// One object: {"class": "DOCTOR", "account", "configuration", "findings": [{"severity", "topic", "found",
/// "mend"}], "faults", "warnings"}; mend is null where all is well.
[[nodiscard]] std::string doctor_json(const Findings& findings, const std::string& account,
                                      const std::string& configuration);
[[nodiscard]] std::size_t count_of(const Findings& findings, Finding::Severity severity);

}  // namespace navcal::cli
