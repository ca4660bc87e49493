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

Value scaled(Value value, double factor) { return value ? Value(*value * factor) : std::nullopt; }
Value degrees(Value value_rad) { return scaled(value_rad, base::kDegreesPerRadian); }

template <std::size_t kAxis>
Value component(const std::optional<Vector3>& vector) {
  return vector ? Value((*vector)[kAxis]) : std::nullopt;
}

// Each maker takes a function from the kind of sample to the value.

template <class Kind, Value (*kValue)(const Kind&)>
Value value_of(const Sample& sample, const ChannelOrigin&) {
  const auto* const kind = std::get_if<Kind>(&sample.value);
  return kind != nullptr ? kValue(*kind) : std::nullopt;
}

template <Value (*kValue)(const instruments::CompassSample&)>
constexpr auto kCompass = value_of<instruments::CompassSample, kValue>;
template <Value (*kValue)(const instruments::ImuSample&)>
constexpr auto kImu = value_of<instruments::ImuSample, kValue>;
template <Value (*kValue)(const instruments::GpsSample&)>
constexpr auto kGps = value_of<instruments::GpsSample, kValue>;
template <Value (*kValue)(const instruments::MotorSample&)>
constexpr auto kMotor = value_of<instruments::MotorSample, kValue>;
template <Value (*kValue)(const instruments::AltimeterSample&)>
constexpr auto kAltimeter = value_of<instruments::AltimeterSample, kValue>;
template <Value (*kValue)(const instruments::PowerSample&)>
constexpr auto kPower = value_of<instruments::PowerSample, kValue>;
template <Value (*kValue)(const instruments::DvlSample&)>
constexpr auto kDvl = value_of<instruments::DvlSample, kValue>;
template <Value (*kValue)(const instruments::DepthSample&)>
constexpr auto kDepth = value_of<instruments::DepthSample, kValue>;

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
Value heading(const Compass& s) { return degrees(s.heading_rad); }
Value temperature(const Compass& s) { return s.temperature_C; }
Value turn_rate(const Compass& s) { return degrees(s.turn_rate_rad_s); }
template <std::size_t kAxis>
Value field(const Compass& s) {
  return component<kAxis>(s.field_body_uT);
}

template <std::size_t kAxis>
Value rate(const Imu& s) {
  return degrees(component<kAxis>(s.rate_rad_s));
}
Value yaw_rate_b(const Imu& s) { return degrees(s.yaw_rate_b_rad_s); }
template <std::size_t kAxis>
Value force(const Imu& s) {
  return component<kAxis>(s.specific_force_m_s2);
}
Value depth(const Imu& s) { return s.depth_m; }
Value imu_temperature(const Imu& s) { return s.temperature_C; }

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

Value rpm(const Motor& s) { return s.rpm; }
template <std::size_t kFin>
Value fin(const Motor& s) {
  return degrees(s.fins_rad[kFin]);
}
Value motor_current(const Motor& s) { return s.current_A; }
Value altitude(const Altimeter& s) { return s.altitude_m; }
Value voltage(const Power& s) { return s.voltage_V; }
Value current(const Power& s) { return s.current_A; }

template <std::size_t kAxis>
Value bottom_velocity(const Dvl& s) {
  return component<kAxis>(s.bottom_velocity_m_s);
}
template <std::size_t kAxis>
Value water_velocity(const Dvl& s) {
  return component<kAxis>(s.water_velocity_m_s);
}
Value dvl_altitude(const Dvl& s) { return s.altitude_m; }
Value water_temperature(const Dvl& s) { return s.temperature_C; }

Value gauge_depth(const Depth& s) { return s.depth_m; }
Value pressure(const Depth& s) { return s.pressure_Pa; }
Value gauge_temperature(const Depth& s) { return s.temperature_C; }

Value scalar(const Sample& sample, const ChannelOrigin&) {
  const auto* const reading = std::get_if<instruments::ScalarSample>(&sample.value);
  return reading != nullptr ? Value(reading->value) : std::nullopt;
}

// Limits of what passes for rest. Larger variations pass where the noise of the readings explains them.
constexpr double kHeading_deg = 0.2, kTilt_deg = 0.1, kField_uT = 0.1, kRate_deg_s = 0.05, kForce_m_s2 = 0.02;
constexpr double kDepth_m = 0.03, kVelocity_m_s = 0.3, kRpm = 1, kFin_deg = 0.3, kAltitude_m = 0.05,
                 kBottom_m_s = 0.02, kPressure_Pa = 300;

constexpr std::string_view kFieldNoise = "compass_field_noise_uT", kTiltNoise = "compass_tilt_noise_deg",
                           kGyroNoise = "imu_gyro_noise_deg_s", kForceNoise = "imu_force_noise_m_s2",
                           kPositionNoise = "gps_position_noise_m", kVelocityNoise = "gps_velocity_noise_m_s",
                           kFinNoise = "motor_fin_noise_deg";

constexpr std::array kChannels{
    NoiseChannel{"heading", "deg", kCompass<heading>, true, kHeading_deg},
    NoiseChannel{"pitch", "deg", kCompass<pitch>, false, kTilt_deg, {}, kTiltNoise, Role::heading},
    NoiseChannel{"roll", "deg", kCompass<roll>, true, kTilt_deg, {}, kTiltNoise, Role::heading},
    NoiseChannel{"field_x", "uT", kCompass<field<0>>, false, kField_uT, {}, kFieldNoise, Role::field},
    NoiseChannel{"field_y", "uT", kCompass<field<1>>, false, kField_uT, {}, kFieldNoise, Role::field},
    NoiseChannel{"field_z", "uT", kCompass<field<2>>, false, kField_uT, {}, kFieldNoise, Role::field},
    NoiseChannel{"turn_rate", "deg/s", kCompass<turn_rate>, false, kRate_deg_s},
    NoiseChannel{
        "temperature", "C", kCompass<temperature>, false, 0, {}, "compass_temperature_noise_C", Role::heading},
    NoiseChannel{"rate_x", "deg/s", kImu<rate<0>>, false, kRate_deg_s, {}, kGyroNoise, Role::rates},
    NoiseChannel{"rate_y", "deg/s", kImu<rate<1>>, false, kRate_deg_s, {}, kGyroNoise, Role::rates},
    NoiseChannel{"rate_z", "deg/s", kImu<rate<2>>, false, kRate_deg_s, {}, kGyroNoise, Role::rates},
    NoiseChannel{"yaw_rate_b", "deg/s", kImu<yaw_rate_b>, false, kRate_deg_s, {}, kGyroNoise, Role::rates},
    NoiseChannel{"force_x", "m/s2", kImu<force<0>>, false, kForce_m_s2, {}, kForceNoise, Role::acceleration},
    NoiseChannel{"force_y", "m/s2", kImu<force<1>>, false, kForce_m_s2, {}, kForceNoise, Role::acceleration},
    NoiseChannel{"force_z", "m/s2", kImu<force<2>>, false, kForce_m_s2, {}, kForceNoise, Role::acceleration},
    NoiseChannel{"depth", "m", kImu<depth>, false, kDepth_m, {}, "imu_depth_noise_m", Role::depth},
    NoiseChannel{"imu_temperature", "C", kImu<imu_temperature>},
    NoiseChannel{"north", "m", position<0>, false, 0, {}, kPositionNoise, Role::position},
    NoiseChannel{"east", "m", position<1>, false, 0, {}, kPositionNoise, Role::position},
    NoiseChannel{"height", "m", kGps<height>},
    NoiseChannel{"velocity_north", "m/s", kGps<velocity_north>, false, kVelocity_m_s, kVelocity_m_s,
                 kVelocityNoise, Role::velocity},
    NoiseChannel{"velocity_east", "m/s", kGps<velocity_east>, false, kVelocity_m_s, kVelocity_m_s, kVelocityNoise,
                 Role::velocity},
    NoiseChannel{"climb", "m/s", kGps<climb>},
    NoiseChannel{"rpm", "rpm", kMotor<rpm>, false, kRpm, kRpm},
    NoiseChannel{"fin_1", "deg", kMotor<fin<0>>, false, kFin_deg, {}, kFinNoise, Role::shaft},
    NoiseChannel{"fin_2", "deg", kMotor<fin<1>>, false, kFin_deg, {}, kFinNoise, Role::shaft},
    NoiseChannel{"fin_3", "deg", kMotor<fin<2>>, false, kFin_deg, {}, kFinNoise, Role::shaft},
    NoiseChannel{"current", "A", kMotor<motor_current>, false, 0, {}, "motor_current_noise_A", Role::shaft},
    NoiseChannel{"altitude", "m", kAltimeter<altitude>, false, kAltitude_m},
    NoiseChannel{"voltage", "V", kPower<voltage>},
    NoiseChannel{"supply_current", "A", kPower<current>},
    NoiseChannel{"bottom_velocity_1", "m/s", kDvl<bottom_velocity<0>>, false, kBottom_m_s, kVelocity_m_s},
    NoiseChannel{"bottom_velocity_2", "m/s", kDvl<bottom_velocity<1>>, false, kBottom_m_s, kVelocity_m_s},
    NoiseChannel{"bottom_velocity_3", "m/s", kDvl<bottom_velocity<2>>, false, kBottom_m_s, kVelocity_m_s},
    NoiseChannel{"water_velocity_1", "m/s", kDvl<water_velocity<0>>},
    NoiseChannel{"water_velocity_2", "m/s", kDvl<water_velocity<1>>},
    NoiseChannel{"water_velocity_3", "m/s", kDvl<water_velocity<2>>},
    NoiseChannel{"bottom_distance", "m", kDvl<dvl_altitude>, false, kAltitude_m},
    NoiseChannel{"water_temperature", "C", kDvl<water_temperature>},
    NoiseChannel{"gauge_depth", "m", kDepth<gauge_depth>, false, kDepth_m},
    NoiseChannel{"pressure", "Pa", kDepth<pressure>, false, kPressure_Pa},
    NoiseChannel{"gauge_temperature", "C", kDepth<gauge_temperature>},
};

constexpr NoiseChannel kScalar{"scalar", "", scalar};

}  // namespace

std::span<const NoiseChannel> noise_channels() { return kChannels; }

const NoiseChannel& scalar_channel() { return kScalar; }

}  // namespace navcal::analysis
