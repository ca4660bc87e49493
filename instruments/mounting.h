// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "config/settings.h"
#include "instruments/samples.h"

namespace navcal::instruments {

/// Turns what a device measured along its own axes into the axes of the body, by the configuration: field, rates,
/// specific force, velocities of a Doppler log, and the angles of a compass. Distances from the origin are left to
/// those who know the attitude.
class Mounting {
 public:
  explicit Mounting(const config::MountingSettings& settings);

  /// Nothing changes, to the last bit, where the configuration states no rotation.
  void to_body(decltype(Sample::value)& value) const;

 private:
  void to_body(CompassSample& compass) const;
  void to_body(ImuSample& imu) const;
  void to_body(DvlSample& dvl) const;

  bool turned_;
  double yaw_rad_;
  Eigen::Matrix3d body_from_device_;
};

}  // namespace navcal::instruments
