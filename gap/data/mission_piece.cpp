// SPDX-License-Identifier: Apache-2.0
#include "gap/data/mission_piece.h"

#include <algorithm>

namespace navcal::gap {
namespace {

template <class Reading>
std::vector<Reading> readings_between(const std::vector<Reading>& all, double from_s, double until_s) {
  std::vector<Reading> some(std::ranges::lower_bound(all, from_s, {}, &Reading::time_s),
                            std::ranges::lower_bound(all, until_s, {}, &Reading::time_s));
  for (Reading& reading : some) reading.time_s -= from_s;
  return some;
}

}  // namespace

Mission piece_of(const Mission& mission, double from_s, double until_s) {
  Mission piece;
  piece.compass = readings_between(mission.compass, from_s, until_s);
  piece.card = readings_between(mission.card, from_s, until_s);
  piece.fixes = readings_between(mission.fixes, from_s, until_s);
  piece.motor = readings_between(mission.motor, from_s, until_s);
  piece.orders = readings_between(mission.orders, from_s, until_s);
  const auto is_within = [&](double time_s) { return time_s >= from_s && time_s < until_s; };
  for (const double time_s : mission.commanded_s) {
    if (is_within(time_s)) piece.commanded_s.push_back(time_s - from_s);
  }
  for (std::size_t i = 0; i < mission.order_times_s.size(); ++i) {
    if (!is_within(mission.order_times_s[i])) continue;
    piece.order_times_s.push_back(mission.order_times_s[i] - from_s);
    if (i < mission.ordered_fins_rad.size()) piece.ordered_fins_rad.push_back(mission.ordered_fins_rad[i]);
  }
  piece.motor_is_commanded = mission.motor_is_commanded;
  piece.duration_s = std::min(until_s, mission.duration_s) - from_s;
  piece.field = mission.field;
  piece.instruments = mission.instruments;
  find_silences(piece);
  return piece;
}

}  // namespace navcal::gap
