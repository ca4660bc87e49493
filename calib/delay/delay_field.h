// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "calib/archive.h"
#include "calib/delay/delay.h"
#include "calib/readings.h"

namespace navcal::calib {

/// Model: x' = -(omega + b) x x and field_m = x + h + tau omega x (field_m - h) + noise (uT, body axes, omega in
/// rad/s): x is the Earth's field as the body sees it turn, h hard iron, b the gyro's bias, and the measured field
/// is what it was tau seconds before. Linear in x, h, b, tau and tau h taken as unknowns of their own; a random
/// walk of x takes what scale errors and soft iron leave. The standard error follows the
/// innovations, larger or smaller than stated. Needs no heading, no level and no calibration, but a
/// changing rate. Kalman filter over 13 states; O(1) per reading. A field that steps (a magnet, a motor) is left
/// out until it stays, then hard iron is sought anew and the delay kept.
class FieldDelay {
 public:
  struct Parameters {
    double field_noise_uT = 0.3;           ///< each axis, each reading
    double walk_uT_sqrt_s = 0.15;          ///< of x
    double hard_iron_std_uT = 50;          ///< prior
    double bias_std_rad_s = 0.05;          ///< prior
    double delay_std_s = 0.5;              ///< prior
    double longest_gap_s = 0.35;           ///< between readings of the gyro
    double gate = 30;                      ///< of the squared innovation, three degrees of freedom
    std::uint32_t rejected_for_step = 10;  ///< in a row: the field has changed and stays so
  };

  FieldDelay() : FieldDelay(Parameters{}) {}
  explicit FieldDelay(const Parameters& parameters);

  void update(const RateReading& rate);
  /// Readings of both in the order of their times.
  void update(const CompassReading& compass);

  [[nodiscard]] Delay estimate() const;
  [[nodiscard]] Eigen::Vector3d hard_iron_uT() const { return state_.segment<3>(kHardIron); }
  [[nodiscard]] std::uint32_t field_steps() const { return field_steps_; }
  [[nodiscard]] std::uint64_t left_out() const { return left_out_; }
  void archive(Archive& archive);

 private:
  static constexpr int kStates = 13;
  enum State : int { kField = 0, kHardIron = 3, kBias = 6, kDelayIron = 9, kDelay = 12 };
  using Vector = Eigen::Matrix<double, kStates, 1>;
  using Matrix = Eigen::Matrix<double, kStates, kStates>;
  /// A value and the time of it.
  struct Timed {
    double time_s = 0;
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
    void archive(Archive& archive) { archive(time_s, value); }
  };
  using Field = Timed;
  using Rate = Timed;
  void advance(const Eigen::Vector3d& mean_rate_rad_s, double duration_s);
  void correct(const Eigen::Vector3d& field_uT, const Eigen::Vector3d& rate_rad_s);
  /// Three states from `first` on are known no better than that, and have nothing to do with the others.
  void forget(int first, double std);

  Parameters parameters_;
  Vector state_ = Vector::Zero();
  Matrix covariance_ = Matrix::Zero();
  std::optional<Rate> rate_;    ///< the newest
  std::optional<Field> field_;  ///< waits for the rate after it
  Eigen::Vector3d last_field_uT_ = Eigen::Vector3d::Zero();
  double chi_squared_ = 0;  ///< sum of the squared innovations over their variances
  DelayBlocks blocks_;
  double rate_square_sum_ = 0;
  Eigen::Vector3d rate_sum_ = Eigen::Vector3d::Zero();
  std::uint64_t readings_ = 0, left_out_ = 0;
  std::uint32_t rejected_in_a_row_ = 0, field_steps_ = 0;
};

}  // namespace navcal::calib
