// SPDX-License-Identifier: Apache-2.0
#include "gap/replay/reported_channels.h"

#include <algorithm>
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

}  // namespace navcal::gap
