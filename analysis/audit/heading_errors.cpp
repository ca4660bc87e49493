// SPDX-License-Identifier: Apache-2.0
#include "analysis/audit/heading_errors.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/audit/bounded.h"
#include "base/angles.h"

namespace navcal::analysis {
namespace {

using calib::Calibrator;
using calib::FieldCorrection;

const FieldCorrection* accepted_field(const calib::Report& report) {
  const auto* const magnetometer = report.find(Calibrator::magnetometer);
  if (magnetometer == nullptr || !magnetometer->judgement.accepted || !report.estimates.magnetometer)
    return nullptr;
  return &*report.estimates.magnetometer;
}

/// The field in body axes with the tilt that levels it.
struct TiltedField {
  double time_s = 0;
  std::int64_t utc_ns = 0;
  Eigen::Vector3d field_uT;
  double roll_rad = 0, pitch_rad = 0;
  [[nodiscard]] double heading_rad(const FieldCorrection& correction) const {
    return calib::levelled_heading(correction(field_uT), roll_rad, pitch_rad);
  }
};

std::vector<TiltedField> tilted_fields(const std::vector<TurnedSample>& samples, std::int64_t since_utc_ns) {
  std::vector<TiltedField> fields;
  for (const TurnedSample& sample : samples) {
    const auto& reading = sample.reading;
    if (!reading.field_body_uT || !reading.roll_rad || !reading.pitch_rad || reading.utc_ns < since_utc_ns)
      continue;
    fields.push_back(
        {reading.time_s, reading.utc_ns, *reading.field_body_uT, *reading.roll_rad, *reading.pitch_rad});
  }
  return fields;
}

/// Standard deviation over mean.
double spread_of(const std::vector<double>& sizes) {
  double sum = 0, squares = 0;
  for (const double size : sizes) sum += size;
  const double mean = sum / static_cast<double>(sizes.size());
  for (const double size : sizes) squares += (size - mean) * (size - mean);
  return std::sqrt(squares / static_cast<double>(sizes.size())) / mean;
}

std::optional<double> value_at(const Series& series, double time_s, double most_apart_s) {
  const auto after = std::lower_bound(series.time_s.begin(), series.time_s.end(), time_s);
  if (after == series.time_s.begin() || after == series.time_s.end()) return std::nullopt;
  const auto i = static_cast<std::size_t>(after - series.time_s.begin());
  const double from_s = series.time_s[i - 1], to_s = series.time_s[i];
  if (to_s - from_s > most_apart_s || !(to_s > from_s)) return std::nullopt;
  const double share = (time_s - from_s) / (to_s - from_s);
  return series.values[i - 1] * (1 - share) + series.values[i] * share;
}

constexpr double kMostApart_s = 0.5;

}  // namespace

IronErrors iron_errors(const AuditedLog& log, const FieldCorrection& correction) {
  constexpr std::size_t kSectors = 12, kFewest = 3;
  IronErrors errors;
  const auto& segments = log.whole.report.segments;
  const auto fields = tilted_fields(log.whole.samples, segments.empty() ? 0 : segments.back().begin_utc_ns);
  const std::array halves{accepted_field(log.halves[0].report), accepted_field(log.halves[1].report)};
  const bool both = halves[0] != nullptr && halves[1] != nullptr && segments.size() < 2;
  std::array<double, kSectors> sums{}, between{};
  std::array<std::size_t, kSectors> counts{};
  for (const TiltedField& field : fields) {
    const double heading_rad = field.heading_rad(correction);
    const auto sector = std::min(static_cast<std::size_t>(heading_rad / base::kTurn_rad * kSectors), kSectors - 1);
    sums.at(sector) += base::wrapped(field.heading_rad(FieldCorrection{}) - heading_rad);
    if (both) between.at(sector) += base::wrapped(field.heading_rad(*halves[0]) - field.heading_rad(*halves[1]));
    ++counts.at(sector);
  }
  if (both) errors.disagreement_rad = 0;
  for (std::size_t i = 0; i < kSectors; ++i) {
    if (counts.at(i) < kFewest) continue;
    const auto count = static_cast<double>(counts.at(i));
    errors.worst_rad = std::max(errors.worst_rad, std::abs(sums.at(i)) / count);
    if (both) errors.disagreement_rad = std::max(*errors.disagreement_rad, std::abs(between.at(i)) / count);
  }
  if (!both) return errors;
  std::vector<double> before, after;
  for (std::size_t half = 0; half < 2; ++half) {
    for (const TurnedSample& sample : log.halves.at(half).samples) {
      if (!sample.reading.field_body_uT) continue;
      before.push_back(sample.reading.field_body_uT->norm());
      after.push_back((*halves.at(1 - half))(*sample.reading.field_body_uT).norm());
    }
  }
  if (before.empty()) return errors;
  errors.spread_before = spread_of(before);
  errors.spread_after = spread_of(after);
  return errors;
}

double motor_heading_rad(const AuditedLog& log, const calib::MotorCurrentCorrection& motor, double current_A) {
  const FieldCorrection* const accepted = accepted_field(log.whole.report);
  const FieldCorrection correction = accepted != nullptr ? *accepted : FieldCorrection{};
  double most_rad = 0;
  for (TiltedField field : tilted_fields(log.whole.samples, 0)) {
    const double with_rad = field.heading_rad(correction);
    field.field_uT -= motor.slope_uT_per_A * current_A;
    most_rad = std::max(most_rad, std::abs(base::wrapped(with_rad - field.heading_rad(correction))));
  }
  return most_rad;
}

std::optional<HeadingErrors> heading_errors(const AuditedLog& log, const RecordedChannel& heading) {
  const std::array halves{accepted_field(log.halves[0].report), accepted_field(log.halves[1].report)};
  if (halves[0] == nullptr || halves[1] == nullptr || log.whole.report.segments.size() > 1) return std::nullopt;
  HeadingErrors errors;
  // A device of the compass states magnetic north; the autopilot states true north.
  const bool is_own = heading.port == log.compass;
  errors.is_absolute =
      is_own || (log.earth && log.earth->declination_source != pipeline::EarthField::Source::none);
  const double declination_rad = is_own || !log.earth ? 0 : log.earth->declination_rad;
  for (std::size_t half = 0; half < 2; ++half) {
    const auto* const report = log.halves.at(half).report.find(Calibrator::magnetometer);
    if (const auto* std = report->quantity("worst_heading_rad"); std != nullptr)
      errors.reference_std_rad = std::max(errors.reference_std_rad, std->std);
    for (const TiltedField& field : tilted_fields(log.halves.at(half).samples, 0)) {
      const double time_s = static_cast<double>(field.utc_ns - log.begin_utc_ns) * 1e-9;
      const auto stated_deg = value_at(heading.series, time_s, kMostApart_s);
      if (!stated_deg) continue;
      const double reference_rad = field.heading_rad(*halves.at(1 - half)) + declination_rad;
      errors.points.push_back({time_s, base::positive_angle(reference_rad),
                               base::wrapped(*stated_deg * base::kRadiansPerDegree - reference_rad)});
    }
  }
  if (errors.points.empty()) return std::nullopt;
  if (errors.is_absolute) return errors;
  double sine = 0, cosine = 0;
  for (const auto& point : errors.points) {
    sine += std::sin(point.error_rad);
    cosine += std::cos(point.error_rad);
  }
  const double mean_rad = std::atan2(sine, cosine);
  for (auto& point : errors.points) point.error_rad = base::wrapped(point.error_rad - mean_rad);
  return errors;
}

std::optional<Series> angles_between(const AuditedLog& log, const std::string& first, const std::string& second) {
  constexpr std::array kAxes{"field_x", "field_y", "field_z"};
  std::array<const RecordedChannel*, 3> of_first{}, of_second{};
  for (std::size_t i = 0; i < kAxes.size(); ++i) {
    of_first.at(i) = log.find(first, kAxes.at(i));
    of_second.at(i) = log.find(second, kAxes.at(i));
    if (of_first.at(i) == nullptr || of_second.at(i) == nullptr) return std::nullopt;
  }
  Series angles;
  const Series& times = of_first[0]->series;
  for (std::size_t k = 0; k < times.time_s.size(); ++k) {
    Eigen::Vector3d a, b;
    bool known = true;
    for (std::size_t i = 0; i < kAxes.size() && known; ++i) {
      const auto other = value_at(of_second.at(i)->series, times.time_s[k], kMostApart_s);
      known = other && k < of_first.at(i)->series.values.size();
      if (!known) break;
      a[static_cast<Eigen::Index>(i)] = of_first.at(i)->series.values[k];
      b[static_cast<Eigen::Index>(i)] = *other;
    }
    if (!known || a.norm() == 0 || b.norm() == 0) continue;
    angles.time_s.push_back(times.time_s[k]);
    angles.values.push_back(std::atan2(a.cross(b).norm(), a.dot(b)) * base::kDegreesPerRadian);
  }
  return angles.values.empty() ? std::nullopt : std::optional(angles);
}

}  // namespace navcal::analysis
