// SPDX-License-Identifier: Apache-2.0
#include "tests/calib/gps_paths.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace navcal::calib::test {

Deviation gps_deviation() {
  Deviation deviation = thesis_deviation();
  deviation[0] = kGpsOffset_rad;
  return deviation;
}

GpsRun measure_by_gps(const std::vector<TruePoint>& path, const Deviation& deviation, const GpsNoise& noise,
                      Random& random) {
  std::normal_distribution<double> normal;
  const auto scatter = [&](double std) { return Eigen::Vector2d(std * normal(random), std * normal(random)); };
  GpsRun run;
  double next_s = path.empty() ? 0 : path.front().time_s;
  for (const TruePoint& point : path) {
    const Eigen::Matrix3d world_from_body = (Eigen::AngleAxisd(point.heading_rad, Eigen::Vector3d::UnitZ()) *
                                             Eigen::AngleAxisd(point.pitch_rad, Eigen::Vector3d::UnitY()) *
                                             Eigen::AngleAxisd(point.roll_rad, Eigen::Vector3d::UnitX()))
                                                .toRotationMatrix();
    const Eigen::Vector2d through_water = (world_from_body * point.velocity_body_m_s).head<2>();
    if (point.time_s >= next_s - 1e-6) {
      next_s += noise.interval_s;
      const Eigen::Vector2d velocity = through_water + noise.current_m_s + scatter(noise.velocity_std_m_s);
      GroundReading ground;
      ground.time_s = point.time_s;
      ground.position_m = point.position_m + noise.current_m_s * point.time_s + scatter(noise.position_std_m);
      ground.speed_m_s = velocity.norm();
      ground.course_rad = std::atan2(velocity.y(), velocity.x());
      run.ground.push_back(ground);
    }
    WaterTrackReading track;
    track.time_s = point.time_s;
    track.heading_rad =
        std::remainder(measured_heading_rad(deviation, point.heading_rad) + noise.heading_std_rad * normal(random),
                       2 * std::numbers::pi);
    track.turn_rate_rad_s =
        (point.rate_rad_s.y() * std::sin(point.roll_rad) + point.rate_rad_s.z() * std::cos(point.roll_rad)) /
        std::cos(point.pitch_rad);
    track.speed_m_s = through_water.norm();
    run.track.push_back(track);
  }
  return run;
}

double worst_residual_rad(const Deviation& found, const Deviation& truth) {
  double worst = 0;
  for (int degree = 0; degree < 360; ++degree)
    worst = std::max(worst, std::abs(deviation_rad(found - truth, degree * std::numbers::pi / 180)));
  return worst;
}

}  // namespace navcal::calib::test
