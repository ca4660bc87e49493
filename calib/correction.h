// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "calib/archive.h"
#include "calib/calibrator.h"
#include "calib/readings.h"

namespace navcal::calib {

/// true rate = scale * measured + bias (thesis 2.12).
struct RateCorrection {
  double scale = 1;
  double bias_rad_s = 0;
  [[nodiscard]] double operator()(double measured_rad_s) const { return scale * measured_rad_s + bias_rad_s; }
  void archive(Archive& archive) { archive(scale, bias_rad_s); }
};

/// true heading = measured - E(measured), E = A + B sin + C cos + D sin 2 + E cos 2 (thesis 2.7, 2.8).
struct DeviationCorrection {
  std::array<double, 5> coefficients_rad{};
  [[nodiscard]] double operator()(double measured_rad) const;
  [[nodiscard]] DeviationCorrection without_offset() const;  ///< A = 0
  void archive(Archive& archive) { archive(coefficients_rad); }
};

/// calibrated field = matrix * (measured - offset), body axes.
struct FieldCorrection {
  Eigen::Vector3d offset_uT = Eigen::Vector3d::Zero();
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  [[nodiscard]] Eigen::Vector3d operator()(const Eigen::Vector3d& measured_uT) const {
    return matrix * (measured_uT - offset_uT);
  }
  void archive(Archive& archive) { archive(offset_uT, matrix); }
};

/// true heading = measured - deviation, linear between the eight cardinal and intercardinal headings (thesis 4.1).
struct SwingCorrection {
  std::array<double, 8> deviation_rad{};  ///< at measured headings 0, 45, ... 315 degrees
  [[nodiscard]] double operator()(double measured_rad) const;
  void archive(Archive& archive) { archive(deviation_rad); }
};

/// Field without the motor's = measured - slope * current, body axes.
struct MotorCurrentCorrection {
  Eigen::Vector3d slope_uT_per_A = Eigen::Vector3d::Zero();
  void archive(Archive& archive) { archive(slope_uT_per_A); }
};

/// Values of the calibrators that have no member in Correction: up to 64 numbers each. Copies share the numbers,
/// so that copying a correction allocates nothing.
class AddedValues {
 public:
  struct Value {
    Calibrator calibrator = Calibrator::gyro;
    std::vector<double> numbers;
    void archive(Archive& archive);
  };

  /// Empty when the calibrator has none.
  [[nodiscard]] std::span<const double> of(Calibrator calibrator) const;
  /// Sets the value of a calibrator; empty numbers remove it.
  void set(Calibrator calibrator, std::span<const double> numbers);
  [[nodiscard]] std::span<const Value> all() const;
  void archive(Archive& archive);

 private:
  std::shared_ptr<const std::vector<Value>> values_;  ///< null: none
};

/// One value for each calibrator that has one: the active values, or the newest estimates.
struct Correction {
  std::optional<RateCorrection> gyro, gyro_b;
  std::optional<DeviationCorrection> compass;
  std::optional<FieldCorrection> magnetometer;
  std::optional<DeviationCorrection> gps_compass;
  std::optional<SwingCorrection> swing;
  std::optional<double> misalignment_rad;
  std::optional<double> compass_delay_s, course_delay_s;
  std::optional<MotorCurrentCorrection> motor_current;
  AddedValues added;

  /// A, which no turn tells: the misalignment, or what GpsCompass found with it.
  [[nodiscard]] std::optional<double> offset_rad() const;
  /// The layout without added values is version 2; version 3 appends them.
  void archive(Archive& archive);
};

[[nodiscard]] bool has(const Correction& correction, Calibrator calibrator);
/// Gives `to` the value that `from` has for one calibrator, or takes it away.
void copy_value(Correction& to, const Correction& from, Calibrator calibrator);

/// The reading without the motor's field: its field, and its heading by what that changes in the levelled field.
/// As it is where no such correction applies, or the current is not known. All that follows takes such readings.
[[nodiscard]] CompassReading without_motor_field(const Correction& correction, const CompassReading& reading,
                                                 std::optional<double> current_A);

/// Magnetic heading of a reading after all that applies to it, 0..2 pi: from the calibrated and levelled field
/// where there is one; else by the deviation; never by both. Then by each added value. Nothing applies, or nothing
/// to apply it to: nullopt. A is that of a heading reference where there is one (CalibratorRow::gives_offset),
/// else offset_rad().
[[nodiscard]] std::optional<double> corrected_heading(const Correction& correction, const CompassReading& reading);

/// The same, and where nothing applies the heading as the device says it.
[[nodiscard]] std::optional<double> best_heading(const Correction& correction, const CompassReading& reading);

/// Heading of a field by thesis (2.2), clockwise from magnetic north, 0..2 pi.
[[nodiscard]] double levelled_heading(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad);

}  // namespace navcal::calib
