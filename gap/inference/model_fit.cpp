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

/// Estimate of the subset, within the bounds of its parameters; non-members are at zero.
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

/// Priors that hold at zero each parameter which cannot be negative and whose estimate would be.
Priors possible_priors(const LinearGaussianModel& model, const std::vector<Eigen::Index>& members) {
  constexpr int kRounds = 4;
  Priors allowed = model.priors;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::VectorXd mean = mean_by(by_membership(allowed, members), model.linear);
    bool possible = true;
    for (Eigen::Index j = Library::kBiases; j < mean.size(); ++j) {
      if (model.library.unknowns()[static_cast<std::size_t>(j)].least < 0 || mean[j] >= 0) continue;
      if (allowed.slab[j] < model.priors.slab[j]) continue;
      allowed.spike[j] = allowed.slab[j] = kAbsentPrior * model.priors.spike[j];
      possible = false;
    }
    if (possible) break;
  }
  return allowed;
}

/// Half the squared residuals and half the squared deviations from the prior, nats.
double cost_of(const Eigen::VectorXd& residual, const Eigen::VectorXd& at, const Eigen::VectorXd& prior) {
  return 0.5 * (residual.squaredNorm() + at.cwiseQuotient(prior).squaredNorm());
}

/// Estimate of a subset while it is simulated until the linear model holds.
struct Settling {
  Linearised linear;         ///< its residual is that of the last estimate accepted
  Eigen::VectorXd mean;      ///< by the linear model
  Eigen::VectorXd left;      ///< residual of the linear model at the mean
  double beyond_linear = 0;  ///< gain of the simulation over the linear model, nats
  bool refused = false;      ///< simulation is worse than at the start of the step
};

/// One step: simulates at the mean, and half way to it if that is worse. Returns whether another step is
/// wanted.
bool settle_once(Settling& now, const InferenceProblem& problem, const std::vector<Eigen::Index>& members) {
  const Eigen::VectorXd prior = by_membership(problem.priors, members);
  Linearised& linear = now.linear;
  now.mean = mean_by(by_membership(possible_priors(problem.about(linear), members), members), linear);
  now.left = linear.residual - linear.design * (now.mean - linear.at);
  Eigen::VectorXd next = now.mean, simulated = residual_at(problem.model, next);
  now.beyond_linear = 0.5 * (now.left.squaredNorm() - simulated.squaredNorm());
  if (std::abs(now.beyond_linear) < kSettled_nats) return false;
  const double here = cost_of(linear.residual, linear.at, prior);
  const auto is_better = [&] { return cost_of(simulated, next, prior) < here - kSettled_nats; };
  for (int half = 0; half < kHalvings && !is_better(); ++half) {
    next = (linear.at + next) / 2;
    simulated = residual_at(problem.model, next);
  }
  if (!is_better()) {
    // The linear model predicts a gain that simulation does not confirm: the start of the last step is the best
    // point that was simulated.
    now.beyond_linear = cost_of(now.left, now.mean, prior) - here;
    now.refused = true;
    return false;
  }
  linear.at = next;
  linear.residual = simulated;
  linear.score = linear.design.transpose() * simulated;
  now.beyond_linear = 0;
  return true;
}

}  // namespace

Priors as_nuisance_parameters(Priors priors, const Library& library, const EffectSubset& effects) {
  for (const Eigen::Index j : parameter_indices(library, effects))
    priors.spike[j] = kNuisancePrior * priors.slab[j];
  return priors;
}

Priors without_members(Priors priors, const Library& library, const EffectSubset& effects) {
  for (const Eigen::Index j : parameter_indices(library, effects)) priors.spike[j] *= kAbsentPrior;
  return priors;
}

Evidence::Posterior bounded_posterior(const LinearGaussianModel& model, const std::vector<Eigen::Index>& members) {
  return evidence_of(model.linear, possible_priors(model, members)).posterior(members);
}

double bound_penalty_nats(const EffectSubset& set, const LinearGaussianModel& model) {
  const Linearised& linear = model.linear;
  const auto members = parameter_indices(model.library, set);
  const Eigen::VectorXd prior = by_membership(model.priors, members);
  const auto cost = [&](const Eigen::VectorXd& values) {
    const Eigen::VectorXd step = values - linear.at;
    return 0.5 * step.dot(linear.gram * step) - linear.score.dot(step) +
           0.5 * values.cwiseQuotient(prior).squaredNorm();
  };
  const Priors possible = possible_priors(model, members);
  return cost(mean_by(by_membership(possible, members), linear)) - cost(mean_by(prior, linear));
}

ModelFit refine(const EffectSubset& set, Linearised linear, const InferenceProblem& problem) {
  ModelFit result;
  result.effects = set;
  result.about = linear.at;
  const auto members = parameter_indices(problem.model.library, set);
  Settling now{std::move(linear), {}, {}};
  for (int i = 0; i < kSettlings && settle_once(now, problem, members); ++i) {
  }
  result.linear = std::move(now.linear);
  result.beyond_linear = now.beyond_linear;
  const LinearGaussianModel model = problem.about(result.linear);
  const auto posterior = bounded_posterior(model, members);
  result.mean = now.refused ? result.linear.at : posterior.mean;
  result.log_odds = SubsetEvidence(model)(set) - bound_penalty_nats(set, model) + result.beyond_linear;
  const double noise = std::max(1.0, now.left.squaredNorm() / static_cast<double>(Whitening::count(now.left)));
  // An effect's estimate has the relative error of the vehicle model that it acts on: the tolerance.
  const Eigen::VectorXd tolerance = kTolerance * result.mean;
  result.std =
      (noise * posterior.covariance.diagonal() + problem.priors.model_error.cwiseAbs2() + tolerance.cwiseAbs2())
          .cwiseSqrt();
  return result;
}

ModelFit fit_model(const EffectSubset& set, const InferenceProblem& problem) {
  return fit_model(set, problem, problem.nominal);
}

ModelFit fit_model(const EffectSubset& set, const InferenceProblem& problem, Linearised start) {
  const Library& library = problem.model.library;
  Linearised linear = std::move(start);
  const auto members = parameter_indices(library, set);
  std::vector<Eigen::Index> moved(Library::kBiases);
  std::iota(moved.begin(), moved.end(), Eigen::Index{0});
  moved.insert(moved.end(), members.begin(), members.end());
  const bool curved = std::ranges::any_of(set, [&](std::size_t e) { return library.is_curved(e); });
  Eigen::VectorXd best_at;
  double best = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < (curved ? kCurvedLinearisations : kLinearisations); ++i) {
    const auto posterior = bounded_posterior(problem.about(linear), members);
    const Eigen::VectorXd at = place_of(posterior, library, moved);
    const Eigen::VectorXd step = (at - linear.at).cwiseAbs();
    const auto has_arrived = [&](Eigen::Index j) {
      return step[j] <= kArrived_sigma * std::sqrt(posterior.covariance(j, j));
    };
    if (i >= kLinearisations && std::ranges::all_of(moved, has_arrived)) break;
    linear = relinearise(problem.model, std::move(linear), at, members);
    if (!curved) continue;
    const double here = SubsetEvidence(problem.about(linear))(set);
    if (here > best) {
      best = here;
      best_at = at;
    } else if (here < best - kStepBack_nats) {
      linear = relinearise(problem.model, std::move(linear), best_at, members);
      break;
    }
  }
  return refine(set, std::move(linear), problem);
}

}  // namespace navcal::gap
