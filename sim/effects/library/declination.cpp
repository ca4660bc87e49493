// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "base/angles.h"
#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr EffectDescription kDeclination{.name = "declination",
                                         .equation = "B = Rz(d) B",
                                         .parameters = {{"angle_deg", 4, -180, 180}},
                                         .manoeuvre = "run straight at the surface on three headings",
                                         .confounders = {"compass_misalignment", "water_current"}};

/// The earth's field is turned about the vertical, positive to the east.
class Declination final : public EffectOf<Declination, kDeclination> {
 public:
  void earth_field(const Instant&, Vector3& field_world_uT) override {
    const double c = std::cos(p_[0] * base::kRadiansPerDegree), s = std::sin(p_[0] * base::kRadiansPerDegree);
    const auto [north, east, down] = field_world_uT;
    field_world_uT = {c * north - s * east, s * north + c * east, down};
  }
};

}  // namespace

std::unique_ptr<Effect> make_declination() { return std::make_unique<Declination>(); }

}  // namespace navcal::sim
