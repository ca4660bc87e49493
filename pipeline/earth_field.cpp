// SPDX-License-Identifier: Apache-2.0
#include "pipeline/earth_field.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "base/enum_name.h"
#include "base/world_magnetic_model.h"
#include "pipeline/readings.h"

namespace navcal::pipeline {
namespace {

/// The model is asked anew after so far, or so long: the declination changes by some 0.1 degrees.
constexpr double kStep_rad = 0.0016;
constexpr std::int64_t kStep_ns = 30LL * 86'400 * 1'000'000'000;

using Source = EarthField::Source;

bool is_complete(const config::EnvironmentSettings& settings) {
  return !settings.model || (settings.declination_rad != 0 && settings.field_uT > 0);
}

}  // namespace

EarthField::EarthField(const config::EnvironmentSettings& settings)
    : declination_rad(settings.declination_rad), size_uT(settings.field_uT), dip_rad(settings.dip_rad) {
  if (declination_rad != 0) declination_source = Source::configuration;
  if (size_uT > 0) size_source = Source::configuration;
}

std::string_view name_of(Source source) {
  return base::enum_name<Source::model>(source, {"none", "configuration", "model"});
}

std::string words_for(const EarthField& field) {
  const auto whence = [](Source source) {
    return source == Source::model ? "by the World Magnetic Model" : "as configured";
  };
  if (field.declination_source == Source::none) return "the declination is not known";
  const double declination_deg = field.declination_rad * base::kDegreesPerRadian;
  std::string words = fmt::format("declination {:.2f} deg {} {}", std::abs(declination_deg),
                                  declination_deg < 0 ? "west" : "east", whence(field.declination_source));
  if (field.size_source != Source::none) {
    words +=
        fmt::format("; field {:.2f} uT, dip {:.2f} deg", field.size_uT, field.dip_rad * base::kDegreesPerRadian);
    if (field.size_source != field.declination_source) words += fmt::format(" {}", whence(field.size_source));
  }
  return words;
}

EarthFieldWatch::EarthFieldWatch(const config::EnvironmentSettings& settings)
    : settings_(settings), field_(settings) {}

bool EarthFieldWatch::take(const instruments::GpsSample& fix) {
  if (!has_position(fix) || !fix.time_utc_ns) return false;
  const FieldPlace here{*fix.latitude_rad, *fix.longitude_rad, *fix.time_utc_ns};
  if (place_) {
    const double north_rad = here.latitude_rad - place_->latitude_rad;
    const double east_rad = std::remainder(here.longitude_rad - place_->longitude_rad, 2 * std::numbers::pi) *
                            std::cos(here.latitude_rad);
    if (std::hypot(north_rad, east_rad) < kStep_rad && std::abs(here.time_utc_ns - place_->time_utc_ns) < kStep_ns)
      return false;
  }
  return go_on_at(here);
}

bool EarthFieldWatch::go_on_at(const FieldPlace& place) {
  if (is_complete(settings_)) return false;
  const double year = base::decimal_year(place.time_utc_ns);
  if (!base::wmm_covers(year)) return false;
  place_ = place;
  const auto model = base::world_magnetic_field({place.latitude_rad, place.longitude_rad, 0}, year);
  if (settings_.declination_rad == 0) {
    field_.declination_rad = model.declination_rad();
    field_.declination_source = Source::model;
  }
  if (!(settings_.field_uT > 0)) {
    field_.size_uT = model.total_uT();
    field_.dip_rad = model.dip_rad();
    field_.size_source = Source::model;
  }
  return true;
}

}  // namespace navcal::pipeline
