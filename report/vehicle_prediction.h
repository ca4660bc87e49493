// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "identify/answer/prediction.h"

namespace navcal::report {

/// Answer of navcal vehicle predict: a table of errors by horizon and predictor, or one JSON object (degrees).
[[nodiscard]] std::string vehicle_prediction_text(const identify::Prediction& found);
[[nodiscard]] std::string vehicle_prediction_json(const identify::Prediction& found);

}  // namespace navcal::report
