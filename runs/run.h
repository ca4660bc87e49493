// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "base/failure.h"

namespace navcal::runs {

/// A run file that cannot be used: the message names file, line and column.
class BadRun : public base::Failure {
 public:
  explicit BadRun(const std::string& message) : Failure(base::Exit::bad_input, message) {}
};

/// One run of a thruster vehicle: rows at a constant rate, the vehicle at the surface with thrusters stopped
/// first.
struct Run {
  std::string name;
  Eigen::VectorXd clock_s;     ///< second of the day, whole, as the file states it
  Eigen::MatrixXd command_us;  ///< pulse width commanded, one column a thruster
  Eigen::VectorXd depth_m;     ///< as the vehicle reported it, positive down
  Eigen::VectorXd pressure;    ///< raw reading of the depth sensor, in its own unit
  Eigen::VectorXd battery_V;
  Eigen::VectorXd roll_rad, pitch_rad;
  Eigen::VectorXd yaw_rate_rad_s;
  [[nodiscard]] Eigen::Index rows() const { return depth_m.size(); }
};

/// Reads a run from comma-separated text with a heading: time (HHMMSS), pwm1, pwm2, ... (microseconds), depth (m),
/// press, voltage (V), roll, pitch (degrees), w_yaw (degrees per second), in any order. Other columns are passed
/// over. `file` is named in messages. Throws BadRun.
[[nodiscard]] Run read_run(std::string_view text, const std::string& name, const std::string& file);

}  // namespace navcal::runs
