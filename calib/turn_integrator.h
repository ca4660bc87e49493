#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "calib/archive.h"
#include "calib/readings.h"
#include "calib/sampled_curve.h"
#include "calib/turn_step.h"

namespace navcal::calib {

/// Model: psidot = omega_z/(cos phi cos theta) + thetadot tan(phi)/cos(theta), the exact kinematics (2.9) with the
/// pitch rate eliminated (THESIS 7.1); phi roll, theta pitch, omega body rates in rad/s, psi clockwise.
///
/// Readings of gyro and compass come each at its own times, those of one instrument in order, and one instrument
/// later than the other; a compass reading waits until both are known beyond it. Rates and tilt are taken as
/// cubics between readings, with slopes by second-order differences: on a common grid that is the trapezoid with
/// end correction.
///
/// Pitch and roll gyros do not replace the slope of the tilt, since their bias would be integrated in every turn,
/// sin(phi) at a time. They restore what a slow inclinometer leaves out: an instrument with first-order lag shows
/// tilt - lag * (slope of the tilt through the same lag), so a bias shifts the tilt by lag * bias and no more.
class TurnIntegrator {
 public:
  struct Parameters {
    double tilt_lag_s = 0;  ///< first-order lag of the inclinometer; 0: fast enough, or no pitch and roll gyros
    double longest_gap_s = 0.35;  ///< between readings of either; a longer one ends the segment
  };

  explicit TurnIntegrator(const Parameters& parameters) : parameters_(parameters) {}

  /// Without heading, pitch or roll, or with `faulty`, the reading is left out.
  void update(const CompassReading& reading);
  /// With `saturated` the reading ends the segment.
  void update(const RateReading& reading);
  /// The next step that is complete, in order; nothing when readings are still missing.
  [[nodiscard]] std::optional<TurnStep> next();

  /// What was measured before has no bearing on what comes.
  void begin_segment();

  [[nodiscard]] std::uint64_t left_out() const { return left_out_; }  ///< readings of either, not used
  void archive(Archive& archive);

 private:
  enum CompassAxis { kRoll, kPitch, kHeading };
  enum RateAxis { kX, kY, kZ, kZOfB };

  /// Whether a reading at `time_s` may follow the others of `curve`; begins anew where there is a gap between.
  template <class Curve>
  bool in_order(Curve& curve, double time_s);
  [[nodiscard]] TurnStep step_between(double begin_s, double end_s);
  /// What the step integrates: S1, S1 of gyro B, S2, T per second.
  [[nodiscard]] Eigen::Vector4d turning_at(double time_s) const;
  /// The tilt's slope (roll, pitch) by the gyros.
  [[nodiscard]] Eigen::Vector2d tilt_slope_at(double time_s) const;
  void advance_lag(double begin_s, double end_s);

  Parameters parameters_;
  SampledCurve<3> compass_;            ///< roll, pitch, heading
  SampledCurve<4> rates_;              ///< x, y, z of gyro A, z of gyro B
  std::optional<double> given_out_s_;  ///< time of the newest reading given out in this segment
  Eigen::Vector2d lagged_slope_rad_s_ = Eigen::Vector2d::Zero();  ///< of the tilt, seen through the lag
  std::uint64_t left_out_ = 0;
};

}  // namespace navcal::calib
