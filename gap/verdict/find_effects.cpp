// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/find_effects.h"

#include <algorithm>
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

/// Priors by the null bank. Where an instrument is silent, what the others hardly show may be there unnoticed.
Priors priors_of(const DiagnosisProblem& problem, const Linearised& nominal) {
  const Library& library = problem.library;
  const NullBank& bank = problem.prepared.bank;
  Priors priors = fit_spike_widths(library, bank.gram, bank.scores);
  if (problem.prepared.mission.silences.empty()) return priors;
  const EffectSubset hidden = hardly_shown_effects(library, nominal.gram, priors);
  priors = as_nuisance_parameters(std::move(priors), library, hidden);
  priors.not_judged = hidden;
  return priors;
}

/// Searches, and searches again with wider priors when backlash was found.
FoundEffects search_with_backlash(const DiagnosisProblem& problem, const Linearised& nominal) {
  const Library& library = problem.library;
  const Priors priors = priors_of(problem, nominal);
  FoundEffects result{search_by(priors, problem, nominal), priors, {}, {}, {}};
  if (!has_backlash(library, result.found.best.effects)) return result;
  problem.progress("null missions with backlash", 0);
  BacklashNullBank bank =
      backlash_null_bank(result.found.best, problem.repeated(), problem.prepared.model(library, problem.threads),
                         {kBacklashMissions, problem.request.bank_seed, problem.threads});
  if (bank.missions <= kBacklashMissions / 2) return result;
  // Searches again: beside a backlash, other effects are recruited for its residuals.
  const Priors wider = widened(priors, library, result.found.best, bank);
  if (SearchResult again = search_by(wider, problem, nominal); has_backlash(library, again.best.effects)) {
    result.found = std::move(again);
    result.priors = wider;
  }
  result.backlash_bank = std::move(bank);
  return result;
}

/// Whether a cell of the residual map is significant against the null bank.
bool is_seen(const DiagnosisProblem& problem) {
  const Innovations nominal = problem.prepared.replay->run(problem.library.model(problem.prepared.at));
  const auto map =
      residual_map(explained_rms(nominal, problem.prepared.course, problem.prepared.mission.fix_times_s()),
                   problem.prepared.bank.explained_rms);
  return !significant_cells(map).empty();
}

/// Whether simulated vehicles without a gap would show the effects found as well: null Bayes factors.
bool is_chance(const DiagnosisProblem& problem, const Linearised& nominal, const FoundEffects& searched) {
  const ModelFit& best = searched.found.best;
  if (best.effects.empty() || best.log_odds > kBeyondNulls_nats || is_seen(problem)) return false;
  problem.progress("null missions to compare the evidence with", 0);
  // Linearising again far from the nominal inflates the evidence: the nominal Jacobian, by which the nulls are
  // scored, scores the recording, too.
  const InferenceProblem inference = problem.inference(nominal, searched.priors);
  const bool curved = std::any_of(best.effects.begin(), best.effects.end(),
                                  [&](std::size_t effect) { return problem.library.is_curved(effect); });
  const double gain = curved ? best.log_odds : gain_over_none(best.effects, inference.about(nominal));
  return !stands_out(gain, null_bayes_factors(best.effects, problem.repeated(), inference,
                                              {kBacklashMissions, problem.request.bank_seed, problem.threads}));
}

}  // namespace

InferenceProblem DiagnosisProblem::inference(const Linearised& nominal, const Priors& priors) const {
  return {prepared.model(library, threads), nominal, priors,
          [report = &progress](double done) { (*report)("searching", done); }};
}

FoundEffects find_effects(const DiagnosisProblem& problem) {
  problem.progress("linearising", 0);
  const Library& library = problem.library;
  const Linearised nominal = linearise(problem.prepared.model(library, problem.threads), problem.prepared.at);
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
  FoundEffects again{{}, as_nuisance_parameters(result.priors, library, hidden), result.backlash_bank, hidden, {}};
  again.found = search_by(again.priors, problem, nominal);
  const bool can_be_told = !again.found.best.effects.empty() && unobservable_effects(again.found).empty() &&
                           has_backlash(library, again.found.best.effects) == result.backlash_bank.has_value();
  return can_be_told && !is_chance(problem, nominal, again) ? again : result;
}

}  // namespace navcal::gap
