// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "autopilot/vehicle_state.h"
#include "config/vehicle.h"

namespace navcal::autopilot {

/// Orders to the actuators.
struct Orders {
  double rudder_rad = 0;
  double elevator_rad = 0;
  Eigen::Vector3d fins_rad = Eigen::Vector3d::Zero();
  double shaft_rps = 0;
};

/// Demanded motion of a vehicle; it holds until the next demand.
struct Demand {
  double heading_rad = 0;  ///< not wrapped
  double turn_rad_s = 0;   ///< rate of the demanded heading
  double depth_m = 0;
  double shaft_rps = 0;
  std::optional<double> speed_m_s{};                ///< instead of the shaft speed
  std::optional<double> rudder_rad{};               ///< instead of the heading
  std::optional<double> elevator_rad{};             ///< instead of the depth
  std::array<std::optional<double>, 3> fins_rad{};  ///< instead of what rudder and elevator make of a fin
};

/// Rudder and elevator onto three fins 120 degrees apart (the card's interface document, section 4).
[[nodiscard]] Eigen::Vector3d mixed_fins(double rudder_rad, double elevator_rad);

/// Heading to rudder, depth to pitch to elevator, speed to shaft speed:
///   rudder = a e_psi + b (turn wanted - turn),            e = wanted - true
///   pitch wanted = c e_z + d integral(e_z), nose up when too deep
///   elevator = f e_theta + g integral(e_theta) - h q
///   shaft = that whose thrust equals the axial drag at the speed wanted + k e_u + l integral(e_u).
/// Each integral grows only where the error before it is small.
class Autopilot {
 public:
  explicit Autopilot(const config::VehicleSettings& settings);

  /// `period_s`: since the last orders, by which the integrals grow.
  [[nodiscard]] Orders orders(const Demand& demand, const VehicleState& state, double period_s);

 private:
  [[nodiscard]] double rudder(const Demand& demand, const VehicleState& state) const;
  [[nodiscard]] double elevator(const Demand& demand, const VehicleState& state, double period_s);
  [[nodiscard]] double shaft(const Demand& demand, const VehicleState& state, double period_s);

  config::AutopilotSettings settings_;
  config::PropellerSettings propeller_;
  double fin_limit_rad_;
  double density_kg_m3_;  ///< of the water
  double drag_kg_m_;      ///< axial, over the square of the speed
  double depth_integral_m_s_ = 0;
  double pitch_integral_rad_s_ = 0;
  double speed_integral_m_ = 0;
};

}  // namespace navcal::autopilot
