// SPDX-License-Identifier: Apache-2.0
#include "bench/dvl_navigation/doppler_log.h"

#include <cmath>

#include "base/rotation.h"
#include "base/vectors.h"

namespace navcal::bench {

DopplerLog::DopplerLog(const DopplerLogOptions& options, std::uint64_t seed)
    : options_(options), noise_(seed), scale_(1 + noise_.normal(options.scale_error)),
      yaw_rad_(noise_.normal(options.alignment_error_rad)) {}

instruments::Vector3 DopplerLog::measured_m_s(const sim::State& state, bool over_bottom) {
  Eigen::Vector3d body_m_s = base::vector_of(state.velocity_body_m_s);
  if (over_bottom) {
    const auto world_from_body = base::rotation_of({state.euler_rad[0], state.euler_rad[1], state.euler_rad[2]});
    body_m_s += world_from_body.transpose() * Eigen::Vector3d(state.current_m_s[0], state.current_m_s[1], 0);
  }
  const Eigen::Vector3d own_m_s = scale_ * (base::rotation_of({0, 0, yaw_rad_}).transpose() * body_m_s);
  const double wrong_m_s = noise_.uniform(0.0, 1.0) < options_.bad ? noise_.uniform(-3.0, 3.0) : 0;
  return {own_m_s.x() + wrong_m_s + noise_.normal(options_.noise_m_s),
          own_m_s.y() + noise_.normal(options_.noise_m_s), own_m_s.z() + noise_.normal(options_.noise_m_s)};
}

instruments::DvlSample DopplerLog::measure(const sim::State& state, double time_s) {
  instruments::DvlSample dvl;
  const bool lost = options_.lost_each_s - std::fmod(time_s, options_.lost_each_s) <= options_.lost_s;
  const auto bottom_m_s = measured_m_s(state, true), water_m_s = measured_m_s(state, false);
  if (!(noise_.uniform(0.0, 1.0) < options_.dropped) && !lost) {
    dvl.bottom_velocity_m_s = bottom_m_s;
    dvl.bottom_velocity_std_m_s = options_.noise_m_s;
  }
  if (options_.through_water) {
    dvl.water_velocity_m_s = water_m_s;
    dvl.water_velocity_std_m_s = options_.noise_m_s;
  }
  return dvl;
}

}  // namespace navcal::bench
