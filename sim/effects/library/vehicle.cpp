// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/library/library.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kBuoyancy = described(
    "buoyancy", "Z_world -= F at the origin", {{"force_N", 0.4, -20, 20}}, "glide or hover with the propeller off",
    {.confounders = {"depth_scale", "elevator_offset"}, .place = EffectPlace::vehicle});
/// The vehicle is not of the water's weight.
struct Buoyancy final : EffectOf<Buoyancy, kBuoyancy> {
  void influence(double /*time_s*/, Influences& on) override { on.buoyancy_N += p_[0]; }
};

constexpr EffectDescription kThrustScale =
    described("thrust_scale", "thrust *= 1 + k", {{"scale", 0.08, -0.9, 1}},
              "run reciprocal legs with speed steps at the surface",
              {.confounders = {"water_current", "fin_gain", "accel_scale"}, .place = EffectPlace::vehicle});
/// The propeller pushes more than nominal.
struct ThrustScale final : EffectOf<ThrustScale, kThrustScale> {
  void influence(double /*time_s*/, Influences& on) override { on.thrust_factor *= 1 + p_[0]; }
};

constexpr EffectDescription kWaterCurrent =
    described("water_current", "v_world += c", {{"north_m_s", 0.06, -5, 5}, {"east_m_s", 0.06, -5, 5}},
              "run reciprocal legs at the surface",
              {.confounders = {"thrust_scale", "declination"}, .place = EffectPlace::vehicle, .vector = 2});
/// The water moves over the ground.
struct WaterCurrent final : EffectOf<WaterCurrent, kWaterCurrent> {
  void influence(double /*time_s*/, Influences& on) override {
    on.current_m_s[0] += p_[0];
    on.current_m_s[1] += p_[1];
  }
};

constexpr EffectDescription kYawDamping = described(
    "yaw_damping", "N -= k M66 r", {{"per_s", 0.3, -0.15, 10}}, "rudder doublets of two sizes at two speeds",
    {.confounders = {"fin_gain", "fin_lag", "thrust_scale"}, .place = EffectPlace::vehicle});
/// The hull resists turning more than nominal.
struct YawDamping final : EffectOf<YawDamping, kYawDamping> {
  void influence(double /*time_s*/, Influences& on) override { on.yaw_damping_per_s += p_[0]; }
};

}  // namespace

std::span<const EffectEntry> effects_of_vehicle() {
  return entries_of<Buoyancy, ThrustScale, WaterCurrent, YawDamping>();
}

}  // namespace navcal::sim
