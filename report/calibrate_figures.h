// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/calibrate_history.h"
#include "calib/suite/report.h"
#include "report/html_page.h"

namespace navcal::report {

/// Deviation curve with its band and the measured deviations; nullopt without an estimate.
[[nodiscard]] std::optional<Figure> deviation_figure(const calib::Report& report,
                                                     const std::vector<analysis::HeadingResidual>& residuals);
/// The same to be read beside the compass, every 30 degrees: shown, deviation, two standard errors, magnetic.
/// Empty without an accepted estimate.
[[nodiscard]] std::vector<std::vector<std::string>> deviation_card(const calib::Report& report);
/// Heading less the gyro's, before and after calibration, over the heading.
[[nodiscard]] std::optional<Figure> residual_figure(const calib::Report& report,
                                                    const std::vector<analysis::HeadingResidual>& residuals);
[[nodiscard]] Figure rose_figure(const calib::Report& report);

/// The field as measured with the fitted ellipse (or the outline of the ellipsoid), as calibrated, and its size
/// over time; empty without readings of the field.
[[nodiscard]] std::vector<Figure> field_figures(const calib::Report& report,
                                                const std::vector<analysis::TurnedSample>& samples);

/// The main estimates over time with their bands.
[[nodiscard]] std::vector<Figure> convergence_figures(const analysis::CalibrateHistory::Estimates& estimates);

}  // namespace navcal::report
