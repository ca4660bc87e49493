// SPDX-License-Identifier: Apache-2.0
#include "gap/actuators/linked_actuators.h"

#include <algorithm>

namespace navcal::gap {
namespace {

constexpr double kStep_s = ActuatorTrack::kStep_s;

}  // namespace

LinkedActuators::LinkedActuators(std::span<const ActuatorTrack::Row> rows, sim::EffectSet& effects) : rows_(rows) {
  sim::Controls sum;
  fins_rad_.reserve(rows.size());
  integrals_.reserve(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    sim::Vector3 linked_rad = rows[k].fins_rad;
    effects.link_fins(static_cast<double>(k) * kStep_s, kStep_s, linked_rad);
    fins_rad_.emplace_back(linked_rad[0], linked_rad[1], linked_rad[2]);
    if (k > 0) {
      sum.fins_rad += kStep_s / 2 * (fins_rad_[k - 1] + fins_rad_[k]);
      sum.shaft_rps += kStep_s / 2 * (rows[k - 1].shaft_rps + rows[k].shaft_rps);
    }
    integrals_.push_back(sum);
  }
}

std::size_t LinkedActuators::row_at(double time_s) const {
  return static_cast<std::size_t>(std::clamp(time_s / kStep_s, 0.0, static_cast<double>(rows_.size() - 1)));
}

sim::Controls LinkedActuators::of_row(std::size_t row) const { return {fins_rad_[row], rows_[row].shaft_rps}; }

sim::Controls LinkedActuators::integral_until(double time_s) const {
  const double place = std::clamp(time_s / kStep_s, 0.0, static_cast<double>(integrals_.size() - 1));
  const auto k = std::min(static_cast<std::size_t>(place), integrals_.size() - 2);
  const double part = place - static_cast<double>(k);
  const auto &a = integrals_[k], &b = integrals_[k + 1];
  return {a.fins_rad + part * (b.fins_rad - a.fins_rad), a.shaft_rps + part * (b.shaft_rps - a.shaft_rps)};
}

sim::Controls LinkedActuators::mean(double from_s, double until_s) const {
  constexpr double kLeast_s = 1e-3;
  until_s = std::max(until_s, from_s + kLeast_s);
  if (until_s >= static_cast<double>(rows_.size() - 1) * kStep_s) return of_row(rows_.size() - 1);
  const auto a = integral_until(from_s), b = integral_until(until_s);
  return {(b.fins_rad - a.fins_rad) / (until_s - from_s), (b.shaft_rps - a.shaft_rps) / (until_s - from_s)};
}

}  // namespace navcal::gap
