// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "devices/instrument_model.h"
#include "protocols/imu_card.h"
#include "sim/effects/effect_set.h"
#include "sim/instruments/device.h"
#include "sim/instruments/electronics.h"
#include "sim/noise.h"
#include "sim/state.h"

namespace navcal::sim {

/// Inertial card: sends without being asked, at the pace of its own clock, and hears nothing. Its errors are those
/// of docs/simulator.md; effects see its gyros, accelerometers and depth before the noise, its voltages after it.
class ImuCard final : public LineDevice {
 public:
  struct Options {
    devices::ImuModel imu;
    double clock_ppm = 0;  ///< positive: its seconds are too long
    std::uint64_t seed = 1;
    int baud = 57600;
    EffectSet* effects = nullptr;  ///< nullptr: nominal
  };
  ImuCard(const Options& options, const Motion& motion);

  void power_on(std::int64_t t_ns) override;

  /// Leak and supply bits (protocols::imu_card::StatusBit) from now on; over range comes of itself.
  void set_status(std::uint8_t status) { status_ = status; }

 private:
  void act(std::int64_t now_ns, std::vector<Emission>& out) override;
  [[nodiscard]] protocols::imu_card::Record measure(std::int64_t t_ns);
  /// What the card's sensors meet at their place and along their axes, without errors.
  struct Mounted {
    Vector3 rate_rad_s, force_m_s2;
    double depth_m;
  };
  [[nodiscard]] Mounted felt(const State& state, std::int64_t t_ns) const;
  /// Sensor outputs of the channels, in their order: deg/s, g, m.
  [[nodiscard]] std::array<double, 8> signals(const Instant& now, const Mounted& mounted);

  Options options_;
  const Motion& motion_;
  EffectSet none_;
  EffectSet& effects_;
  Electronics electronics_;
  Noise noise_;
  std::array<double, 4> bias_rad_s_{};
  std::uint8_t sequence_ = 0;
  std::uint8_t status_ = 0;
};

}  // namespace navcal::sim
