// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/audit/audited_log.h"

/// Errors of headings by calibrations that the judged readings had no part in.
namespace navcal::analysis {

/// Calibration of the field that is accepted, or that states a standard error but is too uncertain to correct by;
/// nullptr: there is none.
[[nodiscard]] const calib::FieldCorrection* determined_field(const calib::Report& report);

struct IronErrors {
  double worst_rad = 0;  ///< largest mean error of the uncalibrated heading in a sector of ten degrees
  /// Largest difference between the headings by the two halves' calibrations; nullopt where one has none.
  std::optional<double> disagreement_rad;
  /// Standard deviation over mean of the size of the field, as measured and by the calibration of the other half.
  std::optional<double> spread_before, spread_after;
};
/// Of the field since its last step; `correction` is that of the whole log.
[[nodiscard]] IronErrors iron_errors(const AuditedLog& log, const calib::FieldCorrection& correction);

/// Largest change of the heading by the field of a current, for the headings of the log.
[[nodiscard]] double motor_heading_rad(const AuditedLog& log, const calib::MotorCurrentCorrection& motor,
                                       double current_A);

/// A stated heading less the heading of the calibrated field.
struct HeadingErrors {
  std::vector<double> time_s, heading_deg, error_deg;
  double reference_std_rad = 0;        ///< of the calibrated heading, at its worst heading
  bool is_absolute = false;            ///< false: the mean is left out
  bool is_of_other_half = true;        ///< false: the field was calibrated on the whole log
  std::optional<double> stated_deg{};  ///< root mean square of the standard errors that the device itself states
  bool is_accepted = true;             ///< false: the calibration is too uncertain to correct by
};
/// nullopt where the log has no calibration with a standard error, or the field stepped.
[[nodiscard]] std::optional<HeadingErrors> heading_errors(const AuditedLog& log, const RecordedChannel& heading);

/// Root mean square of the changes of a field that the rates do not explain while the vehicle turns: as sent, and
/// with the axes that agree best. Every other turn is judged. All three axes reversed is no change: hard iron is
/// free.
struct FieldAxes {
  double changed_uT = 0, sent_uT = 0, best_uT = 0;  ///< the first: mean size of the changes
  std::string best;                                 ///< "-x, z, y"
};
/// nullopt for fewer than 15 turns of 0.2 rad within 10 s.
[[nodiscard]] std::optional<FieldAxes> field_axes(const AuditedLog& log, const std::string& port);

/// Delay of a field behind the rates, 0 to 2 s in steps of 0.05 s, with which its changes follow them best; 0
/// where that does not leave a third less of them than no delay does, or the port sends the rates. Large delays
/// are outside of the calibrators' models.
[[nodiscard]] double field_lag_s(const AuditedLog& log, const std::string& port);

/// The fields of two ports at the times of the first.
struct FieldComparison {
  std::vector<double> time_s, size_uT, apart_deg;  ///< size of the first; between the headings of both, 0 to 180
  bool is_levelled = true;                         ///< roll and pitch are known; else the vehicle counts as level
};
[[nodiscard]] FieldComparison compare_fields(const AuditedLog& log, const std::string& first,
                                             const std::string& second);

}  // namespace navcal::analysis
