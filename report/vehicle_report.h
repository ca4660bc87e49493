// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "config/layout.h"
#include "identify/answer/prediction.h"
#include "identify/conventions/conventions.h"
#include "sim/layout/assessment/assessment.h"

namespace navcal::report {

/// What navcal vehicle check shows: lines of text, or one JSON object. Unknown numbers are null.
[[nodiscard]] std::string vehicle_check_text(const config::Layout& layout, const sim::Assessment& found);
[[nodiscard]] std::string vehicle_check_json(const config::Layout& layout, const sim::Assessment& found);
/// The same of a layout against recordings: units, signs and frames.
[[nodiscard]] std::string conventions_text(const identify::ConventionCheck& found);
[[nodiscard]] std::string conventions_json(const identify::ConventionCheck& found);

/// Answer of navcal vehicle predict: a table of errors by horizon and predictor, or one JSON object (degrees).
[[nodiscard]] std::string vehicle_prediction_text(const identify::Prediction& found);
[[nodiscard]] std::string vehicle_prediction_json(const identify::Prediction& found);

}  // namespace navcal::report
