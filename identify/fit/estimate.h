// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "identify/filter/noise_fit.h"

namespace navcal::identify {

/// Called with what is done and 0 to 1 of it; it may throw to end the fit.
using FitProgress = std::function<void(std::string_view, double)>;

struct EstimateSettings {
  unsigned threads = 2;
};

/// Prior of a recording's nuisances about zero: nuisance_stds(), but commands may reach the actuators late.
[[nodiscard]] Calibration estimated_nuisance_stds(const FilteredReplay& filter);

/// Solution of information * step = score with the unknowns that reach a bound held there.
[[nodiscard]] Eigen::VectorXd step_within(const Eigen::MatrixXd& information, const Eigen::VectorXd& score,
                                          const Eigen::VectorXd& at, const Eigen::VectorXd& low,
                                          const Eigen::VectorXd& high);

/// Recordings of one vehicle with what is unknown: one vector of parameters in their units, then the nuisances of
/// each recording.
class PredictionErrorProblem {
 public:
  /// `recordings` must outlive it. Throws std::invalid_argument as FilteredReplay does.
  PredictionErrorProblem(const config::Layout& layout, const std::vector<Parameter>& parameters,
                         const std::vector<RecordedMotion>& recordings, const EstimateSettings& settings);

  enum class Parameters { free, fixed };
  /// The unknowns at a point with the filters' passes there.
  struct Point {
    Eigen::VectorXd unknowns;
    std::vector<FilterPass> passes;
    double cost =
        0;  ///< twice the negative log posterior but for a constant; infinite: a filter leaves all bounds
    int steps = 0;
    bool is_settled = false;
  };
  /// What the point says of the unknowns: information and score without the priors.
  struct Linearised {
    Eigen::MatrixXd information;
    Eigen::VectorXd score;
    Eigen::MatrixXd block_scores;                 ///< of blocks of 5 s, one column each
    std::vector<Eigen::Index> first_of_blocks;    ///< of each recording, and the end
    std::vector<Eigen::MatrixXd> information_of;  ///< of each recording
  };

  [[nodiscard]] Eigen::VectorXd start() const;
  [[nodiscard]] Point at(Eigen::VectorXd unknowns) const;
  /// Gauss and Newton with the gains held, line search on the full cost with new gains, bounds by an active set.
  [[nodiscard]] Point minimise(Point from, int most, Parameters which, const FitProgress& progress,
                               std::string_view what) const;
  [[nodiscard]] Linearised linearise(const Point& point, Parameters which) const;
  /// Unknowns at the commands' delays that explain each recording best, of a few between 0 and 3 s.
  [[nodiscard]] Eigen::VectorXd with_delays(Eigen::VectorXd unknowns) const;
  /// Leaves out what diverges with these unknowns; returns the number of places.
  std::size_t leave_out_diverging(const Eigen::VectorXd& unknowns);
  void fit_noises(const Point& point, bool with_tau);
  [[nodiscard]] std::vector<FollowedRecording> followed(const Point& point) const;
  void set_noises(const FilterNoises& noises);

  [[nodiscard]] const FilterNoises& noises() const { return filters_.front().noises(); }
  [[nodiscard]] const std::vector<FilteredReplay>& filters() const { return filters_; }
  [[nodiscard]] const std::vector<Parameter>& parameters() const { return filters_.front().parameters(); }
  [[nodiscard]] const config::Layout& layout() const { return filters_.front().layout(); }
  [[nodiscard]] Eigen::Index nuisances_at(std::size_t recording) const {
    return std::ssize(parameters()) + static_cast<Eigen::Index>(recording) * kNuisances;
  }
  [[nodiscard]] Eigen::VectorXd values_of(const Eigen::VectorXd& unknowns, std::size_t recording) const;
  [[nodiscard]] const Eigen::VectorXd& precision() const { return precision_; }  ///< of the priors
  [[nodiscard]] std::vector<std::string> oddities() const;

 private:
  [[nodiscard]] Eigen::VectorXd deviation(const Eigen::VectorXd& unknowns) const;

  std::vector<FilteredReplay> filters_;
  EstimateSettings settings_;
  Eigen::VectorXd precision_, low_, high_;
};

struct Estimate {
  Eigen::VectorXd unknowns;
  PredictionErrorProblem::Point point;
  Eigen::VectorXd stds;               ///< of the parameters, in their units
  Eigen::MatrixXd covariance;         ///< of the parameters
  Eigen::MatrixXd border_covariance;  ///< of parameters and nuisances
  double model_error = 1;   ///< variance of the blocks' scores over that of white innovations, at least 1
  double start_spread = 0;  ///< greatest difference of the ends of two starts, in errors without it
  int iterations = 0;
  bool converged = false;
};

/// Maximum a posteriori estimate by the prediction-error method (Ljung 1999, System Identification, chapter 7):
/// innovations of a filter that also estimates a coloured disturbance, whose sizes and time constant are fitted in
/// turn with the parameters. Two starts: the file's numbers, and those that explain the steps from one reading to
/// the next (equation error: a filter that takes the vehicle to be strongly disturbed); the likelier end counts.
///
/// The covariance is A^-1 (B + P) A^-1 with P the priors' precision, A = H + P, and B the covariance of the score.
/// Under the model B = H. It is estimated from the scores of blocks of 5 s and their neighbours (Newey and West
/// 1987, Econometrica 55), drawn to c H with few blocks, c >= 1 the mean of the empirical over the expected
/// variance. No error is below that of the model, nor below the scatter of the recordings' own estimates. Where
/// the ends of the two starts are more than two errors apart, the error contains the difference.
[[nodiscard]] Estimate estimate(PredictionErrorProblem& problem, const FitProgress& progress);

/// The same about these parameters, from which alone it starts.
[[nodiscard]] Estimate estimate_from(PredictionErrorProblem& problem, const Eigen::VectorXd& parameters,
                                     const FitProgress& progress);

}  // namespace navcal::identify
