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
      {"accelerometer bias x", "m/s2", 0.1},
      {"accelerometer bias y", "m/s2", 0.1},
      {"accelerometer bias z", "m/s2", 0.1},
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
      {"Doppler scale", "", 0.01},
      {"Doppler mounting about z", "rad", 0.02},
      {"current north", "m/s", 0.3},
      {"current east", "m/s", 0.3},
      {"delay of the actuators", "s", 0.02},
  }};
  return kAll;
}

Calibration nuisance_stds(const RecordedMotion& motion) {
  Calibration stds;
  for (std::size_t i = 0; i < nuisances().size(); ++i)
    stds[static_cast<Eigen::Index>(i)] = nuisances()[i].prior_std;
  if (motion.gyro_turn_on_rad_s > 0) stds.head<4>().setConstant(motion.gyro_turn_on_rad_s);
  return stds;
}

}  // namespace navcal::identify
