// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "validation/reference/sink.h"

namespace navcal::reference {

/// Transfers of all ports, brought into one order.
class Outbox {
 public:
  explicit Outbox(Sink& sink) : sink_(sink) {}
  [[nodiscard]] std::vector<Transfer>& waiting() { return waiting_; }
  void hand_over(std::int64_t to_ns) {
    const auto earlier = [](const Transfer& a, const Transfer& b) { return a.time_ns < b.time_ns; };
    std::stable_sort(waiting_.begin(), waiting_.end(), earlier);
    auto next = waiting_.begin();
    for (; next != waiting_.end() && next->time_ns <= to_ns; ++next) sink_.transfer(*next);
    waiting_.erase(waiting_.begin(), next);
  }

 private:
  Sink& sink_;
  std::vector<Transfer> waiting_;
};

}  // namespace navcal::reference
