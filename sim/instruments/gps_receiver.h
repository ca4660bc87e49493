// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "devices/instrument_model.h"
#include "sim/effects/effect_set.h"
#include "sim/geodesy.h"
#include "sim/instruments/electronics.h"
#include "sim/noise.h"

namespace navcal::sim {

/// Solution of the receiver at a full second.
struct GpsReading {
  std::int64_t utc_ns = 0;
  bool fixed = false;
  bool cold = false;    ///< it searches without time or position (SearchModel::receiver_state)
  double degraded = 1;  ///< ratio of its noise to that of a settled fix
  double latitude_deg = 0, longitude_deg = 0, height_m = 0;  ///< without a fix the last known
  double speed_m_s = 0;
  double course_deg = 0;
};

/// Satellites to position and velocity over ground. There is no fix below the antenna's depth. The first fix
/// comes some seconds after surfacing or power-on, from few satellites. The search takes a time between two bounds
/// (SearchModel::uniform), or one by what the receiver knows (SearchModel::receiver_state, docs/surfacing.md): its
/// ephemerides expire, and a loss of power costs it time, position and ephemerides. Fix n (from 0) has
/// devices::GpsModel::noise_factor(n) times the final noise; its dilution of precision is larger by the same
/// factor. It is two-dimensional as long as that factor is above 1.4.
class GpsReceiver {
 public:
  struct Options {
    Origin origin;
    devices::GpsModel gps;
    EffectSet* effects = nullptr;  ///< nullptr: nominal
  };
  GpsReceiver(const Options& options, const Motion& motion, std::uint64_t seed);

  void power_on(std::int64_t t_ns);
  /// The host states the time, or the position: a start with both is a warm one. A search that runs begins anew.
  void learn_time();
  void learn_position();
  /// Called once for each second, in order.
  [[nodiscard]] GpsReading measure(std::int64_t second_ns);

 private:
  /// True when the sky is visible and has been for long enough.
  [[nodiscard]] bool fixes(std::int64_t second_ns);
  void learn(bool& knows);
  [[nodiscard]] double search_s(std::int64_t begin_ns);

  Options options_;
  const Motion& motion_;
  EffectSet none_;
  EffectSet& effects_;
  Electronics electronics_;
  Noise noise_;
  std::int64_t powered_ns_ = 0;
  std::optional<std::int64_t> fix_due_ns_;  ///< while the sky is seen
  bool knows_time_ = false, knows_position_ = false;
  std::optional<std::int64_t> ephemerides_until_ns_;
  double life_s_ = 0;  ///< of the ephemerides after the newest fix
  int fixes_ = 0;      ///< since then
  GpsReading last_;
};

}  // namespace navcal::sim
