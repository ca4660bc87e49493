// SPDX-License-Identifier: Apache-2.0
#include "validation/confounded_effects.h"

#include <algorithm>

namespace navcal::validation {
namespace {

using Channels = std::vector<std::string_view>;

/// Channels that depend on the assumed direction of the body axes.
const Channels kField{"compass.field", "compass.heading"};
const Channels kHeading{"compass.heading", "compass.field", "gps.velocity", "gps.position"};
const Channels kTilt{"compass.tilt", "compass.heading", "compass.field", "imu.accel", "imu.gyro"};
const Channels kRate{"imu.gyro",      "compass.heading",  "compass.tilt",
                     "compass.field", "vehicle.yaw_rate", "vehicle.pitch_rate"};
const Channels kForce{"imu.accel", "compass.tilt", "vehicle.speed", "gps.velocity", "gps.position"};
const Channels kCard{"imu.gyro",         "imu.accel",          "imu.depth",
                     "compass.heading",  "compass.tilt",       "compass.field",
                     "vehicle.yaw_rate", "vehicle.pitch_rate", "vehicle.depth_rate"};
const Channels kDepth{"imu.depth", "vehicle.depth_rate"};
const Channels kFix{"gps.position", "gps.velocity"};
const Channels kDrift{"gps.position", "gps.velocity", "vehicle.speed"};
const Channels kThrust{"vehicle.speed", "gps.velocity",       "gps.position",       "imu.accel",
                       "imu.gyro",      "vehicle.pitch_rate", "vehicle.depth_rate", "vehicle.yaw_rate"};
const Channels kFins{"vehicle.yaw_rate",   "vehicle.pitch_rate", "imu.gyro",    "compass.heading",
                     "vehicle.depth_rate", "imu.accel",          "compass.tilt"};
const Channels kRise{"vehicle.depth_rate", "imu.depth", "vehicle.pitch_rate"};

std::vector<TrialSignature> all_signatures() {
  return {
      {"hard_iron", {"soft_iron", "compass_misalignment", "motor_field", "mag_temperature"}, kField},
      {"soft_iron", {"hard_iron", "compass_misalignment", "magnetic_hysteresis"}, kField},
      {"compass_misalignment", {"tilt_offset", "declination", "hard_iron", "soft_iron"}, kHeading},
      {"declination", {"compass_misalignment", "water_current"}, kHeading},
      {"motor_field", {"hard_iron", "adc_droop"}, kField},
      {"magnetic_hysteresis", {"hard_iron", "soft_iron"}, kField},
      {"mag_temperature", {"hard_iron", "gyro_drift"}, kField},
      {"compass_lag", {"imu_latency", "gyro_scale"}, kHeading},
      {"tilt_slosh", {}, kTilt},
      {"tilt_offset", {"accel_bias", "compass_misalignment"}, kTilt},
      {"gyro_scale", {"fin_gain", "imu_latency", "compass_lag", "gyro_nonlinearity"}, kRate},
      {"gyro_temperature", {"gyro_drift"}, kRate},
      {"gyro_drift", {"gyro_temperature"}, kRate},
      {"gyro_g_sensitivity", {"tilt_offset", "gyro_cross_axis"}, kRate},
      {"gyro_cross_axis", {"compass_misalignment", "tilt_offset", "gyro_g_sensitivity"}, kRate},
      {"gyro_nonlinearity", {"gyro_scale"}, kRate},
      {"accel_bias", {"tilt_offset", "accel_scale"}, kForce},
      {"accel_scale", {"tilt_offset", "accel_bias", "thrust_scale"}, kForce},
      {"accel_vibration", {"adc_droop"}, kForce},
      {"adc_droop", {"motor_field", "accel_vibration"}, kCard},
      {"imu_latency", {"compass_lag", "fin_lag"}, kCard},
      {"depth_scale", {"buoyancy"}, kDepth},
      {"depth_temperature", {"buoyancy", "depth_scale"}, kDepth},
      {"gps_latency", {"gps_lever_arm"}, kFix},
      {"gps_lever_arm", {"gps_latency"}, kFix},
      {"water_current", {"thrust_scale", "declination"}, kDrift},
      {"thrust_scale", {"water_current", "fin_gain", "accel_scale"}, kThrust},
      {"fin_offset", {"fin_gain", "elevator_offset"}, kFins},
      {"elevator_offset", {"fin_gain", "fin_offset"}, kFins},
      {"fin_lag", {"fin_gain", "yaw_damping", "thrust_scale", "imu_latency"}, kFins},
      {"fin_gain", {"fin_lag", "yaw_damping", "thrust_scale"}, kFins},
      {"fin_backlash", {"fin_lag"}, kFins},
      {"yaw_damping", {"fin_gain", "fin_lag", "thrust_scale"}, kFins},
      {"buoyancy", {"depth_scale", "elevator_offset"}, kRise},
      {"crossflow_depth", {}, kFins},
      {"torque_leak", {}, kTilt},
      {"tidal_current", {}, kDrift},
      {"battery_sag", {}, {"vehicle.speed", "imu.accel", "imu.gyro", "imu.depth", "gps.velocity", "gps.position"}},
      {"fin_stall", {}, kFins},
      {"fouling", {}, kThrust},
      {"surface_waves", {}, {"vehicle.yaw_rate", "imu.accel", "imu.gyro", "compass.tilt", "gps.velocity"}},
      {"heading_lag", {}, kHeading},
      {"magnetometer_saturation", {}, kField},
      {"gyro_thermal_twist", {}, kRate},
      {"gyro_popcorn", {}, kRate},
      {"depth_hysteresis", {}, kDepth},
      {"gps_multipath", {}, kFix},
  };
}

}  // namespace

std::span<const TrialSignature> trial_signatures() {
  static const std::vector<TrialSignature> all = all_signatures();
  return all;
}

const TrialSignature* signature_of(std::string_view effect) {
  const auto all = trial_signatures();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.effect == effect; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<ConfoundedEffects> confounded_pairs() {
  std::vector<ConfoundedEffects> pairs;
  for (const TrialSignature& signature : trial_signatures()) {
    for (const std::string_view twin : signature.twins) {
      const bool known = std::any_of(pairs.begin(), pairs.end(), [&](const ConfoundedEffects& pair) {
        return pair.first == twin && pair.second == signature.effect;
      });
      if (!known) pairs.push_back({signature.effect, twin});
    }
  }
  return pairs;
}

}  // namespace navcal::validation
