// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"
#include "sim/effects/low_pass.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kCompassLag{.name = "compass_lag",
                                        .equation = "tau m' + m = field",
                                        .parameters = {{"tau_s", 0.2, 0, 10}},
                                        .manoeuvre = "turn both ways at two different rates",
                                        .confounders = {"imu_latency", "gyro_scale"},
                                        .order = 4,
                                        .kind = EffectKind::lag};

/// The compass filters its magnetometers, hence its heading.
class CompassLag final : public EffectOf<CompassLag, kCompassLag> {
 public:
  void body_field(const Instant& now, Vector3& field_body_uT) override {
    field_body_uT = filter_.at(now.time_s, field_body_uT, p_[0]);
  }

 private:
  LowPass filter_;
};

}  // namespace

std::unique_ptr<Effect> make_compass_lag() { return std::make_unique<CompassLag>(); }

}  // namespace navcal::sim
