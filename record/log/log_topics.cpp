// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_topics.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "base/enum_name.h"
#include "base/line_reader.h"
#include "base/text_rows.h"
#include "instruments/sample_fields.h"

namespace navcal::record {

const char* topic_rows();  // topics.txt

namespace {

using enum FieldKind;

/// As JSON schemas name them; a vector is an array there.
std::string_view name_of(FieldKind kind) {
  return base::enum_name<vector3>(kind, {"number", "boolean", "string", "vector3"});
}

template <class T>
constexpr FieldKind kKindOf = text;
template <>
constexpr FieldKind kKindOf<double> = number;
template <>
constexpr FieldKind kKindOf<std::uint8_t> = number;
template <>
constexpr FieldKind kKindOf<bool> = boolean;
template <>
constexpr FieldKind kKindOf<instruments::Vector3> = vector3;
template <>
constexpr FieldKind kKindOf<std::array<std::optional<double>, 3>> = vector3;
template <class T>
constexpr FieldKind kKindOf<std::optional<T>> = kKindOf<T>;

/// The rows of topics.txt of a topic.
std::vector<std::array<std::string_view, 6>> rows_of(std::string_view topic) {
  std::vector<std::array<std::string_view, 6>> rows;
  for (auto [of, rest] : base::text_rows(topic_rows(), "|")) {
    if (of != topic) continue;
    for (std::string_view& word : rows.emplace_back()) word = base::take_until(rest, "|");
  }
  return rows;
}

template <class Owner, class T>
Field field_of(const instruments::kind::Field<Owner, T>& field) {
  const bool is_degrees = field.quantity.form == instruments::Form::degrees;
  Field made{field.key, kKindOf<T>, is_degrees ? "deg" : "", field.quantity.units};
  for (const auto& [name, kind, unit, units, standard_name, long_name] : rows_of("members")) {
    if (name != field.key) continue;
    made.standard_name = standard_name;
    made.long_name = long_name;
  }
  return made;
}

/// The members of a topic by topics.txt.
std::vector<Field> fields_of(std::string_view topic) {
  std::vector<Field> fields;
  for (const auto& [name, kind, unit, units, standard_name, long_name] : rows_of(topic)) {
    const auto found = base::enum_named<vector3>(kind, name_of);
    fields.push_back(found ? Field{name, *found, unit, units, standard_name, long_name} : sample_field(name));
  }
  return fields;
}

/// The members that all samples have, around those of their own.
template <class Sample>
std::vector<Field> fields_of() {
  std::vector<Field> fields = fields_of("samples");
  instruments::for_each_field<Sample>(
      [&](const auto& field) { fields.insert(fields.end() - 1, field_of(field)); });
  return fields;
}

nlohmann::ordered_json schema_of(const Field& field) {
  nlohmann::ordered_json schema{{"type", name_of(field.kind)}};
  if (field.kind == vector3) schema = {{"type", "array"}, {"items", {{"type", "number"}}}};
  if (!field.unit.empty()) schema["description"] = field.unit;
  return schema;
}

}  // namespace

Field sample_field(std::string_view key) {
  static const std::vector<Field> kShared = fields_of("any");
  if (const auto shared = std::ranges::find(kShared, key, &Field::name); shared != kShared.end()) return *shared;
  Field found;
  instruments::for_each_kind([&]<class Sample>(std::type_identity<Sample>) {
    instruments::for_each_field<Sample>([&](const auto& field) {
      if (field.key == key) found = field_of(field);
    });
  });
  return found;
}

std::span<const Topic> json_topics() {
  static const std::vector<Topic> kTopics{
      {topic::kConfig, "/config", "navcal.Config", fields_of("/config")},
      {topic::kTime, "/time", "navcal.Time", fields_of("/time")},
      {topic::kEvent, "/event", "navcal.Event", fields_of("/event")},
      {topic::kHealth, "/health", "navcal.Health", fields_of("/health")},
      {topic::kCalib, "/calib", "navcal.Calib", fields_of("/calib")},
      {topic::kCompass, "/compass", "navcal.Compass", fields_of<instruments::CompassSample>()},
      {topic::kImu, "/imu", "navcal.Imu", fields_of<instruments::ImuSample>()},
      {topic::kGps, "/gps", "navcal.Gps", fields_of<instruments::GpsSample>()},
      {topic::kMotor, "/motor", "navcal.Motor", fields_of<instruments::MotorSample>()},
      {topic::kAltimeter, "/altimeter", "navcal.Altimeter", fields_of<instruments::AltimeterSample>()},
      {topic::kNav, "/nav", "navcal.Nav", fields_of("/nav")},
      {topic::kCommand, "/command", "navcal.Command", fields_of("/command")},
      {topic::kPower, "/power", "navcal.Power", fields_of<instruments::PowerSample>()},
      {topic::kBattery, "/battery", "navcal.Battery", fields_of("/battery")},
      {topic::kDvl, "/dvl", "navcal.Dvl", fields_of<instruments::DvlSample>()},
      {topic::kDepth, "/depth", "navcal.Depth", fields_of<instruments::DepthSample>()},
      {topic::kSensor, "/sensor", "navcal.Sensor", fields_of<instruments::ScalarSample>()},
  };
  return kTopics;
}

const Topic* json_topic(std::string_view name) {
  const auto found = std::ranges::find(json_topics(), name, &Topic::name);
  return found != json_topics().end() ? &*found : nullptr;
}

std::string json_schema(const Topic& topic) {
  nlohmann::ordered_json schema;
  schema["title"] = topic.schema_name;
  schema["type"] = "object";
  auto& properties = schema["properties"];
  properties["class"] = schema_of(Field{"class", text});
  for (const Field& field : topic.fields) properties[std::string(field.name)] = schema_of(field);
  properties["crc"] = schema_of(Field{"crc", text});
  return schema.dump();
}

}  // namespace navcal::record
