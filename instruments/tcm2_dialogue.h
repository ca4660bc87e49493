// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "base/durations.h"
#include "protocols/tcm2_commands.h"

/// Timing of a dialogue with a TCM2, at start-up and during its calibration (ICD section 1).
namespace navcal::instruments {

/// Time between the two `h` that stop the stream.
inline constexpr std::int64_t kBetweenHalts_ns = 100 * base::kMillisecond_ns;
/// Wait after the second `h`: a word under way and the replies to both then have ended (75 bytes take 78 ms at
/// 9600 baud).
inline constexpr std::int64_t kSettle_ns = 200 * base::kMillisecond_ns;
/// Longest wait for a reply. It comes after the end of a word under way, and at 5 Hz the device reads its input
/// five times a second.
inline constexpr std::int64_t kReplyTimeout_ns = 400 * base::kMillisecond_ns;
/// A stream that is silent for this long has stopped.
inline constexpr std::int64_t kTcm2Stopped_ns = 3 * base::kSecond_ns;
/// Attempts: the command and two repetitions.
inline constexpr int kAttempts = 3;

[[nodiscard]] inline std::vector<std::uint8_t> bytes_of(protocols::tcm2::Verb verb) {
  return protocols::tcm2::encode_command({verb});
}

}  // namespace navcal::instruments
