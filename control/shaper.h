// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "control/order.h"

namespace navcal::control {

/// Moves what is sent towards what is wanted, no faster than the slew rates. Between orders it moves every
/// kStep_ns; one step never makes up for more than that, so that an order after a pause does not jump.
class Shaper {
 public:
  static constexpr std::int64_t kStep_ns = 50'000'000;

  explicit Shaper(const config::CommandSettings& settings);

  void aim(const Order& wanted) { wanted_ = wanted; }
  /// True when the order sent last is the order wanted.
  [[nodiscard]] bool arrived() const { return position_ == wanted_; }
  /// Order to be sent now.
  [[nodiscard]] const Order& step(std::int64_t now_ns);
  /// Records an order that was sent without a ramp.
  void jump(std::int64_t now_ns, const Order& order);
  [[nodiscard]] const Order& wanted() const { return wanted_; }
  /// Time of the next step; kNever_ns when it has arrived.
  [[nodiscard]] std::int64_t next_ns() const { return arrived() ? kNever_ns : last_ns_ + kStep_ns; }

 private:
  double rpm_per_s_, fin_deg_per_s_;
  Order position_, wanted_;
  std::int64_t last_ns_ = 0;
};

}  // namespace navcal::control
