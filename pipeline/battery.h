// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "instruments/samples.h"

namespace navcal::pipeline {

/// Charge left, with one standard deviation.
struct BatteryCharge {
  double charge_Ah = 0;
  double std_Ah = 0;
};

/// The estimate of the battery at one instant (docs/battery.md).
struct BatterySample {
  std::uint16_t port = 0;  ///< of the sample that called for it
  instruments::Stamp stamp;
  std::optional<double> voltage_V;      ///< newest of the gauge; nullopt without one
  std::optional<double> current_A;      ///< out of the pack; nullopt while no instrument tells it
  bool current_is_measured = false;     ///< false: the motor's, with the configured hotel load
  std::optional<BatteryCharge> charge;  ///< nullopt before it was set or seen in the voltage
  double capacity_Ah = 0;
  double nominal_V = 0;
  std::optional<double> time_left_s;   ///< at the mean load
  std::optional<double> range_left_m;  ///< at the mean speed and load
  bool low = false;
};

}  // namespace navcal::pipeline
