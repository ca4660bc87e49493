// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::record {

enum class FieldKind : std::uint8_t { number, boolean, text, vector3 };

/// One member of a topic's messages, with its meaning in the terms of the CF conventions.
struct Field {
  std::string_view name;
  FieldKind kind = FieldKind::number;
  std::string_view unit{};           ///< where the name does not say it
  std::string_view units{};          ///< as UDUNITS reads them; empty of a text or a yes and no
  std::string_view standard_name{};  ///< of the CF table; empty where it has none
  std::string_view long_name{};
};

/// One topic whose messages are JSON. Its number is that of its channel and of its schema.
struct Topic {
  std::uint16_t id = 0;
  std::string_view name;
  std::string_view schema_name;
  std::vector<Field> fields;  ///< besides "class" and "crc"; /health and /calib have more than is listed
};

namespace topic {
inline constexpr std::uint16_t kConfig = 1, kTime = 2, kEvent = 3, kHealth = 4, kCalib = 5, kCompass = 6, kImu = 7,
                               kGps = 8, kMotor = 9, kAltimeter = 10, kNav = 11, kCommand = 12, kPower = 13,
                               kBattery = 14, kDvl = 15, kDepth = 16, kSensor = 17;
/// Channel of the raw bytes of the first port; the others follow. Readers go by the names of the channels.
inline constexpr std::uint16_t kFirstRaw = 32;
inline constexpr std::string_view kRawPrefix = "/raw/";
}  // namespace topic

[[nodiscard]] std::span<const Topic> json_topics();
/// Null for a raw channel.
[[nodiscard]] const Topic* json_topic(std::string_view name);

/// The member of samples that has this name.
[[nodiscard]] Field sample_field(std::string_view name);

/// JSON schema in the dialect that Foxglove reads (a single type for each member: null stands for "absent").
[[nodiscard]] std::string json_schema(const Topic& topic);

}  // namespace navcal::record
