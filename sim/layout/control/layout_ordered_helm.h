// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "config/layout.h"
#include "sim/layout/layout_helm.h"
#include "sim/layout/pulses.h"
#include "sim/vehicle/ordered_helm.h"

namespace navcal::sim {

/// Moves the actuators of a layout as it is ordered while the run goes on. The run begins at rest at the surface,
/// heading north, with all neutral.
class LayoutOrderedHelm final : public LayoutHelm {
 public:
  explicit LayoutOrderedHelm(const config::Layout& layout)
      : pulses_us_(pulses_of(layout, ActuatorValues::neutral(layout))) {}

  /// Takes an order; nullopt leaves an output as it is. Times are in order, seconds of the run. An order applies
  /// from the step whose beginning is nearest; one for a past time, from the next step on.
  void order(double time_s, std::vector<std::optional<double>> pulses_us) {
    waiting_.push_back({time_s, std::move(pulses_us)});
  }

  [[nodiscard]] Body start() const override {
    Body body;
    body.position_m.z() = OrderedHelm::kSurface_m;
    return body;
  }
  [[nodiscard]] const std::vector<double>& next(double time_s, double step_s, const Body& /*body*/) override {
    for (; !waiting_.empty() && waiting_.front().time_s <= time_s + step_s / 2; waiting_.pop_front()) {
      const auto& wanted = waiting_.front().pulses_us;
      for (std::size_t i = 0; i < pulses_us_.size() && i < wanted.size(); ++i)
        pulses_us_[i] = wanted[i].value_or(pulses_us_[i]);
    }
    return pulses_us_;
  }
  [[nodiscard]] bool finished() const override { return false; }

 private:
  struct TimedPulses {
    double time_s;
    std::vector<std::optional<double>> pulses_us;
  };

  std::vector<double> pulses_us_;
  std::deque<TimedPulses> waiting_;
};

}  // namespace navcal::sim
