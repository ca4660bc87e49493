// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "analysis/calibrate_history.h"
#include "calib/suite/report.h"
#include "config/settings.h"

namespace navcal::report {

/// The answer of `navcal calibrate` as text for a terminal.
[[nodiscard]] std::string calibrate_text(const calib::Report& report, double duration_s);

/// Source of a page, for its foot.
struct PageSource {
  std::vector<std::string> files;
  std::string config;  ///< empty: the recording's own
  config::Settings settings;
  double duration_s = 0;
  std::vector<std::string> remarks;
};

/// Report of `navcal calibrate --report`: the results in sentences and plots, as one HTML file.
[[nodiscard]] std::string calibrate_page(const calib::Report& report, const analysis::CalibrateHistory& history,
                                         const PageSource& source);

}  // namespace navcal::report
