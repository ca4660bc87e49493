// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "pipeline/battery.h"

namespace navcal::record {

/// Appends one JSON object (no newline) of class BATTERY (docs/battery.md); `device`: the name of its port. Live
/// log, status socket and replay share it, so they agree to the byte.
void append_json(std::string& out, const pipeline::BatterySample& sample, std::string_view device);

/// Message of the event battery.set: "3.7 Ah, std 0.074 Ah, by command".
[[nodiscard]] std::string battery_event_words(const pipeline::BatteryCharge& charge, std::string_view cause);
/// The charge in such a message; nullopt when it is none.
[[nodiscard]] std::optional<pipeline::BatteryCharge> battery_event_charge(std::string_view words);

}  // namespace navcal::record
