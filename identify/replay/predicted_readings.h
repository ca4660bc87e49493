// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "identify/data/recorded_motion.h"
#include "identify/replay/calibration.h"
#include "identify/replay/instrument_errors.h"
#include "identify/replay/motion_point.h"

namespace navcal::identify {

/// One reading of a channel.
struct ChannelReading {
  Channel channel;
  double time_s, value, std;
};

/// Readings of a recording's instruments at a point of a motion. With nu = (v, omega) through the water, R the
/// rotation from body to world, c the current, r the instrument's place, and the nuisances by their names:
///   rates     (1 + scale)(1 - turn x) omega + bias + drift t
///   force     (1 + scale)(1 - turn x)(v' + omega x v + omega' x r + omega x (omega x r) - R^T g) + bias
///   tilt      roll and pitch through the sensor's first-order lag, + offset
///   heading   the field at yaw + offset, levelled with the lagged tilt, + sine and cosine of it
///   depth     (1 + scale) z of the instrument's place + offset
///   Doppler   (1 + scale) Rz(turn)^T (v + omega x r [+ R^T c over the bottom])
///   fixes     position + R r + c t; R (v + omega x r) + c
/// Rates and the field have the errors of `errors` besides; the tilt of a point is as it is felt.
/// Delays are the caller's: each instrument is asked at the motion of the time it measured.
class PredictedReadings {
 public:
  explicit PredictedReadings(const RecordedMotion& recorded, InstrumentErrors errors = {})
      : recorded_(recorded), errors_(std::move(errors)) {}

  /// One number for each reading to `out`; `carried_m` is the distance that the water has carried the vehicle (c t
  /// above).
  void at(const MotionPoint& point, const Eigen::Vector3d& carried_m, std::span<const ChannelReading> readings,
          const Calibration& calibration, double* out) const;

 private:
  const RecordedMotion& recorded_;
  InstrumentErrors errors_;
};

}  // namespace navcal::identify
