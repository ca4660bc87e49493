// SPDX-License-Identifier: Apache-2.0
#include "gap/design/hypotheses.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "gap/inference/evidence.h"
#include "gap/inference/model_fit.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

/// Probability below which a set is left out, and the largest number of sets: more cost time and change no plan.
constexpr double kLeastHypothesis = 0.002;
constexpr std::size_t kMostHypotheses = 8;
/// Log odds with which a set is named before a rival: a probability of kNamedFrom beside rivals of kMostRivals.
/// Before no effect at all: a probability of no effect below kNoGapBelow.
const double kNamed_nats = std::log(kNamedFrom / kMostRivals), kGap_nats = -std::log(kNoGapBelow);

/// Log odds of `a` against `b` from which the verdict is `a`.
double decisive_nats(const Hypothesis& a, const Hypothesis& b) {
  if (a.effects.empty()) return -kGap_nats;
  return b.effects.empty() ? kGap_nats : kNamed_nats;
}

double normal_probability(double deviation) { return 0.5 * std::erfc(-deviation / std::sqrt(2.0)); }

}  // namespace

std::vector<Hypothesis> probable_hypotheses(const DiagnosisProblem& problem, const FoundEffects& found) {
  const LinearGaussianModel model{found.found.best.linear, problem.library, found.priors};
  std::vector<Hypothesis> all;
  bool has_none = false;
  for (const Candidate& candidate : found.found.candidates) {
    const bool is_none = candidate.effects.empty();
    if (!is_none &&
        (candidate.probability < kLeastHypothesis || all.size() + 1 >= kMostHypotheses + (has_none ? 1 : 0))) {
      continue;
    }
    has_none = has_none || is_none;
    Hypothesis hypothesis{candidate.effects, candidate.log_odds, candidate.probability,
                          Eigen::VectorXd::Zero(found.found.best.mean.size())};
    const auto members = parameter_indices(problem.library, candidate.effects);
    const Eigen::VectorXd mean = candidate.effects == found.found.best.effects
                                     ? found.found.best.mean
                                     : bounded_posterior(model, members).mean;
    for (const Eigen::Index j : members) hypothesis.values[j] = mean[j];
    all.push_back(std::move(hypothesis));
  }
  double total = 0;
  for (const Hypothesis& each : all) total += each.probability;
  for (Hypothesis& each : all) each.probability /= total;
  return all;
}

std::vector<Hypothesis> weak_hypotheses(const Library& library, const Priors& priors, double strength) {
  std::vector<Hypothesis> all{{{}, 0, 0.5, Eigen::VectorXd::Zero(priors.spike.size())}};
  for (std::size_t effect = 0; effect < library.size(); ++effect) {
    if (!library.holds(effect)) continue;
    Hypothesis hypothesis{
        {effect}, 0, 0.5 / static_cast<double>(library.size()), Eigen::VectorXd::Zero(priors.spike.size())};
    const double share = strength / std::sqrt(static_cast<double>(library.count(effect)));
    for (const Eigen::Index j : parameter_indices(library, {effect})) {
      hypothesis.values[j] = share * library.unknowns()[static_cast<std::size_t>(j)].typical;
    }
    all.push_back(std::move(hypothesis));
  }
  return all;
}

Eigen::MatrixXd information_without_biases(const Eigen::MatrixXd& gram, const Priors& priors) {
  constexpr Eigen::Index b = Library::kBiases;
  const Eigen::Index n = gram.rows() - b;
  Eigen::MatrixXd biases = gram.topLeftCorner(b, b);
  biases.diagonal() += priors.slab.head(b).cwiseAbs2().cwiseInverse();
  const Eigen::MatrixXd cross = gram.topRightCorner(b, n);
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(gram.rows(), gram.cols());
  information.bottomRightCorner(n, n) =
      gram.bottomRightCorner(n, n) - cross.transpose() * biases.llt().solve(cross);
  return information;
}

// With covariances C = 1 + X P^2 X^T of the data under each model, and C_0 that of the tolerances,
//   E[log p(r|a) - log p(r|b)] = 1/2 v^T X^T (C_b^-1 - C_a^-1) X v + 1/2 tr((C_b^-1 - C_a^-1) C_0)
//                                + 1/2 (log det C_b - log det C_a),
// and by Woodbury's identity X^T C^-1 X = G - G M G, tr(C^-1) = rows - tr(M G), det C = det(1 + P G P).
ModelForecast::ModelForecast(const EffectSubset& members, const Eigen::MatrixXd& information,
                             const Library& library, const Priors& priors) {
  Eigen::VectorXd prior = priors.spike;
  for (const Eigen::Index j : parameter_indices(library, members)) prior[j] = priors.slab[j];
  Eigen::MatrixXd scaled = prior.asDiagonal() * information * prior.asDiagonal();
  scaled.diagonal().array() += 1;
  const Eigen::LLT<Eigen::MatrixXd> factor(scaled);
  const Eigen::MatrixXd half = prior.asDiagonal() * information;
  const Eigen::MatrixXd solved = factor.solve(half);
  left_ = information - half.transpose() * solved;
  log_determinant_ = 2 * factor.matrixLLT().diagonal().array().log().sum();
  // tr(M G) = tr((1 + P G P)^-1 P G P); the tolerances themselves add tr(S^2 (G - G M G)).
  const auto n = static_cast<double>(prior.size());
  const double taken = n - factor.solve(Eigen::MatrixXd::Identity(prior.size(), prior.size())).trace();
  trace_ = -taken + left_.diagonal().dot(priors.spike.cwiseAbs2());
}

double ModelForecast::unexplained_nats(const Eigen::VectorXd& values) const {
  return 0.5 * std::max(0.0, values.dot(left_ * values));
}

double ModelForecast::expected_over(const ModelForecast& other, const Eigen::VectorXd& values) const {
  return other.unexplained_nats(values) - unexplained_nats(values) + 0.5 * (other.trace_ - trace_) +
         0.5 * (other.log_determinant_ - log_determinant_);
}

double probability_of_exact_answer(const std::vector<Hypothesis>& hypotheses, const Eigen::MatrixXd& separation) {
  double sum = 0;
  for (std::size_t a = 0; a < hypotheses.size(); ++a) {
    double least = 1;
    for (std::size_t b = 0; b < hypotheses.size(); ++b) {
      if (a == b) continue;
      const double nats = separation(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
      const double margin =
          hypotheses[a].log_odds - hypotheses[b].log_odds + nats - decisive_nats(hypotheses[a], hypotheses[b]);
      least = std::min(least, nats > 0     ? normal_probability(margin / std::sqrt(2 * nats))
                              : margin > 0 ? 1.0
                                           : 0.0);
    }
    sum += hypotheses[a].probability * least;
  }
  return sum;
}

}  // namespace navcal::gap
