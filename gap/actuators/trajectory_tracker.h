// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "config/vehicle.h"
#include "gap/actuators/actuator_track.h"
#include "gap/data/innovations.h"
#include "sim/vehicle/helm.h"

namespace navcal::gap {

/// Steers a simulated vehicle as the recorded one was steered. Servos and shaft follow the given angles and
/// speeds. A small correction of rudder and elevator keeps heading and depth near those of the record. Without
/// it, an elevator error of a tenth of a degree grows to metres of depth within ten minutes.
class TrajectoryTracker final : public sim::Helm {
 public:
  /// `servos_rad` at the times of the rows.
  TrajectoryTracker(std::span<const ActuatorTrack::Row> rows, std::vector<Vector3> servos_rad,
                    const Trajectory10Hz& course, const config::FinSettings& fins);

  [[nodiscard]] sim::Body start() const override;
  [[nodiscard]] sim::Actuators actuators_at_start() const override;
  [[nodiscard]] sim::Actuators next(double time_s, double step_s, const sim::Body& body) override;
  [[nodiscard]] bool finished() const override { return finished_; }

 private:
  /// Recorded motion at one time, by linear interpolation between the 10 Hz rows.
  struct Wanted {
    double heading_rad = 0, yaw_rate_rad_s = 0, pitch_rad = 0, pitch_rate_rad_s = 0, depth_m = 0;
  };
  [[nodiscard]] Wanted wanted_at(double time_s) const;

  std::span<const ActuatorTrack::Row> rows_;
  std::vector<Vector3> servos_rad_;
  const Trajectory10Hz& course_;
  config::FinSettings fins_;
  double rudder_rad_ = 0, elevator_rad_ = 0;  ///< correction to the reported angles, after the servos' lag
  bool finished_ = false;
};

}  // namespace navcal::gap
