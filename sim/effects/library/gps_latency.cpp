// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kGpsLatency{.name = "gps_latency",
                                        .equation = "p(t - tau), v(t - tau)",
                                        .parameters = {{"tau_s", 1, 0, 10}},
                                        .manoeuvre = "run straight at the surface at two speeds",
                                        .confounders = {"gps_lever_arm"},
                                        .kind = EffectKind::lag};

/// Position and velocity are older than the second that the message states.
class GpsLatency final : public EffectOf<GpsLatency, kGpsLatency> {
 public:
  void delays(Delays& more) override { more.gps_s += p_[0]; }
};

}  // namespace

std::unique_ptr<Effect> make_gps_latency() { return std::make_unique<GpsLatency>(); }

}  // namespace navcal::sim
