// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/model_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "gap/inference/subset_evidence.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

constexpr int kIterations = 2, kCurvedIterations = 5;
/// An estimate that moves by less, in standard errors, has arrived.
constexpr double kArrived = 0.2;
/// A step by which a set loses so much evidence led along a line that bends, and is taken back.
constexpr double kWorse_nats = 1;
/// An estimate is simulated anew, its signatures as they are, until straight lines say what is left to less than
/// this; strong data make tolerances, which no signature was taken about, what they are.
constexpr int kSettlings = 4;
/// A step that leads beyond where straight lines hold is taken half way, and half of that.
constexpr int kHalvings = 2;
constexpr double kSettled_nats = 1;
/// Prior of what is to be zero, against what tolerance allows it.
constexpr double kNothing = 1e-6;

/// Where the set's own estimate says the vehicle is, in the bounds of its parameters; non-members are at zero.
Eigen::VectorXd place_of(const Evidence::Posterior& posterior, const Library& library,
                         const std::vector<Eigen::Index>& moved) {
  Eigen::VectorXd at = Eigen::VectorXd::Zero(posterior.mean.size());
  for (const Eigen::Index j : moved) {
    const Unknown& unknown = library.unknowns()[static_cast<std::size_t>(j)];
    at[j] = std::clamp(posterior.mean[j], unknown.least, unknown.greatest);
  }
  return at;
}

Eigen::VectorXd by_membership(const Priors& priors, const std::vector<Eigen::Index>& members) {
  Eigen::VectorXd prior = priors.spike;
  for (const Eigen::Index j : members) prior[j] = priors.slab[j];
  return prior;
}

Eigen::VectorXd mean_by(const Eigen::VectorXd& prior, const Linearised& linear) {
  return posterior_mean(linear.gram, linear.score + linear.gram * linear.at, prior);
}

/// Priors by which what cannot be negative, and would be, is nothing.
Priors possible_priors(const Linearised& linear, const Library& library, const Priors& priors,
                       const std::vector<Eigen::Index>& members) {
  constexpr int kRounds = 4;
  Priors allowed = priors;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::VectorXd mean = mean_by(by_membership(allowed, members), linear);
    bool possible = true;
    for (Eigen::Index j = Library::kBiases; j < mean.size(); ++j) {
      if (library.unknowns()[static_cast<std::size_t>(j)].least < 0 || mean[j] >= 0) continue;
      if (allowed.slab[j] < priors.slab[j]) continue;
      allowed.spike[j] = allowed.slab[j] = kNothing * priors.spike[j];
      possible = false;
    }
    if (possible) break;
  }
  return allowed;
}

}  // namespace

Priors as_nuisance_parameters(Priors priors, const Library& library, const EffectSubset& effects) {
  for (const Eigen::Index j : parameter_indices(library, effects))
    priors.spike[j] = kNuisancePrior * priors.slab[j];
  return priors;
}

Priors without_members(Priors priors, const Library& library, const EffectSubset& effects) {
  for (const Eigen::Index j : parameter_indices(library, effects)) priors.spike[j] *= kNothing;
  return priors;
}

Evidence::Posterior bounded_posterior(const Linearised& linear, const Library& library, const Priors& priors,
                                      const std::vector<Eigen::Index>& members) {
  return evidence_of(linear, possible_priors(linear, library, priors, members)).posterior(members);
}

double bound_penalty_nats(const EffectSubset& set, const Linearised& linear, const Library& library,
                          const Priors& priors) {
  const auto members = parameter_indices(library, set);
  const Eigen::VectorXd prior = by_membership(priors, members);
  const auto cost = [&](const Eigen::VectorXd& values) {
    const Eigen::VectorXd step = values - linear.at;
    return 0.5 * step.dot(linear.gram * step) - linear.score.dot(step) +
           0.5 * values.cwiseQuotient(prior).squaredNorm();
  };
  const Priors possible = possible_priors(linear, library, priors, members);
  return cost(mean_by(by_membership(possible, members), linear)) - cost(mean_by(prior, linear));
}

ModelFit refine(const EffectSubset& set, Linearised linear, const Replay& replay, const Library& library,
                const Whitening& whitening, const Priors& priors) {
  ModelFit result;
  result.effects = set;
  result.about = linear.at;
  const auto members = parameter_indices(library, set);
  const Eigen::VectorXd prior = by_membership(priors, members);
  const auto cost = [&](const Eigen::VectorXd& residual, const Eigen::VectorXd& at) {
    return 0.5 * (residual.squaredNorm() + at.cwiseQuotient(prior).squaredNorm());
  };
  result.linear = std::move(linear);
  Eigen::VectorXd left;
  bool refused = false;
  for (int i = 0; i < kSettlings; ++i) {
    result.mean =
        mean_by(by_membership(possible_priors(result.linear, library, priors, members), members), result.linear);
    left = result.linear.residual - result.linear.design * (result.mean - result.linear.at);
    Eigen::VectorXd next = result.mean, simulated = residual_at(replay, library, whitening, next);
    result.beyond_linear = 0.5 * (left.squaredNorm() - simulated.squaredNorm());
    if (std::abs(result.beyond_linear) < kSettled_nats) break;
    const double here = cost(result.linear.residual, result.linear.at);
    for (int half = 0; half < kHalvings && !(cost(simulated, next) < here - kSettled_nats); ++half) {
      next = (result.linear.at + next) / 2;
      simulated = residual_at(replay, library, whitening, next);
    }
    if (!(cost(simulated, next) < here - kSettled_nats)) {
      // Straight lines promise what is not there: where the last step began is the best that was simulated.
      result.beyond_linear = cost(left, result.mean) - here;
      refused = true;
      break;
    }
    result.linear.at = next;
    result.linear.residual = simulated;
    result.linear.score = result.linear.design.transpose() * simulated;
    result.beyond_linear = 0;
  }
  const auto posterior = bounded_posterior(result.linear, library, priors, members);
  result.mean = refused ? result.linear.at : posterior.mean;
  result.log_odds = SubsetEvidence(result.linear, library, priors)(set) -
                    bound_penalty_nats(set, result.linear, library, priors) + result.beyond_linear;
  const double noise = std::max(1.0, left.squaredNorm() / static_cast<double>(Whitening::count(left)));
  // What an effect does is as much off as the vehicle that it acts on.
  const Eigen::VectorXd tolerance = kTolerance * result.mean;
  result.std = (noise * posterior.covariance.diagonal() + priors.model_error.cwiseAbs2() + tolerance.cwiseAbs2())
                   .cwiseSqrt();
  return result;
}

ModelFit fit_model(const EffectSubset& set, const Replay& replay, const Library& library,
                   const Whitening& whitening, Linearised start, const Priors& priors, unsigned threads) {
  Linearised linear = std::move(start);
  const auto members = parameter_indices(library, set);
  std::vector<Eigen::Index> moved(Library::kBiases);
  std::iota(moved.begin(), moved.end(), Eigen::Index{0});
  moved.insert(moved.end(), members.begin(), members.end());
  const bool curved = std::any_of(set.begin(), set.end(), [&](std::size_t e) { return library.is_curved(e); });
  Eigen::VectorXd best_at;
  double best = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < (curved ? kCurvedIterations : kIterations); ++i) {
    const auto posterior = bounded_posterior(linear, library, priors, members);
    const Eigen::VectorXd at = place_of(posterior, library, moved);
    const Eigen::VectorXd step = (at - linear.at).cwiseAbs();
    const auto has_arrived = [&](Eigen::Index j) {
      return step[j] <= kArrived * std::sqrt(posterior.covariance(j, j));
    };
    if (i >= kIterations && std::all_of(moved.begin(), moved.end(), has_arrived)) break;
    linear = relinearise(replay, library, whitening, std::move(linear), at, members, threads);
    if (!curved) continue;
    const double here = SubsetEvidence(linear, library, priors)(set);
    if (here > best) {
      best = here;
      best_at = at;
    } else if (here < best - kWorse_nats) {
      linear = relinearise(replay, library, whitening, std::move(linear), best_at, members, threads);
      break;
    }
  }
  return refine(set, std::move(linear), replay, library, whitening, priors);
}

}  // namespace navcal::gap
