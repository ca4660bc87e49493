// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "runs/response.h"
#include "runs/run.h"

namespace navcal::runs {

/// One-way random effects: value of a run = mean + what its session has + what the run has.
/// (Searle, Casella and McCulloch 1992, Variance Components, ch. 3; moments, for sessions of unequal size.)
struct Scatter {
  Eigen::VectorXd mean;      ///< over sessions, each counted once
  Eigen::MatrixXd session;   ///< covariance of what a new session has; it includes the error of the mean
  Eigen::MatrixXd run;       ///< covariance from run to run within a session
  std::size_t sessions = 0;  ///< sessions that the covariance rests on
};

/// Sessions of this many runs and more count.
inline constexpr std::size_t kRunsOfASession = 3;

/// Moments of the rows of `values`, one a run, in sessions given by places of rows. The session's covariance is
/// not yet regularised: with k sessions it has k - 1 degrees of freedom. With fewer than two sessions nothing is
/// known of it, and its variances are taken as those of the run times `session_over_run`. Needs a session of
/// kRunsOfASession runs.
[[nodiscard]] Scatter scatter_of(const Eigen::MatrixXd& values, std::span<const std::vector<std::size_t>> sessions,
                                 double session_over_run);

/// The correlations of a covariance drawn towards zero by this weight; the variances stay.
[[nodiscard]] Eigen::MatrixXd with_weaker_correlations(const Eigen::MatrixXd& covariance, double weight);

/// Groups runs into sessions: one day, one ballast, one battery after the other.
///
/// The clock of a run has no date, so days overlap on it. A run joins the session whose latest runs it follows
/// within half an hour and resembles in attitude at rest and in pressure at the surface; else it begins a new one.
/// Neither commands nor what happens under thrust takes part. Returns the places of the runs, a list a session.
[[nodiscard]] std::vector<std::vector<std::size_t>> sessions_of(std::span<const RestState> rest);

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
