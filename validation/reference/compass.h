// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "validation/reference/instrument.h"
#include "validation/reference/waters.h"

namespace navcal::reference {

/// tau y' + y = x, exact for an input that runs straight between two calls; begins at its first input.
template <class Value>
class Lag {
 public:
  /// `after_s` since the last call; a lag of zero passes its input on.
  const Value& feed(double after_s, double tau_s, const Value& input) {
    if (!begun_ || tau_s <= 0) {
      output_ = input;
    } else if (after_s > 0) {
      const Value behind = (tau_s / after_s) * (input - input_);  // of a ramp, when settled
      output_ = input - behind + std::exp(-after_s / tau_s) * (output_ - input_ + behind);
    }
    input_ = input;
    begun_ = true;
    return output_;
  }
  [[nodiscard]] const Value& output() const { return output_; }

 private:
  Value input_{}, output_{};
  bool begun_ = false;
};

/// TCM2 (ICD section 1): field in body axes, tilt through a fluid, heading of the levelled field (Mach 2003, eq.
/// 2.2), temperature; 10 Hz, 50 ms from measurement to the first byte.
///     m = (1 + S) B            soft iron, B the field in body axes
///     m = exp(-[a]x) m         the triad turned against the housing: m - a x m where a is small
///     m += b + k I + c (T - 15 C) + h L60[B]
///     m_i *= 1 - s m_i^2       (beyond the library)
///     tau m' + m = ...         tau = lag + |l| + l . (cos psi, sin psi) (beyond the library: l)
class Compass final : public Instrument {
 public:
  /// `field_uT`: the Earth's, north, east, down.
  Compass(const Fitting& fitting, const CompassDeviations& deviations,
          const Vector3& field_uT = Waters{}.field_uT);

  /// Last reading that the helmsman received, radians; heading is magnetic.
  struct Reading {
    double heading_rad = 0, pitch_rad = 0, roll_rad = 0;
  };
  [[nodiscard]] const Reading& reading() const { return reading_; }

 private:
  std::vector<std::uint8_t> sample(const History& history, double time_s) override;
  void settle(const History& history, double time_s);
  void sense(const Snapshot& s, double after_s);

  CompassDeviations departures_;
  Vector3 field_world_uT_;
  Eigen::Matrix3d iron_;  ///< soft iron, then misalignment
  Lag<Vector3> memory_, field_;
  Lag<Eigen::Vector2d> tilt_;  ///< roll, pitch
  double sensed_s_ = 0;
  Reading reading_;
};

}  // namespace navcal::reference
