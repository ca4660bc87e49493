// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "config/vehicle.h"
#include "gap/actuators/actuator_track.h"
#include "gap/data/innovations.h"
#include "gap/data/mission.h"
#include "sim/effects/effect_set.h"
#include "sim/layout/layout_vehicle.h"

namespace navcal::gap {

/// Constant gyro biases, rad/s: A-x, A-z, B-y, B-z. They are nuisance parameters, new at each power-on.
using GyroBias = std::array<double, 4>;

/// Model of a replay: the nominal vehicle and instruments with these effects.
struct Model {
  sim::EffectSet effects = sim::EffectSet();
  GyroBias bias_rad_s{};
};

/// Replays a mission through the nominal vehicle and an estimator of fixed gains.
///
/// The motor card's reports drive the vehicle. The gyros propagate the attitude (strapdown), and each compass
/// reading corrects it. Each frame of the card corrects body rates and depth. Velocity through the water is not
/// corrected; fixes correct the position with a scheduled gain. No truth is needed.
///
/// Instrument errors are evaluated at predicted rates, forces and depths. A regressor that contained the noise
/// of the residuals would be correlated with them.
class Replay {
 public:
  /// `mission` must outlive it; its shortcoming() is empty.
  Replay(const Mission& mission, const config::VehicleSettings& vehicle);

  /// Fills in `course`, where given.
  [[nodiscard]] Innovations run(const Model& model, Trajectory10Hz* course = nullptr) const;
  /// The same with one integration step for each frame of the card. Its innovations are biased, but the difference
  /// of two such runs is as good as that of two others, and costs half.
  [[nodiscard]] Innovations run_coarsely(const Model& model) const;

  [[nodiscard]] Eigen::Index intervals() const { return intervals_; }
  [[nodiscard]] const Mission& mission() const { return mission_; }
  [[nodiscard]] const ActuatorTrack& actuators() const { return track_; }

 private:
  [[nodiscard]] Innovations run_in_steps(const Model& model, double longest_part_s, Trajectory10Hz* course) const;

  const Mission& mission_;
  config::VehicleSettings settings_;
  sim::LayoutVehicle vehicle_;
  ActuatorTrack track_;
  std::vector<double> current_A_;
  std::vector<double> electronics_C_;  ///< at each compass reading, smoothed
  double begin_s_ = 0;                 ///< begin of the first interval
  double compass_shift_s_ = 0;         ///< added to a reading's time to choose its interval
  Eigen::Index intervals_ = 0;
};

}  // namespace navcal::gap
