// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "nav/estimate.h"
#include "nav/options.h"
#include "nav/readings.h"

namespace navcal::nav {

/// Motion of the vehicle since the last step, as far as it is known. World axes north, east.
struct Way {
  double duration_s = 0;
  double speed_m_s = 0;  ///< through the water, or over the bottom; as far as it is known
  /// Direction of the way. With the shaft's speed it is the body's x axis, levelled: shorter than 1 when pitched.
  Eigen::Vector2d ahead = Eigen::Vector2d::Zero();
  double heading_std_rad = 0;
  bool speed_known = false, heading_known = false;
  SpeedSource source = SpeedSource::shaft;
  bool set_turns = false;     ///< the set was shown by a DVL, so the heading's error turned it as well
  double scale_error = 0;     ///< of a measured speed, relative, the same all along; one standard deviation
  double noise_m2_per_s = 0;  ///< growth of the variance of a position, each axis, by its random error
};

/// Model: position = reckoned + correction, reckoned' = speed ahead, correction' = set, set' = -set/T + noise: the
/// set is what the ground's velocity has over the reckoned one, the current above all. Beyond that the position
/// walks (P grows by 0.02 m2/s), and heading and speed are off by a share that stays: what they cost grows with
/// the displacement since the last fix, and comes to nothing on a way that leads back to it.
///
/// While the velocity over the bottom is measured, it moves the position in the place of speed and set. The
/// position then walks by 0.0005 m2/s and by the noise of the measurement. Heading and scale of that velocity are
/// off by a share that stays. These two are consider parameters (Schmidt, in Advances in Control Systems 3, 1966):
/// a fix with the gain K leaves 1 - K of what they cost so far, since it does not tell what they are.
///
/// Variances are those of a Kalman filter for correction and set, the same for both axes; the gains follow from
/// them (a schedule: they do not depend on what is measured). With set_m_s = 0 that is K = P/(P + R) alone.
/// Metres, north and east.
class DeadReckoning {
 public:
  explicit DeadReckoning(const ReckoningOptions& options);

  void advance(const Way& way);
  /// A fix of the time `before_s` ago, when `reckoned_m` was what reckoned_m() says now. Returns the stretch that
  /// it ended, if there was one without fixes for long enough to speak of.
  std::optional<Outage> fix(const FixReading& fix, const Eigen::Vector2d& reckoned_m, double before_s);
  /// The ground's velocity had this over the reckoned one.
  void observe_set(const Eigen::Vector2d& set_m_s, double std_m_s);

  [[nodiscard]] bool known() const { return known_; }
  [[nodiscard]] Eigen::Vector2d position_m() const { return reckoned_m_ + correction_m_; }
  [[nodiscard]] Eigen::Vector2d std_m() const;
  /// Covariance of north and east in `after_s`, m2, if the vehicle goes on as in the last step and gets no fix.
  [[nodiscard]] Eigen::Matrix2d covariance_m2(double after_s) const;
  [[nodiscard]] const Eigen::Vector2d& reckoned_m() const { return reckoned_m_; }
  [[nodiscard]] const Eigen::Vector2d& set_m_s() const { return set_m_s_; }
  [[nodiscard]] double set_variance_m2_s2() const { return set_variance_m2_s2_; }
  /// What a late measurement of velocity adds to the way.
  void shift(const Eigen::Vector2d& way_m) { reckoned_m_ += way_m; }
  [[nodiscard]] double since_fix_s() const { return since_fix_s_; }
  [[nodiscard]] double since_fix_m() const { return since_fix_m_; }

 private:
  [[nodiscard]] Eigen::Vector2d standing_variance_m2() const;
  [[nodiscard]] double even_variance_m2(double after_s) const;
  void apply(const FixReading& fix, const Eigen::Vector2d& difference_m);

  ReckoningOptions options_;
  Eigen::Vector2d reckoned_m_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d correction_m_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d set_m_s_ = Eigen::Vector2d::Zero();
  // Variances of correction and set, each axis.
  double variance_m2_ = 0, covariance_m2_s_ = 0, set_variance_m2_s2_ = 0;
  // Since the last fix: one standard deviation of heading and of speed as displacements, and how far it may have
  // gone while nothing told where to.
  Eigen::Vector2d across_m_ = Eigen::Vector2d::Zero(), along_m_ = Eigen::Vector2d::Zero();
  double blind_m_ = 0;
  // The same for ways over the bottom. A fix lessens them.
  Eigen::Vector2d bottom_across_m_ = Eigen::Vector2d::Zero(), bottom_along_m_ = Eigen::Vector2d::Zero();
  Way last_way_;  ///< of the last step that took time
  bool known_ = false;
  double since_fix_s_ = 0, since_fix_m_ = 0;
};

/// Radius of the circle about the mean that contains 95 % of a normal distribution in the plane with this
/// covariance. By the polynomial of Leenhouts ("On the computation of bi-normal radial error", Navigation 32,
/// 1985), to 0.5 %. Units of the square root of the covariance.
[[nodiscard]] double radius_95_m(const Eigen::Matrix2d& covariance_m2);

}  // namespace navcal::nav
