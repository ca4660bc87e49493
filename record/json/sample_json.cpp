// SPDX-License-Identifier: Apache-2.0
#include "record/json/sample_json.h"

#include <fmt/format.h>

#include "base/angles.h"
#include "instruments/sample_fields.h"
#include "record/json/json_object.h"
#include "record/json/sample_head.h"

namespace navcal::record {
namespace {

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

}  // namespace

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

}  // namespace navcal::record
