// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "instruments/clock_model.h"
#include "pipeline/utc_mapping.h"

namespace navcal::pipeline {

/// UTC from a GPS receiver's messages: each states the second it belongs to and begins on the wire one latency
/// later. The seconds are the ticks of a clock that is right, so what the clock model learns is our own monotonic
/// clock.
class GpsTimeWatch {
 public:
  explicit GpsTimeWatch(double latency_std_s) : latency_std_s_(latency_std_s), model_(1.0) {}

  /// `stated_utc_ns` whole or broken second of the message; `observed_ns` monotonic, less wire time and latency.
  /// `in_leap_second`: as second 60, which stated_utc_ns has as the midnight that follows it. Answers a mapping
  /// when it should replace the one in force.
  std::optional<UtcMapping> update(std::int64_t stated_utc_ns, std::int64_t observed_ns,
                                   const UtcMapping& in_force, bool in_leap_second = false);

 private:
  double latency_std_s_;
  instruments::ClockModel model_;
  std::int64_t last_second_ = 0;
  std::int64_t leap_s_ = 0;            ///< leap seconds since the beginning: the seconds of the model have them
  int jumps_ = 0;                      ///< messages in a row that do not fit
  std::int64_t given_ns_ = INT64_MIN;  ///< UtcMapping::at_ns of the last mapping it gave
};

}  // namespace navcal::pipeline
