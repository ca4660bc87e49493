// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "gap/inference/linearised.h"
#include "gap/inference/spike_and_slab.h"
#include "gap/sources/covariates.h"
#include "gap/sources/error_source.h"

namespace navcal::gap {

/// Gram matrix Z^T (1 + X D^2 X^T)^-1 Z and score Z^T (1 + X D^2 X^T)^-1 r of some traces Z.
struct MarginalTraces {
  Eigen::MatrixXd gram;
  Eigen::VectorXd score;
};

/// What the tolerances of a vehicle can explain in the residuals r of one recording: X are the derivatives by the
/// tolerances, D their standard deviations.
class ToleranceSpace {
 public:
  ToleranceSpace(const Linearised& nominal, const Priors& priors);

  /// `traces`: a column each, in the rows of the residuals. What tolerances can explain counts less in them.
  [[nodiscard]] MarginalTraces marginalised(const Eigen::MatrixXd& traces) const;

 private:
  Eigen::VectorXd residual_, share_, scaled_score_;
  Eigen::MatrixXd basis_;  ///< orthonormal
};

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

/// An error of one component that follows one covariate.
struct ErrorTerm {
  const ErrorComponent* component = nullptr;
  std::size_t covariate = 0;  ///< index into the covariates
  double coefficient = 0;     ///< root mean square of the error, in the unit of the component's place
  double std_error = 0;
};

/// The best description of the residuals by an error of one source.
struct SourceFit {
  const ErrorSource* source = nullptr;
  /// Log evidence over that of a vehicle within tolerance, nats. Each term has paid for the choice among all terms
  /// of the source.
  double gain_nats = 0;
  std::vector<ErrorTerm> terms;  ///< in the order of their gain
};

/// What the sources are compared on. References; valid as long as what they refer to.
struct SourceProblem {
  const ResidualModel& model;  ///< of one recording
  const Linearised& nominal;   ///< about the nominal vehicle; its unknowns are tolerances here
  const Priors& priors;
  std::span<const Covariate> covariates;  ///< of the recording's course
  double begin_s = 0;                     ///< mission time of their first value
};

/// Which covariates an error may follow.
enum class CovariateSet : std::uint8_t {
  basic,  ///< those that tell sources apart
  full,   ///< all
};

/// Compares sources of errors by how well they describe the residuals of one recording. Each component of a source
/// may have an error that follows any covariate. Its trace in all channels comes from replaying the mission with
/// it, so that a source is found although the estimator moves its error into other channels. Terms are chosen one
/// after the other, as long as the evidence grows (Gaussian marginal likelihood with the tolerances as nuisance
/// parameters).
class SourceEvidence {
 public:
  /// Replays the recording. What `problem` refers to must outlive it.
  explicit SourceEvidence(const SourceProblem& problem);

  /// The best description by each of some sources with the basic covariates, largest gain first. Sources that gain
  /// nothing are left out. `progress` is called with the share that is done.
  [[nodiscard]] std::vector<SourceFit> ranked(std::span<const ErrorSource* const> candidates,
                                              const std::function<void(double)>& progress) const;

  /// Descriptions by one source with all covariates: by one term, by two and so on, each with more evidence than
  /// the one before.
  [[nodiscard]] std::vector<SourceFit> descriptions(const ErrorSource& source) const;

 private:
  /// Descriptions by each of some sources that share their replays: by one term, by two and so on.
  [[nodiscard]] std::vector<std::vector<SourceFit>> paths_of(const SourcesTogether& sources,
                                                             CovariateSet set) const;

  SourceProblem problem_;
  ToleranceSpace tolerances_;
  ErrorTraces replayed_;
};

}  // namespace navcal::gap
