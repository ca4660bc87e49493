// SPDX-License-Identifier: Apache-2.0
#include "gap/data/earth_field.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <vector>

#include "base/angles.h"
#include "base/enum_name.h"
#include "base/statistics.h"
#include "base/vectors.h"
#include "gap/data/mission.h"

namespace navcal::gap {
namespace {

/// No place on the Earth has more than 70 uT.
constexpr double kGreatest_uT = 100;

/// Whether the reading has a field and a tilt.
bool is_complete(const CompassReading& reading) {
  return std::isfinite(reading.field_uT[0]) && std::isfinite(reading.roll_rad);
}

/// Unit vector downwards in body axes, by the reading's own tilt.
Eigen::Vector3d downwards(const CompassReading& reading) {
  const double sf = std::sin(reading.roll_rad), cf = std::cos(reading.roll_rad);
  const double st = std::sin(reading.pitch_rad), ct = std::cos(reading.pitch_rad);
  return {-st, ct * sf, ct * cf};
}

/// Least-squares fit of the field's vertical part D and its size F, uT. Iron b along x and y, which turns with the
/// vehicle and would change F, is fitted as well. Model for each reading B, with g the unit vector downwards in
/// body axes:
///     g . B = D + g . b        |B|^2 = (F^2 - |b|^2) + 2 B . b
/// Iron along z remains in the field: the noise of the tilt hides the difference. Where the vehicle hardly turned,
/// the prior keeps b small.
std::optional<std::array<double, 2>> vertical_and_size(std::span<const CompassReading> readings) {
  constexpr double kReading_uT = 10;  ///< lag of the tilt and noise, alike for many readings in a row
  constexpr double kIron_uT = 3;
  constexpr double kOutlier = 0.3;  ///< of the usual size
  std::vector<double> sizes_uT;
  for (const CompassReading& reading : readings) {
    if (is_complete(reading)) sizes_uT.push_back(base::vector_of(reading.field_uT).norm());
  }
  if (sizes_uT.empty()) return std::nullopt;
  const double usual_uT = base::median(std::move(sizes_uT));
  if (!(usual_uT > 0)) return std::nullopt;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();  // of b, D, (F^2 - |b|^2) / (2 usual size)
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  normal.diagonal().head<2>().setConstant(kReading_uT * kReading_uT / (kIron_uT * kIron_uT));
  const auto add = [&](const Eigen::Vector4d& row, double value) {
    normal += row * row.transpose();
    right += row * value;
  };
  for (const CompassReading& reading : readings) {
    if (!is_complete(reading)) continue;
    const Eigen::Vector3d B = base::vector_of(reading.field_uT);
    if (std::abs(B.norm() - usual_uT) > kOutlier * usual_uT) continue;
    const Eigen::Vector3d g = downwards(reading);
    add({g.x(), g.y(), 1, 0}, g.dot(B));
    add({B.x() / usual_uT, B.y() / usual_uT, 0, 1}, B.squaredNorm() / (2 * usual_uT));
  }
  const Eigen::Vector4d found = normal.ldlt().solve(right);
  const double square_uT2 = 2 * usual_uT * found[3] + found.head<2>().squaredNorm();
  if (!found.allFinite() || !(square_uT2 > 0)) return std::nullopt;
  return std::array{found[2], std::sqrt(square_uT2)};
}

std::string place_text(const base::GeodeticPosition& place) {
  const double latitude_deg = place.latitude_rad * base::kDegreesPerRadian;
  const double longitude_deg = std::remainder(place.longitude_rad * base::kDegreesPerRadian, 360);
  return fmt::format("{:.2f} {} {:.2f} {}", std::abs(latitude_deg), latitude_deg < 0 ? 'S' : 'N',
                     std::abs(longitude_deg), longitude_deg < 0 ? 'W' : 'E');
}

std::string source_text(const EarthField& field) {
  using enum EarthField::Source;
  switch (field.source) {
    case given: return "given by --field";
    case stated: return "stated in the recording";
    case model:
      return fmt::format("model WMM2025 at {} on {}{}", place_text(*field.place), field.date(),
                         field.is_extrapolated() ? ", extrapolated" : "");
    case fitted: return "fitted to the compass, from magnetic north";
    case reference: break;
  }
  return "the reference field";
}

}  // namespace

void EarthField::set_by_model() {
  source = Source::model;
  const auto uT = base::world_magnetic_field(*place, base::decimal_year(*utc_ns)).north_east_down_uT;
  north_east_down_uT = {uT.x(), uT.y(), uT.z()};
}

bool EarthField::is_extrapolated() const {
  return source == Source::model && !base::wmm_covers(base::decimal_year(*utc_ns));
}

std::string EarthField::date() const {
  if (!utc_ns) return {};
  using namespace std::chrono;
  const year_month_day day(floor<days>(sys_time<nanoseconds>(nanoseconds(*utc_ns))));
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(day.year()), static_cast<unsigned>(day.month()),
                     static_cast<unsigned>(day.day()));
}

std::string_view name_of(EarthField::Source source) {
  return base::enum_name<EarthField::Source::fitted>(source, {"reference", "given", "stated", "model", "fitted"});
}

std::string text_of(const EarthField& field) {
  const auto& [north, east, down] = field.north_east_down_uT;
  return fmt::format("{}: north {:.2f}, east {:.2f}, down {:.2f} uT", source_text(field), north, east, down);
}

std::string doubt_of(const EarthField& field) {
  if (field.source == EarthField::Source::fitted) {
    return "no fix and no --field: the field of the Earth is fitted to the compass's readings. Headings are "
           "magnetic, declination is unknown, and scale errors or vertical iron of the compass may be taken for "
           "the field";
  }
  if (field.is_extrapolated()) {
    return "the World Magnetic Model is valid from 2025 to 2029; before and after, it may be degrees off (--field "
           "N,E,D states the field)";
  }
  return {};
}

std::optional<Vector3> stated_field_uT(std::string_view event) {
  const std::string text(event);
  Vector3 uT{};
  int length = 0;
  const int read = std::sscanf(text.c_str(), "simulated field of the Earth: north %lf, east %lf, down %lf uT%n",
                               &uT[0], &uT[1], &uT[2], &length);
  const double size_uT = std::hypot(uT[0], uT[1], uT[2]);
  if (read != 3 || length != static_cast<int>(text.size()) || !(size_uT > 0 && size_uT < kGreatest_uT)) {
    return std::nullopt;
  }
  return uT;
}

EarthField fitted_field(std::span<const CompassReading> readings) {
  EarthField field;
  const auto solved = vertical_and_size(readings);
  if (!solved) return field;
  const auto [down_uT, size_uT] = *solved;
  field.source = EarthField::Source::fitted;
  field.north_east_down_uT = {std::sqrt(std::max(size_uT * size_uT - down_uT * down_uT, 0.0)), 0, down_uT};
  return field;
}

}  // namespace navcal::gap
