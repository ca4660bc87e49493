// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"
#include "sim/effects/low_pass.h"

namespace navcal::sim {
namespace {

constexpr std::array<EffectParameter, 1> kFinLagParameters{{{"tau_s", 0.2, 0, 5}}};

constexpr std::array<std::string_view, 4> kFinLagConfounders{"fin_gain", "yaw_damping", "thrust_scale",
                                                             "imu_latency"};

constexpr EffectDescription kFinLag{.name = "fin_lag",
                                    .equation = "tau d' + d = servo",
                                    .parameters = kFinLagParameters,
                                    .manoeuvre = "fast rudder doublets",
                                    .confounders = kFinLagConfounders,
                                    .place = EffectPlace::vehicle,
                                    .order = 1,
                                    .kind = EffectKind::lag};

/// A further lag between the servo that is reported and the fin.
class FinLag final : public EffectOf<FinLag, 1> {
 public:
  [[nodiscard]] const EffectDescription& description() const override { return kFinLag; }
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
