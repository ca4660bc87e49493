// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace navcal::instruments {

/// Standard error of a Doppler log's velocities from its error velocity.
///
/// Four beams measure three components. The fourth combination, the error velocity, is zero without noise. It is
/// scaled so that its variance is that of each horizontal component; the vertical component has less. One error
/// velocity is one draw from that distribution, so its mean square over the last readings is the estimate. The
/// newest one counts by itself when it is larger: its beams disagree now.
class ErrorVelocity {
 public:
  void take(double error_m_s) {
    readings_ = std::min(readings_ + 1, kMemory);
    mean_square_ += (error_m_s * error_m_s - mean_square_) / readings_;
    newest_m_s_ = std::abs(error_m_s);
  }
  /// nullopt before so many readings that the mean square says something.
  [[nodiscard]] std::optional<double> std_m_s() const {
    if (readings_ < kLeast) return std::nullopt;
    return std::max({std::sqrt(mean_square_), newest_m_s_, kResolution_m_s});
  }

 private:
  static constexpr int kLeast = 8, kMemory = 32;
  static constexpr double kResolution_m_s = 0.3e-3;  ///< of values in steps of 1 mm/s, rms

  int readings_ = 0;
  double mean_square_ = 0, newest_m_s_ = 0;
};

}  // namespace navcal::instruments
