// SPDX-License-Identifier: Apache-2.0
#include "fleet/causes/recording_identity.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>

#include "protocols/device_types.h"
#include "record/recording.h"

namespace navcal::fleet {
namespace {

/// UTC of the first bytes, by the first mapping of the recording.
std::optional<std::int64_t> began_utc_ns(record::Recording& recording) {
  std::optional<std::int64_t> first_ns;
  while (const auto entry = recording.next()) {
    if (const auto* read = std::get_if<record::RawRead>(&*entry); read != nullptr && !first_ns) {
      first_ns = read->time_ns;
    }
    if (const auto* change = std::get_if<record::MappingChange>(&*entry)) {
      return first_ns.value_or(change->time_ns) + change->mapping.offset_ns;
    }
  }
  return std::nullopt;
}

}  // namespace

nlohmann::ordered_json recording_identity(const std::filesystem::path& file) {
  const auto recording = record::Recording::open(file);
  std::string gyro, compass;
  for (const config::PortSettings& port : recording->settings().ports) {
    const protocols::Delivery delivers = protocols::device_row(port.protocol).delivers;
    if (delivers.rates && gyro.empty()) gyro = port.serial_number;
    if ((delivers.field || delivers.heading) && compass.empty()) compass = port.serial_number;
  }
  nlohmann::ordered_json json{{"vehicle_id", recording->settings().vehicle.id},
                              {"vehicle_name", recording->settings().vehicle.name},
                              {"gyro_serial", gyro},
                              {"compass_serial", compass}};
  const auto began = began_utc_ns(*recording);
  json["began_utc_ns"] = began ? nlohmann::ordered_json(*began) : nlohmann::ordered_json();
  return json;
}

}  // namespace navcal::fleet
