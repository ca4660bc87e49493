// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"
#include "sim/effects/low_pass.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kFinLag{.name = "fin_lag",
                                    .equation = "tau d' + d = servo",
                                    .parameters = {{"tau_s", 0.2, 0, 5}},
                                    .manoeuvre = "fast rudder doublets",
                                    .confounders = {"fin_gain", "yaw_damping", "thrust_scale", "imu_latency"},
                                    .place = EffectPlace::vehicle,
                                    .order = 1,
                                    .kind = EffectKind::lag};

/// A further lag between the servo that is reported and the fin.
class FinLag final : public EffectOf<FinLag, kFinLag> {
 public:
  void link_fins(double /*time_s*/, double step_s, Vector3& fins_rad) override {
    elapsed_s_ += step_s;
    fins_rad = filter_.at(elapsed_s_, fins_rad, p_[0]);
  }

 private:
  LowPass filter_;
  double elapsed_s_ = 0;
};

}  // namespace

std::unique_ptr<Effect> make_fin_lag() { return std::make_unique<FinLag>(); }

}  // namespace navcal::sim
