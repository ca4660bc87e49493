// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "nav/options.h"

namespace navcal::nav {

/// Model: R' = R [rate + zero]x, R = R_world_from_body, world axes north, east, down; `zero` corrects the gyros'
/// zeros (Titterton and Weston, Strapdown Inertial Navigation Technology, ch. 3 and 11, for the propagation;
/// Mahony, Hamel and Pflimlin, IEEE Trans. Automatic Control 53, 2008, for the correction with fixed gains and an
/// integral). The caller says by how much compass and inclinometer differ from what was thought of the time of
/// their reading.
class Attitude {
 public:
  explicit Attitude(const AttitudeOptions& options) : options_(options) {}

  /// The body turned for so long at this mean rate.
  void turn(const Eigen::Vector3d& rate_rad_s, double duration_s);
  /// How it turned meanwhile is not known: the next reading of the compass is taken as it is.
  void lose_track();
  /// The heading is off by this; the reading before was so long ago. Returns what the heading was turned by.
  double correct_heading(double difference_rad, double since_s);
  /// Likewise roll and pitch.
  Eigen::Vector2d correct_tilt(double roll_difference_rad, double pitch_difference_rad, double since_s);

  /// All headings are counted from another north: they grow by this.
  void turn_north(double change_rad) { set(roll_rad_, pitch_rad_, heading_rad_ + change_rad); }

  [[nodiscard]] bool heading_known() const { return heading_known_; }
  [[nodiscard]] bool tilt_known() const { return tilt_known_; }
  [[nodiscard]] double roll_rad() const { return roll_rad_; }
  [[nodiscard]] double pitch_rad() const { return pitch_rad_; }
  [[nodiscard]] double heading_rad() const { return heading_rad_; }  ///< -pi..pi
  [[nodiscard]] const Eigen::Vector3d& zero_rad_s() const { return zero_rad_s_; }

 private:
  void set(double roll_rad, double pitch_rad, double heading_rad);
  void read_angles();
  void learn_zero(const Eigen::Vector3d& change_rad_s);

  AttitudeOptions options_;
  Eigen::Quaterniond world_from_body_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d zero_rad_s_ = Eigen::Vector3d::Zero();
  double roll_rad_ = 0, pitch_rad_ = 0, heading_rad_ = 0;
  bool heading_known_ = false, tilt_known_ = false;
  bool heading_tracked_ = false, tilt_tracked_ = false;  ///< since the last reading
};

}  // namespace navcal::nav
