// SPDX-License-Identifier: Apache-2.0
#include "identify/replay/calibration.h"

namespace navcal::identify {

const std::array<NuisanceDescription, static_cast<std::size_t>(kNuisances)>& nuisances() {
  static constexpr std::array<NuisanceDescription, static_cast<std::size_t>(kNuisances)> kAll{{
      {"roll gyro bias", "rad/s", 0.005},
      {"pitch gyro bias", "rad/s", 0.005},
      {"yaw gyro bias", "rad/s", 0.005},
      {"second yaw gyro bias", "rad/s", 0.005},
      {"roll gyro scale", "", 0.02},
      {"pitch gyro scale", "", 0.02},
      {"yaw gyro scale", "", 0.02},
      {"second yaw gyro scale", "", 0.02},
      {"roll gyro drift", "rad/s2", 2e-6},
      {"pitch gyro drift", "rad/s2", 2e-6},
      {"yaw gyro drift", "rad/s2", 2e-6},
      {"accelerometer bias x", "m/s2", 0.1},
      {"accelerometer bias y", "m/s2", 0.1},
      {"accelerometer bias z", "m/s2", 0.1},
      {"accelerometer scale x", "", 0.005},
      {"accelerometer scale y", "", 0.005},
      {"accelerometer scale z", "", 0.005},
      {"inertial unit's mounting about x", "rad", 0.02},
      {"inertial unit's mounting about y", "rad", 0.02},
      {"inertial unit's mounting about z", "rad", 0.02},
      {"roll offset", "rad", 0.02},
      {"pitch offset", "rad", 0.02},
      {"heading offset", "rad", 0.5},
      {"heading deviation, sine", "rad", 0.05},
      {"heading deviation, cosine", "rad", 0.05},
      {"dip", "rad", 0.02},
      {"depth offset", "m", 0.2},
      {"offset of the depth gauge", "m", 0.5},
      {"scale of depth", "", 0.005},
      {"Doppler scale", "", 0.01},
      {"Doppler mounting about z", "rad", 0.02},
      {"place of the antenna x", "m", 0.05},
      {"place of the antenna y", "m", 0.05},
      {"current north", "m/s", 0.3},
      {"current east", "m/s", 0.3},
      {"delay of the inertial unit", "s", 0.005},
      {"delay of the heading", "s", 0.02},
      {"delay of the Doppler log", "s", 0.02},
      {"delay of the fixes", "s", 0.1},
      {"delay of the actuators", "s", 0.02},
  }};
  return kAll;
}

std::optional<Nuisance> delay_of(Channel channel) {
  if (channel <= Channel::force_z || channel == Channel::depth) return Nuisance::imu_delay;
  if (channel == Channel::heading) return Nuisance::heading_delay;
  if (channel >= Channel::bottom_x && channel <= Channel::water_z) return Nuisance::doppler_delay;
  if (channel >= Channel::north) return Nuisance::fix_delay;
  return std::nullopt;
}

Calibration nuisance_stds(const RecordedMotion& motion) {
  Calibration stds;
  for (std::size_t i = 0; i < nuisances().size(); ++i)
    stds[static_cast<Eigen::Index>(i)] = nuisances()[i].prior_std;
  if (motion.declination_is_stated) stds[static_cast<Eigen::Index>(Nuisance::heading_offset)] = 0.05;
  if (motion.gyro_turn_on_rad_s > 0) stds.head<4>().setConstant(motion.gyro_turn_on_rad_s);
  return stds;
}

}  // namespace navcal::identify
