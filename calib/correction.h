// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "calib/archive.h"
#include "calib/readings.h"

namespace navcal::calib {

/// What can be calibrated, each by an estimator of its own and each with a place of its own in a Correction.
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
inline constexpr std::array kCalibrators{
    Calibrator::gyro,         Calibrator::gyro_b,       Calibrator::compass,      Calibrator::magnetometer,
    Calibrator::gps_compass,  Calibrator::swing,        Calibrator::misalignment, Calibrator::compass_delay,
    Calibrator::course_delay, Calibrator::motor_current};

/// "gyro", "gyro_b", "compass", ...
[[nodiscard]] std::string_view name_of(Calibrator calibrator);
[[nodiscard]] std::optional<Calibrator> calibrator_named(std::string_view name);

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

/// One value for each calibrator that has one: what is in force, or what the estimators now say.
struct Correction {
  std::optional<RateCorrection> gyro, gyro_b;
  std::optional<DeviationCorrection> compass;
  std::optional<FieldCorrection> magnetometer;
  std::optional<DeviationCorrection> gps_compass;
  std::optional<SwingCorrection> swing;
  std::optional<double> misalignment_rad;
  std::optional<double> compass_delay_s, course_delay_s;
  std::optional<MotorCurrentCorrection> motor_current;

  /// A, which no turn tells: the misalignment, or what GpsCompass found with it.
  [[nodiscard]] std::optional<double> offset_rad() const;
  void archive(Archive& archive) {
    archive.tag("correction 2");
    archive(gyro, gyro_b, compass, magnetometer, gps_compass, swing);
    archive(misalignment_rad, compass_delay_s, course_delay_s, motor_current);
  }
};

[[nodiscard]] bool has(const Correction& correction, Calibrator calibrator);
/// Gives `to` the value that `from` has for one calibrator, or takes it away.
void copy_value(Correction& to, const Correction& from, Calibrator calibrator);

/// The reading without the motor's field: its field, and its heading by what that changes in the levelled field.
/// As it is where no such correction applies, or the current is not known. All that follows takes such readings.
[[nodiscard]] CompassReading without_motor_field(const Correction& correction, const CompassReading& reading,
                                                 std::optional<double> current_A);

/// Magnetic heading of a reading after all that applies to it, 0..2 pi: from the calibrated and levelled field
/// where there is one; else by the deviation; never by both. Nothing applies, or nothing to apply it to: nullopt.
[[nodiscard]] std::optional<double> corrected_heading(const Correction& correction, const CompassReading& reading);

/// The same, and where nothing applies the heading as the device says it.
[[nodiscard]] std::optional<double> best_heading(const Correction& correction, const CompassReading& reading);

/// Heading of a field by thesis (2.2), clockwise from magnetic north, 0..2 pi.
[[nodiscard]] double levelled_heading(const Eigen::Vector3d& field_body_uT, double roll_rad, double pitch_rad);

}  // namespace navcal::calib
