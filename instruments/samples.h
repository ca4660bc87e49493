// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

#include "protocols/gps_fix.h"

namespace navcal::instruments {

using Vector3 = std::array<double, 3>;

/// A short text of fixed size, so that a sample needs no memory of its own. Longer ones are cut.
template <std::size_t Size>
class Text {
 public:
  constexpr Text() = default;
  constexpr explicit Text(std::string_view text) {
    for (std::size_t i = 0; i < text.size() && i < Size; ++i) text_[i] = text[i];
  }
  [[nodiscard]] constexpr std::string_view view() const {
    std::size_t n = 0;
    while (n < Size && text_[n] != '\0') ++n;
    return {text_.data(), n};
  }
  constexpr bool operator==(const Text&) const = default;

 private:
  std::array<char, Size> text_{};
};

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

// Samples name what was measured, not the device: one device may give several kinds, and a member that it does not
// measure is absent. Members `..._std_...` are standard errors of one reading: as the device states them, else by
// the configuration's table [instruments] (pipeline/standard_errors.h).

/// Attitude and magnetic field: of a compass, or of an inertial unit that knows its attitude. Body axes x forward,
/// y starboard, z down; angles as the device sends them, magnetic.
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
  std::optional<double> heading_std_rad;
  std::optional<double> tilt_std_rad;  ///< roll and pitch
  std::optional<double> field_std_uT;  ///< each axis
};

/// State of the thesis's inertial card (ICD section 3).
struct CardState {
  std::uint8_t sequence = 0;
  bool leak_forward = false;
  bool leak_aft = false;
  bool low_supply = false;
};

/// Rates and specific force, body axes, and what else one frame of the same device tells.
struct ImuSample {
  std::optional<Vector3> rate_rad_s;                  ///< roll, pitch, yaw (the card's gyros A-x, B-y, A-z)
  std::optional<double> yaw_rate_b_rad_s;             ///< of a second, redundant gyro
  std::optional<double> yaw_rate_calibrated_rad_s;    ///< rate_rad_s[2] by the calibration in force
  std::optional<double> yaw_rate_b_calibrated_rad_s;  ///< yaw_rate_b_rad_s likewise
  std::optional<Vector3> specific_force_m_s2;         ///< -9.81 in z when level and still
  std::optional<double> depth_m;
  std::optional<double> temperature_C;
  bool over_range = false;  ///< the device says that a value is beyond its range
  std::optional<CardState> card;
  std::optional<double> rate_std_rad_s;           ///< each axis
  std::optional<double> specific_force_std_m_s2;  ///< each axis
  std::optional<double> depth_std_m;
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
  std::optional<double> position_std_m;  ///< north and east, each
  std::optional<double> height_std_m;
  std::optional<double> velocity_std_m_s;  ///< north and east, each
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
  std::optional<double> fins_std_rad;
  std::optional<double> current_std_A;
};

/// Echo sounder (DBT, DPT): distance from the transducer down to the bottom.
struct AltimeterSample {
  double altitude_m = 0;
  std::optional<double> altitude_std_m;
};

/// Axes of a velocity.
enum class VelocityFrame : std::uint8_t {
  body,   ///< forward, starboard, down
  earth,  ///< north, east, down; north as the device knows it
};

/// Doppler log.
struct DvlSample {
  VelocityFrame frame = VelocityFrame::body;
  std::optional<Vector3> bottom_velocity_m_s;     ///< of the device over the bottom; absent without bottom lock
  std::optional<double> bottom_velocity_std_m_s;  ///< each axis
  std::optional<Vector3> water_velocity_m_s;      ///< of the device through the water
  std::optional<double> water_velocity_std_m_s;
  std::optional<double> altitude_m;  ///< vertical, from the transducer to the bottom
  std::optional<double> altitude_std_m;
  std::optional<double> temperature_C;    ///< of the water
  std::optional<double> sound_speed_m_s;  ///< that the device reckons with
};

/// Pressure gauge.
struct DepthSample {
  std::optional<double> depth_m;  ///< as the device states it
  std::optional<double> depth_std_m;
  std::optional<double> pressure_Pa;  ///< absolute
  std::optional<double> pressure_std_Pa;
  std::optional<double> temperature_C;
};

/// A mission sensor: one quantity with its name and unit as the sender writes them ("oxygen", "umol/l").
struct ScalarSample {
  Text<24> quantity;
  Text<16> unit;
  double value = 0;
  std::optional<double> value_std;
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
  std::variant<CompassSample, ImuSample, GpsSample, SkySample, MotorSample, AltimeterSample, PowerSample,
               DvlSample, DepthSample, ScalarSample>
      value;
};

}  // namespace navcal::instruments
