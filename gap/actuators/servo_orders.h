// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "sim/noise.h"

namespace navcal::gap {

/// How a servo's command went, by its reports: angles in rad.
struct ServoOrders {
  double angle_rad = 0, command_rad = 0;  ///< at the first report
  std::vector<double> steps_rad;          ///< of the command, at each order
};

/// Finds a servo's orders from noisy reports of its angle, ten a second. The servo is a first-order lag behind a
/// command that steps at known instants and stands in between. How far it steps is unknown, and so is how far it
/// usually does at that time: of a restless helm like its neighbours, of a steady one rarely, but then by much;
/// the evidence tells which. Steps are smoothed by all reports (Kalman filter, and the disturbance smoother of de
/// Jong 1988).
class ServoSmoother {
 public:
  /// Ascending times; orders outside of the reports are left out. At least one report.
  ServoSmoother(std::span<const double> report_times_s, std::span<const double> order_times_s, double lag_s);

  /// The instants of the orders that are between reports.
  [[nodiscard]] std::span<const double> order_times_s() const { return order_times_s_; }

  /// `angles_rad`: of the reports, each with this standard deviation of noise. Learns the steps' variances.
  [[nodiscard]] ServoOrders smoothed(std::span<const double> angles_rad, double noise_rad);
  /// One of the ways that the servo may have gone: a draw from what these reports allow, by the variances of the
  /// last smoothed().
  [[nodiscard]] ServoOrders drawn(std::span<const double> angles_rad, double noise_rad, sim::Noise& noise) const;

 private:
  /// What happens after `kept` of the distance to the command is left: an order, or a report.
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
