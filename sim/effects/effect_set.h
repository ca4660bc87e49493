// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "sim/effects/effect.h"
#include "sim/layout/effects/layout_effects.h"

namespace navcal::sim {

/// Interval in which an effect acts, in seconds of the mission.
struct Interval {
  double from_s = -std::numeric_limits<double>::infinity();
  double until_s = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool contains(double time_s) const { return time_s >= from_s && time_s < until_s; }
};

/// Effects that act together, each in its place of the order that its description gives. Copies are deep: a copy
/// goes on from the same filters and noise. Without effects nothing changes.
class EffectSet final : public VehicleInfluencer {
 public:
  /// `begin_ns`: UTC of the mission's beginning.
  explicit EffectSet(std::int64_t begin_ns = 0) : begin_ns_(begin_ns) {}
  EffectSet(const EffectSet& other);
  EffectSet& operator=(const EffectSet& other);
  EffectSet(EffectSet&&) = default;
  EffectSet& operator=(EffectSet&&) = default;
  ~EffectSet() override = default;

  /// Returns the added effect, so that the caller can change its parameters.
  Effect& add(std::unique_ptr<Effect> effect, const Interval& when = {});
  /// Adds an effect of the layout itself, in the order in which they act.
  void add(LayoutEffect effect, const Interval& when = {}) {
    layout_members_.push_back({std::move(effect), when});
  }
  /// Seeds the random numbers of all effects, each with a seed of its own.
  void reseed(std::uint64_t seed);
  [[nodiscard]] std::size_t size() const { return members_.size(); }
  [[nodiscard]] Effect& operator[](std::size_t i) const { return *members_[i].effect; }
  [[nodiscard]] const Interval& interval(std::size_t i) const { return members_[i].when; }

  /// An effect of the layout with its interval.
  struct LayoutMember {
    LayoutEffect effect;
    Interval when;
  };
  [[nodiscard]] const std::vector<LayoutMember>& layout_members() const { return layout_members_; }

  [[nodiscard]] double time_s(std::int64_t t_ns) const { return static_cast<double>(t_ns - begin_ns_) * 1e-9; }
  [[nodiscard]] Instant instant(std::int64_t t_ns, const State& state, double electronics_C) const {
    return {time_s(t_ns), state, electronics_C};
  }

  // The hooks of Effect, through all that act now.
  void earth_field(const Instant& now, Vector3& field_world_uT) {
    through(&Effect::earth_field, now, field_world_uT);
  }
  void body_field(const Instant& now, Vector3& field_body_uT) { through(&Effect::body_field, now, field_body_uT); }
  void tilt_seen(const Instant& now, Tilt& tilt) { through(&Effect::tilt_seen, now, tilt); }
  void tilt_said(const Instant& now, Tilt& tilt) { through(&Effect::tilt_said, now, tilt); }
  void gyros(const Instant& now, GyroRates& rate_rad_s) { through(&Effect::gyros, now, rate_rad_s); }
  void accelerometers(const Instant& now, Vector3& force_m_s2) {
    through(&Effect::accelerometers, now, force_m_s2);
  }
  void depth(const Instant& now, double& depth_m) { through(&Effect::depth, now, depth_m); }
  void card_voltages(const Instant& now, CardVoltages_mV& voltages) {
    through(&Effect::card_voltages, now, voltages);
  }
  void antenna(const Instant& now, AntennaMotion& motion) { through(&Effect::antenna, now, motion); }
  [[nodiscard]] Delays delays(double time_s);
  void influence(double time_s, Influences& on) override;
  void link_fins(double time_s, double step_s, Vector3& fins_rad) override;
  void change_layout(double time_s, config::Layout& layout) override;
  [[nodiscard]] double next_layout_change_s(double time_s) const override;
  /// Factor on the standard deviation of an instrument's noise.
  [[nodiscard]] double noise(Instrument of, double time_s);
  /// Amount by which an instrument's clock runs slower than nominal, parts per million.
  [[nodiscard]] double slow_ppm(Instrument of, double time_s);
  [[nodiscard]] Transmission line(Instrument of, double time_s);

 private:
  struct Member {
    std::unique_ptr<Effect> effect;
    Interval when;
  };
  template <class Hook>
  void each(double time_s, Hook hook) {
    for (const Member& member : members_) {
      if (member.when.contains(time_s)) hook(*member.effect);
    }
  }
  template <class Changed>
  void through(void (Effect::*hook)(const Instant&, Changed&), const Instant& now, Changed& changed) {
    each(now.time_s, [&](Effect& effect) { (effect.*hook)(now, changed); });
  }

  std::int64_t begin_ns_;
  std::vector<Member> members_;
  std::vector<LayoutMember> layout_members_;
};

}  // namespace navcal::sim
