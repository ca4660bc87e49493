// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "calib/archive.h"
#include "calib/delay/delay.h"
#include "calib/turn/turn_step.h"

namespace navcal::calib {

/// Model: psi_m(n) - T(n) = psi0 + a S1(n) + b S2(n) + f4(psi_m(n))'q - tau r(n) + kappa g(n) + noise (rad), the
/// measured heading against the gyro's sums of TurnStep (THESIS 11.7): the compass shows what was true tau (s)
/// before its stamp, so it is behind by tau times the turn rate r (rad/s). Gyro scale a and bias b and the
/// deviation B..E are found with it, so that none of them is read as a delay: S1 is the integral of r, and only a
/// changing rate tells the two apart. g = phi' cos psi + theta' sin psi is what a slow inclinometer does to the
/// compass's own levelling: kappa is its lag times the tangent of the dip. Kalman filter; O(1) per step.
class HeadingDelay {
 public:
  struct Parameters {
    double heading_noise_rad = 0.008;       ///< standard deviation of a compass reading
    double rate_noise_rad_sqrt_s = 0.0016;  ///< density of the gyro's noise
    double delay_std_s = 0.5;               ///< prior
    double scale_std = 0.3, bias_std_rad_s = 0.3;
    double deviation_std_rad = 0.5;
    double tilt_lag_std_s = 1.5;  ///< prior of kappa
    double level_std_s = 0;       ///< of what the level feigns, beside the noise; no more readings lessen it
  };
  /// Slopes of roll and pitch, through the lag of the inclinometer (rad/s); zero where they are not known.
  struct TiltSlope {
    double roll_rad_s = 0, pitch_rad_s = 0;
  };

  HeadingDelay() : HeadingDelay(Parameters{}) {}
  explicit HeadingDelay(const Parameters& parameters);

  void update(const TurnStep& step, const TiltSlope& tilt);

  [[nodiscard]] Delay estimate() const;
  void archive(Archive& archive);

 private:
  /// Heading (unwrapped), scale, bias, B..E, delay, kappa.
  static constexpr int kStates = 9;
  enum State : int { kPsi, kScale, kBias, kB, kDelay = 7, kKappa = 8 };
  using Vector = Eigen::Matrix<double, kStates, 1>;
  using Matrix = Eigen::Matrix<double, kStates, kStates>;
  struct Waiting {
    TurnStep step;
    TiltSlope tilt;
    double rate_angle_rad = 0, rate_time_s = 0;
    void archive(Archive& archive);
  };
  void begin(const TurnStep& step);
  void predict(const TurnStep& step);
  void correct(const TurnStep& step, const TiltSlope& tilt, double measured_rate_rad_s);

  Parameters parameters_;
  Vector state_ = Vector::Zero();
  Matrix covariance_ = Matrix::Zero();
  std::optional<Waiting> waiting_;  ///< until the step after it, for the rate about it
  double chi_squared_ = 0;          ///< sum of the squared innovations over their variances
  DelayBlocks blocks_;
  double rate_sum_ = 0, rate_square_sum_ = 0;
  std::uint64_t readings_ = 0;
};

}  // namespace navcal::calib
