// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "sim/effects/library/library.h"
#include "sim/effects/low_pass.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kElevatorOffset =
    described("elevator_offset", "d += mixed elevator o", {{"angle_deg", 1, -20, 20}}, "elevator doublets, level",
              {.confounders = {"fin_gain", "fin_offset"}, .place = EffectPlace::vehicle});
/// The fins stand off in the sense of an elevator command, between servo and fin.
struct ElevatorOffset final : EffectOf<ElevatorOffset, kElevatorOffset> {
  void link_fins(double /*time_s*/, double /*step_s*/, Vector3& fins_rad) override {
    const double elevator_rad = p_[0] * std::numbers::pi / 180;
    constexpr double kShare = std::numbers::sqrt3 / 2;  // docs/simulator.md: how rudder and elevator mix
    add_scaled(fins_rad, elevator_rad, {0, kShare, -kShare});
  }
};

constexpr EffectDescription kFinBacklash = described(
    "fin_backlash", "d stays within b/2 of the servo", {{"width_deg", 2, 0, 30}}, "small fin reversals about zero",
    {.confounders = {"fin_lag"}, .place = EffectPlace::vehicle, .order = 2, .kind = EffectKind::backlash});
/// Backlash of total width b between the servo that is reported and the fin.
struct FinBacklash final : EffectOf<FinBacklash, kFinBacklash> {
  void link_fins(double /*time_s*/, double /*step_s*/, Vector3& fins_rad) override {
    if (!begun_) fins_rad_ = fins_rad;
    begun_ = true;
    const double half_rad = p_[0] * std::numbers::pi / 360;
    for (std::size_t i = 0; i < 3; ++i) {
      fins_rad_[i] = std::clamp(fins_rad_[i], fins_rad[i] - half_rad, fins_rad[i] + half_rad);
    }
    fins_rad = fins_rad_;
  }

 private:
  Vector3 fins_rad_{};
  bool begun_ = false;
};

constexpr EffectDescription kFinGain = described(
    "fin_gain", "d *= 1 + k", {{"scale", 0.08, -0.9, 1}}, "rudder doublets of two sizes at two speeds",
    {.confounders = {"fin_lag", "yaw_damping", "thrust_scale"}, .place = EffectPlace::vehicle, .order = 0});
/// The fin turns further than the servo that is reported.
struct FinGain final : EffectOf<FinGain, kFinGain> {
  void link_fins(double /*time_s*/, double /*step_s*/, Vector3& fins_rad) override {
    for (double& fin_rad : fins_rad) fin_rad *= 1 + p_[0];
  }
};

constexpr EffectDescription kFinLag =
    described("fin_lag", "tau d' + d = servo", {{"tau_s", 0.2, 0, 5}}, "fast rudder doublets",
              {.confounders = {"fin_gain", "yaw_damping", "thrust_scale", "imu_latency"},
               .place = EffectPlace::vehicle,
               .order = 1,
               .kind = EffectKind::lag});
/// A further lag between the servo that is reported and the fin.
struct FinLag final : EffectOf<FinLag, kFinLag> {
  void link_fins(double /*time_s*/, double step_s, Vector3& fins_rad) override {
    elapsed_s_ += step_s;
    fins_rad = filter_.at(elapsed_s_, fins_rad, p_[0]);
  }

 private:
  LowPass filter_;
  double elapsed_s_ = 0;
};

constexpr EffectDescription kFinOffset =
    described("fin_offset", "d += mixed rudder o", {{"angle_deg", 1, -20, 20}}, "rudder doublets, straight",
              {.confounders = {"fin_gain", "elevator_offset"}, .place = EffectPlace::vehicle});
/// The fins stand off in the sense of a rudder command, between servo and fin.
struct FinOffset final : EffectOf<FinOffset, kFinOffset> {
  void link_fins(double /*time_s*/, double /*step_s*/, Vector3& fins_rad) override {
    const double rudder_rad = p_[0] * std::numbers::pi / 180;
    add_scaled(fins_rad, rudder_rad, {-1, 0.5, 0.5});  // docs/simulator.md: how rudder and elevator mix
  }
};

}  // namespace

std::span<const EffectEntry> effects_of_fins() {
  return entries_of<ElevatorOffset, FinBacklash, FinGain, FinLag, FinOffset>();
}

}  // namespace navcal::sim
