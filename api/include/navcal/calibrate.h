// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <navcal/export.h>
#include <navcal/progress.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::api {

/// Options of a calibration.
struct CalibrateOptions {
  std::filesystem::path config;  ///< configuration of navcald, instead of the first recording's; empty: none
  Progress progress;             ///< its step is the file that is read
};

/// One number of an estimate.
struct Quantity {
  std::string name;      ///< with its unit: "bias_rad_s"
  double value = 0;      ///< not a number when it is not determined
  double std_error = 0;  ///< one standard deviation; infinite when it is not known
};

/// Root mean square on readings that had no part in the estimate.
struct HeldOut {
  std::string unit;   ///< "rad", "uT", or "1" for a share of the field's size
  double before = 0;  ///< without the estimate
  double after = 0;   ///< with it
};

/// The estimate of one calibrator, and its judgement of it.
struct CalibratorResult {
  std::string name;                 ///< "gyro", "compass", "magnetometer" ...: members of Calibration::json
  std::string verdict;              ///< "refused", "shadow", or "in force"
  std::string judgement;            ///< "refused", "no better", or "accepted"
  bool accepted = false;            ///< the data support the estimate
  std::string reason;               ///< what stands against the estimate, for people; empty: nothing
  std::string manoeuvre;            ///< remedy, for people; empty: none
  double coverage = 0;              ///< 0 to 1, share of what the calibrator needs to see
  double condition = 0;             ///< condition number of the scaled information matrix; infinite: singular
  std::uint64_t samples = 0;        ///< readings used
  std::vector<Quantity> estimate;   ///< empty: there is none
  std::optional<HeldOut> held_out;  ///< nullopt: nothing was judged

  /// The number of that name; null when the estimate has none. Throws nothing.
  [[nodiscard]] NAVCAL_API const Quantity* quantity(std::string_view quantity_name) const noexcept;
};

/// calibrated field = matrix * (measured - offset), body axes.
struct FieldCorrection {
  std::array<double, 3> offset_uT{};              ///< body axes
  std::array<std::array<double, 3>, 3> matrix{};  ///< rows; symmetric
};

/// Root mean square of the heading against the integrated gyro, in blocks, by estimates made before each block.
struct HeadingCheck {
  std::uint64_t blocks = 0;  ///< 0: nothing was judged, and the other members mean nothing
  double before_rad = 0;     ///< as the device measured it
  double after_rad = 0;      ///< by the calibrators' estimates
};

/// The answer of a calibration.
struct Calibration {
  std::vector<CalibratorResult> calibrators;    ///< those whose instruments are in the recordings
  std::optional<FieldCorrection> magnetometer;  ///< estimate of calibrator "magnetometer"; nullopt: none
  HeadingCheck heading;                         ///< of the compass
  double duration_s = 0;                        ///< of all recordings, without the pauses between them
  std::vector<std::string> remarks;             ///< irregularities of the recordings, for people
  std::string json;                             ///< the answer of `navcal calibrate --json`, without its newline

  /// The result of that name; null when its instruments are missing. Throws nothing.
  [[nodiscard]] NAVCAL_API const CalibratorResult* find(std::string_view name) const noexcept;
};

/// Calibrates compass and gyros by recordings, as `navcal calibrate` does. `files` are logs or captures in order
/// of time, at least one: one series, or several recordings. Throws Error. Source: docs/calibration.md.
[[nodiscard]] NAVCAL_API Calibration calibrate(const std::vector<std::filesystem::path>& files,
                                               const CalibrateOptions& options = {});

}  // namespace navcal::api
