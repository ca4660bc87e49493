// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "calib/suite/report.h"

// What the calibrators say, in words and units of people: shared by the text and the page of `navcal calibrate`.
namespace navcal::report {

/// "Gyro A", "Compass deviation", ...
[[nodiscard]] std::string_view title_of(calib::Calibrator calibrator);

/// One number of an estimate: angles in degrees, delays in milliseconds, as many digits as its error leaves.
struct ShownQuantity {
  std::string name;   ///< "scale", "bias", "B"
  std::string value;  ///< empty for a bare error
  std::string error;  ///< empty when it is not known
  std::string unit;   ///< "deg/s"; empty for none
};
[[nodiscard]] std::vector<ShownQuantity> shown(const calib::CalibratorReport& report);
/// "bias -6.366 +- 0.012 deg/s"; `plus_minus` stands between value and error.
[[nodiscard]] std::string text_of(const ShownQuantity& quantity, std::string_view plus_minus);

/// "accepted", "no better" or "refused".
[[nodiscard]] std::string_view verdict_of(const calib::CalibratorReport& report);
/// What stands against it and what would help; empty when it is accepted and of use.
[[nodiscard]] std::string objection_of(const calib::CalibratorReport& report);
/// "0.63 -> 0.21 deg of heading" on readings held out; empty when nothing was judged.
[[nodiscard]] std::string held_out_of(const calib::CalibratorReport& report, std::string_view arrow);
/// The heading as a whole, before and after, or why it could not be judged.
[[nodiscard]] std::string sentence_of(const calib::HeadingCheck& heading);

/// A line for each step of the field and for each segment between two; empty where it did not step.
[[nodiscard]] std::vector<std::string> field_history_of(const calib::Report& report);

/// "4048 words with E001: the compass reports magnetic distortion"; empty when it does not.
[[nodiscard]] std::string distortion_of(const calib::GateCounts& gate);

/// "12 repeated, 3 frozen" of one instrument; empty when nothing was left out.
[[nodiscard]] std::string left_out_of(const calib::GateCounts& gate, calib::Stream stream);

/// The newest estimates of those that are accepted.
[[nodiscard]] calib::Correction accepted_estimates(const calib::Report& report);

}  // namespace navcal::report
