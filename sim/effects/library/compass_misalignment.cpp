// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "base/angles.h"
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kCompassMisalignment{
    .name = "compass_misalignment",
    .equation = "m = (1 - [a]x) m, as a rotation",
    .parameters = {{"x_deg", 3, -45, 45}, {"y_deg", 3, -45, 45}, {"z_deg", 3, -45, 45}},
    .manoeuvre = "steer by GPS course and pitch up and down",
    .confounders = {"tilt_offset", "declination", "hard_iron", "soft_iron"},
    .vector = 3,
    .order = 1};

/// The triad of magnetometers is turned by the vector a against body and inclinometer.
class CompassMisalignment final : public EffectOf<CompassMisalignment, kCompassMisalignment> {
 public:
  void body_field(const Instant&, Vector3& field_body_uT) override {
    const double angle = std::hypot(p_[0], p_[1], p_[2]) * base::kRadiansPerDegree;
    if (angle == 0) return;
    const Vector3 m = field_body_uT;
    Vector3 axis{};
    add_scaled(axis, base::kRadiansPerDegree / angle, vector());
    const double along = axis[0] * m[0] + axis[1] * m[1] + axis[2] * m[2];
    // Rodrigues' formula, backwards.
    for (double& component : field_body_uT) component *= std::cos(angle);
    add_scaled(field_body_uT, -std::sin(angle), cross(axis, m));
    add_scaled(field_body_uT, (1 - std::cos(angle)) * along, axis);
  }
};

}  // namespace

std::unique_ptr<Effect> make_compass_misalignment() { return std::make_unique<CompassMisalignment>(); }

}  // namespace navcal::sim
