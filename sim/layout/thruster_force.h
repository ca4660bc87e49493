// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "autopilot/thrust_curve.h"
#include "config/layout.h"
#include "sim/layout/vector_of.h"

namespace navcal::sim {

/// A thruster at r with unit direction e advances at u_a = (v + omega x r).e; its thrust T and the reaction Q of
/// its propeller (autopilot/thrust_curve.h) act as force T e and moment r x T e + Q e about the origin.
class ThrusterForce {
 public:
  ThrusterForce(const config::LayoutThruster& thruster, double density_kg_m3)
      : thruster_(thruster), density_kg_m3_(density_kg_m3),
        of_thrust_(force_at(vector_of(thruster.place_m), vector_of(thruster.direction).normalized())) {}

  /// `position`: the command after lag and dead band, in the command's unit; `factor`: of the thrust, not the
  /// reaction.
  void add(const Vector6& velocity, double position, double factor, Vector6& force) const {
    const autopilot::Thrust thrust =
        autopilot::thrust_at(thruster_, density_kg_m3_, position, of_thrust_.dot(velocity));
    force += factor * thrust.force_N * of_thrust_;
    force.tail<3>() += thrust.torque_Nm * of_thrust_.head<3>();
  }

 private:
  config::LayoutThruster thruster_;
  double density_kg_m3_;
  Vector6 of_thrust_;  ///< force about the origin of a unit thrust; the speed of the place along e is its product
                       ///< with the velocity
};

}  // namespace navcal::sim
