// SPDX-License-Identifier: Apache-2.0
#include "gap/design/hypothesis.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/statistics.h"
#include "gap/inference/evidence.h"

namespace navcal::gap {
namespace {

constexpr int kOutcomes = 400;

/// Gaussian predictive of a hypothesis in the space of unknowns: A = L^T G L + 1 with V = L L^T.
struct Predictive {
  Eigen::LLT<Eigen::MatrixXd> factor;  ///< of A
  double half_log_determinant = 0;
  Eigen::MatrixXd image;  ///< G L

  Predictive(const Hypothesis& of, const Eigen::MatrixXd& gram) : image(gram * of.spread) {
    Eigen::MatrixXd scaled = of.spread.transpose() * image;
    scaled.diagonal().array() += 1;
    factor.compute(scaled);
    half_log_determinant = factor.matrixLLT().diagonal().array().log().sum();
  }
};

/// Log density of whitened residuals with this score X^T r, apart from a constant that all hypotheses share.
double log_density(const Hypothesis& of, const Predictive& predictive, const Eigen::MatrixXd& gram,
                   const Eigen::VectorXd& score) {
  const Eigen::VectorXd image = gram * of.mean;
  const Eigen::VectorXd half = predictive.factor.matrixL().solve(of.spread.transpose() * (score - image));
  return of.mean.dot(score) - 0.5 * of.mean.dot(image) + 0.5 * half.squaredNorm() -
         predictive.half_log_determinant;
}

double divergence(const Hypothesis& truth, const Predictive& by_truth, const Hypothesis& rival,
                  const Predictive& by_rival, const Eigen::MatrixXd& gram) {
  const auto lower = by_rival.factor.matrixL();
  const Eigen::VectorXd apart = truth.mean - rival.mean;
  const Eigen::VectorXd signal = gram * apart;
  const double mean = apart.dot(signal) - lower.solve(rival.spread.transpose() * signal).squaredNorm();
  // tr(S_b^-1 S_a) - n with S = 1 + X V X^T and S_b^-1 = 1 - X L_b A_b^-1 L_b^T X^T.
  const Eigen::MatrixXd half = lower.solve(by_rival.image.transpose());
  const double spread = truth.spread.cwiseProduct(by_truth.image).sum();
  const Eigen::MatrixXd inner = rival.spread.transpose() * by_rival.image;
  const double own = by_rival.factor.solve(inner).trace();
  const double both = (half * truth.spread).squaredNorm();
  return 0.5 * (mean + spread - own - both) + by_rival.half_log_determinant - by_truth.half_log_determinant;
}

}  // namespace

Hypothesis make_hypothesis(const EffectSubset& effects, double probability, const Information& so_far,
                           const Library& library, const Priors& priors) {
  const auto members = parameter_indices(library, effects);
  auto [mean, covariance] = Evidence(so_far.gram, so_far.score, priors.spike, priors.slab).posterior(members);
  for (Eigen::Index j = 0; j < mean.size(); ++j) {
    if (j < Library::kBiases) {
      covariance.row(j).setZero();
      covariance.col(j).setZero();
      covariance(j, j) = priors.slab[j] * priors.slab[j];
      mean[j] = 0;
      continue;
    }
    const Unknown& unknown = library.unknowns()[static_cast<std::size_t>(j)];
    mean[j] = std::clamp(mean[j], unknown.least, unknown.greatest);
    covariance(j, j) += priors.model_error[j] * priors.model_error[j];
  }
  return {effects, probability, std::move(mean), root_of(covariance)};
}

Eigen::MatrixXd root_of(const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd std = covariance.diagonal().cwiseSqrt();
  Eigen::MatrixXd scaled = std.cwiseInverse().asDiagonal() * covariance * std.cwiseInverse().asDiagonal();
  scaled.diagonal().array() += 1e-9;
  const Eigen::MatrixXd lower = scaled.llt().matrixL();
  return std.asDiagonal() * lower;
}

double expected_separation_nats(const Hypothesis& truth, const Hypothesis& rival, const Eigen::MatrixXd& gram) {
  return std::max(0.0, divergence(truth, Predictive(truth, gram), rival, Predictive(rival, gram), gram));
}

double log_error_bound(std::span<const Hypothesis> hypotheses, const Eigen::MatrixXd& gram) {
  std::vector<Predictive> predictives;
  for (const Hypothesis& each : hypotheses) predictives.emplace_back(each, gram);
  std::vector<double> terms;
  for (std::size_t a = 0; a < hypotheses.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const double nats = std::min(divergence(hypotheses[a], predictives[a], hypotheses[b], predictives[b], gram),
                                   divergence(hypotheses[b], predictives[b], hypotheses[a], predictives[a], gram));
      const double both = hypotheses[a].probability * hypotheses[b].probability;
      terms.push_back(0.5 * std::log(std::max(both, 1e-12)) - std::max(0.0, nats) / 4);
    }
  }
  if (terms.empty()) return -std::numeric_limits<double>::infinity();
  return base::log_sum_exp(terms);
}

double probability_exact(std::span<const Hypothesis> hypotheses, const Eigen::MatrixXd& gram, double named_from) {
  if (hypotheses.empty()) return 0;
  std::vector<Predictive> predictives;
  for (const Hypothesis& each : hypotheses) predictives.emplace_back(each, gram);
  Eigen::MatrixXd root = gram;
  const Eigen::VectorXd scale = (gram.diagonal().array() + 1e-12).sqrt();
  root = scale.cwiseInverse().asDiagonal() * root * scale.cwiseInverse().asDiagonal();
  root.diagonal().array() += 1e-9;
  const Eigen::MatrixXd noise_factor = scale.asDiagonal() * Eigen::MatrixXd(root.llt().matrixL());
  std::mt19937_64 generator(1);
  std::normal_distribution<double> normal;
  const auto draw = [&](Eigen::Index n) {
    Eigen::VectorXd values(n);
    for (double& value : values) value = normal(generator);
    return values;
  };
  double exact = 0, total = 0;
  for (std::size_t truth = 0; truth < hypotheses.size(); ++truth) {
    const Hypothesis& of = hypotheses[truth];
    int named = 0;
    for (int n = 0; n < kOutcomes; ++n) {
      const Eigen::VectorXd theta = of.mean + of.spread * draw(of.spread.cols());
      const Eigen::VectorXd score = gram * theta + noise_factor * draw(of.mean.size());
      std::vector<double> logs;
      for (std::size_t i = 0; i < hypotheses.size(); ++i) {
        logs.push_back(std::log(std::max(hypotheses[i].probability, 1e-12)) +
                       log_density(hypotheses[i], predictives[i], gram, score));
      }
      if (std::exp(logs[truth] - base::log_sum_exp(logs)) >= named_from) ++named;
    }
    exact += of.probability * named / kOutcomes;
    total += of.probability;
  }
  return exact / total;
}

Eigen::VectorXd smallest_strengths(const Eigen::MatrixXd& gram, std::span<const TestedParameter> tested,
                                   const Eigen::VectorXd& tolerances, double nats) {
  // 1/2 s^2 (G - G P^1/2 (1 + P^1/2 G P^1/2)^-1 P^1/2 G)_jj with the tolerances P of all others; that of j is
  // taken out by the rank-one identity 1/x' = 1/x - p_j.
  Eigen::MatrixXd scaled = tolerances.asDiagonal() * gram * tolerances.asDiagonal();
  scaled.diagonal().array() += 1;
  const Eigen::LLT<Eigen::MatrixXd> factor(scaled);
  const Eigen::MatrixXd half = factor.matrixL().solve(Eigen::MatrixXd(tolerances.asDiagonal() * gram));
  Eigen::VectorXd strengths =
      Eigen::VectorXd::Constant(std::ssize(tested), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < tested.size(); ++i) {
    const Eigen::Index j = tested[i].column;
    const double with = gram(j, j) - half.col(j).squaredNorm();
    const double own = tolerances[j] * tolerances[j];
    const double variance = with > 0 ? 1 / with - own : std::numeric_limits<double>::infinity();
    if (variance > 0 && std::isfinite(variance))
      strengths[static_cast<Eigen::Index>(i)] = std::sqrt(2 * nats * variance) / tested[i].typical;
  }
  return strengths;
}

}  // namespace navcal::gap
