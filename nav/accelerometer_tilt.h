// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "base/reference_instruments.h"
#include "nav/attitude.h"
#include "nav/past_poses.h"
#include "nav/readings.h"

namespace navcal::nav {

struct AccelerometerTiltOptions {
  double tilt_gain_per_s = 0.5;  ///< as of the inclinometer (AttitudeOptions)
  double tilt_zero_gain_per_s2 = 0.01;
  double advance_m =
      base::reference::kAdvance_m;  ///< through the water for one revolution of the shaft; 0: not known
  double speed_lag_s = base::reference::kSpeedLag_s;  ///< of the vehicle's speed behind its shaft's
};

/// Roll and pitch from accelerometers and gyros, for a vehicle without an inclinometer. Model: the specific force
/// is f = u' ex + w x (u ex) - g, with u the speed along the body's x axis, w the rates and g gravity (Titterton
/// and Weston, Strapdown Inertial Navigation Technology, ch. 3; sway and heave are taken as zero). What remains
/// after the first two is gravity, and holds in the long run an attitude that the gyros carry through short times.
/// The speed is the shaft's through the lag, else that over ground of the newest fixes; without either, turns and
/// changes of speed show as tilt. What accelerometers away from the vehicle's origin feel more than at it is taken
/// off. Radians, seconds, body axes x forward, y starboard, z down.
///
/// No memory is taken after construction. The same calls give the same results to the last bit.
class AccelerometerTilt {
 public:
  explicit AccelerometerTilt(const AccelerometerTiltOptions& options);

  /// A reading that is not newer than the last, or has no specific force, is passed over.
  void take(const RateReading& reading);
  void take(const ShaftReading& reading);
  void take(const FixReading& reading);

  /// Tilt at `time_ns`, at most 0.2 s beyond the newest reading and some seconds before it.
  [[nodiscard]] std::optional<TiltReading> at(std::int64_t time_ns) const;
  [[nodiscard]] std::optional<TiltReading> newest() const;

 private:
  void move_speed(std::int64_t time_ns, double duration_s);

  AccelerometerTiltOptions options_;
  Attitude attitude_;
  PastPoses past_;
  std::optional<std::int64_t> time_ns_;
  Eigen::Vector3d rate_rad_s_ = Eigen::Vector3d::Zero();
  double speed_m_s_ = 0, acceleration_m_s2_ = 0;
  double shaft_per_s_ = 0, ground_speed_m_s_ = 0;
  std::optional<std::int64_t> shaft_ns_, ground_ns_;  ///< of the newest readings
  bool speed_by_shaft_ = false;
};

}  // namespace navcal::nav
