// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace navcal::sim {

/// Control of one degree of freedom by a cascade: position to rate to acceleration.
///   rate wanted = rate demanded + clamp(w/2 e, +-rate limit),   e = position demanded - position
///   acceleration = 2 w (rate wanted - rate) + integral of w^3/10 e
/// w is the natural frequency of the loop, critically damped. The integral is for what stands against the vehicle
/// all the time: it grows only while the rate is not limited, and not beyond half of what can be had.
class AxisControl {
 public:
  AxisControl() = default;
  explicit AxisControl(double w_rad_s) : w_rad_s_(w_rad_s) {}

  struct Demand {
    double error = 0, rate = 0, rate_demanded = 0;
    double rate_limit = 0;
    double greatest = 0;  ///< acceleration that actuators give
  };
  struct Wanted {
    double rate = 0;
    double acceleration = 0;
  };
  [[nodiscard]] Wanted next(const Demand& demand, double period_s) {
    const double by_error = w_rad_s_ / 2 * demand.error;
    if (std::abs(by_error) < demand.rate_limit) {
      const double most = 0.5 * demand.greatest;
      integral_ =
          std::clamp(integral_ + w_rad_s_ * w_rad_s_ * w_rad_s_ / 10 * demand.error * period_s, -most, most);
    }
    const double rate = demand.rate_demanded + std::clamp(by_error, -demand.rate_limit, demand.rate_limit);
    return {rate, 2 * w_rad_s_ * (rate - demand.rate) + integral_};
  }
  /// Rate from which 70 % of the greatest acceleration brakes within the loop's own time.
  [[nodiscard]] double rate_limit(double greatest, double low, double high) const {
    return std::clamp(0.7 * greatest / (w_rad_s_ / 2), low, high);
  }
  [[nodiscard]] double w_rad_s() const { return w_rad_s_; }

 private:
  double w_rad_s_ = 1;
  double integral_ = 0;
};

}  // namespace navcal::sim
