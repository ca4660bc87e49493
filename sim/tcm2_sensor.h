#pragma once

#include <optional>

#include "sim/noise.h"
#include "sim/state.h"

namespace navcal::sim {

/// What the sensors inside a TCM2 say, before it is put into units and words.
struct Tcm2Reading {
  double heading_rad = 0;  ///< magnetic, 0 to 2 pi, from its own field and tilt
  double pitch_rad = 0;
  double roll_rad = 0;
  Vector3 field_uT{};
  double temperature_C = 0;
  bool tilt_out_of_range = false;
};

/// Magnetometers, fluid inclinometer and thermometer with the errors of VEHICLE.md section 3.
class Tcm2Sensor {
 public:
  struct Options {
    double field_noise_uT = 0.15;
    double tilt_noise_deg = 0.1;
    double fluid_lag_s = 0.3;
    double tilt_range_deg = 50;
    double temperature_noise_C = 0.1;
    double warming_C = 8;  ///< of the electronics above the water, in the end
    double warming_time_s = 200;
  };
  Tcm2Sensor(const Options& options, const Motion& motion, std::uint64_t seed);

  /// The fluid is level with the truth and the electronics have the water's temperature.
  void power_on(std::int64_t t_ns);
  /// Times must not go back.
  [[nodiscard]] Tcm2Reading measure(std::int64_t t_ns);

 private:
  void settle(std::int64_t t_ns);

  Options options_;
  const Motion& motion_;
  Noise noise_;
  std::int64_t settled_ns_ = 0;
  double pitch_rad_ = 0, roll_rad_ = 0;
  double temperature_C_ = 0;
};

}  // namespace navcal::sim
