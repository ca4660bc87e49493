// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "identify/answer/identification.h"

namespace navcal::report {

// Parts that the text and the page of navcal identify share.

[[nodiscard]] std::vector<std::string> identify_heads();
/// One row of the table of parameters; `between` stands between a value and its error.
[[nodiscard]] std::vector<std::string> identify_row(const identify::IdentifiedParameter& one,
                                                    std::string_view between);
[[nodiscard]] std::string rms_sentence(std::string_view what, const identify::BeforeAfter& rms);
[[nodiscard]] std::string prediction_phrase(const identify::PredictionFit& of);
/// "0.12 m/s2 in sway, 30 % of what the actuators give"
[[nodiscard]] std::string disturbance_phrase(const identify::DisturbanceFit& of);
[[nodiscard]] std::string manoeuvre_sentence(const identify::ManoeuvreAdvice& advice);

/// What navcal identify found: a table for people, one JSON object with a line end (docs/identify.md), and a page.
[[nodiscard]] std::string identify_text(const identify::Identification& found);
[[nodiscard]] std::string identify_json(const identify::Identification& found);
[[nodiscard]] std::string identify_page(const identify::Identification& found);

}  // namespace navcal::report
