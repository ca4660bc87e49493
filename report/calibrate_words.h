// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "calib/suite/report.h"

// Words and units for the results of the calibrators, shared by text and page of `navcal calibrate`.
namespace navcal::report {

/// Title: "Gyro A", "Compass deviation", ...
[[nodiscard]] std::string_view title_of(calib::Calibrator calibrator);

/// One number of an estimate: angles in degrees, delays in milliseconds, with as many digits as its error
/// justifies.
struct ShownQuantity {
  std::string name;    ///< "scale", "bias", "B"
  std::string value;   ///< empty for a bare error
  std::string error;   ///< empty if it is unknown
  std::string unit;    ///< "deg/s"; may be empty
  std::string next{};  ///< error at the next use; empty if it is unknown
};
[[nodiscard]] std::vector<ShownQuantity> shown(const calib::CalibratorReport& report);
/// Text such as "bias -6.366 +- 0.012 deg/s (next use +- 0.05)"; `plus_minus` stands before each error.
[[nodiscard]] std::string text_of(const ShownQuantity& quantity, std::string_view plus_minus);

/// Judgement: "accepted", "no better" or "refused".
[[nodiscard]] std::string_view verdict_of(const calib::CalibratorReport& report);
/// Change on held-out readings, such as "0.63 -> 0.21 deg of heading"; empty if nothing was judged.
[[nodiscard]] std::string held_out_of(const calib::CalibratorReport& report, std::string_view arrow);
/// The heading as a whole, before and after, or the reason why it could not be judged.
[[nodiscard]] std::string sentence_of(const calib::HeadingCheck& heading);

/// Whence the errors at the next use are, or why there are none; empty where they were not asked for.
[[nodiscard]] std::string next_use_of(const calib::Report& report);

/// One line for each step of the field and for each segment between two; empty without a step.
[[nodiscard]] std::vector<std::string> field_history_of(const calib::Report& report);

/// Remark such as "4048 words with E001: the compass reports magnetic distortion"; empty without E001.
[[nodiscard]] std::string distortion_of(const calib::GateCounts& gate);

/// Readings of one instrument that were left out: "12 repeated, 3 frozen"; empty if there are none.
[[nodiscard]] std::string left_out_of(const calib::GateCounts& gate, calib::Stream stream);

/// The newest accepted estimates.
[[nodiscard]] calib::Correction accepted_estimates(const calib::Report& report);

}  // namespace navcal::report
