// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "calib/archive.h"
#include "calib/judgement.h"
#include "calib/magnetometer/motor_window.h"
#include "calib/readings.h"
#include "calib/turn/held_out.h"

namespace navcal::calib {

/// Motor current over time, linear between the motor card's readings.
class CurrentTrack {
 public:
  /// Readings come in the order of their times; one without a current is left out.
  void update(const MotorReading& motor);
  /// Interpolated current in amperes; nullopt unless two readings at most kLongest_s apart enclose `time_s`.
  [[nodiscard]] std::optional<double> at(double time_s) const;
  /// Same as at(), but where that is not known yet the newest reading, if it is not older than kLongest_s.
  [[nodiscard]] std::optional<double> at_or_newest(double time_s) const;
  /// The newest reading, if it is not older than kLongest_s.
  [[nodiscard]] std::optional<double> newest(double time_s) const;
  /// Drops all readings; called when their times belong to another time scale.
  void forget() { count_ = 0; }
  void archive(Archive& archive);

 private:
  static constexpr std::size_t kKept = 64;
  static constexpr double kLongest_s = 1;
  struct Point {
    double time_s = 0, current_A = 0;
    void archive(Archive& archive) { archive(time_s, current_A); }
  };
  [[nodiscard]] const Point& back(std::size_t age) const { return points_[(next_ + 2 * kKept - 1 - age) % kKept]; }

  std::array<Point, kKept> points_{};  ///< a ring
  std::size_t next_ = 0, count_ = 0;
};

/// Field of the motor's supply: measured = field of Earth and iron + k I, k in uT/A in body axes, I the motor's
/// current. k follows from changes of the current: around each change a window is cut out of the readings
/// (MotorFieldEvidence), long enough on both sides for steady current where magnetic readings about the motor's
/// switching are left out. Where the current never changes, its field is one with hard iron, and is refused.
///
/// The stated errors contain what the windows show beyond noise: chi-square of the windows' own k against the
/// common one, pooled with a prior of kPriorWindows windows that agree, so that few windows do not promise too
/// much.
class MotorCurrent {
 public:
  struct Estimate {
    Eigen::Vector3d slope_uT_per_A = Eigen::Vector3d::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  };

  explicit MotorCurrent(const MotorWindowNoise& noise) : noise_(noise) {}

  // Readings of each instrument in the order of their times. Fields as measured: without any correction for the
  // motor's current.
  void update(const RateReading& reading);
  void update(const MotorReading& reading);
  /// `in_force_uT_per_A`: to compare the estimate with on windows that had no part in it.
  void update(const CompassReading& reading, const Eigen::Vector3d& in_force_uT_per_A);
  /// Closes the open window; no more readings come.
  void finish();
  /// Forgets what it has seen; the readings that go on are not.
  void start();
  void on_change() { comparison_.on_change(); }

  [[nodiscard]] std::optional<Estimate> estimate() const;
  [[nodiscard]] Judgement judgement() const;
  /// Misfit of the field, uT: without correction, with the active one, and with the estimate made before each
  /// window.
  [[nodiscard]] const Comparison& comparison() const { return comparison_; }
  /// Current at a time, by the readings so far.
  [[nodiscard]] const CurrentTrack& current() const { return current_; }
  void archive(Archive& archive);

 private:
  /// Windows are merged in pairs where there are more.
  static constexpr std::size_t kMostWindows = 128;
  static constexpr std::size_t kPending = 32;

  struct PendingField {
    double time_s = 0;
    Eigen::Vector3d field_body_uT = Eigen::Vector3d::Zero();
    void archive(Archive& archive) { archive(time_s, field_body_uT); }
  };

  struct Rate {
    double time_s = 0;
    Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();
    void archive(Archive& archive) { archive(time_s, rate_rad_s); }
  };

  void take_pending(const Rate& before, const Rate& now);
  void add(const MotorFieldReading& reading);
  /// Change of the current between the newest readings and those some time before, in amperes.
  [[nodiscard]] double change_A() const;
  [[nodiscard]] double noticeable_A() const;
  void end_window();
  void keep(const MotorFieldEvidence& evidence);

  MotorWindowNoise noise_;
  CurrentTrack current_;
  std::optional<Rate> rate_;  ///< newest
  Eigen::Vector4d turned_ = {0, 0, 0, 1};
  std::array<PendingField, kPending> pending_{};  ///< in order; rates or current are not known yet
  std::size_t pending_count_ = 0;
  std::vector<MotorFieldReading> window_;
  std::optional<double> changed_s_;  ///< newest change of the current within the window
  double current_jitter_A_ = 0;      ///< mean size of the difference of two readings
  std::vector<MotorFieldEvidence> windows_;
  Eigen::Vector3d in_force_uT_per_A_ = Eigen::Vector3d::Zero();
  std::uint64_t readings_ = 0;
  bool current_seen_ = false;
  Comparison comparison_;
};

}  // namespace navcal::calib
