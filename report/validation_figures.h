#pragma once

#include <vector>

#include "validation/report.h"
#include "report/html_page.h"

namespace navcal::cli {

/// Power by strength, calibration of the probabilities, closures; what there are no cases for is left out.
[[nodiscard]] std::vector<Figure> trial_figures(const TrialScores& scores);
/// Empty where nothing was answered.
[[nodiscard]] std::vector<Figure> confusion_figure(const TrialConfusion& confusion);

}  // namespace navcal::cli
