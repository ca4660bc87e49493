// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "config/vehicle.h"
#include "gap/actuators/actuator_track.h"
#include "gap/data/innovations.h"
#include "gap/data/mission.h"
#include "sim/effects/effect_set.h"
#include "sim/vehicle/vehicle.h"

namespace navcal::gap {

/// Constant gyro biases, rad/s: A-x, A-z, B-y, B-z. A nuisance of every power-on.
using GyroBias = std::array<double, 4>;

/// A model that a mission is replayed through: the nominal vehicle and instruments with these effects.
struct Model {
  sim::EffectSet effects = sim::EffectSet();
  GyroBias bias_rad_s{};
};

/// A mission taken through the nominal vehicle and an estimator of fixed gains. The vehicle is driven by what the
/// motor card reported; attitude is carried by the gyros (strapdown) and led by the compass word by word; body
/// rates and depth are led by the card frame by frame; velocity through the water runs free; position is set by
/// fixes with a scheduled gain. No truth is needed. Instrument errors are evaluated at predicted rates, forces and
/// depths: a regressor that held the noise of what it explains would find it.
class Replay {
 public:
  /// `mission` must outlive it; its shortcoming() is empty.
  Replay(const Mission& mission, const config::VehicleSettings& vehicle);

  /// `course`, where given, is filled in.
  [[nodiscard]] Innovations run(const Model& model, Trajectory10Hz* course = nullptr) const;

  [[nodiscard]] Eigen::Index intervals() const { return intervals_; }
  [[nodiscard]] const Mission& mission() const { return mission_; }
  [[nodiscard]] const ActuatorTrack& actuators() const { return track_; }

 private:
  const Mission& mission_;
  config::VehicleSettings settings_;
  sim::Vehicle vehicle_;
  ActuatorTrack track_;
  std::vector<double> current_A_;
  std::vector<double> electronics_C_;  ///< at each compass reading, smoothed
  double begin_s_ = 0;                 ///< of the first interval
  double compass_shift_s_ = 0;         ///< from a reading's time to that by which its interval is chosen
  Eigen::Index intervals_ = 0;
};

}  // namespace navcal::gap
