// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "calib/correction.h"
#include "calib/judgement.h"
#include "calib/magnetometer/magnetometer_estimate.h"
#include "calib/suite/gate.h"
#include "calib/suite/in_force.h"

namespace navcal::calib {

enum class Verdict : std::uint8_t {
  refused,   ///< the data do not support the estimate; the judgement gives reason and remedy
  shadow,    ///< accepted, runs beside the active value
  in_force,  ///< the active value is from this calibrator (an earlier estimate of it)
};
[[nodiscard]] std::string_view name_of(Verdict verdict);

/// Result of the estimate for people: whether it is supported and better than before.
enum class Outcome : std::uint8_t {
  refused,    ///< the data do not support it
  no_better,  ///< supported, but readings that had no part in it are no better with it than before
  accepted,
};
/// "refused", "no better", "accepted".
[[nodiscard]] std::string_view name_of(Outcome outcome);

/// Current state of one calibrator.
struct CalibratorReport {
  Calibrator calibrator = Calibrator::gyro;
  Verdict verdict = Verdict::refused;
  Outcome outcome = Outcome::refused;
  Judgement judgement;
  std::vector<Quantity> estimate;  ///< empty when there is none yet
  Eigen::MatrixXd covariance;      ///< of compass (B..E) and GPS-aided compass; empty of the others
  /// Standard error that steps of the field since then add to the hard iron in force.
  Eigen::Vector3d step_std_uT = Eigen::Vector3d::Zero();
  bool held = false;           ///< rolled back: comes into force only by the operator's word
  std::size_t steps_back = 0;  ///< changes that can be rolled back

  /// Null when the estimate has no such number.
  [[nodiscard]] const Quantity* quantity(std::string_view name) const;
};
/// Objection and remedy, for users; empty: there is none.
[[nodiscard]] std::string objection_of(const CalibratorReport& report);

/// Root-mean-square of heading against the integrated gyro within blocks, by estimates made before each block.
struct HeadingCheck {
  std::uint64_t blocks = 0;  ///< 0: nothing was judged yet
  double before_rad = 0;     ///< as the device measured it
  double after_rad = 0;      ///< by the best that the calibrators say
  double in_force_rad = 0;   ///< by the active calibration
};

/// "2030-01-01T00:00:45.312Z"; of 0 that it is not known.
[[nodiscard]] std::string utc_text(std::int64_t utc_ns);
/// "the field stepped by (-1.5, -0.5, -13.6) +- (0.2, 0.1, 0.1) uT at 2030-01-01T00:00:45.312Z", in body axes; of
/// a return to the field before it says so, and so of another place.
[[nodiscard]] std::string words_of(const FieldStep& step);

/// The whole suite, for status, log and calibrate.
struct Report {
  CorrectionName name;  ///< of the active calibration
  Correction in_force;
  Correction estimates;                       ///< the newest of each calibrator that has one, accepted or not
  std::vector<CalibratorReport> calibrators;  ///< those that have instruments, in the order of the table
  HeadingCheck heading;
  HeadingHistogram rose{};             ///< headings visited, as the compass measured them
  std::vector<FieldStep> steps;        ///< of the field of the compass
  std::uint32_t moves = 0;             ///< changes of the place, which are no steps
  std::vector<FieldSegment> segments;  ///< between them, one more than steps; empty without readings of the field
  GateCounts gate;
  /// Parts of the recordings that were calibrated alone, for Quantity::next_std; 0: that was not done.
  std::size_t parts = 0;
  bool parts_are_files = false;

  /// Null when it has no instruments.
  [[nodiscard]] const CalibratorReport* find(Calibrator calibrator) const;
};

}  // namespace navcal::calib
