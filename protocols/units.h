// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace navcal::protocols {

inline constexpr double kMetresPerSecondPerKnot = 1852.0 / 3600.0;
inline constexpr double kMilliarcsecondsPerDegree = 3'600'000;

}  // namespace navcal::protocols
