// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/recordings_apart.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <utility>

#include "gap/inference/evidence.h"
#include "gap/thresholds.h"

// The estimates m_k of one effect from each recording alone, with covariances V_k, agree with their weighted mean
// m within the errors if Q = sum (m_k - m)^T V_k^-1 (m_k - m) is one of a chi-square distribution with p (K - 1)
// degrees of freedom (Cochran 1954). V_k holds the error of the model in one recording, too.
namespace navcal::gap {
namespace {

/// Estimates of the effects by some rows of the joint linear model.
Evidence::Posterior posterior_of_rows(const ModelFit& best, const LinearGaussianModel& model, Eigen::Index from,
                                      Eigen::Index count, std::span<const Eigen::Index> members) {
  const Eigen::MatrixXd design = best.linear.design.middleRows(from, count);
  const Eigen::VectorXd residual = residual_at_zero(best.linear).segment(from, count);
  return Evidence(design.transpose() * design, design.transpose() * residual, model.priors.spike,
                  model.priors.slab)
      .posterior(members);
}

/// Part of a posterior that belongs to one effect, with the error of the model in one recording.
OwnEstimate estimate_of(const Evidence::Posterior& posterior, const std::vector<Eigen::Index>& members,
                        const Eigen::VectorXd& model_error) {
  OwnEstimate own{posterior.mean(members), posterior.covariance(members, members)};
  own.covariance.diagonal() += model_error(members).cwiseAbs2();
  return own;
}

/// Probability of estimates that differ as much, if the effect is the same in all recordings.
double homogeneity_p_value(const std::vector<OwnEstimate>& estimates) {
  const Eigen::Index n = estimates.front().mean.size();
  Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd weighted = Eigen::VectorXd::Zero(n);
  for (const OwnEstimate& each : estimates) {
    const Eigen::LLT<Eigen::MatrixXd> factor(each.covariance);
    weight += factor.solve(Eigen::MatrixXd::Identity(n, n));
    weighted += factor.solve(each.mean);
  }
  const Eigen::VectorXd mean = weight.llt().solve(weighted);
  double square = 0;
  for (const OwnEstimate& each : estimates) {
    square += (each.mean - mean).dot(each.covariance.llt().solve(each.mean - mean));
  }
  const auto freedom = static_cast<double>(n) * static_cast<double>(estimates.size() - 1);
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(freedom), std::max(square, 0.0)));
}

/// "fin_gain is scale 0.2 +- 0.01 in a.cap and scale 0.0 +- 0.01 in b.cap".
std::string difference_text(std::string_view effect, const std::vector<RecordingFinding>& recordings) {
  std::vector<std::string> parts;
  for (const RecordingFinding& recording : recordings) {
    for (const EffectFinding& finding : recording.effects) {
      if (finding.words() != effect) continue;
      std::vector<std::string> values;
      for (const EffectParameterEstimate& each : finding.parameters) {
        values.push_back(fmt::format("{} {:.3g} +- {:.2g}", each.name, each.value, each.std_error));
      }
      parts.push_back(fmt::format("{} in {}", fmt::join(values, ", "), recording.recording));
    }
  }
  return fmt::format("{} is not the same in all recordings: {}", effect, fmt::join(parts, "; "));
}

}  // namespace

void write_own_estimates(std::vector<EffectFinding> findings, const std::vector<OwnEstimate>& estimates,
                         Diagnosis& answer) {
  const std::string words = findings.front().words();
  const double p_value = homogeneity_p_value(estimates);
  answer.differences.push_back({findings.front().name, p_value, p_value < kSignificantBelow, findings.front().of});
  for (std::size_t k = 0; k < findings.size(); ++k) answer.recordings[k].effects.push_back(std::move(findings[k]));
  if (p_value < kSignificantBelow) answer.remarks.push_back(difference_text(words, answer.recordings));
}

std::vector<Eigen::Index> rows_of_recordings(const DiagnosisProblem& problem) {
  std::vector<Eigen::Index> rows{
      residual_at(problem.prepared.model(problem.library, 1), problem.prepared.at).size()};
  for (const JoinedRecording& other : problem.joined) rows.push_back(other.bias_basis.rows());
  return rows;
}

void compare_recordings(const DiagnosisProblem& problem, const FoundEffects& result,
                        std::span<const std::string> names, Diagnosis& answer) {
  const Library& library = problem.library;
  const ModelFit& best = result.found.best;
  const LinearGaussianModel model{best.linear, library, result.priors};
  const auto members = parameter_indices(library, best.effects);
  // `priors` hold the error of the mean over the recordings; one recording has more.
  const Eigen::VectorXd model_error = result.priors.model_error * std::sqrt(static_cast<double>(names.size()));
  std::vector<Evidence::Posterior> posteriors;
  Eigen::Index from = 0;
  for (const Eigen::Index rows : rows_of_recordings(problem)) {
    posteriors.push_back(posterior_of_rows(best, model, from, rows, members));
    answer.recordings.push_back({names[answer.recordings.size()], {}, {}});
    from += rows;
  }
  for (const std::size_t effect : best.effects) {
    const auto own = parameter_indices(library, {effect});
    std::vector<OwnEstimate> estimates;
    std::vector<EffectFinding> findings;
    for (const Evidence::Posterior& posterior : posteriors) {
      estimates.push_back(estimate_of(posterior, own, model_error));
      findings.push_back({std::string(library[effect].name), 0, {}, {}});
      for (std::size_t i = 0; i < own.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        findings.back().parameters.push_back(
            {std::string(library.unknowns()[static_cast<std::size_t>(own[i])].name), estimates.back().mean[at],
             std::sqrt(estimates.back().covariance(at, at))});
      }
    }
    write_own_estimates(std::move(findings), estimates, answer);
  }
}

void search_apart(const DiagnosisProblem& problem, Diagnosis& answer) {
  for (std::size_t k = 0; k < answer.recordings.size(); ++k) {
    const Prepared& one = k == 0 ? problem.prepared : *problem.others[k - 1];
    const FoundEffects alone =
        find_effects({one, problem.library, problem.request, problem.progress, problem.threads});
    RecordingFinding& finding = answer.recordings[k];
    const Candidate& best = alone.found.candidates.front();
    RecordingFinding::Alone shown;
    shown.probability = best.probability;
    for (const std::size_t effect : best.effects) shown.effects.emplace_back(problem.library[effect].name);
    finding.alone = std::move(shown);
  }
  write_alone(answer);
}

void write_alone(Diagnosis& answer) {
  const auto effects_of = [](const RecordingFinding& finding) {
    const auto& effects = finding.alone->effects;
    return effects.empty() ? "no effect" : fmt::format("{}", fmt::join(effects, " and "));
  };
  bool are_alike = true;
  std::vector<std::string> parts;
  for (const RecordingFinding& finding : answer.recordings) {
    answer.remarks.push_back(fmt::format("{} alone: {} (probability {:.2f})", finding.recording,
                                         effects_of(finding), finding.alone->probability));
    parts.push_back(fmt::format("{} {}", finding.recording, effects_of(finding)));
    are_alike = are_alike && finding.alone->effects == answer.recordings.front().alone->effects;
  }
  if (are_alike || answer.verdict != Verdict::unknown || answer.kind == UnknownKind::ambiguous) return;
  answer.sentence = fmt::format("No effects explain all recordings together. By themselves they show: {}.",
                                fmt::join(parts, "; "));
}

}  // namespace navcal::gap
