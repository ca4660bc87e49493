// SPDX-License-Identifier: Apache-2.0
#include "base/world_magnetic_model.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "base/wmm2025.h"

namespace navcal::base {
namespace {

constexpr double kEquatorialRadius_m = 6378137.0;  // WGS 84
constexpr double kFlattening = 1 / 298.257223563;  // WGS 84
constexpr double kReferenceRadius_m = 6371200.0;   // of the expansion
constexpr double kMicroteslaPerNanotesla = 1e-3;
/// Cosine of the latitude below which the east component, which is divided by it, would lose its digits.
constexpr double kSmallestCosine = 1e-9;

constexpr int kSize = kWmm2025Degree + 1;
/// Coefficients by degree and order.
using Triangle = std::array<std::array<double, kSize>, kSize>;

/// Point in spherical coordinates about the Earth's centre.
struct Geocentric {
  double radius_m = 0, sin_latitude = 0, cos_latitude = 0;
};

Geocentric geocentric(const GeodeticPosition& position) {
  const double sine = std::sin(position.latitude_rad), cosine = std::cos(position.latitude_rad);
  constexpr double kSquaredEccentricity = kFlattening * (2 - kFlattening);
  const double normal_m = kEquatorialRadius_m / std::sqrt(1 - kSquaredEccentricity * sine * sine);
  const double axis_distance_m = (normal_m + position.height_m) * cosine;
  const double z_m = (normal_m * (1 - kSquaredEccentricity) + position.height_m) * sine;
  const double radius_m = std::hypot(axis_distance_m, z_m);
  return {radius_m, z_m / radius_m, std::max(axis_distance_m / radius_m, kSmallestCosine)};
}

/// Schmidt semi-normalised associated Legendre functions of the sine of the latitude, and their derivatives by the
/// latitude, by recursion over the degree.
struct Legendre {
  Triangle value{}, derivative{};

  Legendre(double sine, double cosine) {
    value[0][0] = 1;
    for (std::size_t n = 1; n < kSize; ++n) {
      const auto degree = static_cast<double>(n);
      for (std::size_t m = 0; m <= n; ++m) {
        const auto order = static_cast<double>(m);
        if (n == m) {
          const double factor = n == 1 ? 1 : std::sqrt((2 * degree - 1) / (2 * degree));
          value[n][n] = factor * cosine * value[n - 1][n - 1];
          derivative[n][n] = factor * (cosine * derivative[n - 1][n - 1] - sine * value[n - 1][n - 1]);
          continue;
        }
        const double norm = std::sqrt(degree * degree - order * order);
        const double before = n >= 2 && m <= n - 2 ? std::sqrt((degree - 1) * (degree - 1) - order * order) : 0;
        const double value_before = n >= 2 ? value[n - 2][m] : 0;
        const double derivative_before = n >= 2 ? derivative[n - 2][m] : 0;
        value[n][m] = ((2 * degree - 1) * sine * value[n - 1][m] - before * value_before) / norm;
        derivative[n][m] = ((2 * degree - 1) * (sine * derivative[n - 1][m] + cosine * value[n - 1][m]) -
                            before * derivative_before) /
                           norm;
      }
    }
  }
};

}  // namespace

double MagneticField::horizontal_uT() const { return north_east_down_uT.head<2>().norm(); }
double MagneticField::total_uT() const { return north_east_down_uT.norm(); }
double MagneticField::declination_rad() const {
  return std::atan2(north_east_down_uT.y(), north_east_down_uT.x());
}
double MagneticField::dip_rad() const { return std::atan2(north_east_down_uT.z(), horizontal_uT()); }

MagneticField world_magnetic_field(const GeodeticPosition& position, double decimal_year) {
  const Geocentric point = geocentric(position);
  const Legendre legendre(point.sin_latitude, point.cos_latitude);
  const double years = decimal_year - kWmm2025Epoch;
  double north_nT = 0, east_nT = 0, down_nT = 0;
  for (const GaussCoefficient& term : kWmm2025) {
    const auto n = static_cast<std::size_t>(term.degree), m = static_cast<std::size_t>(term.order);
    const double g_nT = term.g_nT + years * term.g_nT_per_year;
    const double h_nT = term.h_nT + years * term.h_nT_per_year;
    const double cosine = std::cos(term.order * position.longitude_rad);
    const double sine = std::sin(term.order * position.longitude_rad);
    const double scale = std::pow(kReferenceRadius_m / point.radius_m, term.degree + 2);
    const double along = scale * (g_nT * cosine + h_nT * sine);
    north_nT -= along * legendre.derivative[n][m];
    east_nT += scale * term.order * (g_nT * sine - h_nT * cosine) * legendre.value[n][m] / point.cos_latitude;
    down_nT -= (term.degree + 1) * along * legendre.value[n][m];
  }
  // From the sphere's north and down to the ellipsoid's.
  const double tilt_rad = std::atan2(point.sin_latitude, point.cos_latitude) - position.latitude_rad;
  const double cosine = std::cos(tilt_rad), sine = std::sin(tilt_rad);
  MagneticField field;
  field.north_east_down_uT = kMicroteslaPerNanotesla * Eigen::Vector3d(north_nT * cosine - down_nT * sine, east_nT,
                                                                       north_nT * sine + down_nT * cosine);
  return field;
}

bool wmm_covers(double decimal_year) { return decimal_year >= kWmm2025Epoch && decimal_year < kWmm2025End; }

double decimal_year(std::int64_t utc_ns) {
  using std::chrono::sys_days, std::chrono::January, std::chrono::year;
  const std::chrono::sys_time<std::chrono::nanoseconds> time{std::chrono::nanoseconds(utc_ns)};
  const year this_year = std::chrono::year_month_day(std::chrono::floor<std::chrono::days>(time)).year();
  const sys_days begin = this_year / January / 1, end = (this_year + std::chrono::years(1)) / January / 1;
  const std::chrono::duration<double> passed = time - begin, whole = end - begin;
  return static_cast<int>(this_year) + passed / whole;
}

}  // namespace navcal::base
