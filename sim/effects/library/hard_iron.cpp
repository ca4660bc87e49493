// SPDX-License-Identifier: Apache-2.0
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kHardIron{
    .name = "hard_iron",
    .equation = "m += b",
    .parameters = {{"x_uT", 2, -200, 200}, {"y_uT", 2, -200, 200}, {"z_uT", 2, -200, 200}},
    .manoeuvre = "turn full circles with pitch of both signs",
    .confounders = {"soft_iron", "compass_misalignment", "motor_field", "mag_temperature"},
    .vector = 3};

/// Permanent magnetism of the vehicle.
class HardIron final : public EffectOf<HardIron, kHardIron> {
 public:
  void body_field(const Instant&, Vector3& field_body_uT) override { add_scaled(field_body_uT, 1, vector()); }
};

}  // namespace

std::unique_ptr<Effect> make_hard_iron() { return std::make_unique<HardIron>(); }

}  // namespace navcal::sim
