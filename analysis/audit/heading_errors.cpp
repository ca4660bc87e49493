// SPDX-License-Identifier: Apache-2.0
#include "analysis/audit/heading_errors.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/angles.h"
#include "base/durations.h"

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

constexpr double kMostApart_s = 0.5;
constexpr std::size_t kFewestTurns = 15;

/// Vector of three channels of one port, such as field_x, field_y and field_z; not a number where there is none.
Eigen::Vector3d vector_at(const AuditedLog& log, const std::string& port, const std::string& of, double time_s) {
  const auto axis = [&](const char* name) { return log.at(port, of + name, time_s, kMostApart_s).value_or(NAN); };
  return {axis("_x"), axis("_y"), axis("_z")};
}

/// A field before and after a turn by the rates.
struct FieldTurn {
  double begin_s = 0, end_s = 0;
  Eigen::Matrix3d back;  ///< after = back * before, of the Earth's field
  Eigen::Vector3d before = Eigen::Vector3d::Zero(), after = Eigen::Vector3d::Zero();
};

/// Turns of 0.2 rad within 10 s, without a field.
std::vector<FieldTurn> turns_of(const AuditedLog& log) {
  constexpr double kTurn_rad = 0.2, kLongest_s = 10;
  std::vector<FieldTurn> turns;
  const auto rates = log.all("rate_x");
  double begin_s = -INFINITY, last_s = -INFINITY;
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();
  Eigen::Vector3d last_rad_s = Eigen::Vector3d::Zero();
  for (const double time_s : rates.empty() ? std::vector<double>() : rates.front()->series.time_s) {
    const Eigen::Vector3d rate_rad_s =
        base::kRadiansPerDegree * vector_at(log, rates.front()->port, "rate", time_s);
    const Eigen::Vector3d angle_rad =
        (std::exchange(last_rad_s, rate_rad_s) + rate_rad_s) / 2 * (time_s - std::exchange(last_s, time_s));
    if (angle_rad.allFinite()) turned *= Eigen::AngleAxisd(angle_rad.norm(), angle_rad.normalized()).matrix();
    const bool is_turn = Eigen::AngleAxisd(turned).angle() > kTurn_rad && time_s - begin_s < kLongest_s;
    if (!is_turn && time_s - begin_s < kLongest_s) continue;
    if (is_turn) turns.push_back({begin_s, time_s, turned.transpose()});
    begin_s = time_s;
    turned.setIdentity();
  }
  return turns;
}

/// The same turns with the field of lag_s later; without those that have none.
std::vector<FieldTurn> with_fields(std::vector<FieldTurn> turns, const AuditedLog& log, const std::string& port,
                                   double lag_s = 0) {
  for (FieldTurn& turn : turns) {
    turn.before = vector_at(log, port, "field", turn.begin_s + lag_s);
    turn.after = vector_at(log, port, "field", turn.end_s + lag_s);
  }
  std::erase_if(turns, [](const FieldTurn& turn) { return !(turn.before + turn.after).allFinite(); });
  return turns;
}

/// Root mean square of what after - iron = back * (before - iron) leaves of the odd turns, with these axes; the
/// hard iron is that of the even ones.
double unexplained_uT(const std::vector<FieldTurn>& turns, const Eigen::Matrix3d& axes) {
  constexpr double kRidge = 1e-6;
  const auto change_uT = [&](const FieldTurn& turn) -> Eigen::Vector3d {
    return axes * turn.after - turn.back * axes * turn.before;
  };
  const auto by_iron = [](const FieldTurn& turn) -> Eigen::Matrix3d {
    return Eigen::Matrix3d::Identity() - turn.back;
  };
  Eigen::Matrix3d square = kRidge * Eigen::Matrix3d::Identity();
  Eigen::Vector3d product = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < turns.size(); i += 2) {
    square += by_iron(turns[i]).transpose() * by_iron(turns[i]);
    product += by_iron(turns[i]).transpose() * change_uT(turns[i]);
  }
  const Eigen::Vector3d iron_uT = square.inverse() * product;
  const std::size_t judged = turns.size() / 2;
  double squares = 0;
  for (std::size_t i = 1; i < turns.size(); i += 2)
    squares += (change_uT(turns[i]) - by_iron(turns[i]) * iron_uT).squaredNorm();
  return std::sqrt(squares / static_cast<double>(judged));
}

}  // namespace

const FieldCorrection* determined_field(const calib::Report& report) {
  const auto* const magnetometer = report.find(Calibrator::magnetometer);
  const auto* const worst = magnetometer != nullptr ? magnetometer->quantity("worst_heading_rad") : nullptr;
  const bool is_determined = worst != nullptr && std::isfinite(worst->std) && report.estimates.magnetometer;
  return is_determined ? &*report.estimates.magnetometer : accepted_field(report);
}

IronErrors iron_errors(const AuditedLog& log, const FieldCorrection& correction) {
  constexpr std::size_t kSectors = 36, kFewest = 3;
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
  std::array halves{accepted_field(log.halves[0].report), accepted_field(log.halves[1].report)};
  const auto* const whole = determined_field(log.whole.report);
  if (whole == nullptr || log.whole.report.segments.size() > 1) return std::nullopt;
  HeadingErrors errors;
  // A stated heading has no part in the fit of the field: the calibration of the whole log may judge it, too.
  errors.is_of_other_half = halves[0] != nullptr && halves[1] != nullptr;
  errors.is_accepted = errors.is_of_other_half || accepted_field(log.whole.report) != nullptr;
  if (!errors.is_of_other_half) halves = {whole, whole};
  // A device of the compass states magnetic north, but for its filter; the autopilot states true north.
  const bool is_magnetic = heading.port == log.compass && !log.true_headings.contains(heading.port);
  errors.is_absolute =
      is_magnetic || (log.earth && log.earth->declination_source != pipeline::EarthField::Source::none);
  const double declination_rad = is_magnetic || !log.earth ? 0 : log.earth->declination_rad;
  const double late_s = heading.port == log.compass ? log.compass_lag_s : 0;
  const auto own = log.heading_std_deg.find(heading.port);
  double squares = 0, count = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t half = 0; half < 2; ++half) {
    const auto& judge = errors.is_of_other_half ? log.halves.at(half).report : log.whole.report;
    const auto* const report = judge.find(Calibrator::magnetometer);
    if (const auto* std = report->quantity("worst_heading_rad"); std != nullptr)
      errors.reference_std_rad = std::max(errors.reference_std_rad, std->std);
    for (const TiltedField& field : tilted_fields(log.halves.at(half).samples, 0)) {
      const double time_s = base::seconds(field.utc_ns - log.begin_utc_ns);
      const auto stated_deg = value_at(heading.series, time_s + late_s, kMostApart_s);
      if (!stated_deg) continue;
      const double reference_rad = field.heading_rad(*halves.at(1 - half)) + declination_rad;
      const double error_rad = base::wrapped(*stated_deg * base::kRadiansPerDegree - reference_rad);
      sum += Eigen::Vector2d(std::cos(error_rad), std::sin(error_rad));
      errors.time_s.push_back(time_s);
      errors.heading_deg.push_back(base::positive_angle(reference_rad) * base::kDegreesPerRadian);
      errors.error_deg.push_back(error_rad * base::kDegreesPerRadian);
      if (own == log.heading_std_deg.end()) continue;
      if (const auto own_deg = value_at(own->second, time_s, kMostApart_s))
        squares += *own_deg * *own_deg, ++count;
    }
  }
  if (count > 0) errors.stated_deg = std::sqrt(squares / count);
  const double mean_deg = errors.is_absolute ? 0 : std::atan2(sum.y(), sum.x()) * base::kDegreesPerRadian;
  for (double& error_deg : errors.error_deg) error_deg = std::remainder(error_deg - mean_deg, 360.0);
  return errors;
}

std::optional<FieldAxes> field_axes(const AuditedLog& log, const std::string& port) {
  const std::vector<FieldTurn> turns = with_fields(turns_of(log), log, port);
  if (turns.size() < kFewestTurns) return std::nullopt;
  FieldAxes found{0, INFINITY, INFINITY, {}};
  for (const FieldTurn& one : turns)
    found.changed_uT += (one.after - one.before).norm() / static_cast<double>(turns.size());
  std::array<Eigen::Index, 3> order{0, 1, 2};
  do {
    for (Eigen::Index reversed = -1; reversed < 3; ++reversed) {
      Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
      std::string names;
      for (Eigen::Index i = 0; const Eigen::Index from : order) {
        axes(i, from) = i == reversed ? -1 : 1;
        names += fmt::format("{}{}{}", names.empty() ? "" : ", ", i++ == reversed ? "-" : "", "xyz"[from]);
      }
      const double left_uT = unexplained_uT(turns, axes);
      if (found.best.empty()) found.sent_uT = left_uT;
      if (left_uT < found.best_uT) found = {found.changed_uT, found.sent_uT, left_uT, names};
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return found;
}

double field_lag_s(const AuditedLog& log, const std::string& port) {
  constexpr double kStep_s = 0.05, kMost_s = 2, kSharper = 0.7;
  const auto rates = log.all("rate_x");
  if (rates.empty() || rates.front()->port == port) return 0;
  const std::vector<FieldTurn> turns = turns_of(log);
  const auto left_uT = [&](double lag_s) {
    const auto at_lag = with_fields(turns, log, port, lag_s);
    return at_lag.size() < kFewestTurns ? INFINITY : unexplained_uT(at_lag, Eigen::Matrix3d::Identity());
  };
  double best_s = 0, least_uT = kSharper * left_uT(0);
  for (double lag_s = kStep_s; lag_s < kMost_s; lag_s += kStep_s) {
    if (const double uT = left_uT(lag_s); uT < least_uT) best_s = lag_s, least_uT = uT;
  }
  return best_s;
}

FieldComparison compare_fields(const AuditedLog& log, const std::string& first, const std::string& second) {
  FieldComparison fields;
  const auto rolls = log.all("roll"), pitches = log.all("pitch");
  const auto tilt_at = [&](const std::vector<const RecordedChannel*>& tilts, double time_s) {
    const auto tilt_deg = value_at(tilts.front()->series, time_s, kMostApart_s);
    return tilt_deg ? *tilt_deg * base::kRadiansPerDegree : NAN;
  };
  fields.is_levelled = !rolls.empty() && !pitches.empty();
  const RecordedChannel* const times = log.find(first, "field_x");
  if (times == nullptr) return fields;
  for (const double time_s : times->series.time_s) {
    const Eigen::Vector3d one_uT = vector_at(log, first, "field", time_s),
                          other_uT = vector_at(log, second, "field", time_s);
    const double roll_rad = fields.is_levelled ? tilt_at(rolls, time_s) : 0;
    const double pitch_rad = fields.is_levelled ? tilt_at(pitches, time_s) : 0;
    if (!one_uT.allFinite() || !other_uT.allFinite() || !std::isfinite(roll_rad + pitch_rad)) continue;
    const double apart_rad = base::wrapped(calib::levelled_heading(one_uT, roll_rad, pitch_rad) -
                                           calib::levelled_heading(other_uT, roll_rad, pitch_rad));
    fields.time_s.push_back(time_s);
    fields.size_uT.push_back(one_uT.norm());
    fields.apart_deg.push_back(std::abs(apart_rad) * base::kDegreesPerRadian);
  }
  return fields;
}

}  // namespace navcal::analysis
