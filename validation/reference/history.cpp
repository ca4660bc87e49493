// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/history.h"

#include <algorithm>
#include <cmath>

namespace navcal::reference {
namespace {

constexpr double kColderPerMetre_K = 0.25;
constexpr double kSelfHeating_K = 8;
constexpr double kWarming_s = 200;

}  // namespace

double History::water_C(double depth_m) const { return surface_C_ - kColderPerMetre_K * depth_m; }

History::History(const Snapshot& first, double step_s, double memory_s, double surface_C)
    : step_s_(step_s), memory_s_(memory_s), surface_C_(surface_C) {
  past_.push_back(first);
  past_.back().electronics_C = water_C(first.position_m.z());
}

void History::remember(Snapshot next) {
  const Snapshot& last = past_.back();
  const double settled_C = kSelfHeating_K + (water_C(last.position_m.z()) + water_C(next.position_m.z())) / 2;
  next.electronics_C = settled_C + std::exp(-step_s_ / kWarming_s) * (last.electronics_C - settled_C);
  past_.push_back(next);
  while (past_.size() > 2 && past_[1].time_s < next.time_s - memory_s_) past_.pop_front();
}

Snapshot History::at(double time_s) const {
  if (past_.size() < 2 || time_s <= past_.front().time_s) return past_.front();
  if (time_s >= past_.back().time_s) return past_.back();
  // Steps are all alike: the place is known up to rounding.
  const double steps = (time_s - past_.front().time_s) / step_s_;
  auto i = std::min(static_cast<std::size_t>(steps), past_.size() - 2);
  if (past_[i].time_s > time_s) --i;
  const Snapshot &first = past_[i], &second = past_[i + 1];
  return between(first, second, (time_s - first.time_s) / (second.time_s - first.time_s));
}

}  // namespace navcal::reference
