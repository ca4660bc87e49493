// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr std::array<EffectParameter, 1> kImuLatencyParameters{{{"tau_s", 0.05, 0, 1}}};

constexpr std::array<std::string_view, 2> kImuLatencyConfounders{"compass_lag", "fin_lag"};

constexpr EffectDescription kImuLatency{.name = "imu_latency",
                                        .equation = "x(t - tau)",
                                        .parameters = kImuLatencyParameters,
                                        .manoeuvre = "fast rudder and elevator doublets",
                                        .confounders = kImuLatencyConfounders,
                                        .kind = EffectKind::lag};

/// All channels of the inertial card are older than nominal.
class ImuLatency final : public EffectOf<ImuLatency, 1> {
 public:
  [[nodiscard]] const EffectDescription& description() const override { return kImuLatency; }
  void delays(Delays& more) override { more.card_s += p_[0]; }
};

}  // namespace

std::unique_ptr<Effect> make_imu_latency() { return std::make_unique<ImuLatency>(); }

}  // namespace navcal::sim
