// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace navcal::base {

inline constexpr std::int64_t kMillisecond_ns = 1'000'000;
inline constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// The duration in seconds.
[[nodiscard]] constexpr double seconds(std::int64_t duration_ns) {
  return static_cast<double>(duration_ns) * 1e-9;
}

}  // namespace navcal::base
