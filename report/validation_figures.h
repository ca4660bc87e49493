// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "report/html_page.h"
#include "report/validation_report.h"

namespace navcal::report {

/// Power by strength, calibration of the probabilities, closures; figures without cases are left out.
[[nodiscard]] std::vector<Figure> trial_figures(const validation::TrialScores& scores);
/// Empty if nothing was answered.
[[nodiscard]] std::vector<Figure> confusion_figure(const validation::TrialConfusion& confusion);

}  // namespace navcal::report
