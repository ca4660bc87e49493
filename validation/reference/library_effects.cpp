// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/effects.h"
#include "validation/reference/instrument.h"

namespace navcal::reference {
namespace {

constexpr double kPer_deg = 1 / kDegree;
constexpr double kPer_g = 1 / kGravity_m_s2;

std::vector<EffectKind> compass_effects() {
  using D = ParameterDeviations;
  return {
      effect_kind("hard_iron", Trace::field, {"x_uT", "y_uT", "z_uT"}, {.typical = 2, .group = 3},
                  [](D& d) { return d.compass.hard_iron_uT.data(); }),
      effect_kind("soft_iron", Trace::field, {"xx", "yy", "zz", "xy", "xz", "yz"},
                  {.typical = 0.05, .group = 6, .symmetric = true},
                  [](D& d) { return d.compass.soft_iron.data(); }),
      effect_kind("compass_misalignment", Trace::heading, {"x_deg", "y_deg", "z_deg"},
                  {.typical = 3, .group = 3, .si = kDegree},
                  [](D& d) { return d.compass.misalignment_rad.data(); }),
      effect_kind("declination", Trace::heading, {"angle_deg"}, {.typical = 4, .si = kDegree},
                  [](D& d) { return &d.compass.declination_rad; }),
      effect_kind("motor_field", Trace::field, {"x_uT_per_A", "y_uT_per_A", "z_uT_per_A"},
                  {.typical = 1, .group = 3}, [](D& d) { return d.compass.motor_field_uT_per_A.data(); }),
      effect_kind("magnetic_hysteresis", Trace::field, {"gain"}, {.typical = 0.06, .sign = Sign::positive},
                  [](D& d) { return &d.compass.hysteresis; }),
      effect_kind("mag_temperature", Trace::field, {"x_uT_per_C", "y_uT_per_C", "z_uT_per_C"},
                  {.typical = 0.15, .group = 3}, [](D& d) { return d.compass.temperature_uT_per_K.data(); }),
      effect_kind("compass_lag", Trace::heading, {"tau_s"}, {.typical = 0.2, .sign = Sign::not_negative},
                  [](D& d) { return &d.compass.lag_s; }),
      effect_kind("tilt_slosh", Trace::tilt, {"gain"}, {.typical = 0.3, .sign = Sign::positive},
                  [](D& d) { return &d.compass.slosh; }),
      effect_kind("tilt_offset", Trace::tilt, {"roll_deg", "pitch_deg"}, {.typical = 1, .si = kDegree},
                  [](D& d) { return d.compass.tilt_offset_rad.data(); }),
  };
}

std::vector<EffectKind> gyro_effects() {
  using D = ParameterDeviations;
  return {
      effect_kind("gyro_scale", Trace::rates, {"scale_ax", "scale_az", "scale_by", "scale_bz"}, {.typical = 0.03},
                  [](D& d) { return d.card.gyro_scale.data(); }),
      effect_kind("gyro_temperature", Trace::rates,
                  {"deg_per_s_per_C_ax", "deg_per_s_per_C_az", "deg_per_s_per_C_by", "deg_per_s_per_C_bz"},
                  {.typical = 0.06, .si = kDegree},
                  [](D& d) { return d.card.gyro_temperature_rad_s_per_K.data(); }),
      effect_kind("gyro_drift", Trace::rates, {"deg_per_s2_ax", "deg_per_s2_az", "deg_per_s2_by", "deg_per_s2_bz"},
                  {.typical = 0.001, .si = kDegree}, [](D& d) { return d.card.gyro_drift_rad_s2.data(); }),
      effect_kind("gyro_g_sensitivity", Trace::rates,
                  {"ax_x_deg_per_s_per_g", "ax_y_deg_per_s_per_g", "ax_z_deg_per_s_per_g", "az_x_deg_per_s_per_g",
                   "az_y_deg_per_s_per_g", "az_z_deg_per_s_per_g", "by_x_deg_per_s_per_g", "by_y_deg_per_s_per_g",
                   "by_z_deg_per_s_per_g", "bz_x_deg_per_s_per_g", "bz_y_deg_per_s_per_g", "bz_z_deg_per_s_per_g"},
                  {.typical = 0.6, .group = 3, .si = kDegree * kPer_g},
                  [](D& d) { return d.card.gyro_force_rad_s_per_m_s2.data(); }),
      effect_kind(
          "gyro_cross_axis", Trace::rates,
          {"ax_from_y", "ax_from_z", "az_from_x", "az_from_y", "by_from_x", "by_from_z", "bz_from_x", "bz_from_y"},
          {.typical = 0.03}, [](D& d) { return d.card.gyro_cross.data(); }),
      effect_kind(
          "gyro_nonlinearity", Trace::rates, {"s_per_deg_ax", "s_per_deg_az", "s_per_deg_by", "s_per_deg_bz"},
          {.typical = 0.0008, .si = kPer_deg}, [](D& d) { return d.card.gyro_nonlinearity_s_per_rad.data(); }),
  };
}

std::vector<EffectKind> card_effects() {
  using D = ParameterDeviations;
  return {
      effect_kind("accel_bias", Trace::force, {"x_m_s2", "y_m_s2", "z_m_s2"}, {.typical = 0.12, .group = 3},
                  [](D& d) { return d.card.force_bias_m_s2.data(); }),
      effect_kind("accel_scale", Trace::force, {"x", "y", "z"}, {.typical = 0.02},
                  [](D& d) { return d.card.force_scale.data(); }),
      effect_kind("accel_vibration", Trace::force, {"x_m_s2_per_A2", "y_m_s2_per_A2", "z_m_s2_per_A2"},
                  {.typical = 0.05, .group = 3}, [](D& d) { return d.card.vibration_m_s2_per_A2.data(); }),
      effect_kind("adc_droop", Trace::card, {"per_A"}, {.typical = 0.0015},
                  [](D& d) { return &d.card.droop_per_A; }),
      effect_kind("imu_latency", Trace::card, {"tau_s"}, {.typical = 0.05, .sign = Sign::not_negative},
                  [](D& d) { return &d.card.latency_s; }),
      effect_kind("depth_scale", Trace::depth, {"scale"}, {.typical = 0.06},
                  [](D& d) { return &d.card.depth_scale; }),
      effect_kind("depth_temperature", Trace::depth, {"m_per_C"}, {.typical = 0.025},
                  [](D& d) { return &d.card.depth_temperature_m_per_K; }),
      effect_kind("gps_latency", Trace::fixes, {"tau_s"}, {.typical = 1, .sign = Sign::not_negative},
                  [](D& d) { return &d.gps.latency_s; }),
      effect_kind("gps_lever_arm", Trace::fixes, {"x_m", "y_m"}, {.typical = 0.45, .group = 2},
                  [](D& d) { return d.gps.lever_arm_m.data(); }),
  };
}

std::vector<EffectKind> vehicle_effects() {
  using D = ParameterDeviations;
  return {
      effect_kind("water_current", Trace::drift, {"north_m_s", "east_m_s"}, {.typical = 0.06, .group = 2},
                  [](D& d) { return d.vehicle.current_m_s.data(); }),
      effect_kind("thrust_scale", Trace::thrust, {"scale"}, {.typical = 0.08},
                  [](D& d) { return &d.vehicle.thrust; }),
      effect_kind("fin_offset", Trace::fins, {"angle_deg"}, {.typical = 1, .si = kDegree},
                  [](D& d) { return &d.vehicle.rudder_rad; }),
      effect_kind("elevator_offset", Trace::fins, {"angle_deg"}, {.typical = 1, .si = kDegree},
                  [](D& d) { return &d.vehicle.elevator_rad; }),
      effect_kind("fin_lag", Trace::fins, {"tau_s"}, {.typical = 0.2, .sign = Sign::not_negative},
                  [](D& d) { return &d.vehicle.fin_lag_s; }),
      effect_kind("fin_gain", Trace::fins, {"scale"}, {.typical = 0.08}, [](D& d) { return &d.vehicle.fin_gain; }),
      effect_kind("fin_backlash", Trace::fins, {"width_deg"},
                  {.typical = 2, .si = kDegree, .sign = Sign::not_negative},
                  [](D& d) { return &d.vehicle.fin_backlash_rad; }),
      effect_kind("yaw_damping", Trace::fins, {"per_s"}, {.typical = 0.3, .sign = Sign::positive},
                  [](D& d) { return &d.vehicle.yaw_damping_per_s; }),
      effect_kind("buoyancy", Trace::rise, {"force_N"}, {.typical = 0.4}, [](D& d) { return &d.vehicle.lift_N; }),
  };
}

}  // namespace

std::span<const EffectKind> library_effects() {
  static const std::vector<EffectKind> all = [] {
    std::vector<EffectKind> kinds = compass_effects();
    for (const auto& more : {gyro_effects(), card_effects(), vehicle_effects()})
      kinds.insert(kinds.end(), more.begin(), more.end());
    return kinds;
  }();
  return all;
}

}  // namespace navcal::reference
