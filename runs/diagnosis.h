// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runs/effects.h"
#include "runs/nominal_vehicle.h"

namespace navcal::runs {

/// Log density of Student's t with these degrees of freedom, zero mean and scale matrix; without the terms that
/// depend on the degrees and the dimension alone. Few sessions leave the tails uncertain, so they are not
/// Gaussian. `squared` is the squared Mahalanobis distance, `log_determinant` that of the scale matrix.
[[nodiscard]] double log_student(double squared, double log_determinant, double dimension, double degrees);

/// Evidence of hypotheses about one run, or about runs of one session together.
class RunEvidence {
 public:
  RunEvidence(const NominalVehicle& vehicle, std::span<const Response> responses);

  /// Log marginal likelihood of what the runs showed.
  [[nodiscard]] double log_evidence(const Hypothesis& hypothesis);

  /// Mean of each parameter over the runs less the nominal; NaN where no run shows it.
  [[nodiscard]] const ParameterVector& deviations() const { return all_deviations_; }
  /// Standard deviation of the above for a nominal vehicle.
  [[nodiscard]] const ParameterVector& standard_deviations() const { return all_deviations_std_; }

 private:
  void take_parameters(std::span<const Response> responses);
  void take_spectrum(std::span<const Response> responses);
  [[nodiscard]] double of_parameters(const Prediction& prediction) const;
  [[nodiscard]] double with_line(double height_dB) const;
  [[nodiscard]] double of_spectrum(const Prediction& prediction);

  const NominalVehicle& vehicle_;
  double degrees_;
  std::vector<Eigen::Index> shown_;  ///< parameters that the runs show
  ParameterVector all_deviations_, all_deviations_std_;
  Eigen::VectorXd deviations_;
  Eigen::MatrixXd covariance_;
  std::optional<Eigen::LLT<Eigen::MatrixXd>> spectrum_factor_;
  Eigen::VectorXd spectrum_;  ///< deviation of the spectrum, whitened
  double spectrum_log_determinant_ = 0;
  std::map<double, double> with_line_;
};

enum class Verdict {
  nominal,    ///< the vehicle is as the nominal runs show it
  explained,  ///< an effect of the library, or one of a family of which the size is not told
  unknown,    ///< off the nominal, and no effect of the library does that
  undecided,  ///< the runs do not tell
};
/// "no-gap", "explained", "unknown", "undecided".
[[nodiscard]] std::string_view verdict_name(Verdict verdict);

struct Candidate {
  std::string name;  ///< of the effect, or "no-gap", or "unknown"
  double probability = 0;
};

struct RunDiagnosis {
  Verdict verdict = Verdict::undecided;
  /// On which the verdict rests, most probable first; empty unless explained.
  std::vector<Candidate> effects;
  /// All hypotheses, most probable first.
  std::vector<Candidate> candidates;
  /// Parameters less the nominal, and the standard deviation of that for a nominal vehicle; NaN where not shown.
  ParameterVector deviations, standard_deviations;
  /// Runs that were used, of those given: those whose thrusters ran.
  std::size_t runs_used = 0;
};

/// Diagnoses runs of one session together; one run alone is a session of one.
[[nodiscard]] RunDiagnosis diagnose(const NominalVehicle& vehicle, std::span<const Response> responses,
                                    const EffectInformation* removed);

}  // namespace navcal::runs
