// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "sim/instruments/device.h"
#include "sim/noise.h"
#include "sim/state.h"

namespace navcal::sim {

/// A plane: depth of the water at the motion's origin, and how much deeper it is for each metre north and east.
struct SeaFloor {
  double depth_m = 20;
  double slope_north = 0;
  double slope_east = 0;

  [[nodiscard]] double depth_at_m(double north_m, double east_m) const {
    return depth_m + slope_north * north_m + slope_east * east_m;
  }
};

/// Distance from the position of `state` along the body's z axis to the floor; nullopt when that axis does not
/// meet it. Zero or less: the vehicle is in the floor.
[[nodiscard]] std::optional<double> slant_range_m(const SeaFloor& floor, const State& state);

struct AltimeterOptions {
  SeaFloor floor;
  double rate_Hz = 5;
  double noise_m = 0.05;
  double range_m = 100;
  double least_range_m = 0.3;
  double lost = 0.02;  ///< probability that an echo is lost
  std::uint64_t seed = 1;
  int baud = 4800;
};

/// Echo sounder that looks along the body's z axis: NMEA 0183 sentences DBT with the slant range. An empty field
/// stands for no echo: beyond the range, nearer than the transducer can hear, or lost.
class Altimeter final : public MeasuringDevice<AltimeterOptions> {
 public:
  using MeasuringDevice::MeasuringDevice;

  void power_on(std::int64_t t_ns) override { ticks_ = Ticks(t_ns, 1 / options_.rate_Hz, 0); }
  /// What it says at t_ns: nullopt without an echo.
  [[nodiscard]] std::optional<double> measure_m(std::int64_t t_ns);

 private:
  void act(std::int64_t now_ns, std::vector<Emission>& out) override;
};

}  // namespace navcal::sim
