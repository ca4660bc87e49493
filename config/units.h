// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <string_view>
#include <type_traits>

namespace navcal::config {

/// Unit of a number in the file. Inside the program the number is multiplied by numerator / denominator.
struct Unit {
  std::string_view name;
  double numerator = 1;
  double denominator = 1;
};

inline constexpr Unit kNoUnit{""};
inline constexpr Unit kSeconds{"s"};
inline constexpr Unit kMilliseconds{"ms", 1, 1000};
inline constexpr Unit kHours{"h", 3600, 1};
inline constexpr Unit kMegabytes{"MB", 1e6, 1};
inline constexpr Unit kKilobytes{"kB", 1e3, 1};
inline constexpr Unit kDegrees{"deg", std::numbers::pi, 180};
/// Degrees inside as in the file; of lists, which are not converted.
inline constexpr Unit kPlainDegrees{"deg"};
inline constexpr Unit kPercent{"%", 1, 100};
inline constexpr Unit kDegreesPerSecond{"deg/s", std::numbers::pi, 180};
inline constexpr Unit kMetres{"m"};
inline constexpr Unit kHertz{"Hz"};
inline constexpr Unit kCelsius{"C"};
inline constexpr Unit kMetresPerSecondSquared{"m/s2"};
inline constexpr Unit kMicrotesla{"uT"};
inline constexpr Unit kMetresPerSecond{"m/s"};
inline constexpr Unit kMillivolts{"mV"};
inline constexpr Unit kMillivoltsPer{"mV per deg/s, per g, per m"};
inline constexpr Unit kBits{"bit/s"};
inline constexpr Unit kSquareMetres{"m2"};
inline constexpr Unit kKilograms{"kg"};
inline constexpr Unit kKilogramsPerCubicMetre{"kg/m3"};
inline constexpr Unit kHectopascals{"hPa", 100, 1};
inline constexpr Unit kAmperes{"A"};
inline constexpr Unit kAmpereHours{"Ah"};
inline constexpr Unit kVolts{"V"};
inline constexpr Unit kOhms{"ohm"};
inline constexpr Unit kAmperesSecondsCubed{"A s3"};
inline constexpr Unit kRpm{"rpm", 1, 60};
/// Units of the motor card, unlike the two above: orders are compared with limits in the card's own units.
inline constexpr Unit kCardRpm{"rpm"};
inline constexpr Unit kCardRpmPerSecond{"rpm/s"};
inline constexpr Unit kCardDegrees{"deg"};
inline constexpr Unit kCardDegreesPerSecond{"deg/s"};
inline constexpr Unit kRadians{"rad"};
inline constexpr Unit kPerRadian{"1/rad"};
inline constexpr Unit kPerSecond{"1/s"};
inline constexpr Unit kPerMetre{"1/m"};
inline constexpr Unit kPerMetreSecond{"1/(m s)"};
inline constexpr Unit kDegreesPerMetre{"deg/m", std::numbers::pi, 180};
inline constexpr Unit kDegreesPerMetreSecond{"deg/(m s)", std::numbers::pi, 180};

template <class Field>
Field to_inside(double number, const Unit& unit) {
  const double inside = number * unit.numerator / unit.denominator;
  if constexpr (std::is_integral_v<Field>) {
    return static_cast<Field>(std::llround(inside));
  } else {
    return inside;
  }
}

/// The shortest decimal that `holds` (that reads back to the same value inside), near `guess`.
double shortest_decimal(double guess, const std::function<bool(double)>& holds);

/// The number that a file must state for this value inside: the shortest that reads back to the same bits. A value
/// that no number in the file leads to (it did not come from a file) gives the nearest one.
template <class Field>
double to_file(Field inside, const Unit& unit) {
  return shortest_decimal(static_cast<double>(inside) * unit.denominator / unit.numerator,
                          [&](double candidate) { return to_inside<Field>(candidate, unit) == inside; });
}

}  // namespace navcal::config
