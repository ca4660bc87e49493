// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/find_effects.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gap/inference/subset_search.h"
#include "gap/nulls/null_bayes_factors.h"
#include "gap/thresholds.h"
#include "gap/verdict/where.h"

namespace navcal::gap {
namespace {

SearchResult search_by(const Priors& priors, const DiagnosisProblem& problem, const Linearised& nominal) {
  return SubsetSearch(problem.inference(nominal, priors)).run();
}

/// Priors of several recordings together. The tolerance of a vehicle is the same in all of them. The error of the
/// model is another one in each, so that the square of its mean falls with their number.
Priors pooled(const std::vector<Priors>& priors) {
  Priors all = priors.front();
  if (priors.size() == 1) return all;
  const auto count = static_cast<double>(priors.size());
  Eigen::VectorXd square = Eigen::VectorXd::Zero(all.spike.size());
  for (const Priors& each : priors) square += each.model_error.cwiseAbs2() / (count * count);
  all.model_error = square.cwiseSqrt();
  for (Eigen::Index j = Library::kBiases; j < square.size(); ++j) {
    all.spike[j] = std::max(std::hypot(kTolerance * all.slab[j], all.model_error[j]), all.model_error[j]);
  }
  return all;
}

/// Priors by the null banks. Where an instrument is silent, what the others hardly show may be there unnoticed.
Priors priors_of(const DiagnosisProblem& problem, const Linearised& nominal) {
  const Library& library = problem.library;
  std::vector<Priors> of_recordings{
      fit_spike_widths(library, problem.prepared.bank.gram, problem.prepared.bank.scores)};
  bool is_silent = !problem.prepared.mission.silences.empty();
  for (const Prepared* other : problem.others) {
    of_recordings.push_back(fit_spike_widths(library, other->bank.gram, other->bank.scores));
    is_silent = is_silent || !other->mission.silences.empty();
  }
  Priors priors = pooled(of_recordings);
  if (!is_silent) return priors;
  const EffectSubset hidden = hardly_shown_effects(library, nominal.gram, priors);
  priors = as_nuisance_parameters(std::move(priors), library, hidden);
  priors.not_judged = hidden;
  return priors;
}

/// The fit with the part of its linear model that belongs to the first recording: nulls with backlash are made of
/// that.
ModelFit of_first(const ModelFit& fit, const DiagnosisProblem& problem) {
  if (problem.others.empty()) return fit;
  ModelFit first = fit;
  const Eigen::Index rows =
      residual_at(problem.prepared.model(problem.library, problem.threads), fit.about).size();
  first.linear.design = fit.linear.design.topRows(rows);
  first.linear.residual = fit.linear.residual.head(rows);
  first.linear.gram = first.linear.design.transpose() * first.linear.design;
  first.linear.score = first.linear.design.transpose() * first.linear.residual;
  return first;
}

/// Searches, and searches again with wider priors when backlash was found.
FoundEffects search_with_backlash(const DiagnosisProblem& problem, const Linearised& nominal) {
  const Library& library = problem.library;
  const Priors priors = priors_of(problem, nominal);
  FoundEffects result{search_by(priors, problem, nominal), priors, {}, {}, {}, {}};
  if (!has_backlash(library, result.found.best.effects)) return result;
  problem.progress("null missions with backlash", 0);
  BacklashNullBank bank = backlash_null_bank(of_first(result.found.best, problem), problem.repeated().front(),
                                             problem.prepared.model(library, problem.threads),
                                             {kBacklashMissions, problem.request.bank_seed, problem.threads});
  if (bank.missions <= kBacklashMissions / 2) return result;
  // Searches again: beside a backlash, other effects are recruited for its residuals.
  const Priors wider = widened(priors, library, of_first(result.found.best, problem), bank);
  if (SearchResult again = search_by(wider, problem, nominal); has_backlash(library, again.best.effects)) {
    result.found = std::move(again);
    result.priors = wider;
  }
  result.backlash_bank = std::move(bank);
  return result;
}

/// Whether a cell of the residual map is significant against the null bank.
bool is_seen_in(const Prepared& prepared, const Library& library) {
  const Innovations nominal = prepared.replay->run(library.model(prepared.at));
  const auto map = residual_map(explained_rms(nominal, prepared.course, prepared.mission.fix_times_s()),
                                prepared.bank.explained_rms);
  return !significant_cells(map).empty();
}

bool is_seen(const DiagnosisProblem& problem) {
  return is_seen_in(problem.prepared, problem.library) ||
         std::ranges::any_of(problem.others,
                             [&](const Prepared* other) { return is_seen_in(*other, problem.library); });
}

/// Whether simulated vehicles without a gap would show the effects found as well: null Bayes factors.
bool is_chance(const DiagnosisProblem& problem, const Linearised& nominal, const FoundEffects& searched) {
  const ModelFit& best = searched.found.best;
  if (best.effects.empty() || best.log_odds > kBeyondNulls_nats || is_seen(problem)) return false;
  problem.progress("null missions to compare the evidence with", 0);
  // Linearising again far from the nominal inflates the evidence: the nominal Jacobian, by which the nulls are
  // scored, scores the recording, too.
  const InferenceProblem inference = problem.inference(nominal, searched.priors);
  const bool curved =
      std::ranges::any_of(best.effects, [&](std::size_t effect) { return problem.library.is_curved(effect); });
  const double gain = curved ? best.log_odds : gain_over_none(best.effects, inference.about(nominal));
  return !stands_out(gain, null_bayes_factors(best.effects, problem.repeated(), inference,
                                              {kBacklashMissions, problem.request.bank_seed, problem.threads}));
}

FoundEffects searched(const DiagnosisProblem& problem, const Linearised& nominal) {
  const Library& library = problem.library;
  FoundEffects result = search_with_backlash(problem, nominal);
  if (is_chance(problem, nominal, result)) {
    result.by_chance = result.found.best.effects;
    result.found = nothing_found(problem.inference(nominal, result.priors));
    result.backlash_bank.reset();
    return result;
  }
  // An effect that this mission could not show may be there unnoticed, and absorbs what belongs to others. It
  // cannot be named, so it becomes a nuisance parameter of a second search. No second backlash null bank is made.
  const EffectSubset hidden = unobservable_effects(result.found);
  if (hidden.empty()) return result;
  FoundEffects again{{}, as_nuisance_parameters(result.priors, library, hidden), {}, result.backlash_bank, hidden,
                     {}};
  again.found = search_by(again.priors, problem, nominal);
  const bool can_be_told = !again.found.best.effects.empty() && unobservable_effects(again.found).empty() &&
                           has_backlash(library, again.found.best.effects) == result.backlash_bank.has_value();
  return can_be_told && !is_chance(problem, nominal, again) ? again : result;
}

}  // namespace

InferenceProblem DiagnosisProblem::inference(const Linearised& nominal, const Priors& priors) const {
  return {model(), nominal, priors, [report = &progress](double done) { (*report)("searching", done); }};
}

std::vector<RepeatedMission> DiagnosisProblem::repeated() const {
  std::vector<RepeatedMission> all{{*prepared.replay, prepared.course, request.vehicle}};
  for (const Prepared* other : others) all.push_back({*other->replay, other->course, request.vehicle});
  return all;
}

FoundEffects find_effects(const DiagnosisProblem& problem) {
  problem.progress("linearising", 0);
  Linearised nominal = linearise(problem.model(), problem.prepared.at);
  FoundEffects result = searched(problem, nominal);
  result.nominal = std::move(nominal);
  return result;
}

}  // namespace navcal::gap
