// SPDX-License-Identifier: Apache-2.0
#include "record/json/navigation_json.h"

#include "base/angles.h"
#include "record/json/json_object.h"
#include "record/json/sample_head.h"

namespace navcal::record {
namespace {

std::optional<double> degrees_of(const std::optional<double>& rad) {
  if (!rad) return std::nullopt;
  return *rad * base::kDegreesPerRadian;
}

/// The value if a position is known.
std::optional<double> of_position(const nav::Estimate& estimate, double value) {
  if (!estimate.position_m) return std::nullopt;
  return value;
}

void append_speed_source(JsonObject& json, const pipeline::NavigationSample& sample) {
  if (const auto name = pipeline::name_of(sample.estimate.speed_source); !name.empty()) {
    json.text("speed_source", name);
  } else {
    json.null("speed_source");
  }
  if (sample.bottom_lock) {
    json.boolean("bottom_lock", *sample.bottom_lock);
    json.integer("dvl_outliers", static_cast<std::int64_t>(sample.estimate.velocity_outliers));
  } else {
    json.null("bottom_lock");
    json.null("dvl_outliers");
  }
}

void append_outage(JsonObject& json, const pipeline::NavigationSample& sample) {
  const auto& outage = sample.outage;
  json.number("outage_s", outage ? std::optional(outage->duration_s) : std::nullopt);
  json.number("outage_m", outage ? std::optional(outage->distance_m) : std::nullopt);
  json.number("outage_error_m", outage ? std::optional(outage->error_m) : std::nullopt);
  json.number("outage_std_m", outage ? std::optional(outage->std_m) : std::nullopt);
  json.number("outage_error_uncalibrated_m", sample.outage_error_uncalibrated_m);
}

void append_surfacing(JsonObject& json, const std::optional<pipeline::Surfacing>& surfacing) {
  const auto count = [](const std::optional<std::uint8_t>& satellites) {
    return satellites ? std::optional<double>(*satellites) : std::nullopt;
  };
  json.number("submerged_s", surfacing ? surfacing->submerged_s() : std::nullopt);
  json.number("deepest_m", surfacing ? surfacing->deepest_m : std::nullopt);
  json.number("ttff_s", surfacing ? surfacing->time_to_first_fix_s() : std::nullopt);
  json.number("fix_visible", surfacing ? count(surfacing->visible) : std::nullopt);
  json.number("fix_tracked", surfacing ? count(surfacing->tracked) : std::nullopt);
  json.number("fix_dop", surfacing ? surfacing->dop : std::nullopt);
}

}  // namespace

void append_json(std::string& out, const pipeline::NavigationSample& sample) {
  const auto& estimate = sample.estimate;
  JsonObject json(out, "NAV");
  append_head(json, sample.stamp, pipeline::kNavigationDevice);
  json.text("position", name_of(sample.source));
  json.number("lat", degrees_of(sample.latitude_rad));
  json.number("lon", degrees_of(sample.longitude_rad));
  json.number("north_std_m", of_position(estimate, estimate.position_std_m.x()));
  json.number("east_std_m", of_position(estimate, estimate.position_std_m.y()));
  json.number("since_fix_s", of_position(estimate, estimate.since_fix_s));
  json.number("since_fix_m", of_position(estimate, estimate.since_fix_m));
  json.number("depth_m", estimate.depth_m);
  json.number("heading_rad", estimate.heading_rad);
  json.number("heading_std_rad", estimate.heading_rad ? std::optional(estimate.heading_std_rad) : std::nullopt);
  json.number("pitch_rad", estimate.pitch_rad);
  json.number("roll_rad", estimate.roll_rad);
  json.number("speed_m_s", estimate.speed_m_s);
  append_speed_source(json, sample);
  if (const auto& v = estimate.velocity_m_s) {
    json.numbers("velocity_m_s", std::array{v->x(), v->y(), v->z()});
  } else {
    json.null("velocity_m_s");
  }
  json.number("set_north_m_s", of_position(estimate, estimate.set_m_s.x()));
  json.number("set_east_m_s", of_position(estimate, estimate.set_m_s.y()));
  json.number("altitude_m", sample.altitude_m);
  json.number("altitude_std_m", sample.altitude_std_m);
  json.number("water_depth_m", sample.water_depth_m);
  append_outage(json, sample);
  append_surfacing(json, sample.surfacing);
  json.number("predicted_error_m", sample.advice ? std::optional(sample.advice->error_m) : std::nullopt);
  json.number("surface_within_s", sample.advice ? sample.advice->within_s : std::nullopt);
  append_calibration(json, sample.calibration);
}

}  // namespace navcal::record
