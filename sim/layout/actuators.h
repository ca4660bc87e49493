// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <vector>

#include "config/layout.h"

namespace navcal::sim {

/// Numbers of the actuators of one kind, kept in place: a step allocates nothing.
class ActuatorNumbers {
 public:
  ActuatorNumbers() = default;
  ActuatorNumbers(std::initializer_list<double> values) {
    for (const double value : values) push_back(value);
  }
  // Not explicit: a list of numbers is meant.
  ActuatorNumbers(const std::vector<double>& values) {  // NOLINT(google-explicit-constructor)
    for (const double value : values) push_back(value);
  }
  // Only what is there is copied.
  ActuatorNumbers(const ActuatorNumbers& other) : size_(other.size_) {
    std::copy_n(other.begin(), size_, begin());
  }
  ActuatorNumbers& operator=(const ActuatorNumbers& other) {
    size_ = other.size_;
    std::copy_n(other.begin(), size_, begin());
    return *this;
  }
  ~ActuatorNumbers() = default;

  /// Throws std::out_of_range beyond kMaxActuators.
  void push_back(double value) {
    values_.at(size_) = value;
    ++size_;
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] double* begin() { return values_.data(); }
  [[nodiscard]] double* end() { return begin() + size_; }
  [[nodiscard]] const double* begin() const { return values_.data(); }
  [[nodiscard]] const double* end() const { return begin() + size_; }
  [[nodiscard]] double& operator[](std::size_t i) { return values_[i]; }
  [[nodiscard]] double operator[](std::size_t i) const { return values_[i]; }
  [[nodiscard]] double at(std::size_t i) const { return values_.at(i); }
  bool operator==(const ActuatorNumbers& other) const {
    return std::equal(begin(), end(), other.begin(), other.end());
  }

 private:
  std::size_t size_ = 0;
  std::array<double, config::kMaxActuators> values_;
};

/// One number for each actuator of a layout, in its order: commands, or where the actuators are.
struct ActuatorValues {
  ActuatorNumbers thrusters;  ///< in the unit of each command
  ActuatorNumbers surfaces_rad;
  ActuatorNumbers ballasts_N;  ///< added buoyancy
  ActuatorNumbers masses_m;    ///< along the axis

  /// All neutral: thrusters off, angles, ballasts and places zero, or the nearest that limits allow.
  [[nodiscard]] static ActuatorValues neutral(const config::Layout& layout);
};

/// Positions of the actuators after a step towards constant commands. Thrusters and surfaces follow with
/// first-order lags, exactly over the step: p' = (c - p)/T, p(t + h) = p + (1 - exp(-h/T)) (c - p), with c within
/// its limits and neutral in its dead band, behind what the actuator makes of its command (config::LayoutHeard).
/// Ballasts and moving masses go at their rates.
[[nodiscard]] ActuatorValues follow(const config::Layout& layout, const ActuatorValues& positions,
                                    const ActuatorValues& commands, double step_s);

/// The means of two, which the model holds over a step.
[[nodiscard]] ActuatorValues mean_of(const ActuatorValues& a, const ActuatorValues& b);

}  // namespace navcal::sim
