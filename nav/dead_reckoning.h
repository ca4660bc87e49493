// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "nav/estimate.h"
#include "nav/options.h"
#include "nav/readings.h"

namespace navcal::nav {

/// Motion of the vehicle since the last step, as far as it is known. World axes north, east.
struct Way {
  double duration_s = 0;
  double speed_m_s = 0;  ///< through the water, ahead, as far as it is known
  Eigen::Vector2d ahead =
      Eigen::Vector2d::Zero();  ///< of the body's x axis, levelled: shorter than 1 when pitched
  double heading_std_rad = 0;
  bool speed_known = false, heading_known = false;
};

/// Model: position = reckoned + correction, reckoned' = speed ahead, correction' = set, set' = -set/T + noise: the
/// set is what the ground's velocity has over the reckoned one, the current above all. Beyond that the position
/// walks (P grows by 0.02 m2/s), and heading and speed are off by a share that stays: what they cost grows with
/// the displacement since the last fix, and comes to nothing on a way that leads back to it.
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
  [[nodiscard]] double since_fix_s() const { return since_fix_s_; }
  [[nodiscard]] double since_fix_m() const { return since_fix_m_; }

 private:
  [[nodiscard]] Eigen::Vector2d standing_variance_m2() const;

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
  Way last_way_;  ///< of the last step that took time
  bool known_ = false;
  double since_fix_s_ = 0, since_fix_m_ = 0;
};

}  // namespace navcal::nav
