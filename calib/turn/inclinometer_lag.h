// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "base/reference_instruments.h"
#include "calib/archive.h"

namespace navcal::calib {

/// Whether an inclinometer lags behind the tilt as it is configured to, by its readings and the pitch and roll
/// gyros. Model: an inclinometer of first-order lag L shows s with L s' = tilt - s, so s' is the slope of the tilt
/// through the same lag. Over a few tenths of a second the change of s is compared with the integral of the
/// gyros' slope through the lag, with the integral of the slope itself (an accelerometer that serves as
/// inclinometer has no lag), and with no change at all (a card without pitch and roll gyros shows none). The bias
/// of the gyros is found as well: over a long time the integral is the change of s. Angles roll and pitch, rad.
class InclinometerLag {
 public:
  /// `lag_s`: first order; positive. `tilt_noise_rad`: of a reading of the inclinometer.
  explicit InclinometerLag(double lag_s, double tilt_noise_rad = base::reference::kReckonedTiltNoise_rad)
      : lag_s_(lag_s), still_rad2_(4 * tilt_noise_rad * tilt_noise_rad) {}

  /// A reading of the gyros (body axes, rad/s), in the order of their times.
  void update(double time_s, const Eigen::Vector3d& rate_rad_s);
  /// A reading of the inclinometer (roll, pitch), in the order of their times; gyro readings up to `time_s` are
  /// known.
  void update(double time_s, const Eigen::Vector2d& shown_rad);
  /// Starts a segment that has no connection with earlier readings.
  void begin_segment();

  /// True until the readings show that the gyros explain them no better through the lag than without it.
  [[nodiscard]] bool lags() const { return lags_; }
  void archive(Archive& archive);

 private:
  /// Integrals since the beginning of the segment, at a reading of the gyros.
  struct Point {
    double time_s = 0;
    Eigen::Vector2d slope_rad_s = Eigen::Vector2d::Zero();  ///< of the tilt, through the lag
    Eigen::Vector2d lagged_rad = Eigen::Vector2d::Zero();   ///< integral of it
    Eigen::Vector2d direct_rad = Eigen::Vector2d::Zero();   ///< integral of the tilt's slope, without lag
    void archive(Archive& archive) { archive(time_s, slope_rad_s, lagged_rad, direct_rad); }
  };
  struct Anchor {
    bool set = false;
    double time_s = 0;
    Eigen::Vector2d shown_rad = Eigen::Vector2d::Zero(), lagged_rad = Eigen::Vector2d::Zero(),
                    direct_rad = Eigen::Vector2d::Zero();
    void archive(Archive& archive) { archive(set, time_s, shown_rad, lagged_rad, direct_rad); }
  };
  [[nodiscard]] const Point& point(std::uint32_t back) const {
    return ring_[(newest_ + kPoints - back) % kPoints];
  }
  /// False where the readings of the gyros do not reach to both sides of `time_s`.
  [[nodiscard]] bool find(double time_s, Point& at) const;
  void learn_bias(const Anchor& now);
  void compare(const Anchor& now);
  void decide();

  static constexpr std::uint32_t kPoints = 64;

  double lag_s_;
  double still_rad2_;  ///< change of roll and pitch by noise and rounding alone, mean square
  std::array<Point, kPoints> ring_{};
  std::uint32_t newest_ = 0, points_ = 0;
  Eigen::Vector2d slope_rad_s_ = Eigen::Vector2d::Zero();  ///< of the tilt, by the newest reading of the gyros
  Eigen::Vector2d shown_rad_ = Eigen::Vector2d::Zero();    ///< newest
  Eigen::Vector2d bias_rad_s_ = Eigen::Vector2d::Zero();   ///< of the slopes, up to the anchor of the bias
  Eigen::Vector2d bias_now_rad_s_ = Eigen::Vector2d::Zero();
  double bias_weight_s_ = 1;
  Anchor bias_anchor_, compare_anchor_;
  double still_square_ = 0;                       ///< of the changes of s
  double lagged_square_ = 0, direct_square_ = 0;  ///< less what each explains
  std::uint32_t compared_ = 0;
  bool lags_ = true;
};

}  // namespace navcal::calib
