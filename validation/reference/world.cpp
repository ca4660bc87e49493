// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/world.h"

#include <algorithm>
#include <cmath>

namespace navcal::reference {
namespace {

constexpr double kColderPerMetre_K = 0.25;
constexpr double kSelfHeating_K = 8;
constexpr double kWarming_s = 200;

}  // namespace

double World::water_C(double depth_m) const { return surface_C_ - kColderPerMetre_K * depth_m; }

World::World(Vehicle vehicle, double memory_s, double surface_C)
    : vehicle_(std::move(vehicle)), memory_s_(memory_s), surface_C_(surface_C) {
  past_.push_back(vehicle_.snapshot());
  past_.back().electronics_C = water_C(past_.back().position_m.z());
}

void World::advance(double to_s) {
  const double begin_s = vehicle_.time_s();
  const auto steps = std::llround((to_s - begin_s) / Vehicle::kStep_s);
  for (long long i = 1; i <= steps; ++i) {
    vehicle_.advance(begin_s + static_cast<double>(i) * Vehicle::kStep_s);
    remember(Vehicle::kStep_s);
  }
}

void World::remember(double step_s) {
  Snapshot next = vehicle_.snapshot();
  const Snapshot& last = past_.back();
  const double settled_C = kSelfHeating_K + (water_C(last.position_m.z()) + water_C(next.position_m.z())) / 2;
  next.electronics_C = settled_C + std::exp(-step_s / kWarming_s) * (last.electronics_C - settled_C);
  past_.push_back(next);
  while (past_.size() > 2 && past_[1].time_s < next.time_s - memory_s_) past_.pop_front();
}

Snapshot World::at(double time_s) const {
  if (past_.size() < 2 || time_s <= past_.front().time_s) return past_.front();
  if (time_s >= past_.back().time_s) return past_.back();
  // Steps are all alike: the place is known up to rounding.
  const double steps = (time_s - past_.front().time_s) / Vehicle::kStep_s;
  auto i = std::min(static_cast<std::size_t>(steps), past_.size() - 2);
  if (past_[i].time_s > time_s) --i;
  const Snapshot &first = past_[i], &second = past_[i + 1];
  return between(first, second, (time_s - first.time_s) / (second.time_s - first.time_s));
}

}  // namespace navcal::reference
