#pragma once

#include <string>
#include <vector>

#include "cli/gap_trial_report.h"

namespace navcal::cli {

struct TrialFigure {
  std::string title, svg_html, caption;
};

/// Power by strength, calibration of the probabilities, closures; what there are no cases for is left out.
[[nodiscard]] std::vector<TrialFigure> trial_figures(const TrialScores& scores);
/// Empty where nothing was answered.
[[nodiscard]] std::vector<TrialFigure> confusion_figure(const TrialConfusion& confusion);

}  // namespace navcal::cli
