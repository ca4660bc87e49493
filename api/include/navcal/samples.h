// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace navcal::api {

/// Three components along the axes that the member's description names.
using Vector3 = std::array<double, 3>;

/// Times of a measurement, ns. Monotonic times order everything: in a log they are those of the daemon's clock,
/// in a capture they are UTC. UTC is a mapping of them. Source: docs/timing.md.
struct Stamp {
  std::int64_t arrival_ns = 0;       ///< monotonic: the read returned that completed the frame
  std::int64_t validity_ns = 0;      ///< monotonic: estimated time at which the quantity was measured
  std::int64_t std_ns = 0;           ///< one standard deviation of validity_ns
  std::int64_t arrival_utc_ns = 0;   ///< arrival_ns by the mapping then in force, since 1970-01-01 UTC
  std::int64_t validity_utc_ns = 0;  ///< validity_ns likewise; for GPS the second that the message states
};

/// The calibration in force when a sample was made.
struct CalibrationName {
  std::uint32_t number = 0;  ///< counts the changes; 0: no calibration was in force
  std::uint32_t sum = 0;     ///< checksum of its content
};

// A member that a device does not measure is absent. Members `..._std_...` are one standard deviation of one
// reading: as the device states it, else by the configuration's table [instruments]. Body axes are x forward,
// y starboard, z down. The names agree with the lines of `navcal replay`.

/// Attitude and magnetic field.
struct CompassSample {
  std::optional<double> heading_rad;             ///< 0 to 2 pi, clockwise from magnetic north, as the device says
  bool heading_is_true = false;                  ///< the device states true north instead
  std::optional<double> heading_calibrated_rad;  ///< magnetic, by the calibration in force; 0 to 2 pi
  std::optional<double> pitch_rad;               ///< positive nose-up
  std::optional<double> roll_rad;                ///< positive starboard-down
  bool tilt_by_accelerometers = false;           ///< pitch and roll are not the compass's own
  std::optional<Vector3> field_body_uT;          ///< body axes
  std::optional<double> dip_rad;                 ///< as the device sends it
  std::optional<double> turn_rate_rad_s;         ///< as the device sends it, positive to starboard
  std::optional<double> temperature_C;           ///< of the device
  std::optional<std::uint32_t> error;            ///< error code of a TCM2; absent when none stands
  std::optional<double> heading_std_rad;         ///< of heading_rad
  std::optional<double> tilt_std_rad;            ///< of roll and pitch, each
  std::optional<double> field_std_uT;            ///< of each axis
};

/// State of the inertial card.
struct CardState {
  std::uint8_t sequence = 0;  ///< counts the frames modulo 256
  bool leak_forward = false;  ///< water in the forward hull
  bool leak_aft = false;      ///< water in the aft hull
  bool low_supply = false;    ///< the supply is below its limit
};

/// Rates and specific force.
struct ImuSample {
  std::optional<Vector3> rate_rad_s;                  ///< about the body axes: roll, pitch, yaw
  std::optional<double> yaw_rate_b_rad_s;             ///< of a second, redundant gyro
  std::optional<double> yaw_rate_calibrated_rad_s;    ///< rate_rad_s[2] by the calibration in force
  std::optional<double> yaw_rate_b_calibrated_rad_s;  ///< yaw_rate_b_rad_s likewise
  std::optional<Vector3> specific_force_m_s2;         ///< body axes; -9.81 in z when level and still
  std::optional<double> depth_m;                      ///< below the surface
  std::optional<double> temperature_C;                ///< of the device
  bool over_range = false;                            ///< the device says that a value is beyond its range
  std::optional<CardState> card;                      ///< of the inertial card only
  std::optional<double> rate_std_rad_s;               ///< of each axis
  std::optional<double> specific_force_std_m_s2;      ///< of each axis
  std::optional<double> depth_std_m;                  ///< of depth_m
};

/// Kind of a position fix.
enum class Fix : std::uint8_t {
  none,          ///< no fix
  fix_2d,        ///< height held
  fix_3d,        ///< three-dimensional
  propagated,    ///< carried on without satellites
  hold,          ///< a known place is held to find the time; speed, course and DOP mean nothing
  acquiring,     ///< looking for satellites
  bad_geometry,  ///< the satellites' geometry is too poor for a position
};

/// Position fix, WGS84.
struct GpsSample {
  std::optional<std::int64_t> time_utc_ns;  ///< the second that the message states, since 1970-01-01 UTC
  bool time_corrected = false;              ///< a week rollover was undone
  bool leap_known = true;                   ///< false: the receiver lacks the leap seconds
  Fix fix = Fix::none;                      ///< kind of the fix
  std::optional<double> latitude_rad;       ///< geodetic, positive north
  std::optional<double> longitude_rad;      ///< positive east
  std::optional<double> height_m;           ///< above the ellipsoid
  std::optional<double> height_msl_m;       ///< above mean sea level
  std::optional<double> speed_m_s;          ///< over ground
  std::optional<double> course_rad;         ///< over ground, clockwise from true north
  std::optional<double> climb_m_s;          ///< positive up
  std::optional<double> dop;                ///< PDOP of a 3D fix, HDOP of a 2D fix
  std::optional<std::uint8_t> visible;      ///< satellites in view
  std::optional<std::uint8_t> tracked;      ///< satellites tracked
  std::optional<double> position_std_m;     ///< of north and east, each
  std::optional<double> height_std_m;       ///< of the heights
  std::optional<double> velocity_std_m_s;   ///< of north and east, each
};

/// Shaft and fins.
struct MotorSample {
  std::optional<double> rpm_commanded;            ///< shaft speed ordered, revolutions a minute
  std::optional<double> rpm;                      ///< shaft speed measured, revolutions a minute
  std::array<std::optional<double>, 3> fins_rad;  ///< deflections of fins 1 to 3
  std::optional<double> current_A;                ///< of the motor
  std::optional<std::uint8_t> sequence;           ///< counts the frames modulo 256
  std::optional<double> fins_std_rad;             ///< of each fin
  std::optional<double> current_std_A;            ///< of current_A
};

/// Echo sounder.
struct AltimeterSample {
  double altitude_m = 0;                 ///< from the transducer down to the bottom
  std::optional<double> altitude_std_m;  ///< of altitude_m
};

/// Gauge of a battery. At least one member is present.
struct PowerSample {
  std::optional<double> voltage_V;  ///< across the pack's terminals, under load
  std::optional<double> current_A;  ///< out of the pack; negative while it is charged
};

/// Axes of a velocity.
enum class VelocityFrame : std::uint8_t {
  body,   ///< forward, starboard, down
  earth,  ///< north, east, down; north as the device knows it
};

/// Doppler log.
struct DvlSample {
  VelocityFrame frame = VelocityFrame::body;      ///< axes of both velocities
  std::optional<Vector3> bottom_velocity_m_s;     ///< of the device over the bottom; absent without bottom lock
  std::optional<double> bottom_velocity_std_m_s;  ///< of each axis
  std::optional<Vector3> water_velocity_m_s;      ///< of the device through the water
  std::optional<double> water_velocity_std_m_s;   ///< of each axis
  std::optional<double> altitude_m;               ///< vertical, from the transducer to the bottom
  std::optional<double> altitude_std_m;           ///< of altitude_m
  std::optional<double> temperature_C;            ///< of the water
  std::optional<double> sound_speed_m_s;          ///< that the device reckons with
};

/// Pressure gauge.
struct DepthSample {
  std::optional<double> depth_m;          ///< as the device states it
  std::optional<double> depth_std_m;      ///< of depth_m
  std::optional<double> pressure_Pa;      ///< absolute
  std::optional<double> pressure_std_Pa;  ///< of pressure_Pa
  std::optional<double> temperature_C;    ///< of the water
};

/// A mission sensor.
struct ScalarSample {
  std::string quantity;             ///< as the sender names it: "oxygen"
  std::string unit;                 ///< of value and value_std, as the sender writes it: "umol/l"
  double value = 0;                 ///< in `unit`
  std::optional<double> value_std;  ///< in `unit`
};

/// Estimate of position, velocity and attitude by the pipeline's navigator. Source: docs/navigation.md.
struct NavigationSample {
  std::optional<double> latitude_rad;     ///< WGS84; absent before the first fix
  std::optional<double> longitude_rad;    ///< WGS84; absent before the first fix
  std::optional<double> north_std_m;      ///< of the position
  std::optional<double> east_std_m;       ///< of the position
  std::optional<double> since_fix_s;      ///< time since the last fix
  std::optional<double> since_fix_m;      ///< distance since the last fix
  std::optional<double> depth_m;          ///< below the surface
  std::optional<double> depth_std_m;      ///< of depth_m, by what the gauge states
  std::optional<double> heading_rad;      ///< 0 to 2 pi, clockwise from true north
  std::optional<double> heading_std_rad;  ///< of heading_rad
  std::optional<double> pitch_rad;        ///< positive nose-up
  std::optional<double> roll_rad;         ///< positive starboard-down
  std::optional<double> speed_m_s;        ///< through the water, ahead
  std::optional<Vector3> velocity_m_s;    ///< over ground: north, east, down
  std::optional<double> set_north_m_s;    ///< of the ground's velocity over the reckoned one
  std::optional<double> set_east_m_s;     ///< likewise
  std::optional<double> altitude_m;       ///< of the altimeter above the sea floor
  std::optional<double> altitude_std_m;   ///< of altitude_m
  std::optional<double> water_depth_m;    ///< from surface to floor
};

/// Estimate of the battery's charge. Source: docs/battery.md.
struct BatterySample {
  std::optional<double> voltage_V;      ///< newest of the gauge
  std::optional<double> current_A;      ///< out of the pack
  bool current_measured = false;        ///< false: the motor's current, with the configured hotel load
  std::optional<double> charge_Ah;      ///< charge left
  std::optional<double> charge_std_Ah;  ///< of charge_Ah
  std::optional<double> time_left_s;    ///< at the mean load
  std::optional<double> range_left_m;   ///< at the mean speed and load
  bool low = false;                     ///< the alarm for a low battery stands
};

/// What was measured or estimated.
using Measurement = std::variant<CompassSample, ImuSample, GpsSample, MotorSample, AltimeterSample, PowerSample,
                                 DvlSample, DepthSample, ScalarSample, NavigationSample, BatterySample>;

/// One stamped sample.
struct Sample {
  static constexpr std::size_t kNoPort = ~std::size_t{0};  ///< `port` of an estimate that no single port makes

  std::size_t port = kNoPort;   ///< index into the ports of the recording or pipeline
  Stamp stamp;                  ///< when
  CalibrationName calibration;  ///< in force then
  Measurement value;            ///< what
};

/// A serial port and its device.
struct Port {
  std::string name;    ///< as the configuration names it: "compass"
  std::string device;  ///< kind of device: "tcm2"
  int baud = 0;        ///< line speed, bit/s
};

}  // namespace navcal::api
