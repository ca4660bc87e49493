// SPDX-License-Identifier: Apache-2.0
#include "gap/sources/covariates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/angles.h"
#include "base/text_rows.h"

namespace navcal::gap {

const char* basic_covariates();  // basic_covariates.txt

namespace {

constexpr double kOneDegree_rad = 1 / base::kDegreesPerRadian;

/// A quantity before it is scaled.
struct Signal {
  std::string name;
  std::string_view family, regime;
  double least = 0;  ///< root mean square about the mean below which it hardly varies
  Eigen::VectorXd values;
};

Eigen::VectorXd smoothed(const std::vector<double>& values) {
  constexpr Eigen::Index kHalf = 5;  // half a second
  const auto n = static_cast<Eigen::Index>(values.size());
  const Eigen::Map<const Eigen::VectorXd> all(values.data(), n);
  Eigen::VectorXd result(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index from = std::max<Eigen::Index>(0, i - kHalf), until = std::min(n, i + kHalf + 1);
    result[i] = all.segment(from, until - from).mean();
  }
  return result;
}

/// Derivative by time, 1/s.
Eigen::VectorXd derivative(const Eigen::VectorXd& values) {
  const Eigen::Index n = values.size();
  Eigen::VectorXd result = Eigen::VectorXd::Zero(n);
  if (n < 3) return result;
  result.segment(1, n - 2) = (values.tail(n - 2) - values.head(n - 2)) / (2 * kInterval_s);
  return result;
}

/// First-order low-pass that starts at the first value.
Eigen::VectorXd low_pass(const Eigen::VectorXd& values, double tau_s) {
  Eigen::VectorXd result = values;
  const double gain = 1 - std::exp(-kInterval_s / tau_s);
  for (Eigen::Index i = 1; i < values.size(); ++i) result[i] = result[i - 1] + gain * (values[i] - result[i - 1]);
  return result;
}

/// Direction of the last move that was larger than `play`: 1 or -1, zero before the first.
Eigen::VectorXd direction(const Eigen::VectorXd& values, double play) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(values.size());
  if (values.size() == 0) return result;
  double held = values[0], sign = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (std::abs(values[i] - held) > play) {
      sign = values[i] > held ? 1 : -1;
      held = values[i] - sign * play;
    }
    result[i] = sign;
  }
  return result;
}

/// exp(-age / tau), where age is the time since the last step of the shaft or of a fin. Zero before the first.
Eigen::VectorXd since_step(const Trajectory10Hz& course, double tau_s) {
  constexpr Eigen::Index kSecond = 10;
  constexpr double kStep_rps = 1, kStep_rad = 4 * kOneDegree_rad;
  const auto n = static_cast<Eigen::Index>(course.time_s.size());
  Eigen::VectorXd result = Eigen::VectorXd::Zero(n);
  double value = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto now = static_cast<std::size_t>(i),
               before = static_cast<std::size_t>(std::max<Eigen::Index>(0, i - kSecond));
    const auto moved = [&](const std::vector<double>& of, double step) {
      return std::abs(of[now] - of[before]) > step;
    };
    value *= std::exp(-kInterval_s / tau_s);
    if (moved(course.shaft_rps, kStep_rps) || moved(course.rudder_rad, kStep_rad) ||
        moved(course.elevator_rad, kStep_rad)) {
      value = 1;
    }
    result[i] = value;
  }
  return result;
}

/// Collects covariates.
class Collection {
 public:
  explicit Collection(const Trajectory10Hz& course) : course_(course) {}

  void add(std::string name, std::vector<std::string_view> families, std::string_view regime, double least,
           const Eigen::VectorXd& values) {
    const double spread = spread_of(values);
    const bool varies = spread > least;
    // What stands still cannot be scaled by its spread.
    const double mean = values.mean(), scale = spread > 1e-12 ? spread : 1;
    all_.push_back({std::move(name), std::move(families), regime, false, varies, mean, scale,
                    (values.array() - mean) / scale});
  }
  void add(const Signal& signal) { add(signal.name, {signal.family}, signal.regime, signal.least, signal.values); }
  /// Products and powers vary enough where each factor does.
  void add_product(const Signal& a, const Signal& b) {
    std::vector<std::string_view> families{a.family};
    if (b.family != a.family) families.push_back(b.family);
    add(fmt::format("{} x {}", a.name, b.name), std::move(families), a.regime, 0, a.values.cwiseProduct(b.values));
    all_.back().varies = a.least < spread_of(a.values) && b.least < spread_of(b.values);
  }
  void add_derivative(const Signal& of, double least_per_s) {
    add(fmt::format("change of {}", of.name), {of.family, "lag"}, of.regime, least_per_s, derivative(of.values));
  }
  void add_low_pass(const Signal& of, double tau_s) {
    add(fmt::format("{}, lag {:g} s", of.name, tau_s), {of.family, "lag"}, of.regime, of.least,
        low_pass(of.values, tau_s));
  }
  void add_direction(const Signal& of, double play) {
    constexpr double kLeast = 0.3;
    add(fmt::format("direction of {}", of.name), {of.family, "lag"}, of.regime, kLeast,
        direction(of.values, play));
  }
  void add_constant() {
    const auto n = static_cast<Eigen::Index>(course_.time_s.size());
    all_.push_back({"constant", {"constant"}, "constant", false, true, 0, 1, Eigen::VectorXd::Ones(n)});
  }

  [[nodiscard]] std::vector<Covariate> taken() && {
    const auto basic = base::text_rows(basic_covariates(), "\n");
    for (Covariate& each : all_) {
      each.is_basic = std::ranges::any_of(basic, [&](const auto& row) { return row.first == each.name; });
    }
    return std::move(all_);
  }

 private:
  /// Root mean square about the mean.
  static double spread_of(const Eigen::VectorXd& values) {
    const Eigen::VectorXd about = values.array() - values.mean();
    return std::sqrt(about.squaredNorm() / static_cast<double>(values.size()));
  }

  const Trajectory10Hz& course_;
  std::vector<Covariate> all_;
};

}  // namespace

std::vector<Covariate> covariates_of(const Trajectory10Hz& course) {
  Collection all(course);
  const auto n = static_cast<Eigen::Index>(course.time_s.size());
  if (n == 0) return {};
  all.add_constant();
  const Eigen::Map<const Eigen::VectorXd> heading_rad(course.heading_rad.data(), n);
  const auto harmonic = [&](int k, bool is_sine, std::string_view regime) {
    const Eigen::ArrayXd angle = k * heading_rad.array();
    std::string name = fmt::format("{}({}heading)", is_sine ? "sin" : "cos", k == 1 ? "" : fmt::format("{} ", k));
    return Signal{std::move(name), "heading", regime, 0.1,
                  is_sine ? Eigen::VectorXd(angle.sin()) : Eigen::VectorXd(angle.cos())};
  };
  const Signal cosine = harmonic(1, false, "heading_once"), sine = harmonic(1, true, "heading_once");
  const Signal yaw_rate{"yaw_rate", "rate", "turn_rate", 0.3 * kOneDegree_rad, smoothed(course.yaw_rate_rad_s)};
  const Signal yaw_rate_size{"abs(yaw_rate)", "rate", "turn_rate_size", 0.3 * kOneDegree_rad,
                             yaw_rate.values.cwiseAbs()};
  const Signal pitch_rate{"pitch_rate", "rate", "pitch", 0.2 * kOneDegree_rad, smoothed(course.pitch_rate_rad_s)};
  const Signal roll{"roll", "tilt", "roll", 0.3 * kOneDegree_rad, smoothed(course.roll_rad)};
  const Signal pitch{"pitch", "tilt", "pitch", 0.3 * kOneDegree_rad, smoothed(course.pitch_rad)};
  const Signal speed{"speed", "speed", "speed", 0.02, smoothed(course.surge_m_s)};
  const Signal current{"motor_current", "current", "motor_current", 0.05, smoothed(course.current_A)};
  const Signal temperature{"temperature", "temperature", "temperature", 0.3, smoothed(course.temperature_rise_C)};
  const Signal depth{"depth", "depth", "depth", 0.1, smoothed(course.depth_m)};
  const Signal rudder{"rudder", "command", "rudder", 0.3 * kOneDegree_rad, smoothed(course.rudder_rad)};
  const Signal elevator{"elevator", "command", "elevator", 0.3 * kOneDegree_rad, smoothed(course.elevator_rad)};
  const Signal shaft{"shaft_speed", "command", "speed", 0.3, smoothed(course.shaft_rps)};
  const Signal time{"time", "time", "time", 1,
                    Eigen::VectorXd::LinSpaced(n, 0, kInterval_s * static_cast<double>(n))};

  for (const Signal* each : {&cosine, &sine}) all.add(*each);
  for (const int k : {2, 3}) {
    for (const bool is_sine : {false, true})
      all.add(harmonic(k, is_sine, k == 2 ? "heading_twice" : "heading_thrice"));
  }
  for (const Signal* each : {&yaw_rate, &yaw_rate_size, &pitch_rate, &roll, &pitch, &speed, &current, &temperature,
                             &depth, &rudder, &elevator, &shaft, &time}) {
    all.add(*each);
  }
  // Slow courses over time: half waves of a cosine.
  for (const int k : {2, 3, 4}) {
    const double rate = k * std::numbers::pi / (kInterval_s * static_cast<double>(n));
    all.add(fmt::format("time, {} half waves", k), {"time"}, "time", 0.1, (rate * time.values.array()).cos());
  }
  constexpr double kStepTime_s = 5;
  all.add("time since a step of an order", {"step"}, "time", 0.05, since_step(course, kStepTime_s));

  all.add_derivative(yaw_rate, 0.1 * kOneDegree_rad);
  all.add_derivative(pitch_rate, 0.1 * kOneDegree_rad);
  all.add_derivative(speed, 0.005);
  all.add_derivative(rudder, 0.2 * kOneDegree_rad);
  all.add_derivative(elevator, 0.2 * kOneDegree_rad);
  all.add_derivative(depth, 0.02);
  all.add_direction(rudder, 0.7 * kOneDegree_rad);
  all.add_direction(elevator, 0.7 * kOneDegree_rad);
  all.add_direction(depth, 0.15);
  constexpr double kShortLag_s = 5, kLongLag_s = 60;
  for (const Signal* each : {&cosine, &sine}) all.add_low_pass(*each, kLongLag_s);
  for (const Signal* each : {&yaw_rate, &current, &depth}) all.add_low_pass(*each, kShortLag_s);

  for (const Signal* each : {&speed, &current, &temperature, &depth}) all.add_product(*each, *each);
  all.add_product(yaw_rate, yaw_rate_size);
  all.add_product(rudder, {"abs(rudder)", "command", "rudder", 0.3 * kOneDegree_rad, rudder.values.cwiseAbs()});
  for (const Signal* each : {&cosine, &sine}) {
    for (const Signal* with : {&yaw_rate, &current, &speed, &pitch, &roll, &temperature})
      all.add_product(*with, *each);
  }
  all.add_product(yaw_rate, speed);
  all.add_product(yaw_rate, pitch);
  all.add_product(yaw_rate, roll);
  all.add_product(rudder, speed);
  all.add_product(elevator, speed);
  all.add_product(depth, speed);
  all.add_product(rudder, depth);
  return std::move(all).taken();
}

}  // namespace navcal::gap
