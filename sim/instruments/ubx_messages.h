// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "sim/instruments/gps_receiver.h"

namespace navcal::sim {

/// The epoch of a u-blox receiver by its own knowledge.
struct UbxEpoch {
  std::int64_t utc_ns = 0;          ///< to which the receiver rounds it
  std::int64_t clock_error_ns = 0;  ///< by which it was measured later
  int leap_seconds = 18;
  bool knows_time = false;
};

[[nodiscard]] std::vector<std::uint8_t> pvt_message(const GpsReading& reading, const UbxEpoch& epoch,
                                                    const devices::GpsModel& gps);
[[nodiscard]] std::vector<std::uint8_t> dop_message(const GpsReading& reading, const UbxEpoch& epoch);
[[nodiscard]] std::vector<std::uint8_t> timegps_message(const UbxEpoch& epoch);
[[nodiscard]] std::vector<std::uint8_t> sat_message(const GpsReading& reading, const UbxEpoch& epoch);
/// `takes_valset`: of generation 9.
[[nodiscard]] std::vector<std::uint8_t> version_message(bool takes_valset);

}  // namespace navcal::sim
