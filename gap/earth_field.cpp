#include "gap/earth_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "gap/mission.h"
#include "sim/rotation.h"

namespace navcal::gap {
using sim::operator*;  // NOLINT(misc-unused-using-decls): of a matrix and a vector, which are std::array

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
/// No place on the Earth has more than 70 uT.
constexpr double kGreatest_uT = 100;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string place_text(const base::GeodeticPosition& place) {
  const double latitude_deg = place.latitude_rad * kDegrees;
  const double longitude_deg = std::remainder(place.longitude_rad * kDegrees, 360);
  return fmt::format("{:.2f} {} {:.2f} {}", std::abs(latitude_deg), latitude_deg < 0 ? 'S' : 'N',
                     std::abs(longitude_deg), longitude_deg < 0 ? 'W' : 'E');
}

std::string source_text(const EarthField& field) {
  using enum EarthField::Source;
  switch (field.source) {
    case given:
      return "given by --field";
    case stated:
      return "stated in the recording";
    case model:
      return fmt::format("model WMM2025 at {} on {}{}", place_text(*field.place), field.date(),
                         field.is_extrapolated() ? ", extrapolated" : "");
    case fitted:
      return "fitted to the compass, from magnetic north";
    case reference:
      break;
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
  using enum EarthField::Source;
  switch (source) {
    case given:
      return "given";
    case stated:
      return "stated";
    case model:
      return "model";
    case fitted:
      return "fitted";
    case reference:
      break;
  }
  return "reference";
}

std::string text_of(const EarthField& field) {
  const auto& [north, east, down] = field.north_east_down_uT;
  return fmt::format("{}: north {:.2f}, east {:.2f}, down {:.2f} uT", source_text(field), north, east, down);
}

std::string doubt_of(const EarthField& field) {
  if (field.source == EarthField::Source::fitted) {
    return "no fix and no --field: the field of the Earth is fitted to the compass's readings. Headings are "
           "magnetic, declination is unknown, and scale errors or vertical iron of the compass may be taken for "
           "the "
           "field";
  }
  if (field.is_extrapolated()) {
    return "the World Magnetic Model is valid from 2025 to 2029; before and after, it may be degrees off (--field "
           "N,E,D states the field)";
  }
  if (field.source != EarthField::Source::model) return {};
  // Where navcal simulate and its forerunners put recordings by default.
  constexpr double kLatitude_deg = 37.0629, kLongitude_deg = -80.6275, kNear_deg = 0.2;
  const bool is_near = std::abs(field.place->latitude_rad * kDegrees - kLatitude_deg) < kNear_deg &&
                       std::abs(field.place->longitude_rad * kDegrees - kLongitude_deg) < kNear_deg;
  if (!is_near) return {};
  return "older simulated recordings of this place were made in a reference field; they are read with --field "
         "19.0,0.6,44.0";
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
  if (readings.empty()) return field;
  std::vector<double> horizontal, down;
  for (const CompassReading& reading : readings) {
    const Vector3 levelled = sim::R_world_from_body({reading.roll_rad, reading.pitch_rad, 0}) * reading.field_uT;
    horizontal.push_back(std::hypot(levelled[0], levelled[1]));
    down.push_back(levelled[2]);
  }
  field.source = EarthField::Source::fitted;
  field.north_east_down_uT = {median(std::move(horizontal)), 0, median(std::move(down))};
  return field;
}

}  // namespace navcal::gap
