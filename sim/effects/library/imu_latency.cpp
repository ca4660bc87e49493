// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kImuLatency{.name = "imu_latency",
                                        .equation = "x(t - tau)",
                                        .parameters = {{"tau_s", 0.05, 0, 1}},
                                        .manoeuvre = "fast rudder and elevator doublets",
                                        .confounders = {"compass_lag", "fin_lag"},
                                        .kind = EffectKind::lag};

/// All channels of the inertial card are older than nominal.
class ImuLatency final : public EffectOf<ImuLatency, kImuLatency> {
 public:
  void delays(Delays& more) override { more.card_s += p_[0]; }
};

}  // namespace

std::unique_ptr<Effect> make_imu_latency() { return std::make_unique<ImuLatency>(); }

}  // namespace navcal::sim
