// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "sim/instruments/device.h"
#include "sim/noise.h"
#include "sim/state.h"

namespace navcal::sim {

/// A pack: an open-circuit voltage that follows from the charge, behind an internal resistance. Its charge is
/// never less than nothing, nor more than the capacity.
class Battery {
 public:
  struct Options {
    double capacity_Ah = 3.7;
    double charge_Ah = 3.7;  ///< at first
    double resistance_ohm = 0.2;
    double hotel_A = 0.5;  ///< drawn by everything but the motor
    /// Open circuit, at charges 0, 1/7, ... 1 of the capacity.
    std::array<double, 8> curve_V{18.0, 20.7, 21.5, 21.9, 22.5, 23.2, 24.1, 25.1};
  };
  explicit Battery(const Options& options);

  /// The motor drew this current for so long.
  void draw(double motor_A, double duration_s);
  [[nodiscard]] double charge_Ah() const { return charge_Ah_; }
  [[nodiscard]] double open_circuit_V() const;
  /// Current out of the pack and the voltage at its terminals while the motor draws this current.
  [[nodiscard]] double current_A(double motor_A) const { return motor_A + options_.hotel_A; }
  [[nodiscard]] double voltage_V(double motor_A) const;

 private:
  Options options_;
  double charge_Ah_;
};

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
