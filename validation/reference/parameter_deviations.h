// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>

namespace navcal::reference {

using Vector3 = Eigen::Vector3d;

// How this reality departs from the nominal one, each instrument and the vehicle for itself. Everything zero is
// the nominal. SI units, radians, body axes x forward, y starboard, z down; docs/trial.md gives the equation of
// each.

/// Gyro channels in the order in which the card names them: A-x, A-z, B-y, B-z.
inline constexpr std::array<int, 4> kGyroAxes{0, 2, 1, 2};
using PerGyro = Eigen::Array4d;

struct VehicleDeviations {
  double thrust = 0;  ///< relative
  double rudder_rad = 0, elevator_rad = 0;
  double fin_gain = 0;  ///< relative
  double fin_lag_s = 0;
  double fin_play_rad = 0;  ///< total width
  double yaw_damping_per_s = 0;
  double lift_N = 0;                                      ///< upwards, at the origin
  Eigen::Vector2d current_m_s = Eigen::Vector2d::Zero();  ///< north, east

  // Deviations outside the library.
  double crossflow_per_m2 = 0;  ///< relative change of the cross-flow drag, times the square of the depth
  double torque_leak = 0;       ///< further share of the propeller's torque that reaches the hull
  Eigen::Vector2d tide_m_s = Eigen::Vector2d::Zero();  ///< at the beginning: it turns with the tide
  double sag_per_C = 0;      ///< relative loss of the supply by charge taken from the battery, per coulomb
  double stall_loss = 0;     ///< of the angle of attack beyond where the flow parts
  double fouling_per_s = 0;  ///< relative growth of the axial drag
  double wave_N = 0;         ///< sway force of waves at the surface
};

struct CompassDeviations {
  Vector3 hard_iron_uT = Vector3::Zero();
  std::array<double, 6> soft_iron{};  ///< xx, yy, zz, xy, xz, yz
  Vector3 misalignment_rad = Vector3::Zero();
  double declination_rad = 0;  ///< beyond the nominal field's own
  Vector3 motor_field_uT_per_A = Vector3::Zero();
  double hysteresis = 0;
  Vector3 temperature_uT_per_K = Vector3::Zero();
  double lag_s = 0;
  double slosh = 0;
  std::array<double, 2> tilt_offset_rad{};  ///< roll, pitch

  // Deviations outside the library.
  Eigen::Vector2d lag_by_heading_s = Eigen::Vector2d::Zero();  ///< when heading north, east
  double saturation_per_uT2 = 0;
};

struct CardDeviations {
  PerGyro gyro_scale = PerGyro::Zero();
  PerGyro gyro_temperature_rad_s_per_K = PerGyro::Zero();
  PerGyro gyro_drift_rad_s2 = PerGyro::Zero();
  PerGyro gyro_nonlinearity_s_per_rad = PerGyro::Zero();
  Eigen::Matrix<double, 4, 3, Eigen::RowMajor> gyro_force_rad_s_per_m_s2 =
      Eigen::Matrix<double, 4, 3, Eigen::RowMajor>::Zero();
  Eigen::Matrix<double, 4, 2, Eigen::RowMajor> gyro_cross =
      Eigen::Matrix<double, 4, 2, Eigen::RowMajor>::Zero();  ///< from the two other axes, in the order x, y, z
  Vector3 force_bias_m_s2 = Vector3::Zero();
  Vector3 force_scale = Vector3::Zero();
  Vector3 vibration_m_s2_per_A2 = Vector3::Zero();
  double droop_per_A = 0;
  double latency_s = 0;
  double depth_scale = 0;
  double depth_temperature_m_per_K = 0;

  // Deviations outside the library.
  Vector3 gyro_twist_rad_per_K2 = Vector3::Zero();
  double depth_play_m = 0;
  double gyro_jump_rad_s = 0;
};

struct GpsDeviations {
  double latency_s = 0;
  Eigen::Vector2d lever_arm_m = Eigen::Vector2d::Zero();  ///< forward, starboard

  // Deviations outside the library.
  Eigen::Vector2d multipath_m = Eigen::Vector2d::Zero();  ///< north, east, when heading north
};

struct ParameterDeviations {
  VehicleDeviations vehicle;
  CompassDeviations compass;
  CardDeviations card;
  GpsDeviations gps;
};

}  // namespace navcal::reference
