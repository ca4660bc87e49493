// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>

#include "sim/state.h"

namespace navcal::sim {

/// Step of the simulated vehicles.
inline constexpr std::int64_t kMotionStep_ns = 10'000'000;
inline constexpr double kMotionStep_s = 1e-9 * kMotionStep_ns;

/// States at the beginnings of steps of kMotionStep_ns, the newest of them; states between steps in a straight
/// line.
class StepHistory {
 public:
  /// `history_s`: time for which states are kept.
  explicit StepHistory(double history_s) : history_s_(history_s) {}

  void push(const State& state) {
    states_.push_back(state);
    ++steps_;
    if (static_cast<double>(states_.size()) * kMotionStep_s > history_s_ && states_.size() > 2)
      states_.pop_front();
  }
  /// Number of steps that must have been pushed for a state so long after the beginning.
  [[nodiscard]] static std::int64_t steps_for(std::int64_t elapsed_ns) {
    return std::max<std::int64_t>(0, elapsed_ns) / kMotionStep_ns + 2;
  }
  /// Before the beginning, the first state; older than what is kept, the oldest one.
  [[nodiscard]] State at(std::int64_t elapsed_ns) const {
    elapsed_ns = std::max<std::int64_t>(0, elapsed_ns);
    const std::int64_t step = elapsed_ns / kMotionStep_ns;
    const std::int64_t oldest = steps_ - static_cast<std::int64_t>(states_.size());
    if (step < oldest) return states_.front();
    const auto index = static_cast<std::size_t>(step - oldest);
    const double part =
        static_cast<double>(elapsed_ns - step * kMotionStep_ns) / static_cast<double>(kMotionStep_ns);
    return between(states_[index], states_[index + 1], part);
  }
  [[nodiscard]] std::int64_t steps() const { return steps_; }

 private:
  double history_s_;
  std::int64_t steps_ = 0;  ///< pushed
  std::deque<State> states_;
};

}  // namespace navcal::sim
