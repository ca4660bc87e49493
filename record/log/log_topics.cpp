// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_topics.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "instruments/sample_fields.h"

namespace navcal::record {
namespace {

using enum FieldKind;

constexpr std::array kConfig{Field{"time", number, "s"}, Field{"monotonic", number, "s"}, Field{"toml", text}};

constexpr std::array kTimeFields{Field{"time", number, "s"},  Field{"monotonic", number, "s"},
                                 Field{"source", text},       Field{"offset", number, "s"},
                                 Field{"bound", number, "s"}, Field{"at", number, "s"}};

constexpr std::array kEvent{Field{"time", number, "s"}, Field{"monotonic", number, "s"},
                            Field{"severity", text},    Field{"name", text},
                            Field{"port", text},        Field{"message", text}};

constexpr std::array kSomeJson{Field{"time", number, "s"}};

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

template <class Owner, class T>
constexpr Field field_of(const instruments::kind::Field<Owner, T>& field) {
  const bool is_degrees = field.quantity.form == instruments::Form::degrees;
  return {field.key, kKindOf<T>, is_degrees ? std::string_view("deg") : std::string_view()};
}

/// The members that all samples have, around those of their own.
template <std::size_t N>
constexpr std::array<Field, N + 5> sample_fields(const Field (&own)[N]) {
  std::array<Field, N + 5> fields{Field{"time", number, "s"}, Field{"time_std", number, "s"},
                                  Field{"arrival", number, "s"}, Field{"device", text}};
  std::copy(own, own + N, fields.begin() + 4);
  fields.back() = Field{"calibration", text};
  return fields;
}

template <class Sample>
constexpr auto kFieldsOf = std::apply([](const auto&... field) { return sample_fields({field_of(field)...}); },
                                      instruments::kKind<Sample>.fields);

constexpr std::array kBattery{Field{"time", number, "s"},
                              Field{"time_std", number, "s"},
                              Field{"arrival", number, "s"},
                              Field{"device", text},
                              Field{"voltage_V"},
                              Field{"current_A"},
                              Field{"current_measured", boolean},
                              Field{"charge_Ah"},
                              Field{"charge_std_Ah"},
                              Field{"charge_percent"},
                              Field{"energy_Wh"},
                              Field{"time_left_s"},
                              Field{"range_left_m"},
                              Field{"low", boolean}};

constexpr auto kNav = sample_fields({Field{"position", text},
                                     Field{"lat", number, "deg"},
                                     Field{"lon", number, "deg"},
                                     Field{"north_std_m"},
                                     Field{"east_std_m"},
                                     Field{"since_fix_s"},
                                     Field{"since_fix_m"},
                                     Field{"depth_m"},
                                     Field{"depth_std_m"},
                                     Field{"heading_rad"},
                                     Field{"heading_std_rad"},
                                     Field{"pitch_rad"},
                                     Field{"roll_rad"},
                                     Field{"speed_m_s"},
                                     Field{"speed_source", text},
                                     Field{"bottom_lock", boolean},
                                     Field{"dvl_outliers"},
                                     Field{"velocity_m_s", vector3},
                                     Field{"set_north_m_s"},
                                     Field{"set_east_m_s"},
                                     Field{"altitude_m"},
                                     Field{"altitude_std_m"},
                                     Field{"water_depth_m"},
                                     Field{"outage_s"},
                                     Field{"outage_m"},
                                     Field{"outage_error_m"},
                                     Field{"outage_std_m"},
                                     Field{"outage_error_uncalibrated_m"},
                                     Field{"submerged_s"},
                                     Field{"deepest_m"},
                                     Field{"ttff_s"},
                                     Field{"fix_visible"},
                                     Field{"fix_tracked"},
                                     Field{"fix_dop"},
                                     Field{"predicted_error_m"},
                                     Field{"surface_within_s"}});

constexpr std::array kCommandFields{Field{"time", number, "s"},   Field{"monotonic", number, "s"},
                                    Field{"device", text},        Field{"outcome", text},
                                    Field{"source", text},        Field{"sequence"},
                                    Field{"holder", text},        Field{"priority"},
                                    Field{"asked", number, "s"},  Field{"sent", number, "s"},
                                    Field{"echoed", number, "s"}, Field{"late_s"},
                                    Field{"shaft_rpm"},           Field{"fins_deg", vector3},
                                    Field{"shaft_sent_rpm"},      Field{"fins_sent_deg", vector3},
                                    Field{"reason", text},        Field{"refused_since"}};

constexpr std::array kTopics{
    Topic{topic::kConfig, "/config", "navcal.Config", kConfig},
    Topic{topic::kTime, "/time", "navcal.Time", kTimeFields},
    Topic{topic::kEvent, "/event", "navcal.Event", kEvent},
    Topic{topic::kHealth, "/health", "navcal.Health", kSomeJson},
    Topic{topic::kCalib, "/calib", "navcal.Calib", kSomeJson},
    Topic{topic::kCompass, "/compass", "navcal.Compass", kFieldsOf<instruments::CompassSample>},
    Topic{topic::kImu, "/imu", "navcal.Imu", kFieldsOf<instruments::ImuSample>},
    Topic{topic::kGps, "/gps", "navcal.Gps", kFieldsOf<instruments::GpsSample>},
    Topic{topic::kMotor, "/motor", "navcal.Motor", kFieldsOf<instruments::MotorSample>},
    Topic{topic::kAltimeter, "/altimeter", "navcal.Altimeter", kFieldsOf<instruments::AltimeterSample>},
    Topic{topic::kNav, "/nav", "navcal.Nav", kNav},
    Topic{topic::kCommand, "/command", "navcal.Command", kCommandFields},
    Topic{topic::kPower, "/power", "navcal.Power", kFieldsOf<instruments::PowerSample>},
    Topic{topic::kBattery, "/battery", "navcal.Battery", kBattery},
    Topic{topic::kDvl, "/dvl", "navcal.Dvl", kFieldsOf<instruments::DvlSample>},
    Topic{topic::kDepth, "/depth", "navcal.Depth", kFieldsOf<instruments::DepthSample>},
    Topic{topic::kSensor, "/sensor", "navcal.Sensor", kFieldsOf<instruments::ScalarSample>},
};

nlohmann::ordered_json schema_of(const Field& field) {
  nlohmann::ordered_json schema;
  switch (field.kind) {
    case number: schema["type"] = "number"; break;
    case boolean: schema["type"] = "boolean"; break;
    case text: schema["type"] = "string"; break;
    case vector3:
      schema["type"] = "array";
      schema["items"]["type"] = "number";
      break;
  }
  if (!field.unit.empty()) schema["description"] = field.unit;
  return schema;
}

}  // namespace

std::span<const Topic> json_topics() { return kTopics; }

const Topic* json_topic(std::string_view name) {
  for (const Topic& candidate : kTopics) {
    if (candidate.name == name) return &candidate;
  }
  return nullptr;
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
