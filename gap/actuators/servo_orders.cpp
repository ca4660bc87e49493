// SPDX-License-Identifier: Apache-2.0
#include "gap/actuators/servo_orders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/angles.h"

namespace navcal::gap {
namespace {

/// Number of steps on either side that determine the variance of a step.
constexpr std::ptrdiff_t kAround = 15;
/// Standard deviation of the prior of servo and command at the first report.
constexpr double kAnywhere_rad = 1;

/// Symmetric 2 x 2 matrix over servo and command.
struct Two {
  double servo = 0, both = 0, command = 0;
};

/// Mean of each value and its neighbours.
std::vector<double> means_around(const std::vector<double>& values) {
  std::vector<double> sum(values.size() + 1);
  for (std::size_t i = 0; i < values.size(); ++i) sum[i + 1] = sum[i] + values[i];
  const auto count = static_cast<std::ptrdiff_t>(values.size());
  std::vector<double> means;
  means.reserve(values.size());
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto from = std::max<std::ptrdiff_t>(0, i - kAround), until = std::min(count, i + kAround + 1);
    means.push_back((sum[static_cast<std::size_t>(until)] - sum[static_cast<std::size_t>(from)]) /
                    static_cast<double>(until - from));
  }
  return means;
}

/// Prior of the steps.
struct Habit {
  double first_rad = 0;  ///< standard deviation that the iteration begins with
  /// true: Student's t of one degree of freedom about the level of the steps around, for a few large steps
  /// among many that are nearly zero. false: normal with the mean square of the steps around.
  bool jumpy = false;

  /// Variance of each step from its expected square.
  [[nodiscard]] std::vector<double> variances(std::vector<double> squares) const {
    if (!jumpy) return means_around(squares);
    const std::vector<double> usual = levels(squares);
    for (std::size_t i = 0; i < squares.size(); ++i) squares[i] = (usual[i] + squares[i]) / 2;
    return squares;
  }
  /// Log evidence that a variance of its own for each step costs, beside the reports' likelihood. Variational
  /// Bayes; the level of the steps around is taken as it is found.
  [[nodiscard]] double cost_nats(const std::vector<double>& squares) const {
    if (!jumpy) return 0;
    const std::vector<double> usual = levels(squares);
    double cost = 0.5 * std::log(std::numbers::pi) * static_cast<double>(squares.size());
    for (std::size_t i = 0; i < squares.size(); ++i) {
      const double more = (usual[i] + squares[i]) / usual[i];
      cost += 0.5 * std::log(more) + 1 / more - 1;
    }
    return cost;
  }

 private:
  /// Geometric mean of each square and its neighbours.
  static std::vector<double> levels(const std::vector<double>& squares) {
    std::vector<double> levels;
    levels.reserve(squares.size());
    for (const double square : squares) levels.push_back(std::log(square));
    levels = means_around(levels);
    for (double& level : levels) level = std::exp(level);
    return levels;
  }
};

/// First standard deviations: from steps of a restless helm to nearly none. Where the noise of the reports
/// hides the steps, iterations change little, and the evidence selects the right beginning.
constexpr std::array<double, 4> kFirst_rad{0.2 * base::kRadiansPerDegree, 0.05 * base::kRadiansPerDegree,
                                           0.01 * base::kRadiansPerDegree, 0.002 * base::kRadiansPerDegree};
constexpr int kRounds = 8;

/// Standard deviations of the time at which a recorded command acts.
constexpr std::array<double, 3> kLate_s{0.0005, 0.003, 0.01};

}  // namespace

ServoSmoother::ServoSmoother(std::span<const double> report_times_s, std::span<const double> order_times_s,
                             double lag_s, std::span<const double> commands_rad)
    : lag_s_(lag_s) {
  const auto first = std::ranges::upper_bound(order_times_s, report_times_s.front());
  auto order = first;
  double at_s = report_times_s.front();
  const auto add = [&](bool is_order, double time_s) {
    events_.push_back({is_order, std::exp(-(time_s - at_s) / lag_s)});
    at_s = time_s;
  };
  for (const double report_s : report_times_s) {
    for (; order != order_times_s.end() && *order < report_s; ++order) {
      add(true, *order);
      order_times_s_.push_back(*order);
    }
    add(false, report_s);
  }
  variance_rad2_.assign(order_times_s_.size(), kFirst_rad.front() * kFirst_rad.front());
  jolt_variance_rad2_.assign(order_times_s_.size(), 0);
  if (commands_rad.empty() || order_times_s_.empty()) return;
  auto at = static_cast<std::size_t>(first - order_times_s.begin());
  begin_is_told_ = at > 0;
  told_first_rad_ = commands_rad[begin_is_told_ ? at - 1 : 0];
  double command_rad = told_first_rad_;
  for (std::size_t i = 0; i < order_times_s_.size(); ++i) {
    told_steps_rad_.push_back(commands_rad[at + i] - command_rad);
    command_rad = commands_rad[at + i];
  }
}

std::vector<double> ServoSmoother::less_the_told(std::span<const double> angles_rad) const {
  std::vector<double> less_rad;
  less_rad.reserve(angles_rad.size());
  double command_rad = told_first_rad_, servo_rad = command_rad;
  std::size_t order = 0;
  for (const Event& event : events_) {
    servo_rad = command_rad + (servo_rad - command_rad) * event.kept;
    if (event.is_order) {
      command_rad += told_steps_rad_[order++];
    } else {
      less_rad.push_back(angles_rad[less_rad.size()] - servo_rad);
    }
  }
  return less_rad;
}

void ServoSmoother::obey(double late_s) {
  variance_rad2_.assign(order_times_s_.size(), 0);
  // The command before the first one is not recorded.
  if (!begin_is_told_) variance_rad2_.front() = kAnywhere_rad * kAnywhere_rad;
  for (std::size_t i = 0; i < told_steps_rad_.size(); ++i) {
    jolt_variance_rad2_[i] = std::pow(told_steps_rad_[i] * late_s / lag_s_, 2);
  }
}

ServoSmoother::Steps ServoSmoother::steps(std::span<const double> angles_rad, double noise_rad) const {
  /// Update by one report: innovation, its variance, and the Kalman gains of servo and command.
  struct Taught {
    double off_rad = 0, variance_rad2 = 0, servo = 0, command = 0;
  };
  std::vector<Taught> taught(angles_rad.size());
  double servo = angles_rad.front(), command = servo;
  Two p{kAnywhere_rad * kAnywhere_rad, 0, kAnywhere_rad * kAnywhere_rad};
  std::size_t order = 0, report = 0;
  double log_likelihood = 0;
  for (const Event& event : events_) {
    const double a = event.kept, b = 1 - a;
    servo = command + (servo - command) * a;
    p = {a * a * p.servo + 2 * a * b * p.both + b * b * p.command, a * p.both + b * p.command, p.command};
    if (event.is_order) {
      p.servo += jolt_variance_rad2_[order];
      p.command += variance_rad2_[order++];
      continue;
    }
    Taught& t = taught[report];
    t.off_rad = angles_rad[report++] - servo;
    t.variance_rad2 = p.servo + noise_rad * noise_rad;
    t.servo = p.servo / t.variance_rad2;
    t.command = p.both / t.variance_rad2;
    log_likelihood -= 0.5 * (std::log(t.variance_rad2) + t.off_rad * t.off_rad / t.variance_rad2);
    servo += t.servo * t.off_rad;
    command += t.command * t.off_rad;
    p = {p.servo - t.servo * p.servo, p.both - t.servo * p.both, p.command - t.command * p.both};
  }

  // Backward pass: estimate of each step from the reports after it, with its variance.
  Steps result{
      0, 0, log_likelihood, std::vector<double>(order), std::vector<double>(order), std::vector<double>(order)};
  double by_servo = 0, by_command = 0;
  Two n;
  for (auto event = events_.rbegin(); event != events_.rend(); ++event) {
    if (event->is_order) {
      const double variance = variance_rad2_[--order], mean = variance * by_command;
      result.mean_rad[order] = mean;
      result.jolt_rad[order] = jolt_variance_rad2_[order] * by_servo;
      result.square_rad2[order] = mean * mean + variance - variance * variance * n.command;
    } else {
      const Taught& t = taught[--report];
      const double left = 1 - t.servo;
      by_servo = t.off_rad / t.variance_rad2 + left * by_servo - t.command * by_command;
      n = {1 / t.variance_rad2 + left * left * n.servo - 2 * left * t.command * n.both +
               t.command * t.command * n.command,
           left * n.both - t.command * n.command, n.command};
    }
    const double a = event->kept, b = 1 - a;
    by_command += b * by_servo;
    by_servo *= a;
    n = {a * a * n.servo, a * b * n.servo + a * n.both, b * b * n.servo + 2 * b * n.both + n.command};
  }
  result.angle_rad = angles_rad.front() + kAnywhere_rad * kAnywhere_rad * by_servo;
  result.command_rad = angles_rad.front() + kAnywhere_rad * kAnywhere_rad * by_command;
  return result;
}

ServoOrders ServoSmoother::smoothed(std::span<const double> angles_rad, double noise_rad) {
  Steps best;
  std::vector<double> best_variance_rad2, best_jolt_variance_rad2;
  double most = -std::numeric_limits<double>::infinity();
  const auto compare = [&](Steps found, double evidence, bool obeys) {
    if (evidence <= most) return;
    most = evidence;
    obeys_ = obeys;
    best = std::move(found);
    best_variance_rad2 = variance_rad2_;
    best_jolt_variance_rad2 = jolt_variance_rad2_;
  };
  jolt_variance_rad2_.assign(order_times_s_.size(), 0);
  for (std::size_t i = 0; i < 2 * kFirst_rad.size(); ++i) {
    const Habit habit{kFirst_rad[i / 2], i % 2 == 0};
    variance_rad2_.assign(order_times_s_.size(), habit.first_rad * habit.first_rad);
    Steps found = steps(angles_rad, noise_rad);
    for (int round = 1; round < kRounds; ++round) {
      variance_rad2_ = habit.variances(std::move(found.square_rad2));
      found = steps(angles_rad, noise_rad);
    }
    const double evidence = found.log_likelihood - habit.cost_nats(found.square_rad2);
    compare(std::move(found), evidence, false);
  }
  if (!told_steps_rad_.empty()) {
    const std::vector<double> less_rad = less_the_told(angles_rad);
    for (const double late_s : kLate_s) {
      obey(late_s);
      Steps found = steps(less_rad, noise_rad);
      const double evidence = found.log_likelihood;
      compare(std::move(found), evidence, true);
    }
  }
  variance_rad2_ = std::move(best_variance_rad2);
  jolt_variance_rad2_ = std::move(best_jolt_variance_rad2);
  return orders_of(best);
}

ServoOrders ServoSmoother::orders_of(const Steps& found) const {
  ServoOrders orders{found.angle_rad, found.command_rad, found.mean_rad, {}};
  if (!obeys_) return orders;
  orders.angle_rad += told_first_rad_;
  orders.command_rad += told_first_rad_;
  for (std::size_t i = 0; i < told_steps_rad_.size(); ++i) orders.steps_rad[i] += told_steps_rad_[i];
  orders.jolts_rad = found.jolt_rad;
  return orders;
}

ServoOrders ServoSmoother::drawn(std::span<const double> angles_rad, double noise_rad, sim::Noise& noise) const {
  // Simulation smoother (Durbin and Koopman 2002): a servo is simulated under drawn steps, and the smoothed
  // difference between its reports and the recorded ones is added.
  const std::vector<double> all_rad =
      obeys_ ? less_the_told(angles_rad) : std::vector<double>(angles_rad.begin(), angles_rad.end());
  Steps drawn;
  drawn.angle_rad = drawn.command_rad = all_rad.front();
  std::vector<double> reports;
  reports.reserve(all_rad.size());
  double servo = drawn.angle_rad, command = drawn.command_rad;
  for (const Event& event : events_) {
    servo = command + (servo - command) * event.kept;
    if (event.is_order) {
      const std::size_t order = drawn.mean_rad.size();
      drawn.jolt_rad.push_back(noise.normal(std::sqrt(jolt_variance_rad2_[order])));
      drawn.mean_rad.push_back(noise.normal(std::sqrt(variance_rad2_[order])));
      servo += drawn.jolt_rad.back();
      command += drawn.mean_rad.back();
    } else {
      reports.push_back(all_rad[reports.size()] - (servo + noise.normal(noise_rad)));
    }
  }
  // The smoother is linear: smoothing the difference gives the difference of the smoothed values.
  const Steps missed = steps(reports, noise_rad);
  drawn.angle_rad += missed.angle_rad;
  drawn.command_rad += missed.command_rad;
  for (std::size_t i = 0; i < drawn.mean_rad.size(); ++i) {
    drawn.mean_rad[i] += missed.mean_rad[i];
    drawn.jolt_rad[i] += missed.jolt_rad[i];
  }
  return orders_of(drawn);
}

}  // namespace navcal::gap
