// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr std::array<EffectParameter, 1> kGpsLatencyParameters{{{"tau_s", 1, 0, 10}}};

constexpr std::array<std::string_view, 1> kGpsLatencyConfounders{"gps_lever_arm"};

constexpr EffectDescription kGpsLatency{.name = "gps_latency",
                                        .equation = "p(t - tau), v(t - tau)",
                                        .parameters = kGpsLatencyParameters,
                                        .manoeuvre = "run straight at the surface at two speeds",
                                        .confounders = kGpsLatencyConfounders,
                                        .kind = EffectKind::lag};

/// Position and velocity are older than the second that the message states.
class GpsLatency final : public EffectOf<GpsLatency, 1> {
 public:
  [[nodiscard]] const EffectDescription& description() const override { return kGpsLatency; }
  void delays(Delays& more) override { more.gps_s += p_[0]; }
};

}  // namespace

std::unique_ptr<Effect> make_gps_latency() { return std::make_unique<GpsLatency>(); }

}  // namespace navcal::sim
