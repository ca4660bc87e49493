// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include "sim/state.h"

namespace navcal::gap {

/// States of the estimator over the last twelve seconds, one for each frame of the card. Late readings are
/// compared with the state at their time of measurement.
class StateHistory {
 public:
  [[nodiscard]] bool empty() const { return moments_.empty(); }
  [[nodiscard]] double newest_s() const { return moments_.back().time_s; }
  /// State of the newest moment, before its readings were used.
  [[nodiscard]] const sim::State& predicted() const { return moments_.back().predicted; }

  void predict(double time_s, const sim::State& state);
  /// Sets the state of the newest moment after its readings were used.
  void correct(const sim::Vector3& euler_rad, const sim::Vector3& position_m, const sim::Vector3& rate_rad_s);

  /// State at a time, as estimated then. Times beyond the history get its oldest or newest state.
  [[nodiscard]] sim::State filtered_at(double time_s) const;
  /// State at a time shortly before the newest moment, with all corrections since then.
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
