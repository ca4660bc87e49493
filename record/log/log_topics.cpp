// SPDX-License-Identifier: Apache-2.0
#include "record/log/log_topics.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

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

/// The members that all samples have, around those of their own.
template <std::size_t N>
constexpr std::array<Field, N + 5> sample_fields(const Field (&own)[N]) {
  std::array<Field, N + 5> fields{Field{"time", number, "s"}, Field{"time_std", number, "s"},
                                  Field{"arrival", number, "s"}, Field{"device", text}};
  std::copy(own, own + N, fields.begin() + 4);
  fields.back() = Field{"calibration", text};
  return fields;
}

constexpr auto kCompass = sample_fields(
    {Field{"heading_rad"}, Field{"heading_calibrated_rad"}, Field{"heading_is_true", boolean}, Field{"pitch_rad"},
     Field{"roll_rad"}, Field{"field_body_uT", vector3}, Field{"dip_rad"}, Field{"turn_rate_rad_s"},
     Field{"temperature_C"}, Field{"error", text}, Field{"tilt_by_accelerometers", boolean},
     Field{"heading_std_rad"}, Field{"tilt_std_rad"}, Field{"field_std_uT"}});

constexpr auto kImu =
    sample_fields({Field{"rate_rad_s", vector3}, Field{"yaw_rate_b_rad_s"}, Field{"yaw_rate_calibrated_rad_s"},
                   Field{"yaw_rate_b_calibrated_rad_s"}, Field{"specific_force_m_s2", vector3}, Field{"depth_m"},
                   Field{"sequence"}, Field{"leak_forward", boolean}, Field{"leak_aft", boolean},
                   Field{"low_supply", boolean}, Field{"over_range", boolean}, Field{"temperature_C"},
                   Field{"rate_std_rad_s"}, Field{"specific_force_std_m_s2"}, Field{"depth_std_m"}});

constexpr auto kGps = sample_fields(
    {Field{"lat", number, "deg"}, Field{"lon", number, "deg"}, Field{"speed_m_s"}, Field{"course_rad"},
     Field{"fix", text}, Field{"height_m"}, Field{"height_msl_m"}, Field{"climb_m_s"}, Field{"dop"},
     Field{"visible"}, Field{"tracked"}, Field{"time_corrected", boolean}, Field{"leap_known", boolean},
     Field{"position_std_m"}, Field{"height_std_m"}, Field{"velocity_std_m_s"}});

constexpr auto kMotor =
    sample_fields({Field{"rpm"}, Field{"rpm_commanded"}, Field{"fins_rad", vector3}, Field{"current_A"},
                   Field{"sequence"}, Field{"fins_std_rad"}, Field{"current_std_A"}});

constexpr auto kAltimeter = sample_fields({Field{"altitude_m"}, Field{"altitude_std_m"}});

constexpr auto kPower = sample_fields({Field{"voltage_V"}, Field{"current_A"}});

constexpr auto kDvl =
    sample_fields({Field{"frame", text}, Field{"bottom_velocity_m_s", vector3}, Field{"bottom_velocity_std_m_s"},
                   Field{"water_velocity_m_s", vector3}, Field{"water_velocity_std_m_s"}, Field{"altitude_m"},
                   Field{"altitude_std_m"}, Field{"temperature_C"}, Field{"sound_speed_m_s"}});

constexpr auto kDepth = sample_fields({Field{"depth_m"}, Field{"depth_std_m"}, Field{"pressure_Pa"},
                                       Field{"pressure_std_Pa"}, Field{"temperature_C"}});

constexpr auto kSensor =
    sample_fields({Field{"quantity", text}, Field{"unit", text}, Field{"value"}, Field{"value_std"}});

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
    Topic{topic::kCompass, "/compass", "navcal.Compass", kCompass},
    Topic{topic::kImu, "/imu", "navcal.Imu", kImu},
    Topic{topic::kGps, "/gps", "navcal.Gps", kGps},
    Topic{topic::kMotor, "/motor", "navcal.Motor", kMotor},
    Topic{topic::kAltimeter, "/altimeter", "navcal.Altimeter", kAltimeter},
    Topic{topic::kNav, "/nav", "navcal.Nav", kNav},
    Topic{topic::kCommand, "/command", "navcal.Command", kCommandFields},
    Topic{topic::kPower, "/power", "navcal.Power", kPower},
    Topic{topic::kBattery, "/battery", "navcal.Battery", kBattery},
    Topic{topic::kDvl, "/dvl", "navcal.Dvl", kDvl},
    Topic{topic::kDepth, "/depth", "navcal.Depth", kDepth},
    Topic{topic::kSensor, "/sensor", "navcal.Sensor", kSensor},
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
