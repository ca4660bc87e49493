// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "config/layout.h"
#include "identify/data/recorded_motion.h"
#include "sim/layout/actuators.h"
#include "sim/layout/pulses.h"

namespace navcal::identify {

/// Positions of all actuators of a layout on a grid of kStep_s from time 0 on, linear between its points.
class ActuatorTrajectory {
 public:
  static constexpr double kStep_s = 0.01;

  ActuatorTrajectory() = default;
  ActuatorTrajectory(const config::Layout& layout, std::size_t rows);

  /// Row after row.
  void set(std::size_t row, const sim::ActuatorValues& positions);
  /// Writes the positions at a time into `out`, which has the layout's sizes; before and after the grid its ends.
  void at(double time_s, sim::ActuatorValues& out) const;
  /// Exact means over the time from `time_s` on.
  void mean(double time_s, double over_s, sim::ActuatorValues& out) const;
  [[nodiscard]] double end_s() const { return kStep_s * static_cast<double>(rows_ > 0 ? rows_ - 1 : 0); }

 private:
  /// Adds `factor` times the integrals from time 0 on.
  void add_integrals(double time_s, double factor, sim::ActuatorValues& out) const;

  std::size_t columns_ = 0, rows_ = 0;
  std::vector<double> values_, integrals_;  ///< row by row
};

/// Names of the signals of which the first that a recording has moves an actuator of the layout. Empty: none.
[[nodiscard]] std::vector<std::string> signals_of_thruster(const config::Layout& layout, std::size_t thruster);
[[nodiscard]] std::vector<std::string> signals_of_surface(const config::Layout& layout, std::size_t surface);

/// Whether a signal says where an actuator was, and not what it was told.
[[nodiscard]] bool is_position(const RecordedMotion& motion, const std::string& signal);

/// Which recorded signal moves which actuator of a layout, and where the actuators were.
///
/// A thruster in rpm follows "rpm" of the motor card, which is its position; without it "rpm_commanded", which is
/// a command that its lag follows. The k-th thruster in us or percent follows the quantity "output<k>", a command;
/// pulses of what has another unit are converted (sim::PulseRange). The k-th movable surface follows "fin_<k>": a
/// position where a motor card reported it, else a command. The key `channel` of the layout names another signal,
/// which is a command. Without it, ballasts follow "ballast" and moving masses "moving_mass", else they stay
/// neutral. Where none of these signals is there and the recording has just one output for each actuator, the
/// outputs are theirs, in the order of the ranges.
class ActuatorInputs {
 public:
  /// `motion` must outlive it.
  ActuatorInputs(const config::Layout& layout, const RecordedMotion& motion);

  /// In words, with the actuator and the signal that is missing; empty: every actuator has its signal.
  [[nodiscard]] const std::vector<std::string>& missing() const { return missing_; }
  /// Whether an actuator follows a command; else all signals are positions.
  [[nodiscard]] bool follow_commands() const;
  /// Whether this signal moves an actuator.
  [[nodiscard]] bool use(const std::string& signal) const;
  /// What is odd about the commands, with the number that shows it: beyond limits, at a limit for long, gaps.
  [[nodiscard]] std::vector<std::string> oddities(const config::Layout& layout) const;
  /// Positions with the lags, limits and dead bands of this layout, which has the actuators of that of the
  /// constructor.
  [[nodiscard]] ActuatorTrajectory trajectory(const config::Layout& layout) const;

 private:
  struct Input {
    const Signal* signal = nullptr;  ///< nullptr: neutral
    bool is_position = false;
    std::string name;
    std::shared_ptr<const Signal> converted;  ///< of pulses, in the unit of the command
  };
  /// Whether a predicate holds for any input that has its signal.
  template <class Is>
  [[nodiscard]] bool has_any(Is is) const;
  /// `by_place`: the output that moves it where none of the wanted signals is there; empty: none does.
  [[nodiscard]] Input input_of(const std::string& actuator, std::vector<std::string> wanted,
                               const std::string& by_place, const sim::PulseRange& range);

  const RecordedMotion& motion_;
  bool are_by_place_ = false;  ///< actuators that an output moves by its place
  std::vector<Input> thrusters_, surfaces_, ballasts_, masses_;
  std::vector<std::string> missing_;
};

}  // namespace navcal::identify
