// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kAccelVibration{
    .name = "accel_vibration",
    .equation = "f += k I^2",
    .parameters = {{"x_m_s2_per_A2", 0.05, -5, 5}, {"y_m_s2_per_A2", 0.05, -5, 5}, {"z_m_s2_per_A2", 0.05, -5, 5}},
    .manoeuvre = "step the shaft speed through its whole range, straight and level",
    .confounders = {"adc_droop"},
    .vector = 3};

/// The motor's vibration is rectified by the accelerometers.
class AccelVibration final : public EffectOf<AccelVibration, kAccelVibration> {
 public:
  void accelerometers(const Instant& now, Vector3& force_m_s2) override {
    const double current_A = now.state.motor_current_A;
    add_scaled(force_m_s2, current_A * current_A, vector());
  }
};

}  // namespace

std::unique_ptr<Effect> make_accel_vibration() { return std::make_unique<AccelVibration>(); }

}  // namespace navcal::sim
