// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace navcal::fleet {

inline constexpr double kNanosecondsPerDay = 86'400e9;

/// One value of a calibration, as one recording determined it.
struct CalibrationPoint {
  std::string recording, vehicle;
  std::int64_t utc_ns = 0;
  double value = 0, std = 0;
};

/// The course of a calibration over the recordings of one vehicle or instrument.
enum class CalibrationCourse : std::uint8_t {
  constant,  ///< the values agree
  drift,     ///< they change evenly with time
  step,      ///< they change from one recording to the next, and agree before and after
  scatter,   ///< they differ by more than their errors, and neither drift nor one step explains that
  too_few,   ///< fewer than three values: nothing can be said
};
/// "constant", "drift", "step", "scatter", "too few".
[[nodiscard]] std::string_view name_of(CalibrationCourse course);

/// A series of one value of one calibrator, with what its course is. Unit as in the name of the value.
struct CalibrationHistory {
  std::string subject;                   ///< the vehicle, or the instrument by its serial number
  std::string quantity;                  ///< "gyro.scale", "compass.deviation_deg.B"
  std::vector<CalibrationPoint> points;  ///< in order of time
  CalibrationCourse course = CalibrationCourse::too_few;
  double mean = 0, mean_std = 0;  ///< of constant values
  double drift_per_day = 0, drift_std = 0;
  std::size_t step_at = 0;  ///< index of the first point after the step
  double step = 0, step_std = 0;
  /// Standard deviation beyond the stated errors that makes the values agree with the course.
  double excess_std = 0;
};

/// Determines the course of a series: constant, drift, and a step at each place are compared by their marginal
/// likelihood, with errors that are inflated where even the best course leaves more than they allow.
void judge_course(CalibrationHistory& history);

}  // namespace navcal::fleet
