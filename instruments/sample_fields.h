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
  std::string_view key;  ///< in JSON; what it means says record/log/topics.txt
  T Owner::*member;
  Quantity quantity;
  Meaning meaning{};  ///< of the number that a described device sends; of a vector, its first
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
        "COMPASS", "compass", Field{"heading_rad", &S::heading_rad, kDirection, heading},
        Field{"heading_calibrated_rad", &S::heading_calibrated_rad, kOurDirection},
        Field{"heading_is_true", &S::heading_is_true, kFlag}, Field{"pitch_rad", &S::pitch_rad, kAngle, pitch},
        Field{"roll_rad", &S::roll_rad, kAngle, roll}, Field{"field_body_uT", &S::field_body_uT, kField, field_x},
        Field{"dip_rad", &S::dip_rad, kDip, dip}, Field{"turn_rate_rad_s", &S::turn_rate_rad_s, kRate, turn_rate},
        Field{"temperature_C", &S::temperature_C, kTemperature, temperature}, Field{"error", &S::error, kCode},
        Field{"tilt_by_accelerometers", &S::tilt_by_accelerometers, kFlag},
        Field{"heading_std_rad", &S::heading_std_rad, error_in("radian"), heading},
        Field{"tilt_std_rad", &S::tilt_std_rad, error_in("radian"), pitch},
        Field{"field_std_uT", &S::field_std_uT, error_in("uT"), field_x});
  } else if constexpr (requires { &S::over_range; }) {
    using Card = typename decltype(S::card)::value_type;
    return Kind("IMU", "imu", Field{"rate_rad_s", &S::rate_rad_s, kRate, rate_x},
                Field{"yaw_rate_b_rad_s", &S::yaw_rate_b_rad_s, kRate, rate_yaw_b},
                Field{"yaw_rate_calibrated_rad_s", &S::yaw_rate_calibrated_rad_s, kOurRate},
                Field{"yaw_rate_b_calibrated_rad_s", &S::yaw_rate_b_calibrated_rad_s, kOurRate},
                Field{"specific_force_m_s2", &S::specific_force_m_s2, kForce, specific_force_x},
                Field{"depth_m", &S::depth_m, kDepth, depth}, Field{"sequence", &Card::sequence, kCount, sequence},
                Field{"leak_forward", &Card::leak_forward, kFlag, leak_forward},
                Field{"leak_aft", &Card::leak_aft, kFlag, leak_aft},
                Field{"low_supply", &Card::low_supply, kFlag, low_supply},
                Field{"over_range", &S::over_range, kFlag, over_range},
                Field{"temperature_C", &S::temperature_C, kTemperature, temperature},
                Field{"rate_std_rad_s", &S::rate_std_rad_s, error_in("radian s-1"), rate_x},
                Field{"specific_force_std_m_s2", &S::specific_force_std_m_s2, error_in("m s-2"), specific_force_x},
                Field{"depth_std_m", &S::depth_std_m, error_in("m"), depth});
  } else if constexpr (requires { &S::fix; }) {
    return Kind("GPS", "gps", Field{"lat", &S::latitude_rad, kLatitude, latitude},
                Field{"lon", &S::longitude_rad, kLongitude, longitude},
                Field{"speed_m_s", &S::speed_m_s, kSpeed, speed},
                Field{"course_rad", &S::course_rad, kDirection, course}, Field{"fix", &S::fix, kWord},
                Field{"height_m", &S::height_m, kHeight, height},
                Field{"height_msl_m", &S::height_msl_m, kHeight, height_msl},
                Field{"climb_m_s", &S::climb_m_s, kVelocity, climb}, Field{"dop", &S::dop, kDop, dop},
                Field{"visible", &S::visible, kCount}, Field{"tracked", &S::tracked, kCount, satellites},
                Field{"time_corrected", &S::time_corrected, kFlag}, Field{"leap_known", &S::leap_known, kFlag},
                Field{"position_std_m", &S::position_std_m, error_in("m"), latitude},
                Field{"height_std_m", &S::height_std_m, error_in("m"), height},
                Field{"velocity_std_m_s", &S::velocity_std_m_s, error_in("m s-1"), speed});
  } else if constexpr (requires { &S::fins_rad; }) {
    return Kind("MOTOR", "motor", Field{"rpm", &S::rpm, kTurns, rpm},
                Field{"rpm_commanded", &S::rpm_commanded, kTurns, rpm_commanded},
                Field{"fins_rad", &S::fins_rad, kAngle, fin_1},
                Field{"current_A", &S::current_A, kCurrent, motor_current},
                Field{"sequence", &S::sequence, kSequence, sequence},
                Field{"fins_std_rad", &S::fins_std_rad, error_in("radian"), fin_1},
                Field{"current_std_A", &S::current_std_A, error_in("A"), motor_current});
  } else if constexpr (requires { &S::voltage_V; }) {
    return Kind("POWER", "power", Field{"voltage_V", &S::voltage_V, kVoltage, voltage},
                Field{"current_A", &S::current_A, kCurrent, current});
  } else if constexpr (requires { &S::frame; }) {
    return Kind(
        "DVL", "dvl", Field{"frame", &S::frame, kWord},
        Field{"bottom_velocity_m_s", &S::bottom_velocity_m_s, kVelocity, bottom_velocity_x},
        Field{"bottom_velocity_std_m_s", &S::bottom_velocity_std_m_s, error_in("m s-1"), bottom_velocity_x},
        Field{"water_velocity_m_s", &S::water_velocity_m_s, kVelocity, water_velocity_x},
        Field{"water_velocity_std_m_s", &S::water_velocity_std_m_s, error_in("m s-1"), water_velocity_x},
        Field{"altitude_m", &S::altitude_m, kAltitude, altitude},
        Field{"altitude_std_m", &S::altitude_std_m, error_in("m"), altitude},
        Field{"temperature_C", &S::temperature_C, kTemperature, temperature},
        Field{"sound_speed_m_s", &S::sound_speed_m_s, kSound, sound_speed});
  } else if constexpr (requires { &S::pressure_Pa; }) {
    return Kind("DEPTH", "depth", Field{"depth_m", &S::depth_m, kDepth, depth},
                Field{"depth_std_m", &S::depth_std_m, error_in("m"), depth},
                Field{"pressure_Pa", &S::pressure_Pa, kPressure, pressure},
                Field{"pressure_std_Pa", &S::pressure_std_Pa, error_in("Pa"), pressure},
                Field{"temperature_C", &S::temperature_C, kTemperature, temperature});
  } else if constexpr (requires { &S::quantity; }) {
    return Kind("SENSOR", "sensor", Field{"quantity", &S::quantity, kWord}, Field{"unit", &S::unit, kWord},
                Field{"value", &S::value, kAny}, Field{"value_std", &S::value_std, error_in("")});
  } else if constexpr (requires { &S::satellites; }) {
    return Kind("SKY", "sky");  // counts, which are written apart
  } else {
    return Kind("ALTIMETER", "altimeter", Field{"altitude_m", &S::altitude_m, kAltitude, altitude},
                Field{"altitude_std_m", &S::altitude_std_m, error_in("m"), altitude});
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
