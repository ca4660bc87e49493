// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace navcal::sim {

/// An instrument whose own clock runs off its nominal rate.
struct ClockFactor {
  std::string port;
  double factor = 1;  ///< rate over nominal rate: 0.99 sends a hundredth too rarely

  /// Excess length of the clock's seconds, parts per million.
  [[nodiscard]] double ppm() const { return (1 / factor - 1) * 1e6; }
};

/// Excess length of the seconds of `port`, ppm: from the last of `factors` that names it, else `otherwise_ppm`.
[[nodiscard]] inline double clock_ppm(const std::vector<ClockFactor>& factors, const std::string& port,
                                      double otherwise_ppm) {
  for (auto it = factors.rbegin(); it != factors.rend(); ++it) {
    if (it->port == port) return it->ppm();
  }
  return otherwise_ppm;
}

}  // namespace navcal::sim
