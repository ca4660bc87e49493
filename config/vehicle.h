// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace navcal::config {

struct WaterSettings {
  double density_kg_m3 = 1000;

  bool operator==(const WaterSettings&) const = default;
};

struct HullSettings {
  double length_m = 0.91;
  double diameter_m = 0.089;
  double mass_kg = 5.3;
  double gravity_below_m = 0.010;
  double roll_inertia_factor = 0.88;
  double pitch_inertia_factor = 0.85;
  double roll_added_factor = 0.3;
  double axial_drag = 0.30;
  double cross_flow_drag = 1.1;
  double lift_slope_per_rad = 0.6;
  double lift_area_factor = 0.7;
  double lift_at_m = 0.05;

  bool operator==(const HullSettings&) const = default;
};

struct FinSettings {
  double area_m2 = 0.0048;
  double lift_slope_per_rad = 3.0;
  double induced_drag = 1.2;
  double stall_rad = 0.45;
  double station_m = -0.40;
  double radius_m = 0.085;
  double lag_s = 0.15;
  double limit_rad = 25 * std::numbers::pi / 180;

  bool operator==(const FinSettings&) const = default;
};

struct PropellerSettings {
  double diameter_m = 0.10;
  double thrust_at_rest = 0.35;
  double thrust_slope = -0.32;
  double torque = 0.02;
  double torque_felt = 0.1;
  double lag_s = 0.5;
  double idle_current_A = 0.15;
  double current_A_s3 = 5.5e-4;

  bool operator==(const PropellerSettings&) const = default;
};

struct DampingSettings {
  double roll_ratio = 0.25;
  double pitch_ratio = 0.5;
  double yaw_per_s = 0.15;

  bool operator==(const DampingSettings&) const = default;
};

struct AutopilotSettings {
  double period_s = 0.1;
  double rudder_per_heading = 1.2;
  double rudder_per_turn_s = 0.5;
  double rudder_limit_rad = 22 * std::numbers::pi / 180;
  double pitch_per_depth_rad_m = 12 * std::numbers::pi / 180;
  double pitch_per_depth_integral_rad_m_s = 0.5 * std::numbers::pi / 180;
  double pitch_limit_rad = 25 * std::numbers::pi / 180;
  double elevator_per_pitch = 0.8;
  double elevator_per_pitch_integral_per_s = 0.3;
  double elevator_per_turn_s = 0.4;
  double elevator_limit_rad = 15 * std::numbers::pi / 180;
  double shaft_per_speed_per_m = 4;
  double shaft_per_way_per_m_s = 2;
  double shaft_limit_rps = 30;

  bool operator==(const AutopilotSettings&) const = default;
};

/// The vehicle and its autopilot as the simulator takes them, SI and radians; by default the reference vehicle.
/// config/vehicle.toml says what each number means, docs/simulator.md in which equation it stands.
struct VehicleSettings {
  WaterSettings water;
  HullSettings hull;
  FinSettings fins;
  PropellerSettings propeller;
  DampingSettings damping;
  AutopilotSettings autopilot;

  bool operator==(const VehicleSettings&) const = default;
};

}  // namespace navcal::config
