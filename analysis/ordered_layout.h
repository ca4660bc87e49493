// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sim/layout/control/layout_ordered_helm.h"
#include "sim/layout/layout_motion.h"

namespace navcal::analysis {

/// A simulated layout that obeys the outputs that it is sent, in real time: as OrderedMotion, which obeys a motor
/// card.
class OrderedLayout final : public sim::Motion {
 public:
  /// `options.start_ns` in UTC; `now_ns` gives UTC.
  OrderedLayout(const config::Layout& layout, const sim::MotionOptions& options,
                std::function<std::int64_t()> now_ns)
      : now_ns_(std::move(now_ns)), start_ns_(options.start_ns), helm_(new sim::LayoutOrderedHelm(layout)),
        motion_(layout, std::unique_ptr<sim::LayoutHelm>(helm_), options) {}

  /// The state at t_ns; for a time to come, the state now. Throws UnstableVehicle.
  [[nodiscard]] sim::State at(std::int64_t t_ns) const override { return motion_.at(std::min(t_ns, now_ns_())); }
  void take_outputs(std::int64_t t_ns, std::vector<sim::OutputOrder>& out) const override {
    motion_.take_outputs(std::min(t_ns, now_ns_()), out);
  }
  /// What the outputs were told at t_ns; nullopt leaves one as it is. It takes effect at once.
  void order(std::int64_t t_ns, const std::vector<std::optional<double>>& pulses_us) {
    helm_->order(static_cast<double>(t_ns - start_ns_) * 1e-9, pulses_us);
  }

 private:
  std::function<std::int64_t()> now_ns_;
  std::int64_t start_ns_;
  sim::LayoutOrderedHelm* helm_;  ///< owned by motion_
  sim::LayoutMotion motion_;
};

}  // namespace navcal::analysis
