// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "validation/layout_score.h"

namespace navcal::report {

/// The scores of a validation on layouts, and what was answered in each arm, as text for a terminal.
[[nodiscard]] std::string layout_score_text(const validation::LayoutScores& scores);
/// The same as one JSON object.
[[nodiscard]] std::string layout_score_json(const validation::LayoutScores& scores);

}  // namespace navcal::report
