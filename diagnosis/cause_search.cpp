// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/cause_search.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "diagnosis/limits.h"

namespace navcal::diagnosis {
namespace {

std::vector<Eigen::Index> columns_of(const CauseLibrary& library, const CauseSet& set) {
  std::vector<Eigen::Index> all;
  for (const std::size_t cause : set) {
    for (const Eigen::Index column : library.causes[cause].columns()) all.push_back(column);
  }
  return all;
}

double log_mean_exp(const std::vector<double>& values) {
  const double most = *std::max_element(values.begin(), values.end());
  double sum = 0;
  for (const double value : values) sum += std::exp(value - most);
  return most + std::log(sum / static_cast<double>(values.size()));
}

/// log(2 Phi(z)): what the evidence gains when a prior of both signs becomes one of positive values (a lag, a dead
/// band).
double log_share_above_zero(double z) {
  if (z > -8) return std::log(std::erfc(-z / std::numbers::sqrt2));
  // Mills' ratio, where erfc loses its digits.
  return -0.5 * z * z - std::log(-z * std::sqrt(std::numbers::pi / 2));
}

CauseSet with(CauseSet set, std::size_t cause) {
  set.insert(std::upper_bound(set.begin(), set.end(), cause), cause);
  return set;
}

/// Scores of sets, and the fits of those that were fitted at their own estimate.
class Scores {
 public:
  /// A set that was fitted keeps the score of its own fit.
  void set(const CauseSet& causes, double log_odds, bool is_own = false) {
    if (is_own) own_.insert(causes);
    if (is_own || !own_.contains(causes)) scores_[causes] = log_odds;
  }
  [[nodiscard]] bool is_fitted(const CauseSet& causes) const { return own_.contains(causes); }
  [[nodiscard]] std::vector<ScoredSet> ranked() const {
    std::vector<ScoredSet> all;
    for (const auto& [causes, log_odds] : scores_) all.push_back({causes, log_odds, 0});
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.log_odds > b.log_odds; });
    double sum = 0;
    for (const ScoredSet& one : all) sum += std::exp(one.log_odds - all.front().log_odds);
    for (ScoredSet& one : all) one.probability = std::exp(one.log_odds - all.front().log_odds) / sum;
    return all;
  }

 private:
  std::map<CauseSet, double> scores_;
  std::set<CauseSet> own_;
};

/// Priors with which a set is fitted at its own estimate.
std::vector<ParameterPrior> priors_for(const CauseLibrary& library, const ColumnPriors& priors,
                                       const CauseSet& set, const Eigen::VectorXd& estimate) {
  std::vector<ParameterPrior> all;
  for (const std::size_t cause : set) {
    for (const CauseParameter& parameter : library.causes[cause].parameters) {
      // The estimate enters as the point to begin at; the prior about it is wide.
      const double begin = std::clamp(estimate[parameter.column], parameter.low * parameter.per_unit,
                                      parameter.high * parameter.per_unit);
      all.push_back({parameter.column, begin, kMemberStrengths.back() * priors.typical[parameter.column]});
    }
  }
  return all;
}

}  // namespace

SetEvidence::SetEvidence(const LinearRecording& linear, const CauseLibrary& library, const ColumnPriors& priors)
    : library_(library), priors_(priors),
      evidence_(linear.gram, linear.score, priors.spike,
                (kMemberStrengths.back() * priors.typical).cwiseMax(priors.spike)),
      base_(evidence_.base() - 0.5 * linear.power) {}

double SetEvidence::log_prior(std::size_t size) const {
  double log_prior = 0;
  for (std::size_t i = 0; i < size; ++i) {
    log_prior -= i == 0 ? kComplexityPenalty_nats : kComplexityPenaltyPerFurtherEffect_nats;
    log_prior -= std::log(static_cast<double>(library_.causes.size() - i) / static_cast<double>(i + 1));
  }
  return log_prior;
}

double SetEvidence::operator()(const CauseSet& set) const {
  if (set.empty()) return base_;
  const std::vector<Eigen::Index> members = columns_of(library_, set);
  const Eigen::VectorXd spike = priors_.spike(members), typical = priors_.typical(members);
  std::vector<double> gains;
  for (const double strength : kMemberStrengths) {
    const Eigen::VectorXd slab = (strength * typical).cwiseMax(spike);
    gains.push_back(evidence_.gain(members, slab) + gain_of_signs(set, members, slab));
  }
  return base_ + log_mean_exp(gains) + log_prior(set.size());
}

/// What the evidence gains because some of the members cannot be negative, nats.
double SetEvidence::gain_of_signs(const CauseSet& set, const std::vector<Eigen::Index>& members,
                                  const Eigen::VectorXd& slab) const {
  std::vector<bool> one_sided;
  for (const std::size_t cause : set) {
    for (const CauseParameter& parameter : library_.causes[cause].parameters)
      one_sided.push_back(parameter.low == 0);
  }
  if (std::none_of(one_sided.begin(), one_sided.end(), [](bool is) { return is; })) return 0;
  // Posterior of the members with the wide prior, from that with the narrow one.
  const gap::Evidence::Posterior& narrow = evidence_.base_posterior();
  const Eigen::MatrixXd covariance = narrow.covariance(members, members);
  const Eigen::VectorXd more = slab.cwiseAbs2().cwiseInverse() - priors_.spike(members).cwiseAbs2().cwiseInverse();
  Eigen::MatrixXd changed = covariance * more.asDiagonal();
  changed.diagonal().array() += 1;
  const Eigen::PartialPivLU<Eigen::MatrixXd> factor(changed);
  const Eigen::MatrixXd wide_covariance = factor.solve(covariance);
  const Eigen::VectorXd wide_mean = factor.solve(narrow.mean(members));
  double gain = 0;
  for (Eigen::Index i = 0; i < wide_mean.size(); ++i) {
    if (one_sided[static_cast<std::size_t>(i)])
      gain += log_share_above_zero(wide_mean[i] / std::sqrt(std::max(wide_covariance(i, i), 1e-300)));
  }
  return gain;
}

SetEvidence::Posterior SetEvidence::posterior(const CauseSet& set) const {
  const gap::Evidence::Posterior posterior = evidence_.posterior(columns_of(library_, set));
  return {posterior.mean, posterior.covariance.diagonal().cwiseSqrt()};
}

double SetEvidence::separation(std::size_t cause, const CauseSet& others) const {
  const std::vector<Eigen::Index> members = library_.causes[cause].columns();
  const Eigen::VectorXd values = priors_.typical / std::sqrt(static_cast<double>(members.size()));
  return evidence_.separation(members, values, columns_of(library_, others));
}

CauseSearchResult search_causes(const FittedRecording& recording, const RecordingFit& nominal,
                                const CauseLibrary& library, const ColumnPriors& priors,
                                const Progress& progress) {
  Scores scores;
  std::map<CauseSet, RecordingFit> fits;
  const SetEvidence about_nominal(nominal.linear, library, priors);
  scores.set({}, about_nominal({}), true);
  for (std::size_t i = 0; i < library.causes.size(); ++i) {
    scores.set({i}, about_nominal({i}));
    for (std::size_t j = i + 1; j < library.causes.size(); ++j) scores.set({i, j}, about_nominal({i, j}));
  }
  constexpr double kImpossible_nats = 1e6;
  const auto fit_again = [&](const CauseSet& set, const RecordingFit& from, const SetEvidence& evidence) {
    RecordingFit fit;
    try {
      fit = recording.fit(priors_for(library, priors, set, evidence.posterior(set).mean), &from, [](double) {});
    } catch (const identify::UnboundedReplay&) {
      // With these effects the vehicle could not have moved as it did.
      scores.set(set, about_nominal({}) - kImpossible_nats, true);
      return;
    }
    const SetEvidence here(fit.linear, library, priors);
    scores.set(set, here(set), true);
    if (set.size() < kMostEffects) {
      for (std::size_t i = 0; i < library.causes.size(); ++i) {
        if (!std::binary_search(set.begin(), set.end(), i)) scores.set(with(set, i), here(with(set, i)));
      }
    }
    fits.insert_or_assign(set, std::move(fit));
  };
  // Leaders of each size at their own estimate, while they are not far behind the best.
  constexpr double kHopeless_nats = 40;
  for (std::size_t size = 1; size <= kMostEffects; ++size) {
    for (std::size_t done = 0; done < kRefitted; ++done) {
      progress((static_cast<double>(size - 1) + static_cast<double>(done) / kRefitted) / kMostEffects);
      const auto ranked = scores.ranked();
      const auto next = std::find_if(ranked.begin(), ranked.end(), [&](const ScoredSet& one) {
        return one.causes.size() == size && !scores.is_fitted(one.causes);
      });
      if (next == ranked.end() || (size > 1 && next->log_odds < ranked.front().log_odds - kHopeless_nats)) break;
      // From the fit of the set without one of its members, where there is one.
      const RecordingFit* from = &nominal;
      for (std::size_t left = 0; left < next->causes.size(); ++left) {
        CauseSet smaller = next->causes;
        smaller.erase(smaller.begin() + static_cast<std::ptrdiff_t>(left));
        if (const auto found = fits.find(smaller); found != fits.end()) from = &found->second;
      }
      fit_again(next->causes, *from, SetEvidence(from->linear, library, priors));
    }
  }
  // The best set is judged by its own fit.
  for (int i = 0; i < static_cast<int>(kRefitted); ++i) {
    const CauseSet best = scores.ranked().front().causes;
    if (scores.is_fitted(best)) break;
    fit_again(best, nominal, about_nominal);
  }
  CauseSearchResult result;
  result.sets = scores.ranked();
  const CauseSet& best = result.sets.front().causes;
  result.best = best.empty() || !fits.contains(best) ? nominal : fits.at(best);
  const SetEvidence evidence(result.best.linear, library, priors);
  const auto posterior = evidence.posterior(best);
  result.mean = posterior.mean;
  result.std = posterior.std;
  return result;
}

}  // namespace navcal::diagnosis
