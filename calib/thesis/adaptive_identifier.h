// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "calib/archive.h"

namespace navcal::calib::thesis {

/// Model: psidot = c f'beta, f = [omega_m 1]', beta = [abar bbar]', c = cos(phi)/cos(theta) (3.6, 3.7); identified
/// by betahat += -h Lambda f xt (3.15) and xhat += h (K xt + c f'betahat) (3.16), xt = xhat - psi. Radians, rad/s.
/// As in Mach 2003, with its gains (THESIS section 0): at a constant rate only abar omega_m + bbar is found.
class AdaptiveIdentifier {
 public:
  explicit AdaptiveIdentifier(double period_s) : period_s_(period_s) {}

  /// `heading_rad` unwrapped.
  void update(double heading_rad, double roll_rad, double pitch_rad, double measured_rate_rad_s);
  /// h of the readings that come.
  void set_period(double period_s) { period_s_ = period_s; }
  /// Readings are missing: the heading begins anew.
  void restart() { heading_rad_.reset(); }
  /// (abar, bbar).
  [[nodiscard]] Eigen::Vector2d estimate() const { return estimate_; }
  /// xhat; nothing before the first reading.
  [[nodiscard]] std::optional<double> heading_rad() const { return heading_rad_; }

  /// Without the period.
  void archive(Archive& archive) { archive(heading_rad_, estimate_); }

 private:
  static constexpr double kGain = -0.75;               ///< K, 1/s
  inline static const Eigen::Vector2d kRates{2, 0.2};  ///< diagonal of Lambda

  double period_s_;
  std::optional<double> heading_rad_;  ///< xhat
  Eigen::Vector2d estimate_{1, 1};
};

}  // namespace navcal::calib::thesis
