// SPDX-License-Identifier: Apache-2.0
#include "protocols/described/meaning.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace navcal::protocols::described {
namespace {

constexpr double kPi = std::numbers::pi;
/// The number of base/gravity.h, which this folder may not use; a test compares the two.
constexpr double kStandardGravity_m_s2 = 9.81;
constexpr double kDegree_rad = kPi / 180;

constexpr double kMaxRate_rad_s = 200, kMaxForce_m_s2 = 4000, kMaxField_uT = 10000, kMaxVelocity_m_s = 100;

using D = Dimension;

/// In the order of Meaning.
constexpr std::array<MeaningInfo, kMeaningCount> kMeanings{{
    {"none", D::any, -1e300, 1e300},
    {"sensor", D::any, -1e300, 1e300},
    {"rate.x", D::angular_rate, -kMaxRate_rad_s, kMaxRate_rad_s},
    {"rate.y", D::angular_rate, -kMaxRate_rad_s, kMaxRate_rad_s},
    {"rate.z", D::angular_rate, -kMaxRate_rad_s, kMaxRate_rad_s},
    {"rate.yaw_b", D::angular_rate, -kMaxRate_rad_s, kMaxRate_rad_s},
    {"specific_force.x", D::acceleration, -kMaxForce_m_s2, kMaxForce_m_s2},
    {"specific_force.y", D::acceleration, -kMaxForce_m_s2, kMaxForce_m_s2},
    {"specific_force.z", D::acceleration, -kMaxForce_m_s2, kMaxForce_m_s2},
    {"heading", D::angle, -4 * kPi, 4 * kPi},
    {"heading.true", D::angle, -4 * kPi, 4 * kPi},
    {"pitch", D::angle, -2 * kPi, 2 * kPi},
    {"roll", D::angle, -2 * kPi, 2 * kPi},
    {"field.x", D::magnetic_field, -kMaxField_uT, kMaxField_uT},
    {"field.y", D::magnetic_field, -kMaxField_uT, kMaxField_uT},
    {"field.z", D::magnetic_field, -kMaxField_uT, kMaxField_uT},
    {"dip", D::angle, -kPi, kPi},
    {"turn_rate", D::angular_rate, -kMaxRate_rad_s, kMaxRate_rad_s},
    {"depth", D::length, -1000, 12000},
    {"pressure", D::pressure, 0, 2e8},
    {"temperature", D::temperature, -273.15, 1000},
    {"altitude", D::length, 0, 12000},
    {"bottom_velocity.x", D::velocity, -kMaxVelocity_m_s, kMaxVelocity_m_s},
    {"bottom_velocity.y", D::velocity, -kMaxVelocity_m_s, kMaxVelocity_m_s},
    {"bottom_velocity.z", D::velocity, -kMaxVelocity_m_s, kMaxVelocity_m_s},
    {"bottom_velocity.north", D::velocity, -kMaxVelocity_m_s, kMaxVelocity_m_s},
    {"bottom_velocity.east", D::velocity, -kMaxVelocity_m_s, kMaxVelocity_m_s},
    {"bottom_velocity.down", D::velocity, -kMaxVelocity_m_s, kMaxVelocity_m_s},
    {"water_velocity.x", D::velocity, -kMaxVelocity_m_s, kMaxVelocity_m_s},
    {"water_velocity.y", D::velocity, -kMaxVelocity_m_s, kMaxVelocity_m_s},
    {"water_velocity.z", D::velocity, -kMaxVelocity_m_s, kMaxVelocity_m_s},
    {"water_velocity.north", D::velocity, -kMaxVelocity_m_s, kMaxVelocity_m_s},
    {"water_velocity.east", D::velocity, -kMaxVelocity_m_s, kMaxVelocity_m_s},
    {"water_velocity.down", D::velocity, -kMaxVelocity_m_s, kMaxVelocity_m_s},
    {"sound_speed", D::velocity, 300, 3000},
    {"latitude", D::angle, -kPi / 2, kPi / 2},
    {"longitude", D::angle, -2 * kPi, 2 * kPi},
    {"height", D::length, -12000, 1e6},
    {"height_msl", D::length, -12000, 1e6},
    {"speed", D::velocity, 0, 1000},
    {"course", D::angle, -4 * kPi, 4 * kPi},
    {"climb", D::velocity, -1000, 1000},
    {"dop", D::number, 0, 1000},
    {"satellites", D::number, 0, 255},
    {"utc", D::time, 0, 4102444800.0},
    {"rpm", D::rotation, -1e6, 1e6},
    {"rpm_commanded", D::rotation, -1e6, 1e6},
    {"fin.1", D::angle, -kPi, kPi},
    {"fin.2", D::angle, -kPi, kPi},
    {"fin.3", D::angle, -kPi, kPi},
    {"motor_current", D::current, -1000, 1000},
    {"voltage", D::voltage, 0, 1000},
    {"current", D::current, -1000, 1000},
    {"sequence", D::number, 0, 1e300},
    {"leak_forward", D::number, -1e300, 1e300},
    {"leak_aft", D::number, -1e300, 1e300},
    {"over_range", D::number, -1e300, 1e300},
    {"low_supply", D::number, -1e300, 1e300},
}};

/// The first of each dimension is that of samples.
constexpr auto kUnits = std::to_array<Unit>({
    {"counts", D::number},
    {"rad", D::angle},
    {"deg", D::angle, kDegree_rad},
    {"arcmin", D::angle, kDegree_rad / 60},
    {"mils", D::angle, 2 * kPi / 6400},
    {"counts16", D::angle, 2 * kPi / 65536},
    {"rad/s", D::angular_rate},
    {"deg/s", D::angular_rate, kDegree_rad},
    {"deg/min", D::angular_rate, kDegree_rad / 60},
    {"deg/h", D::angular_rate, kDegree_rad / 3600},
    {"m/s2", D::acceleration},
    {"cm/s2", D::acceleration, 0.01},
    {"g", D::acceleration, kStandardGravity_m_s2},
    {"mg", D::acceleration, kStandardGravity_m_s2 / 1000},
    {"uT", D::magnetic_field},
    {"nT", D::magnetic_field, 1e-3},
    {"mT", D::magnetic_field, 1e3},
    {"G", D::magnetic_field, 100},
    {"mG", D::magnetic_field, 0.1},
    {"m", D::length},
    {"mm", D::length, 1e-3},
    {"cm", D::length, 1e-2},
    {"km", D::length, 1e3},
    {"ft", D::length, 0.3048},
    {"fathoms", D::length, 1.8288},
    {"m/s", D::velocity},
    {"mm/s", D::velocity, 1e-3},
    {"cm/s", D::velocity, 1e-2},
    {"km/h", D::velocity, 1 / 3.6},
    {"kn", D::velocity, 1852.0 / 3600},
    {"ft/s", D::velocity, 0.3048},
    {"Pa", D::pressure},
    {"hPa", D::pressure, 100},
    {"mbar", D::pressure, 100},
    {"kPa", D::pressure, 1e3},
    {"dbar", D::pressure, 1e4},
    {"bar", D::pressure, 1e5},
    {"MPa", D::pressure, 1e6},
    {"psi", D::pressure, 6894.757293168361},
    {"C", D::temperature},
    {"K", D::temperature, 1, -273.15},
    {"F", D::temperature, 5.0 / 9, -160.0 / 9},
    {"V", D::voltage},
    {"mV", D::voltage, 1e-3},
    {"A", D::current},
    {"mA", D::current, 1e-3},
    {"rpm", D::rotation},
    {"1/s", D::rotation, 60},
    {"s", D::time},
    {"ms", D::time, 1e-3},
    {"us", D::time, 1e-6},
    {"ns", D::time, 1e-9},
});

}  // namespace

const MeaningInfo& info_of(Meaning meaning) { return kMeanings.at(static_cast<std::size_t>(meaning)); }

std::optional<Meaning> meaning_named(std::string_view name) {
  for (std::size_t i = 0; i < kMeanings.size(); ++i) {
    if (kMeanings[i].name == name) return static_cast<Meaning>(i);
  }
  return std::nullopt;
}

std::span<const Unit> all_units() { return kUnits; }

const Unit* unit_named(std::string_view name) {
  const auto* const found =
      std::find_if(kUnits.begin(), kUnits.end(), [&](const Unit& unit) { return unit.name == name; });
  return found == kUnits.end() ? nullptr : found;
}

}  // namespace navcal::protocols::described
