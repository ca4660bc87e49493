// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/library/library.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kAccelBias =
    described("accel_bias", "f += b", alike("x_m_s2 y_m_s2 z_m_s2", 0.12, -20, 20),
              "pitch through more than 30 degrees", {.confounders = {"tilt_offset", "accel_scale"}, .vector = 3});
/// The accelerometers' zeros are off.
struct AccelBias final : EffectOf<AccelBias, kAccelBias> {
  void accelerometers(const Instant&, Vector3& force_m_s2) override { add_scaled(force_m_s2, 1, vector()); }
};

constexpr EffectDescription kAccelScale =
    described("accel_scale", "f += s f", alike("x y z", 0.02, -0.9, 1), "pitch through more than 30 degrees",
              {.confounders = {"tilt_offset", "accel_bias", "thrust_scale"}});
/// Each accelerometer's scale is off.
struct AccelScale final : EffectOf<AccelScale, kAccelScale> {
  void accelerometers(const Instant& now, Vector3& force_m_s2) override {
    for (std::size_t i = 0; i < 3; ++i) force_m_s2[i] += p_[i] * now.state.specific_force_m_s2[i];
  }
};

constexpr EffectDescription kAccelVibration =
    described("accel_vibration", "f += k I^2", alike("x_m_s2_per_A2 y_m_s2_per_A2 z_m_s2_per_A2", 0.05, -5, 5),
              "step the shaft speed through its whole range, straight and level",
              {.confounders = {"adc_droop"}, .vector = 3});
/// The motor's vibration is rectified by the accelerometers.
struct AccelVibration final : EffectOf<AccelVibration, kAccelVibration> {
  void accelerometers(const Instant& now, Vector3& force_m_s2) override {
    const double current_A = now.state.motor_current_A;
    add_scaled(force_m_s2, current_A * current_A, vector());
  }
};

constexpr EffectDescription kAdcDroop =
    described("adc_droop", "every raw channel in mV: v *= 1 + k I", {{"per_A", 0.0015, -0.1, 0.1}},
              "step the motor current, straight and level", {.confounders = {"motor_field", "accel_vibration"}});
/// The converter's reference follows the motor's load.
struct AdcDroop final : EffectOf<AdcDroop, kAdcDroop> {
  void card_voltages(const Instant& now, CardVoltages_mV& voltages) override {
    for (double& voltage : voltages) voltage *= 1 + p_[0] * now.state.motor_current_A;
  }
};

constexpr EffectDescription kDepthScale = described("depth_scale", "z += s z", {{"scale", 0.06, -0.9, 1}},
                                                    "hold two depths far apart", {.confounders = {"buoyancy"}});
/// The pressure gauge's scale is off.
struct DepthScale final : EffectOf<DepthScale, kDepthScale> {
  void depth(const Instant& now, double& depth_m) override { depth_m += p_[0] * now.state.position_m[2]; }
};

constexpr EffectDescription kDepthTemperature =
    described("depth_temperature", "z += c T, T above 15 C", {{"m_per_C", 0.025, -1, 1}},
              "hold one depth while the electronics warm up", {.confounders = {"buoyancy", "depth_scale"}});
/// The pressure gauge's zero moves as the electronics warm up.
struct DepthTemperature final : EffectOf<DepthTemperature, kDepthTemperature> {
  void depth(const Instant& now, double& depth_m) override { depth_m += p_[0] * now.temperature_rise_C(); }
};

constexpr EffectDescription kImuLatency =
    described("imu_latency", "x(t - tau)", {{"tau_s", 0.05, 0, 1}}, "fast rudder and elevator doublets",
              {.confounders = {"compass_lag", "fin_lag"}, .kind = EffectKind::lag});
/// All channels of the inertial card are older than nominal.
struct ImuLatency final : EffectOf<ImuLatency, kImuLatency> {
  void delays(Delays& more) override { more.card_s += p_[0]; }
};

}  // namespace

std::span<const EffectEntry> effects_of_card() {
  return entries_of<AccelBias, AccelScale, AccelVibration, AdcDroop, DepthScale, DepthTemperature, ImuLatency>();
}

}  // namespace navcal::sim
