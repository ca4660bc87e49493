// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include "sim/state.h"

namespace navcal::gap {

/// The estimator's last twelve seconds, a state at each reading of the card: what readings that are late were
/// measured at.
class StateHistory {
 public:
  [[nodiscard]] bool empty() const { return moments_.empty(); }
  [[nodiscard]] double newest_s() const { return moments_.back().time_s; }
  /// Of the newest moment, before its readings were used.
  [[nodiscard]] const sim::State& predicted() const { return moments_.back().predicted; }

  void predict(double time_s, const sim::State& state);
  /// The newest moment, after its readings were used.
  void correct(const sim::Vector3& euler_rad, const sim::Vector3& position_m, const sim::Vector3& rate_rad_s);

  /// As it was known then; the oldest or newest for times beyond.
  [[nodiscard]] sim::State filtered_at(double time_s) const;
  /// Of a time little before the newest moment, corrected by all that was read since.
  [[nodiscard]] sim::State corrected_at(double time_s) const;

 private:
  struct Moment {
    double time_s = 0;
    sim::State predicted;  ///< before the readings of this moment were used
    sim::State corrected;  ///< after
  };
  std::deque<Moment> moments_;  ///< the newest last
};

}  // namespace navcal::gap
