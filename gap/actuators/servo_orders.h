// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "sim/noise.h"

namespace navcal::gap {

/// Commands of one servo, recorded or estimated from its reports. Angles in rad.
struct ServoOrders {
  double angle_rad = 0, command_rad = 0;  ///< at the first report
  std::vector<double> steps_rad;          ///< of the command, at each order
  /// Steps of the angle itself, at each order: a recorded command that acts a little earlier or later than its
  /// time. Empty where the commands are estimated.
  std::vector<double> jolts_rad;
};

/// Estimates a servo's orders from noisy reports of its angle, ten a second.
///
/// Model: the servo is a first-order lag behind a command that steps at known instants and is constant in
/// between. The sizes of the steps are unknown, and so are their variances. A restless helm has steps like
/// those around them; a steady one has few steps, which may be large. The marginal likelihood selects between
/// the two. The steps are smoothed with all reports (Kalman filter, and the disturbance smoother of de Jong
/// 1988).
///
/// Where the commands are recorded, a second model has steps of known size. Unknown are the angle at the first
/// report, a constant offset between command and angle, and the time at which each command acts. The marginal
/// likelihood selects between this model and the one above, so that a servo that does not obey is followed, too.
class ServoSmoother {
 public:
  /// Ascending times; orders outside of the reports are left out. At least one report. `commands_rad`: the
  /// command from each order on; empty: not recorded.
  ServoSmoother(std::span<const double> report_times_s, std::span<const double> order_times_s, double lag_s,
                std::span<const double> commands_rad = {});

  /// The instants of the orders that are between reports.
  [[nodiscard]] std::span<const double> order_times_s() const { return order_times_s_; }

  /// `angles_rad`: reported angles; `noise_rad`: standard deviation of each. Estimates the variances of the
  /// steps.
  [[nodiscard]] ServoOrders smoothed(std::span<const double> angles_rad, double noise_rad);
  /// Whether the last smoothed() found that the servo obeyed the recorded commands.
  [[nodiscard]] bool obeys() const { return obeys_; }
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
    std::vector<double> jolt_rad;               ///< expected, of the angle at each order
  };
  [[nodiscard]] Steps steps(std::span<const double> angles_rad, double noise_rad) const;
  [[nodiscard]] ServoOrders orders_of(const Steps& found) const;
  /// The reported angles less those of a servo that obeys the recorded commands.
  [[nodiscard]] std::vector<double> less_the_told(std::span<const double> angles_rad) const;
  /// Variances of the model with recorded commands, each of which acts within `late_s` of its time.
  void obey(double late_s);

  std::vector<Event> events_;
  std::vector<double> order_times_s_;
  double lag_s_;
  double told_first_rad_ = 0;           ///< recorded command at the first report
  std::vector<double> told_steps_rad_;  ///< recorded; empty: not recorded
  bool begin_is_told_ = false;
  bool obeys_ = false;
  std::vector<double> variance_rad2_;       ///< of each step, beyond the recorded one where the servo obeys
  std::vector<double> jolt_variance_rad2_;  ///< of the angle at each order
};

}  // namespace navcal::gap
