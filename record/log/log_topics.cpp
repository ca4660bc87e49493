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

constexpr Field word(std::string_view name, std::string_view long_name) {
  return {name, text, "", "", "", long_name};
}
constexpr Field flag(std::string_view name, std::string_view long_name) {
  return {name, boolean, "", "", "", long_name};
}
constexpr Field quantity(std::string_view name, std::string_view units, std::string_view long_name,
                         std::string_view standard_name = {}) {
  return {name, number, "", units, standard_name, long_name};
}

// Members of several topics.
constexpr Field kValidity{"time", number, "s", "", "time", "time of validity"};
constexpr Field kValidityStd{"time_std", number, "s", "s", "", "standard error of the time of validity"};
constexpr Field kArrival{"arrival", number, "s", "", "", "arrival of the last byte"};
constexpr Field kMonotonic{"monotonic", number, "s", "ns", "", "the same instant on the monotonic clock"};
constexpr Field kDevice = word("device", "port of the configuration");
constexpr Field kCalibration = word("calibration", "calibration in force");

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
  return {field.key,
          kKindOf<T>,
          is_degrees ? std::string_view("deg") : std::string_view(),
          field.quantity.units,
          field.cf_name,
          field.description};
}

constexpr Field field_of_samples(std::string_view key) {
  Field found;
  instruments::for_each_kind([&]<class Sample>(std::type_identity<Sample>) {
    instruments::for_each_field<Sample>([&](const auto& field) {
      if (field.key == key && !field.description.empty()) found = field_of(field);
    });
  });
  return found;
}

/// A member with its description, or else with that of the same key of another kind.
template <class Owner, class T>
constexpr Field described(const instruments::kind::Field<Owner, T>& field) {
  return field.description.empty() ? field_of_samples(field.key) : field_of(field);
}

/// The members that all samples have, around those of their own.
template <std::size_t N>
constexpr std::array<Field, N + 5> sample_fields(const Field (&own)[N]) {
  std::array<Field, N + 5> fields{kValidity, kValidityStd, kArrival, kDevice};
  std::copy(own, own + N, fields.begin() + 4);
  fields.back() = kCalibration;
  return fields;
}

template <class Sample>
constexpr auto kFieldsOf = std::apply([](const auto&... field) { return sample_fields({described(field)...}); },
                                      instruments::kKind<Sample>.fields);

constexpr std::array kConfig{kValidity, kMonotonic, Field{"toml", text}};
constexpr std::array kSomeJson{kValidity};
constexpr std::array kTimeFields{kValidity,
                                 kMonotonic,
                                 word("source", "whence UTC is known"),
                                 Field{"offset", number, "s", "ns", "", "UTC less monotonic time"},
                                 Field{"bound", number, "s", "s", "", "bound of the error of UTC"},
                                 Field{"at", number, "s", "ns", "", "when it was found, on the monotonic clock"}};

constexpr std::array kEvent{kValidity,
                            kMonotonic,
                            word("severity", "info, warning, error or alarm"),
                            word("name", "short name of the event"),
                            word("port", "port of the configuration"),
                            word("message", "what happened, in words")};

constexpr std::array kBattery{kValidity,
                              kValidityStd,
                              kArrival,
                              kDevice,
                              field_of_samples("voltage_V"),
                              field_of_samples("current_A"),
                              flag("current_measured", "the current is that of a gauge of the whole vehicle"),
                              quantity("charge_Ah", "A h", "charge left"),
                              quantity("charge_std_Ah", "A h", "standard error of the charge left"),
                              quantity("charge_percent", "percent", "charge left, of the capacity"),
                              quantity("energy_Wh", "W h", "energy left, at the nominal voltage"),
                              quantity("time_left_s", "s", "time left at the mean load"),
                              quantity("range_left_m", "m", "way left at the mean load and speed"),
                              flag("low", "the battery is low")};

constexpr std::array kCommandFields{
    kValidity,
    kMonotonic,
    kDevice,
    word("outcome", "what became of the order"),
    word("source", "what caused the line: an order, the ramp to it, the safe state"),
    quantity("sequence", "1", "number of the order"),
    word("holder", "controller in charge"),
    quantity("priority", "1", "priority of the controller"),
    Field{"asked", number, "s", "s", "", "arrival of the order at the control socket, UTC"},
    Field{"sent", number, "s", "s", "", "time at which the line was on the wire, UTC"},
    Field{"echoed", number, "s", "s", "", "arrival of the status that shows the line, UTC"},
    quantity("late_s", "s", "arrival of the order after the state that it answers"),
    quantity("shaft_rpm", "rpm", "shaft speed ordered"),
    Field{"fins_deg", vector3, "", "degree", "", "fin angles ordered"},
    quantity("shaft_sent_rpm", "rpm", "shaft speed on the wire"),
    Field{"fins_sent_deg", vector3, "", "degree", "", "fin angles on the wire"},
    word("reason", "why the order was refused"),
    quantity("refused_since", "1", "refusals before this one without a record")};

constexpr auto kNav = sample_fields(
    {word("position", "whence the position is"),
     field_of_samples("lat"),
     field_of_samples("lon"),
     quantity("north_std_m", "m", "standard error of the position northward"),
     quantity("east_std_m", "m", "standard error of the position eastward"),
     quantity("since_fix_s", "s", "time since the last fix"),
     quantity("since_fix_m", "m", "way since the last fix, through the water or over the bottom"),
     field_of_samples("depth_m"),
     field_of_samples("depth_std_m"),
     quantity("heading_rad", "radian", "heading from true north", "platform_orientation"),
     field_of_samples("heading_std_rad"),
     field_of_samples("pitch_rad"),
     field_of_samples("roll_rad"),
     quantity("speed_m_s", "m s-1", "speed through the water", "platform_speed_wrt_sea_water"),
     word("speed_source", "instrument whose velocity moves the position"),
     flag("bottom_lock", "whether the Doppler log measures over the bottom"),
     quantity("dvl_outliers", "1", "velocities of the Doppler log that were passed over, so far"),
     Field{"velocity_m_s", vector3, "", "m s-1", "", "velocity over ground (north, east, down)"},
     quantity("set_north_m_s", "m s-1", "set northward"),
     quantity("set_east_m_s", "m s-1", "set eastward"),
     field_of_samples("altitude_m"),
     field_of_samples("altitude_std_m"),
     quantity("water_depth_m", "m", "depth of the water", "sea_floor_depth_below_sea_surface"),
     quantity("outage_s", "s", "duration of the stretch without fixes that has ended"),
     quantity("outage_m", "m", "way through the water in it"),
     quantity("outage_error_m", "m", "distance of the reckoned position from the fix that ended it"),
     quantity("outage_std_m", "m", "standard error of that distance, as stated before the fix"),
     quantity("outage_error_uncalibrated_m", "m", "the same without calibrations"),
     quantity("submerged_s", "s", "time under water before the surfacing that this fix ended"),
     quantity("deepest_m", "m", "greatest depth of that dive"),
     quantity("ttff_s", "s", "time from surfacing to the first fix"),
     quantity("fix_visible", "1", "satellites in view at the first fix"),
     quantity("fix_tracked", "1", "satellites tracked at the first fix"),
     quantity("fix_dop", "1", "dilution of precision of the first fix"),
     quantity("predicted_error_m", "m", "95 % radius of the position at a first fix after surfacing now"),
     quantity("surface_within_s", "s", "time left to surface with that radius below the bound")});

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

Field sample_field(std::string_view key) { return field_of_samples(key); }

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
