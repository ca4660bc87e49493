// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "devices/instrument_model.h"
#include "sim/effects/effect_set.h"
#include "sim/effects/low_pass.h"
#include "sim/instruments/electronics.h"
#include "sim/noise.h"
#include "sim/state.h"

namespace navcal::sim {

/// Outputs of the sensors inside a TCM2, before conversion into its units and text.
struct Tcm2Reading {
  double heading_rad = 0;  ///< magnetic, 0 to 2 pi, from its own field and tilt
  double pitch_rad = 0;
  double roll_rad = 0;
  Vector3 field_uT{};
  double temperature_C = 0;
  bool tilt_out_of_range = false;
  bool distorted = false;  ///< the field's size is far from the Earth's
};

/// Magnetometers, fluid inclinometer (a first-order lag of the tilt) and thermometer, with the errors of
/// docs/simulator.md. The axes are those of the device, turned in the body by its mounting; lag and effects are in
/// the body's. Effects see the earth's field, the body's, the tilt before and after the fluid.
class Tcm2Sensor {
 public:
  struct Options {
    devices::CompassModel compass;
    double tilt_range_deg = 50;
    double distortion_share =
        0.25;                      ///< departure of the field's size from the Earth's, relative, that is remarked
    EffectSet* effects = nullptr;  ///< nullptr: nominal
  };
  Tcm2Sensor(const Options& options, const Motion& motion, std::uint64_t seed);

  /// The fluid is level with the truth and the electronics have the water's temperature.
  void power_on(std::int64_t t_ns);
  /// Times must not go back.
  [[nodiscard]] Tcm2Reading measure(std::int64_t t_ns);

 private:
  /// Fluid and field at this instant; what has a memory is shown the time in between in small steps.
  void feel(std::int64_t t_ns);

  Options options_;
  const Motion& motion_;
  EffectSet none_;
  EffectSet& effects_;
  Electronics electronics_;
  Noise noise_;
  LowPass fluid_;
  std::int64_t powered_ns_ = 0, felt_ns_ = 0;
  Tilt tilt_;  ///< of the fluid
  Vector3 field_body_uT_{};
};

}  // namespace navcal::sim
