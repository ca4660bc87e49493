// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "sim/instruments/gps_receiver.h"

namespace navcal::sim {

/// Time of a reading by the receiver's clock.
struct ReceiverTime {
  std::int64_t reported_ns = 0;  ///< UTC, or GPS time while the leap seconds are not known; rolled over or not
  int leap_seconds = 18;
  bool leap_seconds_known = true;
};

[[nodiscard]] std::vector<std::uint8_t> ha_message(const GpsReading& reading, const ReceiverTime& time);
[[nodiscard]] std::vector<std::uint8_t> ea_message(const GpsReading& reading, const ReceiverTime& time);
[[nodiscard]] std::vector<std::uint8_t> bb_message();
[[nodiscard]] std::vector<std::uint8_t> bo_message(const ReceiverTime& time);
[[nodiscard]] std::vector<std::uint8_t> cj_message();
/// GGA, RMC, GSA and GSV of one second.
[[nodiscard]] std::vector<std::uint8_t> nmea_sentences(const GpsReading& reading, const ReceiverTime& time);

}  // namespace navcal::sim
