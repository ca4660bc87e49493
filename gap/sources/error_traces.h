// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "gap/inference/linearised.h"
#include "gap/sources/error_source.h"

namespace navcal::gap {

/// Sources whose errors are simulated in one replay for all components: the estimator does not feed them back, so
/// that each stays in channels of its own.
using SourcesTogether = std::vector<const ErrorSource*>;

/// Sources by the replays that they share. Without a compass, accelerometers and fixes steer the estimator, too,
/// and then each source has its own replays.
[[nodiscard]] std::vector<SourcesTogether> by_replays(std::span<const ErrorSource* const> sources,
                                                      const Mission& mission);

/// A covariate that may be a term.
struct Series {
  std::size_t covariate;
  std::shared_ptr<const Eigen::VectorXd> values;
};

/// Traces of errors in the whitened residuals of one recording, by replaying it.
class ErrorTraces {
 public:
  /// `at`: values of all unknowns about which the errors are small. `begin_s`: mission time of the first value of
  /// a series. `model` must outlive it.
  ErrorTraces(const ResidualModel& model, const Eigen::VectorXd& at, double begin_s);

  /// -d residual / d amplitude of an error of each component that follows each series: a column each, components
  /// by series. `in_one_replay`: for components of sources that share their replays.
  [[nodiscard]] Eigen::MatrixXd of(const std::vector<const ErrorComponent*>& components, bool in_one_replay,
                                   const std::vector<Series>& series) const;

 private:
  /// Innovations with one step of an error in each of some components.
  [[nodiscard]] Innovations innovations_with(std::span<const ErrorComponent* const> components,
                                             const std::shared_ptr<const Eigen::VectorXd>& series) const;

  const ResidualModel& model_;
  Model about_;
  double begin_s_;
  Innovations nominal_;
};

}  // namespace navcal::gap
