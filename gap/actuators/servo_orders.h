// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "sim/noise.h"

namespace navcal::gap {

/// Commands of one servo, estimated from its reports. Angles in rad.
struct ServoOrders {
  double angle_rad = 0, command_rad = 0;  ///< at the first report
  std::vector<double> steps_rad;          ///< of the command, at each order
};

/// Estimates a servo's orders from noisy reports of its angle, ten a second.
///
/// Model: the servo is a first-order lag behind a command that steps at known instants and is constant in
/// between. The sizes of the steps are unknown, and so are their variances. A restless helm has steps like
/// those around them; a steady one has few steps, which may be large. The marginal likelihood selects between
/// the two. The steps are smoothed with all reports (Kalman filter, and the disturbance smoother of de Jong
/// 1988).
class ServoSmoother {
 public:
  /// Ascending times; orders outside of the reports are left out. At least one report.
  ServoSmoother(std::span<const double> report_times_s, std::span<const double> order_times_s, double lag_s);

  /// The instants of the orders that are between reports.
  [[nodiscard]] std::span<const double> order_times_s() const { return order_times_s_; }

  /// `angles_rad`: reported angles; `noise_rad`: standard deviation of each. Estimates the variances of the
  /// steps.
  [[nodiscard]] ServoOrders smoothed(std::span<const double> angles_rad, double noise_rad);
  /// A draw from the orders that these reports allow, by the variances of the last smoothed().
  [[nodiscard]] ServoOrders drawn(std::span<const double> angles_rad, double noise_rad, sim::Noise& noise) const;

 private:
  /// An order or a report. `kept`: share of the distance to the command that is left since the event before.
  struct Event {
    bool is_order = false;
    double kept = 1;
  };
  struct Steps {
    double angle_rad = 0, command_rad = 0, log_likelihood = 0;
    std::vector<double> mean_rad, square_rad2;  ///< expected, of each step
  };
  [[nodiscard]] Steps steps(std::span<const double> angles_rad, double noise_rad) const;

  std::vector<Event> events_;
  std::vector<double> order_times_s_;
  std::vector<double> variance_rad2_;  ///< of each step
};

}  // namespace navcal::gap
