// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

/// Input of the calibrators: readings of the instruments in SI units and body axes (x forward, y starboard, z
/// down). Each has the time at which it was measured, in seconds from an origin that the caller chooses. No
/// calibrator reads a clock.
namespace navcal::calib {

struct CompassReading {
  double time_s = 0;
  std::optional<double> heading_rad;  ///< as the device says it, clockwise from magnetic north
  std::optional<double> pitch_rad;    ///< positive nose-up
  std::optional<double> roll_rad;     ///< positive starboard-down
  std::optional<Eigen::Vector3d> field_body_uT;
  std::int64_t utc_ns = 0;         ///< time_s in UTC, for reports; 0: not known
  double time_std_s = 0;           ///< of time_s, as its stamp claims it
  bool distorted = false;          ///< the device reports magnetic distortion (TCM2 E001): a remark, voids nothing
  bool tilt_out_of_range = false;  ///< heading and tilt are absent for that reason (E002)
  bool field_out_of_range = false;  ///< heading and field are absent for that reason (E004)
  bool faulty = false;              ///< the device reports another error: nothing of the reading is used
};

struct RateReading {
  double time_s = 0;
  Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();  ///< gyro A-x, B-y, A-z
  std::optional<double> yaw_rate_b_rad_s;                ///< gyro B-z, redundant; most vehicles have none
  std::optional<Eigen::Vector3d> specific_force_m_s2;
  bool saturated = false;  ///< the card's converter was over its range
  double time_std_s = 0;   ///< as its stamp claims it
};

/// A fix at the surface, in a local plane (north, east) that the caller holds fixed.
struct GroundReading {
  double time_s = 0;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< north, east
  double speed_m_s = 0;                                  ///< over ground
  std::optional<double> course_rad;                      ///< over ground, clockwise from true north
};

struct MotorReading {
  double time_s = 0;
  // Each nullopt where the device does not say.
  std::optional<double> rpm{};
  std::optional<double> current_A{};
};

/// A true heading by an external reference, independent of the compass.
struct ReferenceReading {
  double time_s = 0;
  double time_std_s = 0;
  double heading_rad = 0;  ///< clockwise from true north
  double std_rad = 0;      ///< its standard error; positive
  template <class Archive>
  void archive(Archive& archive) {
    archive(time_s, time_std_s, heading_rad, std_rad);
  }
};

}  // namespace navcal::calib
