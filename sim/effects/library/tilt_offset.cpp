#include <numbers>

#include "sim/effects/effect.h"

namespace navcal::sim {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

constexpr std::array<EffectParameter, 2> kParameters{{{"roll_deg", 1, -45, 45}, {"pitch_deg", 1, -45, 45}}};

constexpr EffectDescription kDescription{
    .name = "tilt_offset", .equation = "tilt += o", .parameters = kParameters};

/// The inclinometer is mounted askew.
class TiltOffset final : public EffectOf<TiltOffset, 2> {
 public:
  [[nodiscard]] const EffectDescription& description() const override { return kDescription; }
  void tilt_said(const Instant&, Tilt& tilt) override {
    tilt.roll_rad += p_[0] * kRadians;
    tilt.pitch_rad += p_[1] * kRadians;
  }
};

}  // namespace

std::unique_ptr<Effect> make_tilt_offset() { return std::make_unique<TiltOffset>(); }

}  // namespace navcal::sim
