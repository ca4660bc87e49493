// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "analysis/thesis/thesis_results.h"

namespace navcal::report {

/// What the tables say in a sentence each.
struct ThesisFinding {
  std::string word, sentence;
};
[[nodiscard]] std::vector<ThesisFinding> thesis_findings(const analysis::ThesisResults& results);

/// Errors and disagreements within the thesis, as (place, what is the matter).
[[nodiscard]] std::vector<std::vector<std::string>> thesis_errata();

}  // namespace navcal::report
