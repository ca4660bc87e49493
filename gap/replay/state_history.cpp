// SPDX-License-Identifier: Apache-2.0
#include "gap/replay/state_history.h"

#include <algorithm>
#include <iterator>

namespace navcal::gap {
namespace {

/// Memory: a GPS may be late by ten seconds (gps_latency in sim/effects/library/receiver.cpp).
constexpr double kRemembered_s = 12;

void add_difference(sim::Vector3& sum, const sim::Vector3& after, const sim::Vector3& before) {
  for (std::size_t i = 0; i < 3; ++i) sum[i] += after[i] - before[i];
}

}  // namespace

void StateHistory::predict(double time_s, const sim::State& state) {
  moments_.push_back({time_s, state, state});
  while (moments_.front().time_s < time_s - kRemembered_s) moments_.pop_front();
}

void StateHistory::correct(const sim::Vector3& euler_rad, const sim::Vector3& position_m,
                           const sim::Vector3& rate_rad_s) {
  sim::State& newest = moments_.back().corrected;
  newest.euler_rad = euler_rad;
  newest.position_m = position_m;
  newest.rate_rad_s = rate_rad_s;
}

sim::State StateHistory::filtered_at(double time_s) const {
  const auto later = std::ranges::lower_bound(moments_, time_s, {}, &Moment::time_s);
  if (later == moments_.begin()) return moments_.front().predicted;
  if (later == moments_.end()) return moments_.back().corrected;
  const Moment& earlier = *std::prev(later);
  // Interpolation between corrected states keeps corrections continuous in time. Otherwise the innovations, as
  // a function of a delay, would jump where it reaches the time between two readings.
  return sim::between(earlier.corrected, later->corrected,
                      (time_s - earlier.time_s) / (later->time_s - earlier.time_s));
}

sim::State StateHistory::corrected_at(double time_s) const {
  sim::Vector3 euler_rad{}, position_m{}, rate_rad_s{};
  auto later = std::prev(moments_.end());
  for (; later != moments_.begin() && std::prev(later)->time_s > time_s; --later) {
    const Moment& read = *std::prev(later);
    add_difference(euler_rad, read.corrected.euler_rad, read.predicted.euler_rad);
    add_difference(position_m, read.corrected.position_m, read.predicted.position_m);
    add_difference(rate_rad_s, read.corrected.rate_rad_s, read.predicted.rate_rad_s);
  }
  if (later == moments_.begin()) return moments_.front().predicted;
  const Moment& earlier = *std::prev(later);
  // Interpolation along the vehicle's own motion, without the corrections in between. With them, the noise of
  // single corrections would make the innovations jump where a delay reaches the time between two readings.
  sim::State state = sim::between(earlier.corrected, later->predicted,
                                  (time_s - earlier.time_s) / (later->time_s - earlier.time_s));
  add_difference(state.euler_rad, euler_rad, {});
  add_difference(state.position_m, position_m, {});
  add_difference(state.rate_rad_s, rate_rad_s, {});
  return state;
}

}  // namespace navcal::gap
