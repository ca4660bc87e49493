// SPDX-License-Identifier: Apache-2.0
#include "calib/correction.h"

#include <cmath>
#include <utility>

#include "base/angles.h"

namespace navcal::calib {

void AddedValues::Value::archive(Archive& archive) {
  calib::archive(archive, calibrator);
  archive(numbers);
}

std::span<const AddedValues::Value> AddedValues::all() const {
  return values_ ? std::span<const Value>(*values_) : std::span<const Value>();
}

std::span<const double> AddedValues::of(Calibrator calibrator) const {
  for (const Value& value : all()) {
    if (value.calibrator == calibrator) return value.numbers;
  }
  return {};
}

void AddedValues::set(Calibrator calibrator, std::span<const double> numbers) {
  std::vector<Value> values(all().begin(), all().end());
  std::erase_if(values, [&](const Value& value) { return value.calibrator == calibrator; });
  if (!numbers.empty()) values.push_back({calibrator, {numbers.begin(), numbers.end()}});
  values_ = values.empty() ? nullptr : std::make_shared<const std::vector<Value>>(std::move(values));
}

void AddedValues::archive(Archive& archive) {
  std::vector<Value> values(all().begin(), all().end());
  archive(values);
  if (archive.saving()) return;
  if (!archive.ok()) values.clear();
  values_ = values.empty() ? nullptr : std::make_shared<const std::vector<Value>>(std::move(values));
}

void Correction::archive(Archive& archive) {
  const bool with_added = archive.tag_either("correction 2", "correction 3", !added.all().empty());
  archive(gyro, gyro_b, compass, magnetometer, gps_compass, swing);
  archive(misalignment_rad, compass_delay_s, course_delay_s, motor_current);
  if (with_added) {
    archive(added);
  } else {
    added = {};
  }
}

bool has_added(const Correction& correction, Calibrator calibrator) {
  return !correction.added.of(calibrator).empty();
}

void copy_added(Correction& to, const Correction& from, Calibrator calibrator) {
  to.added.set(calibrator, from.added.of(calibrator));
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
  return row_of(calibrator).place.has(correction, calibrator);
}

void copy_value(Correction& to, const Correction& from, Calibrator calibrator) {
  row_of(calibrator).place.copy(to, from, calibrator);
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

namespace {

/// Applies the added values to a heading. Returns the A that is left to be taken off; nullopt: none.
std::optional<double> add_values(const Correction& correction, const CompassReading& reading, bool by_field,
                                 std::optional<double>& heading) {
  std::optional<double> offset_rad = correction.offset_rad();
  bool has_offset = false;
  for (const AddedValues::Value& value : correction.added.all()) {
    const CalibratorRow& row = row_of(value.calibrator);
    if (row.apply == nullptr) continue;
    const auto before = row.applies_to == AppliesTo::measured || !heading ? reading.heading_rad : heading;
    const bool is_of_other =
        row.applies_to != AppliesTo::corrected && (row.applies_to == AppliesTo::field) != by_field;
    // A is the same for both headings of a compass, the harmonics are not.
    if (is_of_other && row.gives_offset) offset_rad = value.numbers.front();
    if (is_of_other || !before) continue;
    heading = row.apply(value.numbers, reading, *before);
    has_offset = has_offset || row.gives_offset;
  }
  return has_offset ? std::nullopt : offset_rad;
}

}  // namespace

std::optional<double> corrected_heading(const Correction& correction, const CompassReading& reading) {
  std::optional<double> heading;
  const bool by_field = correction.magnetometer && reading.field_body_uT && reading.pitch_rad && reading.roll_rad;
  if (by_field) {
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
  const auto offset_rad = add_values(correction, reading, by_field, heading);
  if (offset_rad) heading = heading.value_or(*reading.heading_rad) - *offset_rad;
  if (!heading) return std::nullopt;
  return base::positive_angle(*heading);
}

std::optional<double> best_heading(const Correction& correction, const CompassReading& reading) {
  const auto corrected = corrected_heading(correction, reading);
  return corrected ? corrected : reading.heading_rad;
}

}  // namespace navcal::calib
