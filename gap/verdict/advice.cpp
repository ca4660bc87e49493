// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/advice.h"

#include <algorithm>
#include <array>

namespace navcal::gap {
namespace {

struct Manoeuvre {
  std::string_view effect, text;
};

constexpr std::array<Manoeuvre, 34> kManoeuvres{{
    {"accel_bias", "pitch through more than 30 degrees"},
    {"accel_scale", "pitch through more than 30 degrees"},
    {"accel_vibration", "step the shaft speed through its whole range, straight and level"},
    {"adc_droop", "step the motor current, straight and level"},
    {"buoyancy", "glide or hover with the propeller off"},
    {"compass_lag", "turn both ways at two different rates"},
    {"compass_misalignment", "steer by GPS course and pitch up and down"},
    {"declination", "run straight at the surface on three headings"},
    {"depth_scale", "hold two depths far apart"},
    {"depth_temperature", "hold one depth while the electronics warm up"},
    {"elevator_offset", "elevator doublets, level"},
    {"fin_backlash", "small fin reversals about zero"},
    {"fin_gain", "rudder doublets of two sizes at two speeds"},
    {"fin_lag", "fast rudder doublets"},
    {"fin_offset", "rudder doublets, straight"},
    {"gps_latency", "run straight at the surface at two speeds"},
    {"gps_lever_arm", "turn on the spot at the surface"},
    {"gyro_cross_axis", "turn level, then turn pitched up"},
    {"gyro_drift", "run long straight legs"},
    {"gyro_g_sensitivity", "hold a pitch without turning"},
    {"gyro_nonlinearity", "turn at two very different rates"},
    {"gyro_scale", "turn two full revolutions one way"},
    {"gyro_temperature", "run once from cold and once warmed up"},
    {"hard_iron", "turn full circles with pitch of both signs"},
    {"imu_latency", "fast rudder and elevator doublets"},
    {"mag_temperature", "let the electronics warm up with the motor off"},
    {"magnetic_hysteresis", "come to the same heading from both sides"},
    {"motor_field", "step the motor current on a constant heading"},
    {"soft_iron", "turn full circles at two pitch angles"},
    {"thrust_scale", "run reciprocal legs with speed steps at the surface"},
    {"tilt_offset", "pitch up and down by the same angle"},
    {"tilt_slosh", "turn at one rate and two speeds"},
    {"water_current", "run reciprocal legs at the surface"},
    {"yaw_damping", "rudder doublets of two sizes at two speeds"},
}};

}  // namespace

std::string_view telling_manoeuvre(std::string_view effect) {
  const auto* const found =
      std::find_if(kManoeuvres.begin(), kManoeuvres.end(), [&](const Manoeuvre& m) { return m.effect == effect; });
  return found != kManoeuvres.end() ? found->text : "a longer mission with more turns, dives and speed steps";
}

std::string tie_breaker(std::string_view one, std::string_view other) {
  const std::string_view first = telling_manoeuvre(one), second = telling_manoeuvre(other);
  if (first == second) return std::string(first);
  return std::string(first) + "; and " + std::string(second);
}

}  // namespace navcal::gap
