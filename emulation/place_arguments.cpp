// SPDX-License-Identifier: Apache-2.0
#include "emulation/place_arguments.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "base/angles.h"
#include "base/failure.h"

namespace navcal::emulation {

std::string SimulatedPlace::field_event() const {
  return "event simulated field of the Earth: " + field_text(field_world_uT);
}

SimulatedPlace simulated_place(const PlaceArguments& arguments, std::int64_t otherwise_ns) {
  constexpr double kGreatestLatitude_deg = 89;
  SimulatedPlace place;
  if (const auto position = arguments.position()) {
    place.origin = {position->latitude_rad * base::kDegreesPerRadian,
                    std::remainder(position->longitude_rad * base::kDegreesPerRadian, 360), position->height_m};
    if (!(std::abs(place.origin.latitude_deg) <= kGreatestLatitude_deg)) {
      throw base::Failure(
          base::Exit::usage,
          fmt::format("--place {}: a simulated vehicle stays within 89 degrees of latitude", *arguments.place));
    }
  }
  if (arguments.place && !arguments.field)
    place.remark = extrapolation_remark(model_year(arguments, otherwise_ns));
  place.field_world_uT = chosen_field_uT(arguments, otherwise_ns).value_or(place.field_world_uT);
  return place;
}

SimulatedPlace emulated_place(const PlaceArguments& arguments, std::int64_t now_ns) {
  PlaceArguments where = arguments;
  if (!where.place) {
    constexpr sim::Origin kHome;
    where.place = fmt::format("{},{},{}", kHome.latitude_deg, kHome.longitude_deg, kHome.height_m);
  }
  return simulated_place(where, now_ns);
}

namespace {

/// Iron beside the vehicle aside, no place on the Earth has more than 70 uT.
constexpr double kGreatestField_uT = 100;

/// Numbers between commas; empty when the text is anything else.
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  const char* const end = text.data() + text.size();
  for (const char* at = text.data(); at < end;) {
    double number = 0;
    const auto [rest, error] = std::from_chars(at, end, number);
    if (error != std::errc() || (rest != end && *rest != ',')) return {};
    numbers.push_back(number);
    at = rest + 1;
    if (rest != end && at == end) return {};  // a comma that nothing follows
  }
  return numbers;
}

}  // namespace

std::optional<base::GeodeticPosition> PlaceArguments::position() const {
  if (!place) return std::nullopt;
  const std::vector<double> numbers = numbers_in(*place);
  if (numbers.size() != 2 && numbers.size() != 3) {
    throw base::Failure(
        base::Exit::usage,
        fmt::format(
            "--place {}: expected LAT,LON or LAT,LON,HEIGHT_M, in degrees and metres (such as 59.33,18.07)",
            *place));
  }
  if (!(numbers[0] >= -90 && numbers[0] <= 90) || !(numbers[1] >= -180 && numbers[1] <= 360)) {
    throw base::Failure(base::Exit::usage,
                        fmt::format("--place {}: latitude is -90 to 90, longitude -180 to 360 degrees", *place));
  }
  const double height_m = numbers.size() == 3 ? numbers[2] : 0;
  if (!(std::abs(height_m) <= 1e6)) {
    throw base::Failure(base::Exit::usage,
                        fmt::format("--place {}: the height is at most 1000 km from 0", *place));
  }
  return base::GeodeticPosition{numbers[0] / base::kDegreesPerRadian, numbers[1] / base::kDegreesPerRadian,
                                height_m};
}

std::optional<std::int64_t> PlaceArguments::day_ns() const {
  using namespace std::chrono;
  if (!date) return std::nullopt;
  int y = 0;
  unsigned m = 0, d = 0;
  int length = 0;
  const bool read = std::sscanf(date->c_str(), "%4d-%2u-%2u%n", &y, &m, &d, &length) == 3;
  const year_month_day day_read{year(y), month(m), day(d)};
  if (!read || length != static_cast<int>(date->size()) || !day_read.ok()) {
    throw base::Failure(base::Exit::usage, fmt::format("--date {}: expected a day, YYYY-MM-DD", *date));
  }
  return duration_cast<nanoseconds>(sys_days(day_read).time_since_epoch()).count();
}

std::optional<std::array<double, 3>> PlaceArguments::field_uT() const {
  if (!field) return std::nullopt;
  const std::vector<double> numbers = numbers_in(*field);
  if (numbers.size() != 3) {
    throw base::Failure(
        base::Exit::usage,
        fmt::format("--field {}: expected NORTH,EAST,DOWN in microtesla (such as 19.0,0.6,44.0)", *field));
  }
  const double size = std::hypot(numbers[0], numbers[1], numbers[2]);
  if (!(size > 1 && size <= kGreatestField_uT)) {
    throw base::Failure(base::Exit::usage,
                        fmt::format("--field {}: the size of a field of the Earth is 1 to 100 uT", *field));
  }
  return std::array<double, 3>{numbers[0], numbers[1], numbers[2]};
}

double model_year(const PlaceArguments& arguments, std::int64_t otherwise_ns) {
  return base::decimal_year(arguments.day_ns().value_or(otherwise_ns));
}

std::optional<std::array<double, 3>> chosen_field_uT(const PlaceArguments& arguments, std::int64_t otherwise_ns) {
  const auto given = arguments.field_uT();
  const auto position = arguments.position();
  if (given || !position) return given;
  const auto uT = base::world_magnetic_field(*position, model_year(arguments, otherwise_ns)).north_east_down_uT;
  return std::array<double, 3>{uT.x(), uT.y(), uT.z()};
}

std::string extrapolation_remark(double year) {
  if (base::wmm_covers(year)) return {};
  return fmt::format(
      "the World Magnetic Model is valid from 2025 to 2029; for {:.1f} it is extrapolated and may be degrees off",
      year);
}

void warn_if_extrapolated(double year) {
  const std::string remark = extrapolation_remark(year);
  if (!remark.empty()) fmt::print(stderr, "navcal: {}\n", remark);
}

std::string field_text(const std::array<double, 3>& field_uT) {
  return fmt::format("north {:.3f}, east {:.3f}, down {:.3f} uT", field_uT[0], field_uT[1], field_uT[2]);
}

}  // namespace navcal::emulation
