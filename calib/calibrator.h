// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "calib/archive.h"
#include "calib/readings.h"

namespace navcal::calib {

class CalibratorUnit;
struct Correction;
struct SharedEstimators;
struct SuiteOptions;

/// Place of a calibrator in the table (calib/suite/calibrator_table.cpp). The first ten have names here, because
/// other code builds on their results and stored states number them so. A further calibrator needs no name here.
enum class Calibrator : std::uint8_t {
  gyro,           ///< A's z axis
  gyro_b,         ///< B's z axis
  compass,        ///< deviation B..E from the gyro
  magnetometer,   ///< hard and soft iron from the field itself
  gps_compass,    ///< deviation A..E from GPS
  swing,          ///< table of eight headings
  misalignment,   ///< A from straight runs by GPS
  compass_delay,  ///< of the compass against the gyro
  course_delay,   ///< of the GPS course against the heading
  motor_current,  ///< field of the motor's current
};
/// Number of calibrators that have a name in Calibrator, a member in Correction, and a numbered place in stored
/// states.
inline constexpr std::size_t kNamedCalibrators = 10;

/// Quantity that a correction changes. Calibrators that use another calibrator's result start again when that
/// result changes.
enum class Corrects : std::uint8_t {
  rate,     ///< the rate of turn of a gyro
  heading,  ///< the heading, but for a constant
  offset,   ///< the constant A of the heading
  time,     ///< the time of validity
  field,    ///< the measured magnetic field, and the heading with it
};

/// Instruments that exist, or that a calibrator takes.
struct Instruments {
  bool compass = false, rate = false, ground = false, motor = false, reference = false;
};

/// One number, a vector or a matrix of a correction, by name. The name ends with the unit, as in Quantity.
struct NamedNumbers {
  std::string_view name;       ///< "scale", "bias_rad_s", "offset_uT"
  std::vector<double> values;  ///< a matrix row by row
  std::size_t rows = 0;        ///< 0: a single number; 1: a vector; more: a matrix
};

/// Functions that find and copy one calibrator's value in a Correction.
struct CorrectionPlace {
  bool (*has)(const Correction& correction, Calibrator calibrator);
  /// Gives `to` the value that `from` has, or takes it away.
  void (*copy)(Correction& to, const Correction& from, Calibrator calibrator);
};
[[nodiscard]] bool has_added(const Correction& correction, Calibrator calibrator);
void copy_added(Correction& to, const Correction& from, Calibrator calibrator);

/// Heading on which the value of a calibrator without a member in Correction acts.
enum class AppliesTo : std::uint8_t {
  corrected,  ///< what all before it in the table have made of the heading
  measured,   ///< the heading that the compass states, in place of what others have made of it; not for field
  field,      ///< the heading of the calibrated field, where there is one
};

/// The row of a calibrator in the table: everything about it that does not depend on readings.
struct CalibratorRow {
  std::string_view name;   ///< in orders, JSON and logs: "gyro_b"
  std::string_view title;  ///< in texts and pages: "Gyro B"

  Instruments needs;            ///< the instruments without which it cannot begin
  std::string_view needs_text;  ///< the same for people: "a compass and an inertial card (protocol imu-card)"
  bool needs_advance = false;   ///< it takes the advance of the propeller (SuiteOptions::advance_m)

  Corrects corrects = Corrects::heading;
  bool automatic = false;    ///< its estimate may come into force without an order
  bool only_shown = false;   ///< it has no value that could come into force
  bool by_order = false;     ///< it begins only when an order starts it
  bool of_compass = false;   ///< begins anew when the compass or its field becomes another one
  bool field_alone = false;  ///< learns from the field alone; judged by the field where no gyro serves
  bool clears_rose = false;  ///< its start clears the histogram of headings

  /// Place of the calibrator's value in a Correction; by default in Correction::added.
  CorrectionPlace place{has_added, copy_added};
  /// Names of the numbers of a value in Correction::added, with their units: "offset_rad".
  std::span<const std::string_view> value_names = {};
  /// The value of a calibrator with a member of its own. Only called when there is one.
  std::vector<NamedNumbers> (*values)(const Correction& correction) = nullptr;
  /// Its correction applied to a heading, rad: only for a value in Correction::added. The result is the better
  /// magnetic heading, before A unless it gives_offset. Null: its value does not change headings.
  double (*apply)(std::span<const double> value, const CompassReading& reading, double heading_rad) = nullptr;
  AppliesTo applies_to = AppliesTo::corrected;
  /// The value contains A, as its first number: that of other calibrators is not taken off then.
  bool gives_offset = false;
  std::unique_ptr<CalibratorUnit> (*make)(const SuiteOptions& options, SharedEstimators& shared) = nullptr;
};

/// All calibrators, in the order of the table.
[[nodiscard]] std::span<const Calibrator> calibrators();
[[nodiscard]] const CalibratorRow& row_of(Calibrator calibrator);

/// Values of one calibrator in a correction, for JSON; empty when there are none.
[[nodiscard]] std::vector<NamedNumbers> values_of(const Correction& correction, Calibrator calibrator);

[[nodiscard]] constexpr std::size_t index_of(Calibrator calibrator) {
  return static_cast<std::size_t>(calibrator);
}
/// "gyro", "gyro_b", "compass", ...
[[nodiscard]] std::string_view name_of(Calibrator calibrator);
[[nodiscard]] std::optional<Calibrator> calibrator_named(std::string_view name);

/// A calibrator as a byte; from the eleventh on the byte 255 and its name, so that the table may grow in any
/// order. Restoring the name of a calibrator that is not in the table fails.
void archive(Archive& archive, Calibrator& calibrator);

/// Appends a row to the table while the object exists: how a test adds a calibrator. Not while a suite exists.
class ScopedCalibrator {
 public:
  explicit ScopedCalibrator(const CalibratorRow& row);
  ~ScopedCalibrator();
  ScopedCalibrator(const ScopedCalibrator&) = delete;
  ScopedCalibrator& operator=(const ScopedCalibrator&) = delete;
};

}  // namespace navcal::calib
