// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"
#include "sim/effects/low_pass.h"

namespace navcal::sim {
namespace {

constexpr double kMemory_s = 60;

constexpr EffectDescription kMagneticHysteresis{.name = "magnetic_hysteresis",
                                                .equation = "m += k lowpass(m, 60 s)",
                                                .parameters = {{"gain", 0.06, -0.03, 1}},
                                                .manoeuvre = "come to the same heading from both sides",
                                                .confounders = {"hard_iron", "soft_iron"},
                                                .order = 2};

/// Iron that remembers the field of the last minute.
class MagneticHysteresis final : public EffectOf<MagneticHysteresis, kMagneticHysteresis> {
 public:
  void body_field(const Instant& now, Vector3& field_body_uT) override {
    add_scaled(field_body_uT, p_[0], memory_.at(now.time_s, field_body_uT, kMemory_s));
  }

 private:
  LowPass memory_;
};

}  // namespace

std::unique_ptr<Effect> make_magnetic_hysteresis() { return std::make_unique<MagneticHysteresis>(); }

}  // namespace navcal::sim
