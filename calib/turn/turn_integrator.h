// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

#include "base/reference_instruments.h"
#include "calib/archive.h"
#include "calib/readings.h"
#include "calib/turn/inclinometer_lag.h"
#include "calib/turn/sampled_curve.h"
#include "calib/turn/tilt_smoother.h"
#include "calib/turn/turn_step.h"

namespace navcal::calib {

/// Model: psidot = omega_z/(cos phi cos theta) + thetadot tan(phi)/cos(theta), the exact kinematics (2.9) with the
/// pitch rate eliminated (THESIS 7.1); phi roll, theta pitch, omega body rates in rad/s, psi clockwise.
///
/// Readings of gyro and compass come each at its own times, those of one instrument in order, and one instrument
/// later than the other; a compass reading waits until both are known beyond it. Rates and tilt are taken as
/// cubics between readings, with slopes by second-order differences: on a common grid that is the trapezoid with
/// end correction.
///
/// An inclinometer with lag shows a tilt that has passed. TiltSmoother restores the true one by the roll and pitch
/// gyros, and the heading is corrected by what levelling with the true tilt changes: at a dip of 67 degrees,
/// 1 degree of tilt changes the heading by up to 2.4 degrees. Without the field in the reading the heading stays.
/// The smoother looks ahead, so steps come kLookAhead_s late; without a lag they come at once. Where the readings
/// show that the inclinometer does not lag, or that the roll and pitch gyros tell nothing (InclinometerLag), the
/// tilt is taken as shown.
class TurnIntegrator {
 public:
  static constexpr double kLookAhead_s = 2;
  struct Parameters {
    double tilt_lag_s = 0;  ///< first-order lag of the inclinometer; 0: fast enough, or no pitch and roll gyros
    double tilt_noise_rad = base::reference::kReckonedTiltNoise_rad;  ///< of a reading of the inclinometer
    double rate_noise_rad_sqrt_s = 0.0004;                            ///< density, of the roll and pitch gyros
    bool levels_heading = true;   ///< false: the heading stays as measured, and steps come at once
    double longest_gap_s = 0.35;  ///< between readings of either; a longer one ends the segment
  };

  explicit TurnIntegrator(const Parameters& parameters);

  /// Takes a compass reading. It is left out without heading, pitch or roll, or with `faulty`.
  void update(const CompassReading& reading);
  /// Takes a gyro reading. A `saturated` reading ends the segment.
  void update(const RateReading& reading);
  /// Calibration of gyro A's z axis, used for the tilt: true rate = scale * measured + bias.
  void set_gyro(double scale, double bias_rad_s) { gyro_ = {scale, bias_rad_s}; }
  /// The next complete step, in order; nothing while readings are still missing. `last`: no more readings will
  /// come, so it waits for none.
  [[nodiscard]] std::optional<TurnStep> next(bool last = false);

  /// Starts a segment that is not connected with earlier readings.
  void begin_segment();

  [[nodiscard]] std::uint64_t left_out() const { return left_out_; }  ///< readings of either, not used
  void archive(Archive& archive);

 private:
  enum CompassAxis { kRoll, kPitch, kHeading };
  enum RateAxis { kX, kY, kZ, kZOfB };

  /// True when a reading at `time_s` may follow the others of `curve`. A gap starts the curve anew.
  template <class Curve>
  bool in_order(Curve& curve, double time_s);
  /// Ends the segment: the turn after the newest step is unknown. Pending steps go into `waiting_`.
  void end_segment();
  [[nodiscard]] std::optional<TurnStep> step(bool at_once);
  /// True when the tilt is restored from an inclinometer that lags.
  [[nodiscard]] bool lags() const { return parameters_.tilt_lag_s > 0 && lags_; }
  /// Tells inclinometer_ of the readings that have settled.
  void test_lag();
  /// Takes the smoother through the readings from `first` on; true when it has looked far enough ahead.
  bool look_ahead(std::uint32_t first);
  [[nodiscard]] TurnStep step_between(double begin_s, double end_s);
  /// Integrands of the step: S1, S1 of gyro B, S2 and T, per second.
  [[nodiscard]] Eigen::Vector4d turning_at(double time_s) const;
  /// Body rates at `time_s`: x and y as measured, z corrected by the gyro's calibration.
  [[nodiscard]] Eigen::Vector3d body_rate_at(double time_s) const;
  void advance_tilt(double begin_s, double end_s);
  /// Heading of compass reading `i`, levelled by the true tilt instead of the displayed one.
  [[nodiscard]] double heading_of(std::uint32_t i) const;

  Parameters parameters_;
  SampledCurve<6> compass_;            ///< roll, pitch, heading, field (not a number where there is none)
  SampledCurve<4> rates_;              ///< x, y, z of gyro A, z of gyro B
  std::optional<double> given_out_s_;  ///< time of the newest reading given out in this segment
  InclinometerLag inclinometer_;
  std::optional<double> lag_tested_s_;  ///< time of the newest reading of the compass that it was told of
  bool lags_ = true;                    ///< its last answer
  TiltSmoother smoother_;               ///< its oldest reading is the newest given out, but at the beginning
  double ahead_s_ = 0;                  ///< how far the smoother has come
  TiltSmoother::State tilt_ = TiltSmoother::State::Zero();  ///< on the way from one reading to the next
  Eigen::Vector2d gyro_{1, 0};                              ///< scale and bias of A's z axis
  std::array<TurnStep, TiltSmoother::kCapacity> waiting_{};
  std::uint32_t first_waiting_ = 0, waiting_count_ = 0;
  std::uint64_t left_out_ = 0;
};

}  // namespace navcal::calib
