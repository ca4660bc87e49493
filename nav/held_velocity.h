// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "nav/readings.h"

namespace navcal::nav {

/// Velocity of the vehicle's origin, as a DVL measured it, and the test of each measurement.
///
/// Model: the velocity changes by no more than 1 m/s2 between two measurements. A measurement that differs from
/// the one before by more than that and five standard deviations is an outlier: a beam met a fish or a side lobe.
/// Five outliers in a row that agree with each other begin anew. Between measurements the newest velocity is
/// held, in the frame in which it was measured: in body axes it turns with the vehicle. After a pause it is not
/// current any more. Body axes x forward, y starboard, z down, or north, east, down. No memory is taken, and no
/// clock read.
class HeldVelocity {
 public:
  /// After this time without a measurement the velocity is unknown.
  static constexpr double kPause_s = 3;

  struct Step {
    /// The new velocity less the one before, m/s; zero when there is nothing before it.
    Eigen::Vector3d change_m_s = Eigen::Vector3d::Zero();
    double since_s = 0;  ///< the measurement before; 0 when there is none
  };
  /// What other instruments expect, for the measurement that begins.
  struct Expected {
    Eigen::Vector3d velocity_m_s =
        Eigen::Vector3d::Zero();  ///< in the frame of the measurement; z is not compared
    double std_m_s = 0;
  };

  /// Nullopt when the measurement is an outlier. Times increase.
  std::optional<Step> take(std::int64_t time_ns, const Eigen::Vector3d& velocity_m_s, VelocityFrame frame,
                           double std_m_s, const std::optional<Expected>& expected);
  [[nodiscard]] bool current(std::int64_t time_ns) const;

  [[nodiscard]] const Eigen::Vector3d& velocity_m_s() const { return newest_.velocity_m_s; }
  [[nodiscard]] VelocityFrame frame() const { return frame_; }
  [[nodiscard]] double std_m_s() const { return newest_.std_m_s; }
  /// Growth of the variance of an integrated velocity, by the noise of its measurements, m2/s.
  [[nodiscard]] double noise_m2_per_s() const { return newest_.std_m_s * newest_.std_m_s * interval_s_; }
  [[nodiscard]] std::uint64_t outliers() const { return outliers_; }

 private:
  struct Measurement {
    std::int64_t time_ns = 0;
    Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
    double std_m_s = 0;
  };
  [[nodiscard]] static bool follows(const Measurement& before, const Measurement& next);
  [[nodiscard]] bool is_outlier(const Measurement& next, const std::optional<Expected>& expected) const;
  /// Whether the outliers agree for long enough.
  [[nodiscard]] bool insists(const Measurement& outlier);

  Measurement newest_, newest_outlier_;
  VelocityFrame frame_ = VelocityFrame::body;
  bool known_ = false;
  double interval_s_ = 1;
  int outliers_in_a_row_ = 0;
  std::uint64_t outliers_ = 0;
};

/// The set as a DVL shows it: velocity over the bottom less velocity through the water, both north and east,
/// averaged over a second. What changes within that second lowers its weight: in turns and at changes of speed the
/// velocity through the water is known least. No memory is taken.
class SetWindow {
 public:
  struct Set {
    Eigen::Vector2d set_m_s = Eigen::Vector2d::Zero();
    double std_m_s = 0;  ///< each axis
  };
  /// `std_m_s` of the difference, each axis. Times increase. Returns the mean when a second is full.
  std::optional<Set> take(std::int64_t time_ns, const Eigen::Vector2d& bottom_m_s,
                          const Eigen::Vector2d& water_m_s, double std_m_s);

 private:
  std::int64_t first_ns_ = 0, newest_ns_ = 0;
  Eigen::Vector2d first_bottom_m_s_ = Eigen::Vector2d::Zero(), first_water_m_s_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d sum_m_s_ = Eigen::Vector2d::Zero();
  double variances_m2_s2_ = 0;
  int count_ = 0;
};

}  // namespace navcal::nav
