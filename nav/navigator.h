// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "nav/attitude.h"
#include "nav/dead_reckoning.h"
#include "nav/depth_filter.h"
#include "nav/estimate.h"
#include "nav/held_velocity.h"
#include "nav/options.h"
#include "nav/past_poses.h"
#include "nav/readings.h"

namespace navcal::nav {

/// Attitude, depth and position of a vehicle that has a compass, gyros, a depth gauge, a shaft that is counted, a
/// DVL, and now and then a fix; any of them may be absent (docs/navigation.md). Readings come in the order of
/// their arrival, each with the time at which it was measured.
///
/// The card with the gyros drives the time: each of its frames moves everything on to its own time. Any other
/// reading is compared with what was thought of its time, and what follows from the difference corrects the
/// present. While no frames come, whatever comes drives the time. A reading that is not newer than the last of its
/// kind, is older than what is remembered, or holds what no instrument can say, is left out.
///
/// No memory is taken after construction. The same calls give the same results to the last bit.
class Navigator {
 public:
  explicit Navigator(const Options& options);

  void take(const RateReading& reading);
  void take(const CompassReading& reading);
  /// The tilt by accelerometers, for a vehicle without an inclinometer.
  void take(const TiltReading& reading);
  void take(const ShaftReading& reading);
  /// It moves the position while it comes, and shows the set. An outlier is passed over and counted.
  void take(const GroundVelocityReading& reading);
  /// It takes the place of the shaft's speed.
  void take(const WaterVelocityReading& reading);
  void take(const DepthReading& reading);
  void take(const FixReading& reading);

  /// Headings are counted from another north from here on (the declination became known): they grow by this.
  void turn_north(double change_rad);

  /// Whether anything came yet.
  [[nodiscard]] bool started() const { return time_ns_.has_value(); }
  [[nodiscard]] std::int64_t time_ns() const { return time_ns_.value_or(0); }
  [[nodiscard]] Estimate estimate() const;
  /// Attitude at a time of the last seconds; nullopt before a heading came, and for other
  /// times. A tilt that was never measured is zero.
  [[nodiscard]] std::optional<Pose> attitude_at(std::int64_t time_ns) const;
  /// Radius around the estimated position that contains the true one with a probability of 95 %, in `after_s`, if
  /// the vehicle goes on as it does and gets no fix, m. Nullopt before the first fix.
  [[nodiscard]] std::optional<double> error_radius_m(double after_s) const;
  /// A stretch without fixes that the last fix ended; once.
  [[nodiscard]] std::optional<Outage> take_outage();
  [[nodiscard]] std::uint64_t left_out() const { return left_out_; }
  /// Measurements of a DVL that disagreed with those before them.
  [[nodiscard]] std::uint64_t velocity_outliers() const { return bottom_.outliers() + water_.outliers(); }

 private:
  /// The newest reading of a kind.
  using Last = std::optional<std::int64_t>;

  [[nodiscard]] bool is_new(Last& last, std::int64_t time_ns, bool plausible);
  /// The pose that a new reading is compared with; a reading without one is left out.
  [[nodiscard]] std::optional<Pose> pose_for(Last& last, std::int64_t time_ns, bool plausible);
  [[nodiscard]] bool rates_come(std::int64_t time_ns) const;
  /// While nothing else does, this reading moves the time on.
  void drive(std::int64_t time_ns);
  /// Takes what a gauge reads that is mounted at `position_m`.
  void correct_depth(double gauge_m, const Eigen::Vector3d& position_m, std::optional<double> std_m);
  void advance(std::int64_t time_ns, const std::optional<Eigen::Vector3d>& mean_rate_rad_s);
  void move_speed(double duration_s);
  /// The best that is current; null without any.
  [[nodiscard]] const HeldVelocity* held_velocity() const;
  [[nodiscard]] Eigen::Vector3d measured_m_s(const HeldVelocity& held) const;
  [[nodiscard]] bool direction_known(const HeldVelocity& held) const;
  /// Velocity of an instrument at that place, by the turning of the vehicle, in this frame.
  [[nodiscard]] Eigen::Vector3d arm_velocity_m_s(const Pose& pose, const Eigen::Vector3d& position_m,
                                                 VelocityFrame frame) const;
  template <bool kOverBottom>
  bool hold(HeldVelocity& held, const VelocityReading<kOverBottom>& reading, const Pose& pose, SpeedSource source);
  [[nodiscard]] std::optional<HeldVelocity::Expected> expected(const GroundVelocityReading& reading,
                                                               const Pose& pose) const;
  [[nodiscard]] std::optional<HeldVelocity::Expected> expected(const WaterVelocityReading& reading,
                                                               const Pose& pose) const;
  [[nodiscard]] std::optional<Eigen::Vector2d> water_velocity_m_s(const Pose& pose) const;
  [[nodiscard]] std::optional<double> speed_through_water_m_s() const;
  /// North and east, over ground.
  [[nodiscard]] std::optional<Eigen::Vector2d> level_velocity_m_s() const;
  /// The way of a step by a DVL; `before_m_s` at its begin.
  void measure(Way& way, const HeldVelocity& held, const Eigen::Vector3d& before_m_s) const;
  [[nodiscard]] Eigen::Vector2d ahead() const;
  void observe_set(const FixReading& reading);
  [[nodiscard]] double heading_std_rad() const;

  Options options_;
  Attitude attitude_;
  DepthFilter depth_;
  DeadReckoning reckoning_;
  PastPoses past_;
  std::optional<std::int64_t> time_ns_;
  Last rates_ns_, compass_ns_, tilt_reading_ns_, shaft_ns_, fix_ns_, bottom_ns_, water_ns_, depth_ns_;
  Eigen::Vector3d rate_rad_s_ = Eigen::Vector3d::Zero();
  double revolutions_per_s_ = 0;
  double speed_m_s_ = 0;
  bool speed_known_ = false;
  HeldVelocity bottom_, water_;
  SetWindow set_window_;
  SpeedSource source_ = SpeedSource::none;            ///< of the last step
  std::optional<std::int64_t> over_bottom_ns_;        ///< end of the last step by the velocity over the bottom
  std::optional<std::int64_t> heading_ns_, tilt_ns_;  ///< of the last reading that had one
  double heading_error_rad_ = 0;                      ///< of its heading, all along a leg
  double drift_rad_ = 0;                              ///< of the heading since then, one standard deviation
  std::optional<Outage> outage_;
  std::uint64_t left_out_ = 0;
};

}  // namespace navcal::nav
