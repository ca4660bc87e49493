// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "control/order.h"
#include "instruments/samples.h"
#include "pipeline/battery.h"
#include "pipeline/navigation.h"
#include "pipeline/utc_mapping.h"

/// The messages of the log in JSON. Live log, status socket and replay share these functions, so they agree to the
/// byte.
namespace navcal::record {

/// "7-1a2b3c4d"; the number must not be 0.
[[nodiscard]] std::string calibration_text(instruments::CalibrationName name);

/// Appends one JSON object (no newline) with the keys of docs/cli.md's `replay`: class, time, time_std, arrival,
/// device, then SI values; absent optionals are null.
void append_json(std::string& out, const instruments::Sample& sample, std::string_view device);

/// Appends one JSON object (no newline) of class NAV (docs/navigation.md).
void append_json(std::string& out, const pipeline::NavigationSample& sample);

/// Appends one JSON object (no newline) of class BATTERY (docs/battery.md); `device`: the name of its port.
void append_json(std::string& out, const pipeline::BatterySample& sample, std::string_view device);

/// Message of the event battery.set: "3.7 Ah, std 0.074 Ah, by command".
[[nodiscard]] std::string battery_event_words(const pipeline::BatteryCharge& charge, std::string_view cause);
/// The charge in such a message; nullopt when it is none.
[[nodiscard]] std::optional<pipeline::BatteryCharge> battery_event_charge(std::string_view words);

/// Appends what became of an order, COMMAND, as it stands in the log. `now_ns` monotonic: when that was known;
/// `device`: the motor card's port.
void append_json(std::string& out, const pipeline::UtcMapping& mapping, std::int64_t now_ns,
                 std::string_view device, const control::OrderRecord& record);

/// Appends an event as it stands in the log. `now_ns` monotonic; `port` empty: of no port.
void append_event_json(std::string& out, const pipeline::UtcMapping& mapping, std::int64_t now_ns,
                       std::string_view severity, std::string_view name, std::string_view port,
                       std::string_view message);

}  // namespace navcal::record
