// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>

#include "protocols/gps_fix.h"

namespace navcal::instruments {

using Vector3 = std::array<double, 3>;

/// Times of a measurement. Monotonic times order everything; UTC is a mapping of them (docs/timing.md).
struct Stamp {
  std::int64_t arrival_ns = 0;       ///< monotonic: when the read returned that completed the frame
  std::int64_t validity_ns = 0;      ///< monotonic: estimated time at which the quantity was measured
  std::int64_t std_ns = 0;           ///< one standard deviation of validity_ns
  std::int64_t arrival_utc_ns = 0;   ///< arrival_ns through the UTC mapping then in force
  std::int64_t validity_utc_ns = 0;  ///< validity_ns likewise; for GPS the second that the message states
};

/// The calibration in force when a sample was made; number 0: none.
struct CalibrationName {
  std::uint32_t number = 0;
  std::uint32_t sum = 0;  ///< checksum of its content
};

/// Magnetic compass. Body axes x forward, y starboard, z down; angles as the device sends them, magnetic.
struct CompassSample {
  std::optional<double> heading_rad;             ///< 0..2 pi clockwise from magnetic north
  bool heading_is_true = false;                  ///< the device states true north (HDT, THS)
  std::optional<double> heading_calibrated_rad;  ///< magnetic, by the calibration in force; 0..2 pi
  std::optional<double> pitch_rad;               ///< positive nose-up
  std::optional<double> roll_rad;                ///< positive starboard-down
  bool tilt_by_accelerometers = false;           ///< pitch and roll are not the compass's own
  std::optional<Vector3> field_body_uT;
  std::optional<double> dip_rad;          ///< as the device sends it, where it does
  std::optional<double> turn_rate_rad_s;  ///< as the device sends it (ROT), positive to starboard
  std::optional<double> temperature_C;
  std::optional<std::uint32_t> error;  ///< TCM2's raw error code (CompassError); absent when none stands
};

/// Inertial card (ICD section 3), body axes.
struct ImuSample {
  Vector3 rate_rad_s{};                               ///< gyro A-x (roll), B-y (pitch), A-z (yaw)
  double yaw_rate_b_rad_s = 0;                        ///< gyro B-z, redundant
  std::optional<double> yaw_rate_calibrated_rad_s;    ///< A-z by the calibration in force
  std::optional<double> yaw_rate_b_calibrated_rad_s;  ///< B-z likewise
  Vector3 specific_force_m_s2{};                      ///< -9.81 in z when level and still
  double depth_m = 0;
  std::uint8_t sequence = 0;
  bool leak_forward = false;
  bool leak_aft = false;
  bool over_range = false;
  bool low_supply = false;
};

using Fix = protocols::Fix;

/// Position fix, WGS84. Angles in radians inside; degrees where people look.
struct GpsSample {
  std::optional<std::int64_t> time_utc_ns;  ///< the second that the message states
  bool time_corrected = false;              ///< a week rollover was undone
  bool leap_known = true;                   ///< false: the receiver does not have the leap seconds yet
  Fix fix = Fix::none;
  std::optional<double> latitude_rad, longitude_rad;
  std::optional<double> height_m;      ///< above the ellipsoid
  std::optional<double> height_msl_m;  ///< above mean sea level
  std::optional<double> speed_m_s;     ///< over ground
  std::optional<double> course_rad;    ///< over ground, clockwise from true north
  std::optional<double> climb_m_s;
  std::optional<double> dop;  ///< PDOP when 3D, HDOP when 2D
  std::optional<std::uint8_t> visible, tracked;
};

/// Satellites in view.
struct SkySample {
  struct Satellite {
    std::uint16_t prn = 0;
    std::optional<float> elevation_deg, azimuth_deg, cn0_dBHz;
    bool used = false;
  };
  static constexpr std::size_t kMaxSatellites = 64;
  std::array<Satellite, kMaxSatellites> satellites{};
  std::size_t count = 0;
};

struct MotorSample {
  std::optional<double> rpm_commanded;
  std::optional<double> rpm;
  std::array<std::optional<double>, 3> fins_rad;
  std::optional<double> current_A;
  std::optional<std::uint8_t> sequence;
};

/// Echo sounder (DBT, DPT): distance from the transducer down to the bottom.
struct AltimeterSample {
  double altitude_m = 0;
};

/// Gauge of a battery (XDR). At least one member is present.
struct PowerSample {
  std::optional<double> voltage_V;  ///< across the pack's terminals, under load
  std::optional<double> current_A;  ///< whole current out of the pack; negative while it is charged
};

struct Sample {
  std::uint16_t port = 0;  ///< index into the configuration's ports
  Stamp stamp;
  CalibrationName calibration;
  std::variant<CompassSample, ImuSample, GpsSample, SkySample, MotorSample, AltimeterSample, PowerSample> value;
};

}  // namespace navcal::instruments
