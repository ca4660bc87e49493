// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "base/reference_instruments.h"
#include "devices/instrument_model.h"
#include "gap/replay/replay.h"
#include "sim/effects/effect_set.h"
#include "sim/effects/low_pass.h"

namespace navcal::gap {

/// Noise-free readings of the instruments at the predicted state, with a model's effects.
class PredictedInstruments {
 public:
  struct Card {
    std::array<double, 4> gyro_rad_s{};  ///< A-x, A-z, B-y, B-z
    sim::Vector3 force_m_s2{};
    double depth_m = 0;
  };
  struct Word {
    sim::Vector3 field_uT{};
    sim::Tilt tilt;
  };

  /// `effects` and `instruments` must outlive it.
  PredictedInstruments(sim::EffectSet& effects, const GyroBias& bias_rad_s,
                       const devices::InstrumentModel& instruments)
      : effects_(effects), bias_rad_s_(bias_rad_s), instruments_(instruments) {}

  /// Restarts the lag of the tilt sensor's fluid: the next attitude is its first.
  void restart() { fluid_ = {}; }
  void set_electronics(double temperature_C) { electronics_C_ = temperature_C; }
  [[nodiscard]] double electronics_C() const { return electronics_C_; }

  [[nodiscard]] Card card(double time_s, const sim::State& state);
  /// Updates the compass with the state at this time. To be called in the order of time, because the tilt
  /// sensor and some effects have a memory.
  void feel(double time_s, const sim::State& state);
  /// The compass reading at this instant; calls feel().
  [[nodiscard]] Word word(double time_s, const sim::State& state);
  [[nodiscard]] sim::AntennaMotion antenna(double time_s, const sim::State& state,
                                           const std::array<double, 2>& offset_m);

 private:
  [[nodiscard]] sim::Instant instant(double time_s, const sim::State& state) const {
    return {time_s, state, electronics_C_};
  }

  sim::EffectSet& effects_;
  GyroBias bias_rad_s_;
  const devices::InstrumentModel& instruments_;
  double electronics_C_ = base::reference::kTemperature_C;
  sim::LowPass fluid_;
  sim::Tilt tilt_;
  sim::Vector3 field_uT_{};
};

}  // namespace navcal::gap
