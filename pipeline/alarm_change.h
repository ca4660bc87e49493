// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace navcal::pipeline {

/// Alarms that follow from an estimate, not from a bit of an instrument.
enum class EstimateAlarm : std::uint8_t { battery_low, floor_near };

struct AlarmChange {
  EstimateAlarm alarm{};
  bool raised = false;
  std::uint16_t port = 0;    ///< that of the instrument whose sample showed it
  std::int64_t time_ns = 0;  ///< arrival of that sample, monotonic
  std::string words{};       ///< the value and the limit, for people
};

}  // namespace navcal::pipeline
