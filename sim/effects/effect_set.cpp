// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect_set.h"

#include <algorithm>

namespace navcal::sim {

EffectSet::EffectSet(const EffectSet& other)
    : VehicleInfluencer(other), begin_ns_(other.begin_ns_), layout_members_(other.layout_members_) {
  members_.reserve(other.members_.size());
  for (const Member& member : other.members_) members_.push_back({member.effect->clone(), member.when});
}

EffectSet& EffectSet::operator=(const EffectSet& other) { return *this = EffectSet(other); }

Effect& EffectSet::add(std::unique_ptr<Effect> effect, const Interval& when) {
  const auto later = std::ranges::upper_bound(members_, effect->description().order, {}, [](const Member& member) {
    return member.effect->description().order;
  });
  return *members_.insert(later, {std::move(effect), when})->effect;
}

void EffectSet::reseed(std::uint64_t seed) {
  constexpr std::uint64_t kApart = 0x9e3779b97f4a7c15;  // so that neighbouring seeds share no stream
  for (const Member& member : members_) member.effect->reseed(seed += kApart);
}

Delays EffectSet::delays(double time_s) {
  Delays more;
  each(time_s, [&](Effect& effect) { effect.delays(more); });
  return more;
}

void EffectSet::influence(double time_s, Influences& on) {
  each(time_s, [&](Effect& effect) { effect.influence(time_s, on); });
}

void EffectSet::link_fins(double time_s, double step_s, Vector3& fins_rad) {
  each(time_s, [&](Effect& effect) { effect.link_fins(time_s, step_s, fins_rad); });
}

void EffectSet::change_layout(double time_s, config::Layout& layout) {
  for (const LayoutMember& member : layout_members_) {
    if (member.when.contains(time_s)) layout = changed_layout(std::move(layout), member.effect);
  }
}

double EffectSet::next_layout_change_s(double time_s) const {
  double next_s = std::numeric_limits<double>::infinity();
  for (const LayoutMember& member : layout_members_) {
    for (const double edge_s : {member.when.from_s, member.when.until_s}) {
      if (edge_s > time_s) next_s = std::min(next_s, edge_s);
    }
  }
  return next_s;
}

double EffectSet::noise(Instrument of, double time_s) {
  double factor = 1;
  each(time_s, [&](Effect& effect) { effect.noise(of, factor); });
  return factor;
}

double EffectSet::slow_ppm(Instrument of, double time_s) {
  double ppm = 0;
  each(time_s, [&](Effect& effect) { effect.clock(of, ppm); });
  return ppm;
}

Transmission EffectSet::line(Instrument of, double time_s) {
  Transmission way;
  each(time_s, [&](Effect& effect) { effect.line(of, time_s, way); });
  return way;
}

}  // namespace navcal::sim
