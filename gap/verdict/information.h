// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/world_magnetic_model.h"
#include "gap/verdict/request.h"

namespace navcal::gap {

/// One parameter of one effect of the library.
struct ParameterName {
  std::string effect, parameter;   ///< "hard_iron", "x_uT"
  double typical = 1;              ///< value of strength 1, in the unit that the parameter's name states
  double least = 0, greatest = 0;  ///< bounds of its value, in typical values; infinite where there are none

  bool operator==(const ParameterName&) const = default;
};

/// Information of one recording about all parameters of the library at once: a Gaussian likelihood
///   log p(recording | v) = score^T v - 1/2 v^T information v + constant,
/// v in typical values of each effect (docs/gap.md), zero for the nominal vehicle. The gyros' turn-on biases are
/// integrated out. Several recordings are pooled by adding their terms.
struct RecordingInformation {
  std::vector<ParameterName> parameters;  ///< n, in the order of the library
  Eigen::MatrixXd information;            ///< n x n, symmetric, positive semidefinite
  Eigen::VectorXd score;                  ///< n
  /// Standard deviation of the model's own error in each parameter, typical values. It differs from recording to
  /// recording, and a longer recording does not reduce it.
  Eigen::VectorXd model_error;
  double power = 0;           ///< sum of squares of the whitened residuals of the nominal vehicle, biases fitted
  double measurements = 0;    ///< number of those residuals
  double null_power = 0;      ///< mean square of them among the null missions: the floor
  double null_power_std = 0;  ///< its scatter from null mission to null mission
  /// Effects about whose estimates the model was linearised; empty: about the nominal vehicle.
  std::vector<std::string> about;
  std::optional<base::GeodeticPosition> place;  ///< of the first fix
  std::optional<std::int64_t> utc_ns;           ///< of the first fix
  double duration_s = 0;
};

/// What came of a recording: its information, or the reason why there is none.
struct InformationResult {
  std::optional<RecordingInformation> information;
  std::string shortcoming;
  std::vector<std::string> remarks;
};

/// Computes the information of the first of `request.missions`; others and hold-outs are not used. Throws as
/// diagnose() does.
[[nodiscard]] InformationResult information_of(const Request& request, const Progress& progress);

}  // namespace navcal::gap
