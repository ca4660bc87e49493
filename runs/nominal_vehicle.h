// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "runs/response.h"
#include "runs/run.h"
#include "runs/scatter.h"

namespace navcal::runs {

/// The nominal runs do not show what the nominal vehicle does.
class BadNominal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The nominal vehicle: its parameters, and their scatter from session to session and from run to run, which is
/// the tolerance within which a vehicle counts as nominal.
struct NominalVehicle {
  RunClock clock;
  Eigen::Index thrusters = 0;
  Scatter parameters;  ///< of kParameters
  /// Of the spectrum of the yaw rate, after level, slope and curvature were taken out of each run; none when the
  /// runs are too short or their rate too low.
  std::optional<Scatter> spectrum;
  /// Takes level, slope and curvature out of a spectrum.
  Eigen::MatrixXd without_shape;
  /// Names of the runs of each session that was found.
  std::vector<std::vector<std::string>> sessions;
  /// Runs that were left out, and what limits the answers.
  std::vector<std::string> remarks;
};

/// Identifies the nominal vehicle. Throws BadNominal when the runs are too few or their thrusters never run.
[[nodiscard]] NominalVehicle identify(std::span<const Run> runs);

}  // namespace navcal::runs
