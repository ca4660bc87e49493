// SPDX-License-Identifier: Apache-2.0
#include "gap/replay/regimes.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/gamma.hpp>
#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "gap/replay/estimator_gains.h"

namespace navcal::gap {
namespace {

constexpr double kSettling_s = 20;

enum Reported : std::size_t {
  compass_heading,
  compass_field,
  compass_tilt,
  imu_gyro,
  imu_accel,
  imu_depth,
  gps_position,
  gps_velocity,
  vehicle_yaw_rate,
  vehicle_pitch_rate,
  vehicle_speed,
  vehicle_depth_rate
};

/// Bands of frequency, by means over so many rows: slow is what the long means show, fast is what the short
/// means leave.
constexpr Eigen::Index kSlow = 200, kFast = 20;

enum Regime : std::size_t {
  constant,
  heading_once,
  heading_twice,
  heading_thrice,
  turn_rate,
  turn_rate_size,
  roll,
  pitch,
  motor_current,
  temperature,
  time_passed,
  depth_below,
  speed,
  surface,
  rudder,
  elevator,
  slow,
  fast,
  overall
};

Eigen::Map<const Eigen::VectorXd> mapped(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

/// Mean square of the least-squares fit of each column on the drivers (without their means, except for a
/// constant).
double fitted_mean_square(const Eigen::MatrixXd& values, const Eigen::MatrixXd& drivers) {
  Eigen::MatrixXd gram = drivers.transpose() * drivers;
  const double size = gram.trace();
  if (!(size > 1e-12 * static_cast<double>(drivers.rows()))) return 0;  // the driver stands still
  gram.diagonal().array() += 1e-9 * size;
  const Eigen::MatrixXd fit = drivers * gram.llt().solve(drivers.transpose() * values);
  return fit.squaredNorm() / static_cast<double>(values.rows());
}

Eigen::MatrixXd without_mean(Eigen::MatrixXd columns) {
  columns.rowwise() -= columns.colwise().mean().eval();
  return columns;
}

/// The part of the heading's third harmonic that is orthogonal to the first two, which iron causes. On courses
/// that do not turn evenly, the harmonics are correlated. Zero where the course turns too little to separate
/// them.
Eigen::MatrixXd third_harmonic(const Eigen::ArrayXd& heading_rad) {
  constexpr double kLeast = 0.1;  // of its size
  Eigen::MatrixXd lower(heading_rad.size(), 5), third(heading_rad.size(), 2);
  lower << Eigen::ArrayXd::Ones(heading_rad.size()), heading_rad.cos(), heading_rad.sin(), (2 * heading_rad).cos(),
      (2 * heading_rad).sin();
  third << (3 * heading_rad).cos(), (3 * heading_rad).sin();
  const double size = third.squaredNorm();
  third -= (lower * lower.colPivHouseholderQr().solve(third)).eval();
  if (third.squaredNorm() < kLeast * kLeast * size) third.setZero();
  return third;
}

/// Deflection of a fin, or zero where it only holds the course. Such a fin moves by the noise of the
/// instruments that steer it, so it follows the innovations and does not drive them.
Eigen::MatrixXd deflected(const std::vector<double>& fin_rad) {
  constexpr double kLeast_rad = 0.5 * std::numbers::pi / 180;  // root mean square
  Eigen::MatrixXd moves = without_mean(mapped(fin_rad));
  if (moves.squaredNorm() < kLeast_rad * kLeast_rad * static_cast<double>(moves.rows())) moves.setZero();
  return moves;
}

/// Mean square within a band of frequencies, or of all frequencies.
double values_square(const Eigen::MatrixXd& values, std::size_t band) {
  const auto n = static_cast<double>(values.rows());
  if (band == overall) return values.squaredNorm() / n;
  if (values.rows() < 2 * kSlow) return 0;
  if (band == slow) return without_mean(block_means(values, kSlow)).squaredNorm() / n;
  return (values - block_means(values, kFast)).squaredNorm() / n;
}

}  // namespace

const std::vector<ReportedChannel>& reported_channels() {
  static const std::vector<ReportedChannel> kAll{{"compass.heading", "deg", base::kDegreesPerRadian},
                                                 {"compass.field", "uT", 1},
                                                 {"compass.tilt", "deg", base::kDegreesPerRadian},
                                                 {"imu.gyro", "deg/s", base::kDegreesPerRadian},
                                                 {"imu.accel", "m/s2", 1},
                                                 {"imu.depth", "m", 1},
                                                 {"gps.position", "m", 1},
                                                 {"gps.velocity", "m/s", 1},
                                                 {"vehicle.yaw_rate", "deg/s", base::kDegreesPerRadian},
                                                 {"vehicle.pitch_rate", "deg/s", base::kDegreesPerRadian},
                                                 {"vehicle.speed", "m/s", 1},
                                                 {"vehicle.depth_rate", "m/s", 1}};
  return kAll;
}

Eigen::MatrixXd block_means(const Eigen::MatrixXd& values, Eigen::Index length) {
  Eigen::MatrixXd means(values.rows(), values.cols());
  for (Eigen::Index from = 0; from < values.rows(); from += length) {
    const Eigen::Index rows = std::min(length, values.rows() - from);
    means.middleRows(from, rows).rowwise() = values.middleRows(from, rows).colwise().mean().eval();
  }
  return means;
}

ChannelSeries series_of(std::size_t channel, const Innovations& innovations, const Trajectory10Hz& course,
                        const std::vector<double>& fix_times_s) {
  ChannelSeries series;
  const bool at_fixes = channel == gps_position || channel == gps_velocity || channel == vehicle_speed;
  const std::size_t points = at_fixes ? fix_times_s.size() : course.time_s.size();
  // Correction of the estimator's depth a second, for each metre that it is off: turns a depth into a rate.
  const double depth_gain_per_s = kDepthGain * course.instruments.imu.timing.rate_Hz;
  // Without a second yaw gyro, the first one is the yaw rate, and its roll the rest.
  const bool both_gyros = innovations.grid.col(gyro_yaw_b).array().isFinite().any();
  std::vector<Eigen::VectorXd> rows;
  for (std::size_t i = 0; i < points; ++i) {
    std::size_t at = i;
    if (at_fixes) {
      const double place = (fix_times_s[i] - course.time_s.front()) / kInterval_s;
      if (place < 0 || place >= static_cast<double>(course.time_s.size())) continue;
      at = static_cast<std::size_t>(place);
    }
    if (course.time_s[at] < course.time_s.front() + kSettling_s) continue;
    Eigen::VectorXd row;
    const auto grid = [&](Eigen::Index column) { return innovations.grid(static_cast<Eigen::Index>(i), column); };
    const auto fix = [&](Eigen::Index column) { return innovations.fixes(static_cast<Eigen::Index>(i), column); };
    switch (channel) {
      case compass_heading: row = Eigen::VectorXd::Constant(1, grid(heading)); break;
      case compass_field: row = Eigen::Vector3d{grid(field_x), grid(field_y), grid(field_z)}; break;
      case compass_tilt: row = Eigen::Vector2d{grid(tilt_roll), grid(tilt_pitch)}; break;
      case imu_gyro:
        row = both_gyros ? Eigen::VectorXd(Eigen::Vector2d{
                               grid(gyro_roll), (grid(gyro_yaw_a) - grid(gyro_yaw_b)) / std::numbers::sqrt2})
                         : Eigen::VectorXd::Constant(1, grid(gyro_roll));
        break;
      case imu_accel: row = Eigen::Vector3d{grid(force_x), grid(force_y), grid(force_z)}; break;
      case imu_depth: row = Eigen::VectorXd::Constant(1, grid(depth)); break;
      case gps_position:
        row =
            innovations.fix_scale_m[static_cast<Eigen::Index>(i)] * Eigen::Vector2d{fix(fix_north), fix(fix_east)};
        break;
      case gps_velocity: row = Eigen::Vector2d{fix(velocity_north), fix(velocity_east)}; break;
      case vehicle_yaw_rate:
        row = Eigen::VectorXd::Constant(1,
                                        both_gyros ? (grid(gyro_yaw_a) + grid(gyro_yaw_b)) / 2 : grid(gyro_yaw_a));
        break;
      case vehicle_pitch_rate: row = Eigen::VectorXd::Constant(1, grid(gyro_pitch)); break;
      case vehicle_speed:
        row = Eigen::VectorXd::Constant(1, std::cos(course.heading_rad[at]) * fix(velocity_north) +
                                               std::sin(course.heading_rad[at]) * fix(velocity_east));
        break;
      default: row = Eigen::VectorXd::Constant(1, depth_gain_per_s * grid(depth));
    }
    if (!row.allFinite()) continue;
    rows.push_back(row * reported_channels()[channel].per_si);
    series.rows.push_back(at);
  }
  series.values.resize(static_cast<Eigen::Index>(rows.size()), rows.empty() ? 0 : rows.front().size());
  for (std::size_t i = 0; i < rows.size(); ++i) series.values.row(static_cast<Eigen::Index>(i)) = rows[i];
  if (channel == vehicle_depth_rate && series.values.rows() > 0) series.values = block_means(series.values, 10);
  return series;
}

const std::vector<std::string_view>& regimes() {
  static const std::vector<std::string_view> kAll{
      "constant", "heading_once",  "heading_twice", "heading_thrice", "turn_rate", "turn_rate_size", "roll",
      "pitch",    "motor_current", "temperature",   "time",           "depth",     "speed",          "surface",
      "rudder",   "elevator",      "slow",          "fast",           "overall"};
  return kAll;
}

Eigen::Index overall_regime() { return overall; }

Eigen::MatrixXd drivers_of(std::size_t regime, const Trajectory10Hz& course) {
  const auto one = [](const auto& column) { return without_mean(Eigen::MatrixXd(column)); };
  const Eigen::ArrayXd turned = mapped(course.heading_rad).array();
  Eigen::MatrixXd both(turned.size(), 2);
  switch (regime) {
    case constant: return Eigen::MatrixXd::Ones(turned.size(), 1);
    case heading_once: both << turned.cos(), turned.sin(); return without_mean(both);
    case heading_twice: both << (2 * turned).cos(), (2 * turned).sin(); return without_mean(both);
    case heading_thrice: return third_harmonic(turned);
    case turn_rate: return one(mapped(course.yaw_rate_rad_s));
    case turn_rate_size: return one(mapped(course.yaw_rate_rad_s).cwiseAbs());
    case roll: return one(mapped(course.roll_rad));
    case pitch: return one(mapped(course.pitch_rad));
    case motor_current: return one(mapped(course.current_A));
    case temperature: return one(mapped(course.temperature_rise_C));
    case time_passed: return one(mapped(course.time_s));
    case depth_below: return one(mapped(course.depth_m));
    case speed: return one(mapped(course.surge_m_s));
    case surface:
      return one(
          (mapped(course.depth_m).array() < course.instruments.gps.antenna_depth_m).cast<double>().matrix());
    case rudder: return deflected(course.rudder_rad);
    case elevator: return deflected(course.elevator_rad);
    default: return {};
  }
}

Eigen::MatrixXd explained_rms(const Innovations& innovations, const Trajectory10Hz& course,
                              const std::vector<double>& fix_times_s) {
  const auto channels = static_cast<Eigen::Index>(reported_channels().size());
  const auto kinds = static_cast<Eigen::Index>(regimes().size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(channels, kinds);
  std::vector<Eigen::MatrixXd> drivers;
  for (std::size_t k = 0; k < regimes().size(); ++k) drivers.push_back(drivers_of(k, course));
  for (Eigen::Index c = 0; c < channels; ++c) {
    const ChannelSeries series = series_of(static_cast<std::size_t>(c), innovations, course, fix_times_s);
    const Eigen::Index n = series.values.rows();
    if (n < 8) continue;
    for (Eigen::Index k = 0; k < kinds; ++k) {
      const auto& driver = drivers[static_cast<std::size_t>(k)];
      double square = 0;
      if (driver.size() > 0) {
        Eigen::MatrixXd here = driver(series.rows, Eigen::all);
        // The rows of a channel have another mean than the course. A driver that hardly varies in them would
        // otherwise stand for a constant.
        if (static_cast<std::size_t>(k) != constant) here = without_mean(std::move(here));
        square = fitted_mean_square(series.values, here);
      } else {
        square = values_square(series.values, static_cast<std::size_t>(k));
      }
      result(c, k) = std::sqrt(square);
    }
  }
  return result;
}

/// Factor on the variance: a tail that is heavier than the bank can resolve.
constexpr double kHeavier = 1.5;

RegimeStatistics::RegimeStatistics(const std::vector<Eigen::MatrixXd>& of_nulls) {
  if (of_nulls.empty()) return;
  mean_square = variance = Eigen::MatrixXd::Zero(of_nulls.front().rows(), of_nulls.front().cols());
  for (const auto& null : of_nulls) mean_square += null.cwiseAbs2();
  mean_square /= static_cast<double>(of_nulls.size());
  for (const auto& null : of_nulls) variance += (null.cwiseAbs2() - mean_square).cwiseAbs2();
  // Few nulls hardly tell their variance: its upper limit (99 %), as far as the heavier tail does not cover it.
  const double freedom = std::max<double>(1, static_cast<double>(of_nulls.size()) - 1);
  constexpr double kLimit = 0.01;
  variance /= std::min(freedom,
                       kHeavier * boost::math::quantile(boost::math::chi_squared_distribution<>(freedom), kLimit));
}

double RegimeStatistics::floor(Eigen::Index channel, Eigen::Index regime) const {
  return std::sqrt(mean_square(channel, regime));
}

double RegimeStatistics::p_value(Eigen::Index channel, Eigen::Index regime, double value) const {
  const double mean = mean_square(channel, regime);
  const double spread = kHeavier * variance(channel, regime);
  if (!(mean > 0) || !(spread > 0) || !(value > 0)) return 1;
  // Nulls that hardly differ give a distribution too narrow for its tail to be computed. The bound on its shape
  // changes no decision.
  constexpr double kNarrowest = 1e6;
  const double shape = std::min(mean * mean / spread, kNarrowest);
  const boost::math::gamma_distribution<double> gamma(shape, mean / shape);
  return boost::math::cdf(boost::math::complement(gamma, value * value));
}

}  // namespace navcal::gap
