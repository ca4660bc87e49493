// SPDX-License-Identifier: Apache-2.0
#include "record/json/message_json.h"

#include <fmt/format.h>

#include <charconv>

#include "base/angles.h"
#include "instruments/sample_fields.h"
#include "record/json/json_object.h"

namespace navcal::record {
namespace {

// The members that samples of instruments and what is estimated of them have in common.
void append_head(JsonObject& json, const instruments::Stamp& stamp, std::string_view device) {
  json.seconds("time", stamp.validity_utc_ns);
  json.seconds("time_std", stamp.std_ns);
  json.seconds("arrival", stamp.arrival_utc_ns);
  json.text("device", device);
}

void append_calibration(JsonObject& json, instruments::CalibrationName name) {
  if (name.number == 0) {
    json.null("calibration");
  } else {
    json.text("calibration", calibration_text(name));
  }
}

using instruments::Form;

/// A member as its type is written.
struct MemberJson {
  JsonObject& json;
  std::string_view key;
  Form form;

  void operator()(double value) const { json.number(key, value); }
  void operator()(const std::optional<double>& value) const {
    json.number(key, form == Form::degrees && value ? std::optional(*value * base::kDegreesPerRadian) : value);
  }
  void operator()(const std::array<std::optional<double>, 3>& values) const { json.numbers(key, values); }
  void operator()(const instruments::Vector3& values) const { json.numbers(key, values); }
  void operator()(bool value) const { json.boolean(key, value); }
  void operator()(std::uint8_t count) const { json.integer(key, count); }
  void operator()(std::uint32_t code) const { json.text(key, fmt::format("{:03X}", code)); }
  void operator()(instruments::Fix fix) const { json.text(key, name_of(fix)); }
  void operator()(instruments::VelocityFrame frame) const { json.text(key, name_of(frame)); }
  template <std::size_t Size>
  void operator()(const instruments::Text<Size>& words) const {
    json.text(key, words.view());
  }
  template <class T>
  void operator()(const std::optional<T>& value) const {
    value ? (*this)(*value) : json.null(key);
  }
};

template <class Sample>
void append_members(JsonObject& json, const Sample& sample) {
  instruments::for_each_field<Sample>([&](const auto& field) {
    const auto* const member = instruments::member_of(sample, field);
    member != nullptr ? MemberJson{json, field.key, field.quantity.form}(*member) : json.null(field.key);
  });
}

void append_members(JsonObject& json, const instruments::SkySample& sky) {
  std::int64_t used = 0;
  for (std::size_t i = 0; i < sky.count; ++i) used += sky.satellites[i].used ? 1 : 0;
  json.integer("visible", static_cast<std::int64_t>(sky.count));
  json.integer("used", used);
}

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

std::string calibration_text(instruments::CalibrationName name) {
  return fmt::format("{}-{:08x}", name.number, name.sum);
}

void append_json(std::string& out, const instruments::Sample& sample, std::string_view device) {
  std::visit(
      [&]<class Kind>(const Kind& value) {
        JsonObject json(out, instruments::kKind<Kind>.class_name);
        append_head(json, sample.stamp, device);
        append_members(json, value);
        append_calibration(json, sample.calibration);
      },
      sample.value);
}

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
  json.number("depth_std_m", estimate.depth_std_m);
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

void append_json(std::string& out, const pipeline::BatterySample& sample, std::string_view device) {
  const auto of_charge = [&](double factor) -> std::optional<double> {
    if (!sample.charge) return std::nullopt;
    return sample.charge->charge_Ah * factor;
  };
  JsonObject json(out, "BATTERY");
  append_head(json, sample.stamp, device);
  json.number("voltage_V", sample.voltage_V);
  json.number("current_A", sample.current_A);
  json.boolean("current_measured", sample.current_is_measured);
  json.number("charge_Ah", of_charge(1));
  json.number("charge_std_Ah", sample.charge ? std::optional(sample.charge->std_Ah) : std::nullopt);
  json.number("charge_percent", of_charge(100 / sample.capacity_Ah));
  json.number("energy_Wh", of_charge(sample.nominal_V));
  json.number("time_left_s", sample.time_left_s);
  json.number("range_left_m", sample.range_left_m);
  json.boolean("low", sample.low);
}

std::string battery_event_words(const pipeline::BatteryCharge& charge, std::string_view cause) {
  return fmt::format("{} Ah, std {} Ah, {}", charge.charge_Ah, charge.std_Ah, cause);
}

std::optional<pipeline::BatteryCharge> battery_event_charge(std::string_view words) {
  constexpr std::string_view kBetween = " Ah, std ";
  pipeline::BatteryCharge charge;
  const char* const last = words.data() + words.size();
  const auto first = std::from_chars(words.data(), last, charge.charge_Ah);
  if (first.ec != std::errc{}) return std::nullopt;
  const std::string_view rest(first.ptr, static_cast<std::size_t>(last - first.ptr));
  if (!rest.starts_with(kBetween)) return std::nullopt;
  const auto second = std::from_chars(rest.data() + kBetween.size(), last, charge.std_Ah);
  return second.ec == std::errc{} ? std::optional(charge) : std::nullopt;
}

void append_json(std::string& out, const pipeline::UtcMapping& mapping, std::int64_t now_ns,
                 std::string_view device, const control::OrderRecord& record) {
  JsonObject json(out, "COMMAND");
  const auto utc = [&](std::string_view key, const std::optional<std::int64_t>& at_ns) {
    at_ns ? json.seconds(key, mapping.to_utc(*at_ns)) : json.null(key);
  };
  utc("time", record.sent_ns ? record.sent_ns : record.asked_ns);
  json.seconds("monotonic", now_ns);
  json.text("device", device);
  json.text("outcome", name_of(record.outcome));
  json.text("source", name_of(record.source));
  json.integer("sequence", static_cast<std::int64_t>(record.sequence));
  json.text("holder", record.holder);
  record.priority ? json.integer("priority", *record.priority) : json.null("priority");
  utc("asked", record.asked_ns);
  utc("sent", record.sent_ns);
  utc("echoed", record.echoed_ns);
  json.number("late_s", record.late_s);
  json.number("shaft_rpm", record.wanted.shaft_rpm);
  json.numbers("fins_deg", record.wanted.fins_deg);
  if (record.sent) {
    json.integer("shaft_sent_rpm", record.sent->rpm);
    json.numbers("fins_sent_deg", record.sent->fins_deg);
  } else {
    json.null("shaft_sent_rpm");
    json.null("fins_sent_deg");
  }
  json.text("reason", record.reason);
  json.integer("refused_since", static_cast<std::int64_t>(record.refused_since));
}

void append_event_json(std::string& out, const pipeline::UtcMapping& mapping, std::int64_t now_ns,
                       std::string_view severity, std::string_view name, std::string_view port,
                       std::string_view message) {
  JsonObject json(out, "EVENT");
  json.seconds("time", mapping.to_utc(now_ns));
  json.seconds("monotonic", now_ns);
  json.text("severity", severity);
  json.text("name", name);
  json.text("port", port);
  json.text("message", message);
}

}  // namespace navcal::record
