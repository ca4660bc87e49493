// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "sim/state.h"

namespace navcal::sim {

/// A motion at a place whose field is not the reference field of State.
class MotionInField final : public Motion {
 public:
  /// `field_world_uT`: north, east, down.
  MotionInField(std::unique_ptr<const Motion> motion, const Vector3& field_world_uT)
      : motion_(std::move(motion)), field_world_uT_(field_world_uT) {}

  [[nodiscard]] State at(std::int64_t t_ns) const override {
    State state = motion_->at(t_ns);
    state.field_world_uT = field_world_uT_;
    return state;
  }
  void take_orders(std::int64_t t_ns, std::vector<Order>& out) const override { motion_->take_orders(t_ns, out); }
  void take_outputs(std::int64_t t_ns, std::vector<OutputOrder>& out) const override {
    motion_->take_outputs(t_ns, out);
  }

 private:
  std::unique_ptr<const Motion> motion_;
  Vector3 field_world_uT_;
};

}  // namespace navcal::sim
