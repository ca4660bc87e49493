// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise/channels.h"

#include <array>
#include <cmath>

#include "base/angles.h"
#include "base/local_plane.h"

namespace navcal::analysis {
namespace {

using config::Role;
using instruments::Sample;
using instruments::Vector3;
using Value = std::optional<double>;

Value degrees(Value value_rad) { return value_rad ? Value(*value_rad * base::kDegreesPerRadian) : std::nullopt; }

Value component(const std::optional<Vector3>& vector, std::size_t i) {
  return vector ? Value((*vector)[i]) : std::nullopt;
}
Value component(const std::array<Value, 3>& values, std::size_t i) { return values[i]; }
Value component(Value value, std::size_t /*i*/) { return value; }

template <class Kind, Value (*kValue)(const Kind&)>
Value value_of(const Sample& sample, const ChannelOrigin&) {
  const auto* const kind = std::get_if<Kind>(&sample.value);
  return kind != nullptr ? kValue(*kind) : std::nullopt;
}

template <class Kind, class Member>
Kind kind_of(Member Kind::*);

/// A member of the samples of a kind, or a component of it.
template <auto kMember, std::size_t kAxis = 0>
Value reading(const Sample& sample, const ChannelOrigin&) {
  const auto* const kind = std::get_if<decltype(kind_of(kMember))>(&sample.value);
  return kind != nullptr ? component(kind->*kMember, kAxis) : std::nullopt;
}
/// The same of angles.
template <auto kMember, std::size_t kAxis = 0>
Value degrees_of(const Sample& sample, const ChannelOrigin& origin) {
  return degrees(reading<kMember, kAxis>(sample, origin));
}

using Compass = instruments::CompassSample;
using Imu = instruments::ImuSample;
using Gps = instruments::GpsSample;
using Motor = instruments::MotorSample;
using Altimeter = instruments::AltimeterSample;
using Power = instruments::PowerSample;
using Dvl = instruments::DvlSample;
using Depth = instruments::DepthSample;

/// Tilt by another instrument's accelerometers is not the compass's.
Value pitch(const Compass& s) { return s.tilt_by_accelerometers ? std::nullopt : degrees(s.pitch_rad); }
Value roll(const Compass& s) { return s.tilt_by_accelerometers ? std::nullopt : degrees(s.roll_rad); }

bool is_position(const Gps& s) { return s.fix == instruments::Fix::fix_2d || s.fix == instruments::Fix::fix_3d; }

/// North or east of the origin.
template <std::size_t kAxis>
Value position(const Sample& sample, const ChannelOrigin& origin) {
  const auto* const gps = std::get_if<Gps>(&sample.value);
  if (gps == nullptr || !is_position(*gps) || !gps->latitude_rad || !gps->longitude_rad) return std::nullopt;
  const base::LocalPlane plane(origin.latitude_rad, origin.longitude_rad);
  return plane.position_m(*gps->latitude_rad, *gps->longitude_rad)[kAxis];
}
Value height(const Gps& s) {
  if (s.fix != instruments::Fix::fix_3d) return std::nullopt;
  return s.height_m ? s.height_m : s.height_msl_m;
}
Value velocity_north(const Gps& s) {
  if (!is_position(s) || !s.speed_m_s || !s.course_rad) return std::nullopt;
  return *s.speed_m_s * std::cos(*s.course_rad);
}
Value velocity_east(const Gps& s) {
  if (!is_position(s) || !s.speed_m_s || !s.course_rad) return std::nullopt;
  return *s.speed_m_s * std::sin(*s.course_rad);
}
Value climb(const Gps& s) { return is_position(s) ? s.climb_m_s : std::nullopt; }

// Limits of what passes for rest. Larger variations pass where the noise of the readings explains them.
constexpr double kHeading_deg = 0.2, kTilt_deg = 0.1, kField_uT = 0.1, kRate_deg_s = 0.05, kForce_m_s2 = 0.02;
constexpr double kDepth_m = 0.03, kVelocity_m_s = 0.3, kRpm = 1, kFin_deg = 0.3, kAltitude_m = 0.05,
                 kBottom_m_s = 0.02, kPressure_Pa = 300;

constexpr std::string_view kFieldNoise = "compass_field_noise_uT", kTiltNoise = "compass_tilt_noise_deg",
                           kGyroNoise = "imu_gyro_noise_deg_s", kForceNoise = "imu_force_noise_m_s2",
                           kPositionNoise = "gps_position_noise_m", kVelocityNoise = "gps_velocity_noise_m_s",
                           kFinNoise = "motor_fin_noise_deg", kTemperatureNoise = "compass_temperature_noise_C";

constexpr auto kForce = &Imu::specific_force_m_s2;

constexpr auto kChannels = std::to_array<NoiseChannel>({
    {"heading", "deg", degrees_of<&Compass::heading_rad>, true, kHeading_deg},
    {"pitch", "deg", value_of<Compass, pitch>, false, kTilt_deg, {}, kTiltNoise, Role::heading},
    {"roll", "deg", value_of<Compass, roll>, true, kTilt_deg, {}, kTiltNoise, Role::heading},
    {"field_x", "uT", reading<&Compass::field_body_uT, 0>, false, kField_uT, {}, kFieldNoise, Role::field},
    {"field_y", "uT", reading<&Compass::field_body_uT, 1>, false, kField_uT, {}, kFieldNoise, Role::field},
    {"field_z", "uT", reading<&Compass::field_body_uT, 2>, false, kField_uT, {}, kFieldNoise, Role::field},
    {"turn_rate", "deg/s", degrees_of<&Compass::turn_rate_rad_s>, false, kRate_deg_s},
    {"temperature", "C", reading<&Compass::temperature_C>, false, 0, {}, kTemperatureNoise, Role::heading},
    {"rate_x", "deg/s", degrees_of<&Imu::rate_rad_s, 0>, false, kRate_deg_s, {}, kGyroNoise, Role::rates},
    {"rate_y", "deg/s", degrees_of<&Imu::rate_rad_s, 1>, false, kRate_deg_s, {}, kGyroNoise, Role::rates},
    {"rate_z", "deg/s", degrees_of<&Imu::rate_rad_s, 2>, false, kRate_deg_s, {}, kGyroNoise, Role::rates},
    {"yaw_rate_b", "deg/s", degrees_of<&Imu::yaw_rate_b_rad_s>, false, kRate_deg_s, {}, kGyroNoise, Role::rates},
    {"force_x", "m/s2", reading<kForce, 0>, false, kForce_m_s2, {}, kForceNoise, Role::acceleration},
    {"force_y", "m/s2", reading<kForce, 1>, false, kForce_m_s2, {}, kForceNoise, Role::acceleration},
    {"force_z", "m/s2", reading<kForce, 2>, false, kForce_m_s2, {}, kForceNoise, Role::acceleration},
    {"depth", "m", reading<&Imu::depth_m>, false, kDepth_m, {}, "imu_depth_noise_m", Role::depth},
    {"imu_temperature", "C", reading<&Imu::temperature_C>},
    {"north", "m", position<0>, false, 0, {}, kPositionNoise, Role::position},
    {"east", "m", position<1>, false, 0, {}, kPositionNoise, Role::position},
    {"height", "m", value_of<Gps, height>},
    {"velocity_north", "m/s", value_of<Gps, velocity_north>, false, kVelocity_m_s, kVelocity_m_s, kVelocityNoise,
     Role::velocity},
    {"velocity_east", "m/s", value_of<Gps, velocity_east>, false, kVelocity_m_s, kVelocity_m_s, kVelocityNoise,
     Role::velocity},
    {"climb", "m/s", value_of<Gps, climb>},
    {"rpm", "rpm", reading<&Motor::rpm>, false, kRpm, kRpm},
    {"fin_1", "deg", degrees_of<&Motor::fins_rad, 0>, false, kFin_deg, {}, kFinNoise, Role::shaft},
    {"fin_2", "deg", degrees_of<&Motor::fins_rad, 1>, false, kFin_deg, {}, kFinNoise, Role::shaft},
    {"fin_3", "deg", degrees_of<&Motor::fins_rad, 2>, false, kFin_deg, {}, kFinNoise, Role::shaft},
    {"current", "A", reading<&Motor::current_A>, false, 0, {}, "motor_current_noise_A", Role::shaft},
    {"altitude", "m", reading<&Altimeter::altitude_m>, false, kAltitude_m},
    {"voltage", "V", reading<&Power::voltage_V>},
    {"supply_current", "A", reading<&Power::current_A>},
    {"bottom_velocity_1", "m/s", reading<&Dvl::bottom_velocity_m_s, 0>, false, kBottom_m_s, kVelocity_m_s},
    {"bottom_velocity_2", "m/s", reading<&Dvl::bottom_velocity_m_s, 1>, false, kBottom_m_s, kVelocity_m_s},
    {"bottom_velocity_3", "m/s", reading<&Dvl::bottom_velocity_m_s, 2>, false, kBottom_m_s, kVelocity_m_s},
    {"water_velocity_1", "m/s", reading<&Dvl::water_velocity_m_s, 0>},
    {"water_velocity_2", "m/s", reading<&Dvl::water_velocity_m_s, 1>},
    {"water_velocity_3", "m/s", reading<&Dvl::water_velocity_m_s, 2>},
    {"bottom_distance", "m", reading<&Dvl::altitude_m>, false, kAltitude_m},
    {"water_temperature", "C", reading<&Dvl::temperature_C>},
    {"gauge_depth", "m", reading<&Depth::depth_m>, false, kDepth_m},
    {"pressure", "Pa", reading<&Depth::pressure_Pa>, false, kPressure_Pa},
    {"gauge_temperature", "C", reading<&Depth::temperature_C>},
});

constexpr NoiseChannel kScalar{"scalar", "", reading<&instruments::ScalarSample::value>};

}  // namespace

std::span<const NoiseChannel> noise_channels() { return kChannels; }

const NoiseChannel& scalar_channel() { return kScalar; }

}  // namespace navcal::analysis
