// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

// The Frobenius norm of S counts, in which what stands off the diagonal counts twice.
constexpr double kNorm = 0.05;

constexpr EffectDescription kSoftIron{.name = "soft_iron",
                                      .equation = "m = (1 + S) m, S symmetric",
                                      .parameters = {{"xx", kNorm, -0.5, 0.5},
                                                     {"yy", kNorm, -0.5, 0.5},
                                                     {"zz", kNorm, -0.5, 0.5},
                                                     {"xy", kNorm / std::numbers::sqrt2, -0.5, 0.5},
                                                     {"xz", kNorm / std::numbers::sqrt2, -0.5, 0.5},
                                                     {"yz", kNorm / std::numbers::sqrt2, -0.5, 0.5}},
                                      .manoeuvre = "turn full circles at two pitch angles",
                                      .confounders = {"hard_iron", "compass_misalignment", "magnetic_hysteresis"},
                                      .vector = 6,
                                      .order = 0};

/// Iron that the field itself magnetises, without preferred rotation.
class SoftIron final : public EffectOf<SoftIron, kSoftIron> {
 public:
  void body_field(const Instant&, Vector3& field_body_uT) override {
    const auto [xx, yy, zz, xy, xz, yz] = p_;
    const Matrix3 more{{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}}};
    add_scaled(field_body_uT, 1, more * field_body_uT);
  }
};

}  // namespace

std::unique_ptr<Effect> make_soft_iron() { return std::make_unique<SoftIron>(); }

}  // namespace navcal::sim
