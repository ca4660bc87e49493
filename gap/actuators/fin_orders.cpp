// SPDX-License-Identifier: Apache-2.0
#include "gap/actuators/fin_orders.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "base/rounding.h"
#include "protocols/motor_card.h"

namespace navcal::gap {
namespace {

constexpr double kOrderPeriod_s = 0.1;
/// The card takes tenths of a degree, fin by fin. The rounding rolls the vehicle a little all the time, by less
/// than reports show.
constexpr double kOrdered_rad = protocols::motor_card::kFinStep_deg * base::kRadiansPerDegree;

/// Rolling, rudder and elevator of fins 1 to 3, all of length one (the mixing of the card's interface document,
/// section 4).
constexpr double kThird = 1 / std::numbers::sqrt3, kHalf = 1 / std::numbers::sqrt2, kSixth = kThird * kHalf;
constexpr std::array<Vector3, 3> kWaysOfFins{Vector3{kThird, kThird, kThird}, Vector3{-2 * kSixth, kSixth, kSixth},
                                             Vector3{0, kHalf, -kHalf}};

double along(const Vector3& way, const Vector3& fins) {
  return way[0] * fins[0] + way[1] * fins[1] + way[2] * fins[2];
}

std::vector<double> grid(std::size_t count, double step_s, double from_s) {
  std::vector<double> times_s;
  times_s.reserve(count);
  for (std::size_t k = 0; k < count; ++k) times_s.push_back(from_s + static_cast<double>(k) * step_s);
  return times_s;
}

}  // namespace

FinOrders::FinOrders(std::span<const MotorReading> readings, std::span<const double> order_times_s,
                     std::span<const Vector3> ordered_fins_rad, double servo_lag_s, double report_noise_rad)
    : lag_s_(servo_lag_s), report_noise_rad_(report_noise_rad) {
  report_times_s_.reserve(readings.size());
  for (const MotorReading& reading : readings) report_times_s_.push_back(reading.time_s);
  for (std::size_t i = 0; i < kWays; ++i) {
    reports_rad_[i].reserve(readings.size());
    for (const MotorReading& reading : readings) {
      reports_rad_[i].push_back(along(kWaysOfFins[i], reading.fins_rad));
    }
    std::vector<double> commands_rad;
    for (const Vector3& fins_rad : ordered_fins_rad) commands_rad.push_back(along(kWaysOfFins[i], fins_rad));
    smoothers_.emplace_back(report_times_s_, order_times_s, servo_lag_s, commands_rad);
    orders_[i] = smoothers_[i].smoothed(reports_rad_[i], report_noise_rad_);
  }
}

std::vector<Vector3> FinOrders::servos_rad(std::size_t count, double step_s) const {
  return followed(orders_, grid(count, step_s, 0));
}

std::vector<Vector3> FinOrders::drawn_servos_rad(std::size_t count, double step_s, double later_s,
                                                 sim::Noise& noise) const {
  std::array<ServoOrders, kWays> drawn;
  for (std::size_t i = 0; i < kWays; ++i) {
    drawn[i] = smoothers_[i].drawn(reports_rad_[i], report_noise_rad_, noise);
  }
  if (!obeys()) round_off(drawn);
  return followed(drawn, grid(count, step_s, -later_s));
}

double FinOrders::misfit() const {
  const std::vector<Vector3> servos_rad = followed(orders_, report_times_s_);
  double square = 0;
  for (std::size_t i = 0; i < kWays; ++i) {
    for (std::size_t k = 0; k < servos_rad.size(); ++k) {
      square += std::pow((reports_rad_[i][k] - along(kWaysOfFins[i], servos_rad[k])) / report_noise_rad_, 2);
    }
  }
  return square / static_cast<double>(kWays * servos_rad.size());
}

bool FinOrders::obeys() const {
  return std::ranges::all_of(smoothers_, [](const auto& smoother) { return smoother.obeys(); });
}

void FinOrders::round_off(std::array<ServoOrders, kWays>& orders) {
  std::array<double, kWays> exact{}, rounded{};
  for (std::size_t i = 0; i < kWays; ++i) exact[i] = rounded[i] = orders[i].command_rad;
  for (std::size_t order = 0; order < orders.front().steps_rad.size(); ++order) {
    Vector3 fins{};
    for (std::size_t i = 0; i < kWays; ++i) {
      exact[i] += orders[i].steps_rad[order];
      for (std::size_t fin = 0; fin < fins.size(); ++fin) fins[fin] += exact[i] * kWaysOfFins[i][fin];
    }
    for (double& angle : fins) angle = base::rounded(angle, kOrdered_rad);
    for (std::size_t i = 0; i < kWays; ++i) {
      orders[i].steps_rad[order] = along(kWaysOfFins[i], fins) - rounded[i];
      rounded[i] += orders[i].steps_rad[order];
    }
  }
}

std::vector<Vector3> FinOrders::followed(const std::array<ServoOrders, kWays>& orders,
                                         std::span<const double> times_s) const {
  std::array<double, kWays> servo{}, command{};
  for (std::size_t i = 0; i < kWays; ++i) {
    servo[i] = orders[i].angle_rad;
    command[i] = orders[i].command_rad;
  }
  double at_s = report_times_s_.front();
  const auto go_on_until = [&](double time_s) {
    const double kept = std::exp(-(time_s - at_s) / lag_s_);
    for (std::size_t i = 0; i < kWays; ++i) servo[i] = command[i] + (servo[i] - command[i]) * kept;
    at_s = time_s;
  };
  std::vector<Vector3> path;
  path.reserve(times_s.size());
  std::size_t order = 0;
  for (const double time_s : times_s) {
    for (; order < order_times_s().size() && order_times_s()[order] <= time_s; ++order) {
      go_on_until(order_times_s()[order]);
      for (std::size_t i = 0; i < kWays; ++i) {
        command[i] += orders[i].steps_rad[order];
        if (!orders[i].jolts_rad.empty()) servo[i] += orders[i].jolts_rad[order];
      }
    }
    if (time_s > at_s) go_on_until(time_s);
    Vector3& fins = path.emplace_back();
    for (std::size_t i = 0; i < kWays; ++i) {
      for (std::size_t fin = 0; fin < fins.size(); ++fin) fins[fin] += servo[i] * kWaysOfFins[i][fin];
    }
  }
  return path;
}

std::vector<double> regular_orders(double phase_s, double duration_s) {
  std::vector<double> times_s;
  for (int k = 0; phase_s + k * kOrderPeriod_s < duration_s; ++k) times_s.push_back(phase_s + k * kOrderPeriod_s);
  return times_s;
}

}  // namespace navcal::gap
