// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "config/settings.h"
#include "record/log/log_encoder.h"

namespace navcal::record::testing {

/// Two ports: "compass" (tcm2) and "imu" (imu-card).
[[nodiscard]] config::Settings sample_settings();

[[nodiscard]] instruments::Sample compass_sample(std::int64_t at_ns);
[[nodiscard]] instruments::Sample imu_sample(std::int64_t at_ns);

/// A log of some seconds at about the vehicle's rates. Monotonic time begins at 5 s; UTC is 1 790 000 000 s later.
struct SampleLog {
  std::string bytes;
  std::uint64_t messages = 0;
  std::uint64_t raw_messages = 0;
  std::vector<std::uint64_t> ends;  ///< of its messages' records, in order
  std::size_t data_end = 0;
};
[[nodiscard]] SampleLog sample_log(int seconds, bool finished);

inline constexpr std::int64_t kSampleStart_ns = 5'000'000'000;
inline constexpr std::int64_t kSampleOffset_ns = 1'790'000'000'000'000'001;

}  // namespace navcal::record::testing
