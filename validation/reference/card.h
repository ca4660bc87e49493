// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "validation/reference/instrument.h"

namespace navcal::reference {

/// Inertial card (ICD section 3): two gyros of two axes, accelerometers, depth; 20 Hz, 25 ms from measurement to
/// the first byte, 1/16 mV. All departures are reckoned from the true rate w, specific force f and depth z:
///     w_i + bias_i + k_i w_i + c_i (T - 15 C) + d_i t + G_i . f + (cross axes) + n_i w_i |w_i|
///     f_i (1 + s_i) + b_i + v_i I^2        z (1 + s) + c (T - 15 C)
/// then every channel in mV times (1 + k I). The bias of a gyro is new at each power-on (0.3 deg/s) and no
/// departure.
class Card final : public Instrument {
 public:
  Card(const Fitting& fitting, const CardDeviations& deviations);

  /// Last reading that the helmsman received.
  struct Reading {
    double pitch_rate_rad_s = 0, yaw_rate_rad_s = 0, depth_m = 0, roll_rate_rad_s = 0;
  };
  [[nodiscard]] const Reading& reading() const { return reading_; }

 private:
  std::vector<std::uint8_t> sample(const History& history, double time_s) override;
  [[nodiscard]] PerGyro rates(const Snapshot& s);
  [[nodiscard]] Vector3 forces(const Snapshot& s);
  [[nodiscard]] double depth(const Snapshot& s);

  CardDeviations departures_;
  PerGyro bias_rad_s_ = PerGyro::Zero();
  std::array<bool, 4> jumped_{};  ///< which gyros stand beside their bias
  double seat_m_ = 0;             ///< of the backlash in the depth sensor
  std::uint8_t sequence_;
  Reading reading_;
};

}  // namespace navcal::reference
