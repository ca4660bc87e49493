// SPDX-License-Identifier: Apache-2.0
#include "calib/correction.h"

#include <cmath>

#include "base/angles.h"

namespace navcal::calib {
namespace {

constexpr std::array<std::string_view, kCalibrators.size()> kNames{
    "gyro",  "gyro_b",       "compass",       "magnetometer", "gps_compass",
    "swing", "misalignment", "compass_delay", "course_delay", "motor_current"};

/// `visit(value)` with the optional of that calibrator.
template <class Corrections, class Visit>
auto visit_value(Corrections& c, Calibrator calibrator, Visit visit) {
  switch (calibrator) {
    case Calibrator::gyro:
      return visit(&Correction::gyro, c);
    case Calibrator::gyro_b:
      return visit(&Correction::gyro_b, c);
    case Calibrator::compass:
      return visit(&Correction::compass, c);
    case Calibrator::magnetometer:
      return visit(&Correction::magnetometer, c);
    case Calibrator::gps_compass:
      return visit(&Correction::gps_compass, c);
    case Calibrator::swing:
      return visit(&Correction::swing, c);
    case Calibrator::misalignment:
      return visit(&Correction::misalignment_rad, c);
    case Calibrator::compass_delay:
      return visit(&Correction::compass_delay_s, c);
    case Calibrator::course_delay:
      return visit(&Correction::course_delay_s, c);
    case Calibrator::motor_current:
      break;
  }
  return visit(&Correction::motor_current, c);
}

}  // namespace

std::string_view name_of(Calibrator calibrator) { return kNames.at(static_cast<std::size_t>(calibrator)); }

std::optional<Calibrator> calibrator_named(std::string_view name) {
  for (const Calibrator calibrator : kCalibrators) {
    if (name_of(calibrator) == name) return calibrator;
  }
  return std::nullopt;
}

double DeviationCorrection::operator()(double measured_rad) const {
  const auto& [a, b, c, d, e] = coefficients_rad;
  return measured_rad - (a + b * std::sin(measured_rad) + c * std::cos(measured_rad) +
                         d * std::sin(2 * measured_rad) + e * std::cos(2 * measured_rad));
}

DeviationCorrection DeviationCorrection::without_offset() const {
  DeviationCorrection rest = *this;
  rest.coefficients_rad[0] = 0;
  return rest;
}

double SwingCorrection::operator()(double measured_rad) const {
  const double place = base::positive_angle(measured_rad) / base::kTurn_rad * 8;
  const auto sector = static_cast<std::size_t>(place) % 8;
  const double share = place - std::floor(place);
  return measured_rad - ((1 - share) * deviation_rad[sector] + share * deviation_rad[(sector + 1) % 8]);
}

std::optional<double> Correction::offset_rad() const {
  if (misalignment_rad || !gps_compass) return misalignment_rad;
  return gps_compass->coefficients_rad[0];
}

bool has(const Correction& correction, Calibrator calibrator) {
  return visit_value(correction, calibrator,
                     [](auto member, const Correction& c) { return (c.*member).has_value(); });
}

void copy_value(Correction& to, const Correction& from, Calibrator calibrator) {
  visit_value(to, calibrator, [&](auto member, Correction& c) { c.*member = from.*member; });
}

double levelled_heading(const Eigen::Vector3d& field, double roll_rad, double pitch_rad) {
  const double sin_roll = std::sin(roll_rad), cos_roll = std::cos(roll_rad);
  const double across = field.y() * sin_roll + field.z() * cos_roll;
  const double forward = field.x() * std::cos(pitch_rad) + across * std::sin(pitch_rad);
  const double starboard = field.y() * cos_roll - field.z() * sin_roll;
  return base::positive_angle(std::atan2(-starboard, forward));
}

CompassReading without_motor_field(const Correction& correction, const CompassReading& reading,
                                   std::optional<double> current_A) {
  if (!correction.motor_current || !current_A || !reading.field_body_uT) return reading;
  CompassReading without = reading;
  *without.field_body_uT -= *current_A * correction.motor_current->slope_uT_per_A;
  if (reading.heading_rad && reading.roll_rad && reading.pitch_rad) {
    const auto levelled = [&](const CompassReading& r) {
      return levelled_heading(*r.field_body_uT, *r.roll_rad, *r.pitch_rad);
    };
    without.heading_rad = base::positive_angle(*reading.heading_rad + levelled(without) - levelled(reading));
  }
  return without;
}

std::optional<double> corrected_heading(const Correction& correction, const CompassReading& reading) {
  std::optional<double> heading;
  if (correction.magnetometer && reading.field_body_uT && reading.pitch_rad && reading.roll_rad) {
    heading = levelled_heading((*correction.magnetometer)(*reading.field_body_uT), *reading.roll_rad,
                               *reading.pitch_rad);
  } else if (!reading.heading_rad) {
    return std::nullopt;
  } else if (correction.compass) {
    heading = (*correction.compass)(*reading.heading_rad);
  } else if (correction.gps_compass) {
    heading = correction.gps_compass->without_offset()(*reading.heading_rad);
  } else if (correction.swing) {
    heading = (*correction.swing)(*reading.heading_rad);
  } else if (correction.motor_current) {
    heading = reading.heading_rad;
  }
  if (const auto offset_rad = correction.offset_rad())
    heading = heading.value_or(*reading.heading_rad) - *offset_rad;
  if (!heading) return std::nullopt;
  return base::positive_angle(*heading);
}

std::optional<double> best_heading(const Correction& correction, const CompassReading& reading) {
  const auto corrected = corrected_heading(correction, reading);
  return corrected ? corrected : reading.heading_rad;
}

}  // namespace navcal::calib
