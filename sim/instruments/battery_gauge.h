// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "sim/battery.h"
#include "sim/instruments/device.h"
#include "sim/noise.h"
#include "sim/state.h"

namespace navcal::sim {

/// A battery with its gauge: NMEA 0183 sentences XDR with voltage and current of the pack, twice a second. The
/// motor draws the current of the motion; the battery is not charged again when power comes.
class BatteryGauge final : public LineDevice {
 public:
  struct Options {
    Battery::Options battery;
    double voltage_noise_V = 0.02;
    double current_noise_A = 0.02;
    std::uint64_t seed = 1;
    int baud = 4800;
  };
  BatteryGauge(const Options& options, const Motion& motion);

  void power_on(std::int64_t t_ns) override;

 private:
  void act(std::int64_t now_ns, std::vector<Emission>& out) override;
  Options options_;
  const Motion& motion_;
  Battery battery_;
  Noise noise_;
  std::int64_t drawn_ns_ = 0;
};

}  // namespace navcal::sim
