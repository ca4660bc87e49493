#pragma once

namespace navcal::protocols {

inline constexpr double kMetresPerSecondPerKnot = 1852.0 / 3600.0;

}  // namespace navcal::protocols
