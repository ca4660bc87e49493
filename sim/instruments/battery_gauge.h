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
class BatteryGauge final : public Device {
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
  void on_bytes(std::int64_t, protocols::Bytes) override {}
  [[nodiscard]] std::int64_t next_event_ns() const override { return ticks_.next_ns(); }
  void advance(std::int64_t t_ns, std::vector<Emission>& out) override;
  [[nodiscard]] int baud() const override { return options_.baud; }

 private:
  Options options_;
  const Motion& motion_;
  Battery battery_;
  Noise noise_;
  Line line_;
  Ticks ticks_;
  std::int64_t drawn_ns_ = 0;
};

}  // namespace navcal::sim
