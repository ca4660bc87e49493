// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <numbers>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>

#include "instruments/samples.h"
#include "protocols/described/meaning.h"
#include "protocols/gps_fix.h"
#include "protocols/samples_line.h"

namespace navcal::api {

[[nodiscard]] constexpr std::string_view name_of(VelocityFrame frame) {
  return frame == VelocityFrame::body ? "body" : "earth";
}

}  // namespace navcal::api

/// The only table of the members of samples (docs/samples.md). JSON, log, export, injected samples, described
/// devices, library and Python follow it.
namespace navcal::instruments {

/// Part of a member in its sample.
enum class Role : std::uint8_t {
  measured,  ///< a sample has one of these at least
  detail,    ///< goes with what is measured
  error,     ///< standard error of one reading
  result,    ///< by navcal itself; no device and no program sends it
};

enum class Form : std::uint8_t {
  plain,
  direction,  ///< 0 to 2 pi
  degrees,    ///< radians in the sample, degrees in text
};

/// Nature of a member: unit as UDUNITS reads it, and bounds in text beyond which it cannot be of a vehicle on this
/// planet.
struct Quantity {
  std::string_view units{};
  protocols::samples_line::Bounds bounds{};
  Role role = Role::measured;
  Form form = Form::plain;
};

namespace quantity {
inline constexpr double kPi = std::numbers::pi;
inline constexpr Quantity kDirection{"radian", {-2 * kPi, 2 * kPi}, Role::measured, Form::direction};
inline constexpr Quantity kAngle{"radian", {-kPi, kPi}}, kDip{"radian", {-kPi / 2, kPi / 2}};
inline constexpr Quantity kLatitude{"degrees_north", {-90, 90}, Role::measured, Form::degrees};
inline constexpr Quantity kLongitude{"degrees_east", {-180, 180}, Role::measured, Form::degrees};
inline constexpr Quantity kRate{"radian s-1", {-100, 100}}, kForce{"m s-2", {-2000, 2000}};
inline constexpr Quantity kField{"uT", {-10'000, 10'000}}, kTemperature{"degree_Celsius", {-273.15, 1000}};
inline constexpr Quantity kDepth{"m", {-100, 12'000}}, kHeight{"m", {-12'000, 100'000}},
    kAltitude{"m", {0, 12'000}};
inline constexpr Quantity kVelocity{"m s-1", {-1000, 1000}}, kSpeed{"m s-1", {0, 1000}},
    kSound{"m s-1", {300, 3000}};
inline constexpr Quantity kPressure{"Pa", {0, 2e8}}, kDop{"1", {0, 1e6}}, kCount{"1", {0, 255}};
inline constexpr Quantity kTurns{"rpm", {-100'000, 100'000}}, kVoltage{"V", {0, 1000}},
    kCurrent{"A", {-1000, 1000}};
inline constexpr Quantity kAny{"", {-1e300, 1e300}}, kCode{};
inline constexpr Quantity kSequence{"1", {0, 255}, Role::detail}, kWord{"", {}, Role::detail}, kFlag = kWord;
inline constexpr Quantity kOurDirection{"radian", {}, Role::result}, kOurRate{"radian s-1", {}, Role::result};
constexpr Quantity error_in(std::string_view units) { return {units, {0, 1e6}, Role::error}; }
}  // namespace quantity

/// The kinds, with their fields in the order of JSON. The library's own samples have the same members.
namespace kind {
using namespace quantity;
using protocols::described::Meaning;

/// One member of a sample, or of the state of a card in it.
template <class Owner, class T>
struct Field {
  std::string_view key;  ///< in JSON
  T Owner::*member;
  Quantity quantity;
  std::string_view description{};  ///< empty: as of the same key in a kind before
  Meaning meaning{};               ///< of the number that a described device sends; of a vector, its first
  std::string_view cf_name{};      ///< standard name of the CF conventions
};
template <class Owner, class T, class... Rest>
Field(std::string_view, T Owner::*, Rest...) -> Field<Owner, T>;

template <class... Fields>
struct Kind {
  constexpr Kind(std::string_view kind_class, std::string_view kind_name, Fields... kind_fields)
      : class_name(kind_class), name(kind_name), fields(kind_fields...) {}
  std::string_view class_name, name;  ///< "COMPASS", "compass"
  std::tuple<Fields...> fields;
};

/// Kind of a sample, with its fields in the order of JSON. A type is known by a member that no other kind has, so
/// that the samples of the library, which have the same members, are found too.
template <class S>
constexpr auto kind_of() {
  using enum Meaning;
  if constexpr (requires { &S::dip_rad; }) {
    return Kind(
        "COMPASS", "compass",
        Field{"heading_rad", &S::heading_rad, kDirection, "heading as the device said it, from magnetic north",
              heading},
        Field{"heading_calibrated_rad", &S::heading_calibrated_rad, kOurDirection,
              "heading by the calibration in force, from magnetic north"},
        Field{"heading_is_true", &S::heading_is_true, kFlag, "the device itself says the heading from true north"},
        Field{"pitch_rad", &S::pitch_rad, kAngle, "pitch, positive nose up", pitch, "platform_pitch_fore_up"},
        Field{"roll_rad", &S::roll_rad, kAngle, "roll, positive starboard down", roll,
              "platform_roll_starboard_down"},
        Field{"field_body_uT", &S::field_body_uT, kField, "magnetic field in body axes (forward, starboard, down)",
              field_x},
        Field{"dip_rad", &S::dip_rad, kDip, "inclination of the magnetic field as the device said it", dip},
        Field{"turn_rate_rad_s", &S::turn_rate_rad_s, kRate,
              "rate of turn as the device said it, positive to starboard", turn_rate,
              "platform_yaw_rate_fore_starboard"},
        Field{"temperature_C", &S::temperature_C, kTemperature, "temperature that the device measures",
              temperature},
        Field{"error", &S::error, kCode, "error code of the compass, hexadecimal"},
        Field{"tilt_by_accelerometers", &S::tilt_by_accelerometers, kFlag,
              "pitch and roll are not the compass's own"},
        Field{"heading_std_rad", &S::heading_std_rad, error_in("radian"), "standard error of the heading",
              heading},
        Field{"tilt_std_rad", &S::tilt_std_rad, error_in("radian"), "standard error of pitch and roll", pitch},
        Field{"field_std_uT", &S::field_std_uT, error_in("uT"), "standard error of the magnetic field, each axis",
              field_x});
  } else if constexpr (requires { &S::over_range; }) {
    using Card = typename decltype(S::card)::value_type;
    return Kind(
        "IMU", "imu",
        Field{"rate_rad_s", &S::rate_rad_s, kRate, "rate of turn about body axes (gyros A-x, B-y, A-z)", rate_x},
        Field{"yaw_rate_b_rad_s", &S::yaw_rate_b_rad_s, kRate, "rate of turn about the z axis, gyro B",
              rate_yaw_b},
        Field{"yaw_rate_calibrated_rad_s", &S::yaw_rate_calibrated_rad_s, kOurRate,
              "gyro A's z axis by the calibration in force"},
        Field{"yaw_rate_b_calibrated_rad_s", &S::yaw_rate_b_calibrated_rad_s, kOurRate,
              "gyro B's z axis by the calibration in force"},
        Field{"specific_force_m_s2", &S::specific_force_m_s2, kForce,
              "specific force in body axes, -9.81 in z when level and still", specific_force_x},
        Field{"depth_m", &S::depth_m, kDepth, "depth of the vehicle", depth, "depth"},
        Field{"sequence", &Card::sequence, kCount, "number of the frame as the device counts it", sequence},
        Field{"leak_forward", &Card::leak_forward, kFlag, "water in the forward section", leak_forward},
        Field{"leak_aft", &Card::leak_aft, kFlag, "water in the aft section", leak_aft},
        Field{"low_supply", &Card::low_supply, kFlag, "the supply is low", low_supply},
        Field{"over_range", &S::over_range, kFlag, "a channel is beyond its range", over_range},
        Field{"temperature_C", &S::temperature_C, kTemperature, "", temperature},
        Field{"rate_std_rad_s", &S::rate_std_rad_s, error_in("radian s-1"),
              "standard error of the rates of turn, each axis", rate_x},
        Field{"specific_force_std_m_s2", &S::specific_force_std_m_s2, error_in("m s-2"),
              "standard error of the specific force, each axis", specific_force_x},
        Field{"depth_std_m", &S::depth_std_m, error_in("m"), "standard error of the depth", depth});
  } else if constexpr (requires { &S::fix; }) {
    return Kind(
        "GPS", "gps", Field{"lat", &S::latitude_rad, kLatitude, "latitude, WGS84", latitude, "latitude"},
        Field{"lon", &S::longitude_rad, kLongitude, "longitude, WGS84", longitude, "longitude"},
        Field{"speed_m_s", &S::speed_m_s, kSpeed, "speed over ground", speed, "platform_speed_wrt_ground"},
        Field{"course_rad", &S::course_rad, kDirection, "course over ground, from true north", course,
              "platform_course"},
        Field{"fix", &S::fix, kWord, "kind of the fix"},
        Field{"height_m", &S::height_m, kHeight, "height above the ellipsoid", height,
              "height_above_reference_ellipsoid"},
        Field{"height_msl_m", &S::height_msl_m, kHeight, "height above mean sea level", height_msl, "altitude"},
        Field{"climb_m_s", &S::climb_m_s, kVelocity, "vertical velocity, positive upwards", climb},
        Field{"dop", &S::dop, kDop, "dilution of precision, of position when 3D, horizontal when 2D", dop},
        Field{"visible", &S::visible, kCount, "satellites in view"},
        Field{"tracked", &S::tracked, kCount, "satellites tracked", satellites},
        Field{"time_corrected", &S::time_corrected, kFlag, "a rollover of the week was undone"},
        Field{"leap_known", &S::leap_known, kFlag, "the receiver knows the leap seconds"},
        Field{"position_std_m", &S::position_std_m, error_in("m"),
              "standard error of the position, north and east", latitude},
        Field{"height_std_m", &S::height_std_m, error_in("m"), "standard error of the height", height},
        Field{"velocity_std_m_s", &S::velocity_std_m_s, error_in("m s-1"),
              "standard error of the velocity, north and east", speed});
  } else if constexpr (requires { &S::fins_rad; }) {
    return Kind(
        "MOTOR", "motor", Field{"rpm", &S::rpm, kTurns, "revolutions of the shaft", rpm},
        Field{"rpm_commanded", &S::rpm_commanded, kTurns, "revolutions commanded", rpm_commanded},
        Field{"fins_rad", &S::fins_rad, kAngle, "angle of the fin", fin_1},
        Field{"current_A", &S::current_A, kCurrent, "current of the motor, or out of the battery", motor_current},
        Field{"sequence", &S::sequence, kSequence, "", sequence},
        Field{"fins_std_rad", &S::fins_std_rad, error_in("radian"), "standard error of the fin angles", fin_1},
        Field{"current_std_A", &S::current_std_A, error_in("A"), "standard error of the current", motor_current});
  } else if constexpr (requires { &S::voltage_V; }) {
    return Kind("POWER", "power",
                Field{"voltage_V", &S::voltage_V, kVoltage, "voltage of the battery under load", voltage},
                Field{"current_A", &S::current_A, kCurrent, "", current});
  } else if constexpr (requires { &S::frame; }) {
    return Kind("DVL", "dvl",
                Field{"frame", &S::frame, kWord,
                      "axes of the velocities: body (forward, starboard, down) or earth (north, east, down)"},
                Field{"bottom_velocity_m_s", &S::bottom_velocity_m_s, kVelocity, "velocity over the bottom",
                      bottom_velocity_x},
                Field{"bottom_velocity_std_m_s", &S::bottom_velocity_std_m_s, error_in("m s-1"),
                      "standard error of the velocity over the bottom, each axis", bottom_velocity_x},
                Field{"water_velocity_m_s", &S::water_velocity_m_s, kVelocity, "velocity through the water",
                      water_velocity_x},
                Field{"water_velocity_std_m_s", &S::water_velocity_std_m_s, error_in("m s-1"),
                      "standard error of the velocity through the water, each axis", water_velocity_x},
                Field{"altitude_m", &S::altitude_m, kAltitude, "", altitude},
                Field{"altitude_std_m", &S::altitude_std_m, error_in("m"), "", altitude},
                Field{"temperature_C", &S::temperature_C, kTemperature, "", temperature},
                Field{"sound_speed_m_s", &S::sound_speed_m_s, kSound,
                      "speed of sound that the device reckons with", sound_speed, "speed_of_sound_in_sea_water"});
  } else if constexpr (requires { &S::pressure_Pa; }) {
    return Kind(
        "DEPTH", "depth", Field{"depth_m", &S::depth_m, kDepth, "", depth},
        Field{"depth_std_m", &S::depth_std_m, error_in("m"), "", depth},
        Field{"pressure_Pa", &S::pressure_Pa, kPressure, "absolute pressure", pressure},
        Field{"pressure_std_Pa", &S::pressure_std_Pa, error_in("Pa"), "standard error of the pressure", pressure},
        Field{"temperature_C", &S::temperature_C, kTemperature, "", temperature});
  } else if constexpr (requires { &S::quantity; }) {
    return Kind("SENSOR", "sensor", Field{"quantity", &S::quantity, kWord, "quantity that the sensor measures"},
                Field{"unit", &S::unit, kWord, "unit of the value"},
                Field{"value", &S::value, kAny, "value in that unit"},
                Field{"value_std", &S::value_std, error_in(""), "standard error of the value"});
  } else if constexpr (requires { &S::satellites; }) {
    return Kind("SKY", "sky");  // counts, which are written apart
  } else {
    return Kind("ALTIMETER", "altimeter",
                Field{"altitude_m", &S::altitude_m, kAltitude, "distance from the transducer to the bottom",
                      altitude, "height_above_sea_floor"},
                Field{"altitude_std_m", &S::altitude_std_m, error_in("m"),
                      "standard error of the height above the sea floor", altitude});
  }
}

}  // namespace kind

template <class S>
inline constexpr auto kKind = kind::kind_of<S>();

/// Calls `visit(std::type_identity<S>{})` for each kind.
template <class Visit>
constexpr void for_each_kind(Visit&& visit) {
  [&]<class... S>(std::type_identity<std::variant<S...>>) {
    (visit(std::type_identity<S>{}), ...);
  }(std::type_identity<decltype(Sample::value)>{});
}

template <class S, class Visit>
constexpr void for_each_field(Visit&& visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, kKind<S>.fields);
}

/// The member; null where the sample has no card.
template <class S, class Owner, class T>
constexpr auto* member_of(S& sample, const kind::Field<Owner, T>& field) {
  if constexpr (std::is_same_v<std::remove_const_t<S>, Owner>) {
    return &(sample.*field.member);
  } else {
    return sample.card ? &((*sample.card).*field.member) : nullptr;
  }
}

}  // namespace navcal::instruments
