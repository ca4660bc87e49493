// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/find_effects.h"

#include <algorithm>
#include <utility>

#include "gap/nulls/null_bayes_factors.h"
#include "gap/thresholds.h"
#include "gap/verdict/where.h"

namespace navcal::gap {
namespace {

/// Simulated vehicles with the backlash, or without the gap, that was found: enough for a floor, few enough to
/// wait for.
constexpr int kBacklashMissions = 16;

SearchResult search_by(const Priors& priors, const Problem& problem, const Linearised& nominal) {
  return search(*problem.prepared.replay, problem.library, problem.prepared.bank.whitening, nominal, priors,
                problem.threads, [&](double done) { problem.progress("searching", done); });
}

/// A search, and a second one with wider priors when the first found backlash.
FoundEffects search_with_backlash(const Problem& problem, const Linearised& nominal) {
  const Priors priors =
      fit_spike_widths(problem.library, problem.prepared.bank.gram, problem.prepared.bank.scores);
  FoundEffects result{search_by(priors, problem, nominal), priors, {}, {}, {}};
  if (!has_play(problem.library, result.found.best.effects)) return result;
  problem.progress("vehicles with such a play", 0);
  BacklashNullBank twins =
      backlash_null_bank(*problem.prepared.replay, problem.prepared.course, problem.request.vehicle,
                         problem.library, problem.prepared.bank.whitening, result.found.best,
                         {kBacklashMissions, problem.request.bank_seed, problem.threads});
  if (twins.missions <= kBacklashMissions / 2) return result;
  // Once more: beside a play, others are recruited for what it leaves.
  const Priors wider = with_twins(priors, problem.library, result.found.best, twins);
  if (SearchResult again = search_by(wider, problem, nominal); has_play(problem.library, again.best.effects)) {
    result.found = std::move(again);
    result.priors = wider;
  }
  result.backlash_bank = std::move(twins);
  return result;
}

/// Whether a cell of the residual map is significant against the null bank.
bool is_seen(const Problem& problem) {
  const Innovations nominal = problem.prepared.replay->run(problem.library.model(problem.prepared.at));
  const auto map =
      residual_map(explained_rms(nominal, problem.prepared.course, problem.prepared.mission.fix_times_s()),
                   problem.prepared.bank.explained_rms);
  return !significant_cells(map).empty();
}

/// Whether simulated vehicles without a gap would show the effects found as well: null Bayes factors.
bool is_chance(const Problem& problem, const Linearised& nominal, const FoundEffects& searched) {
  const ModelFit& best = searched.found.best;
  if (best.effects.empty() || best.log_odds > kBeyondNulls_nats || is_seen(problem)) return false;
  problem.progress("vehicles without a gap", 0);
  // As nulls are looked at: signatures taken anew at an estimate far off gain some nats that nothing is behind.
  const bool curved = std::any_of(best.effects.begin(), best.effects.end(),
                                  [&](std::size_t effect) { return problem.library.is_curved(effect); });
  const double gain =
      curved ? best.log_odds : gain_over_none(best.effects, nominal, problem.library, searched.priors);
  return !stands_out(
      gain, null_bayes_factors(best.effects, *problem.prepared.replay, problem.prepared.course,
                               problem.request.vehicle, problem.library, problem.prepared.bank.whitening, nominal,
                               searched.priors, {kBacklashMissions, problem.request.bank_seed, problem.threads}));
}

}  // namespace

FoundEffects find_effects(const Problem& problem) {
  problem.progress("linearising", 0);
  const Linearised nominal = linearise(*problem.prepared.replay, problem.library, problem.prepared.bank.whitening,
                                       problem.prepared.at, problem.threads);
  FoundEffects result = search_with_backlash(problem, nominal);
  if (is_chance(problem, nominal, result)) {
    result.by_chance = result.found.best.effects;
    result.found = nothing_found(*problem.prepared.replay, problem.library, problem.prepared.bank.whitening,
                                 nominal, result.priors, problem.threads);
    result.backlash_bank.reset();
    return result;
  }
  // What this mission could not show may be there unnoticed, and takes what is not its own: it cannot be named,
  // but is allowed for, and the others are asked again. Twins of another play are not made.
  const EffectSubset hidden = unobservable_effects(result.found);
  if (hidden.empty()) return result;
  FoundEffects again{
      {}, as_nuisance_parameters(result.priors, problem.library, hidden), result.backlash_bank, hidden, {}};
  again.found = search_by(again.priors, problem, nominal);
  const bool can_be_told = !again.found.best.effects.empty() && unobservable_effects(again.found).empty() &&
                           has_play(problem.library, again.found.best.effects) == result.backlash_bank.has_value();
  return can_be_told && !is_chance(problem, nominal, again) ? again : result;
}

}  // namespace navcal::gap
