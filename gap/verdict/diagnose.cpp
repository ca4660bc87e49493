// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "base/parallel.h"
#include "gap/inference/biases.h"
#include "gap/inference/blocks.h"
#include "gap/thresholds.h"
#include "gap/verdict/answer.h"
#include "gap/verdict/find_effects.h"
#include "gap/verdict/holdout.h"
#include "gap/verdict/prepare.h"
#include "gap/verdict/recordings_apart.h"
#include "gap/verdict/request.h"
#include "gap/verdict/sources.h"
#include "gap/verdict/study.h"
#include "gap/verdict/verdict.h"
#include "gap/verdict/where.h"
#include "pipeline/pipeline.h"
#include "record/port_matching.h"

namespace navcal::gap {
namespace {

using HoldOuts = std::vector<std::unique_ptr<Prepared>>;

/// The recording and its hold-outs, compared with and without the effects found.
struct Comparisons {
  Comparison here;
  std::vector<Comparison> others;  ///< of the recordings that are diagnosed together with the first one
  std::vector<Comparison> holdouts;
  std::vector<HeldOutPrediction> predictions;  ///< of the hold-outs; empty when no effect was found
};

/// Residuals with all that was found in the model, the small parameters included.
Innovations rest_of(const Replay& replay, const Library& library, const ModelFit& best) {
  Innovations rest = replay.run(library.model(best.mean));
  // Rolling comes from the small sum of three fins' angles, and its gyro shows each reversal of a servo between
  // two reports. The missions of the backlash null bank are steered by the reports and contain no such
  // reversals.
  if (has_backlash(library, best.effects)) rest.grid.col(gyro_roll).setZero();
  return rest;
}

/// Maps of several recordings as one: of each cell the entry with the smallest p-value, which then holds over all
/// of the recordings (Bonferroni). The order is that of the ranks in the single maps.
std::vector<WhereEntry> merged(std::vector<std::vector<WhereEntry>> maps) {
  if (maps.size() == 1) return std::move(maps.front());
  std::size_t longest = 0;
  for (auto& map : maps) {
    longest = std::max(longest, map.size());
    for (WhereEntry& entry : map) entry.p_value = std::min(1.0, entry.p_value * static_cast<double>(maps.size()));
  }
  std::vector<WhereEntry> all;
  for (std::size_t rank = 0; rank < longest; ++rank) {
    for (const auto& map : maps) {
      if (rank >= map.size()) continue;
      const auto same = std::ranges::find_if(all, [&](const WhereEntry& other) {
        return other.channel == map[rank].channel && other.regime == map[rank].regime;
      });
      if (same == all.end()) {
        all.push_back(map[rank]);
      } else if (map[rank].p_value < same->p_value) {
        *same = map[rank];
      }
    }
  }
  return all;
}

/// Significant cells of the other recordings with all that was found in the model. Beside a backlash only the
/// first recording is judged, because the nulls with backlash repeat that one.
std::vector<std::vector<WhereEntry>> leftover_of_others(const DiagnosisProblem& problem,
                                                        const FoundEffects& result,
                                                        const std::vector<Comparison>& others) {
  std::vector<std::vector<WhereEntry>> all;
  if (result.backlash_bank) return all;
  for (std::size_t k = 0; k < others.size(); ++k) {
    const Prepared& other = *problem.others[k];
    Eigen::VectorXd mean = result.found.best.mean;
    mean.head<Library::kBiases>() = problem.joined[k].biases_rad_s;
    mean = with_biases_fitted(other.model(problem.library, problem.threads), std::move(mean));
    const Innovations rest = other.replay->run(problem.library.model(mean));
    all.push_back(significant_cells(
        residual_map(explained_rms(rest, others[k].course, others[k].fix_times_s), other.bank.explained_rms)));
  }
  return all;
}

/// Cells of the residual map that are significant although all that was found is in the model; `seen`: a cell was
/// significant before.
std::vector<WhereEntry> leftover_of(const DiagnosisProblem& problem, const FoundEffects& result,
                                    const Comparison& here, bool seen) {
  const NullBank& bank = problem.prepared.bank;
  Innovations rest = rest_of(*problem.prepared.replay, problem.library, result.found.best);
  const auto map_of = [&] { return explained_rms(rest, here.course, here.fix_times_s); };
  if (result.backlash_bank) return significant_cells(residual_map(map_of(), result.backlash_bank->explained_rms));
  auto leftover = significant_cells(residual_map(map_of(), bank.explained_rms));
  // Without an effect and without a significant cell there is no gap. The tolerances are estimated only nearly,
  // and their errors are no gap either.
  if (result.found.best.effects.empty() && !seen) return leftover;
  // The roll gyro is no evidence, so no search fits it. The start position is only as accurate as the first
  // fixes, decimetres. The exact models leave other residuals in both, so both are left out.
  rest.grid.col(gyro_roll).setZero();
  rest.fixes.leftCols<2>().setZero();
  for (WhereEntry& entry : significant_against_exact_model(map_of(), bank.left, bank.explained_rms)) {
    const bool is_there = std::ranges::any_of(leftover, [&](const WhereEntry& other) {
      return other.channel == entry.channel && other.regime == entry.regime;
    });
    if (!is_there) leftover.push_back(std::move(entry));
  }
  return leftover;
}

/// The third step. Only the effects named go into the hold-outs' models; a prediction of a hold-out uses all
/// parameters, tolerances included, because a vehicle is the same in all missions. `without`: the tolerances
/// alone, against which the hold-outs are predicted; null: they are not.
Comparisons compare_all(const DiagnosisProblem& problem, const ModelFit& best, const HoldOuts& holdouts,
                        const Eigen::VectorXd* without = nullptr) {
  const Library& library = problem.library;
  Eigen::VectorXd members = Eigen::VectorXd::Zero(best.mean.size());
  for (const Eigen::Index j : parameter_indices(library, best.effects)) members[j] = best.mean[j];
  problem.progress("missions held out", 0);
  Comparisons result;
  result.others.resize(problem.others.size());
  result.holdouts.resize(holdouts.size());
  if (without != nullptr) result.predictions.resize(holdouts.size());
  base::in_parallel(problem.threads, holdouts.size() + 1 + problem.others.size(), [&](std::size_t i) {
    if (i == holdouts.size()) {
      result.here = compare(problem.prepared, library, members);
      return;
    }
    if (i > holdouts.size()) {
      const std::size_t k = i - holdouts.size() - 1;
      result.others[k] = compare(*problem.others[k], library, members);
      return;
    }
    const Prepared& other = *holdouts[i];
    result.holdouts[i] = compare(other, library, members);
    if (without != nullptr) result.predictions[i] = predict_held_out(other.model(library, 1), *without, best.mean);
  });
  return result;
}

void remark_on(const FoundEffects& result, const Library& library, Diagnosis& answer) {
  for (const std::size_t effect : result.not_judged()) {
    answer.instruments.not_judged.emplace_back(library[effect].name);
  }
  if (!result.not_judged().empty()) {
    const auto& [missing, interrupted, not_judged] = answer.instruments;
    std::vector<std::string_view> silent(missing.begin(), missing.end());
    for (const Interruption& each : interrupted) silent.push_back(each.what);
    answer.remarks.push_back(fmt::format("without {}, these effects hardly show and were not judged: {}",
                                         fmt::join(silent, " and "), fmt::join(not_judged, ", ")));
  }
  for (const std::size_t effect : result.by_chance) {
    answer.remarks.push_back(fmt::format(
        "{} was the best candidate, but simulated vehicles without a gap show as much on such a course",
        library[effect].name));
  }
  for (const std::size_t effect : result.unobservable) {
    answer.remarks.push_back(
        fmt::format("{} hardly shows in this mission: it was allowed for, not asked for", library[effect].name));
  }
}

/// Whether the instruments of the recording hardly show any effect of the library.
bool judges_nothing(const FoundEffects& result, const Library& library) {
  std::size_t held = 0;
  for (std::size_t effect = 0; effect < library.size(); ++effect) held += library.holds(effect) ? 1U : 0U;
  return result.not_judged().size() == held;
}

/// Reason why a gap that is seen has no name: effects that were not judged take it up.
std::string hidden_cause_text(const FoundEffects& result, const Library& library) {
  std::vector<std::string_view> strong;
  for (const std::size_t effect : result.not_judged()) {
    if (strength_of(library, effect, result.found.best.mean) > kBeyondWideTolerance) {
      strong.push_back(library[effect].name);
    }
  }
  return fmt::format("the gap goes away with effects that were not judged{}{}", strong.empty() ? "" : ": ",
                     fmt::join(strong, ", "));
}

std::string other_vehicle_text(double least_ratio) {
  return fmt::format(
      "all channels of the motion are off by at least {:.1f} times what vehicles without a gap show: this looks "
      "like the recording of another vehicle",
      least_ratio);
}

/// The sets that are still probable, each with the closure of its own estimate, if several close the gap.
std::vector<Alternative> alternatives_of(const DiagnosisProblem& problem, const FoundEffects& result,
                                         const HoldOuts& holdouts) {
  constexpr std::size_t kMostAlternatives = 3;
  std::vector<Alternative> all;
  for (const Candidate& set : result.found.candidates) {
    if (set.effects.empty() || set.probability < kToldFrom || all.size() == kMostAlternatives) continue;
    const ModelFit fit = set.effects == result.found.best.effects
                             ? result.found.best
                             : fit_model(set.effects, problem.inference(result.nominal, result.priors));
    Comparisons compared = compare_all(problem, fit, holdouts);
    if (compared.holdouts.empty()) {
      compared.holdouts = std::move(compared.others);
      compared.holdouts.push_back(std::move(compared.here));
    }
    const PooledClosure closure = pooled_closure(compared.holdouts);
    if (closure.clear && closure.upper < kClosedFrom) continue;
    all.push_back(alternative_of(fit, problem.library, set.probability,
                                 closure.clear ? std::optional(closure.closed) : std::nullopt));
  }
  if (all.size() < 2) all.clear();
  return all;
}

/// The verdict, the gap's size and how much of it the effects close.
void judge_into(const DiagnosisProblem& problem, const FoundEffects& result, const HoldOuts& holdouts,
                Comparisons compared, Diagnosis& answer) {
  std::vector<std::vector<WhereEntry>> leftovers = leftover_of_others(problem, result, compared.others);
  leftovers.insert(leftovers.begin(), leftover_of(problem, result, compared.here, !answer.where.empty()));
  const std::vector<WhereEntry> leftover = merged(std::move(leftovers));
  const ModelFit& best = result.found.best;
  const bool blocks = compared.holdouts.empty();
  std::vector<double> gains_nats;
  PooledClosure closure_by_all;
  if (blocks) {
    const LinearGaussianModel model{best.linear, problem.library, result.priors};
    gains_nats = problem.others.empty() ? gains_of_blocks(best.effects, model, layout_of(*problem.prepared.replay))
                                        : gains_of_recordings(best.effects, model, rows_of_recordings(problem));
    compared.holdouts.push_back(compared.here);
    compared.holdouts.insert(compared.holdouts.end(), compared.others.begin(), compared.others.end());
  } else if (!compared.predictions.empty()) {
    std::vector<Power> by_all;
    for (HeldOutPrediction& each : compared.predictions) {
      gains_nats.push_back(each.gain_nats);
      by_all.push_back(std::move(each.power));
    }
    closure_by_all = pooled_closure(compared.holdouts, by_all);
  }
  const PooledClosure closure = pooled_closure(compared.holdouts);
  const Judgement judgement =
      judge({result.found, problem.library, answer.where, leftover, gains_nats, closure, closure_by_all, blocks});
  answer.verdict = judgement.verdict;
  answer.unexplained = judgement.reasons;
  write_gap(compared.holdouts, closure, !blocks, answer);
  const bool is_seen = shows_gap(answer);
  answer.kind = is_seen ? judgement.kind : UnknownKind::cannot_say;
  if (answer.verdict == Verdict::unknown && is_seen && answer.kind == UnknownKind::cannot_say) {
    answer.alternatives = alternatives_of(problem, result, holdouts);
    if (!answer.alternatives.empty()) answer.kind = UnknownKind::ambiguous;
  }
  const bool judges_none = judges_nothing(result, problem.library);
  if (judges_none ||
      (answer.verdict == Verdict::no_gap && !answer.where.empty() && !result.not_judged().empty())) {
    answer.verdict = Verdict::unknown;
    answer.kind = UnknownKind::cannot_say;
    if (!judges_none) answer.unexplained.push_back(hidden_cause_text(result, problem.library));
  }
  if (answer.verdict == Verdict::unknown && answer.least_ratio.value_or(0) > kOtherVehicle) {
    answer.unexplained.insert(answer.unexplained.begin(), other_vehicle_text(*answer.least_ratio));
  }
}

/// Fills in the data of the page's figures.
void write_pictures(const Prepared& a, const Comparison& here, bool with_effects, Diagnosis& answer) {
  answer.changes = change_points(here.nominal, a.course, here.fix_times_s, a.bank.explained_rms);
  answer.tracks = Tracks{track_of_fixes(a.mission), reckoned_track(a.course, a.mission),
                         with_effects ? reckoned_track(here.course, a.mission) : Track{}};
  answer.courses = courses(here.nominal, here.improved, here.course, here.fix_times_s);
  if (!answer.where.empty()) {
    answer.scatter = scatter(answer.where.front(), here.nominal, here.improved, here.course, here.fix_times_s);
  }
}

/// Residual maps of all recordings as one, and the smallest of their ratios.
void write_map(const DiagnosisProblem& problem, const Comparisons& compared, Diagnosis& answer) {
  std::vector<std::vector<WhereEntry>> maps;
  const auto add = [&](const Prepared& of, const Comparison& compared_with) {
    const Eigen::MatrixXd rms = explained_rms(compared_with.nominal, of.course, compared_with.fix_times_s);
    maps.push_back(residual_map(rms, of.bank.explained_rms));
    const auto ratio = least_ratio(rms, of.bank.explained_rms);
    if (ratio && (!answer.least_ratio || *ratio < *answer.least_ratio)) answer.least_ratio = ratio;
  };
  add(problem.prepared, compared.here);
  for (std::size_t k = 0; k < problem.others.size(); ++k) add(*problem.others[k], compared.others[k]);
  answer.map = merged(std::move(maps));
  answer.where = significant_cells(answer.map);
}

/// Runs the steps of gap/README.md from the search on, and hands on what the search found. `names`: of the
/// recordings that are diagnosed together.
FoundEffects diagnose_prepared(const DiagnosisProblem& problem, const HoldOuts& holdouts,
                               const std::vector<std::string>& names, Diagnosis& answer) {
  const Prepared& a = problem.prepared;
  FoundEffects result = find_effects(problem);
  SearchResult& found = result.found;
  const bool with_effects = !found.best.effects.empty();
  Comparisons compared =
      compare_all(problem, found.best, holdouts, with_effects ? &found.mean_without_effects : nullptr);
  const Comparison here = compared.here;
  write_map(problem, compared, answer);
  remark_on(result, problem.library, answer);
  judge_into(problem, result, holdouts, std::move(compared), answer);
  const bool is_named = answer.verdict == Verdict::explained || answer.kind == UnknownKind::ambiguous;
  if (answer.where.empty() && is_named && with_effects && !answer.map.empty()) {
    const Eigen::MatrixXd nominal_rms = explained_rms(here.nominal, a.course, here.fix_times_s);
    const Eigen::MatrixXd with_members = explained_rms(here.improved, here.course, here.fix_times_s);
    answer.where.push_back(most_changed(answer.map, nominal_rms, with_members, a.bank.explained_rms));
  }
  if (answer.verdict != Verdict::no_gap) {
    write_sources(problem, result, holdouts, answer);
    put_source_first(answer);
  }
  result.nominal = {};  // large, and no longer needed
  answer.duration_s = a.mission.duration_s;
  for (const Prepared* other : problem.others) answer.duration_s += other->mission.duration_s;
  for (Eigen::Index i = 0; i < Library::kBiases; ++i) {
    answer.gyro_bias_rad_s[static_cast<std::size_t>(i)] = found.best.mean[i];
  }
  answer.bank = {a.bank.missions, a.bank.seed, a.from_cache, a.bank.seconds};
  if (result.backlash_bank) correct(found.best, problem.library, *result.backlash_bank);
  write_findings(result, problem.library, answer);
  write_pictures(a, here, with_effects, answer);
  write_words(answer);
  if (judges_nothing(result, problem.library)) {
    answer.sentence =
        "Nothing can be said of a gap: the instruments of this recording show none of the library's effects.";
  }
  if (!problem.others.empty()) {
    compare_recordings(problem, result, names, answer);
    const bool differs =
        std::ranges::any_of(answer.differences, [](const EffectDifference& each) { return each.differs; });
    if (differs || answer.verdict == Verdict::unknown) search_apart(problem, answer);
  }
  return result;
}

/// Compares the instruments of a recording with each other where one is missing that the diagnosis needs
/// (docs/calibration.md). It estimates iron about the compass from its own field, deviation from the gyro or
/// from course over ground, scale and bias of the gyro, and delays. `stated` is the configuration to use
/// instead of the recording's own. `field` gives the declination, where it is known. `progress` gets 0 to 1.
/// Throws record::BadRecording.
calib::Report instruments_alone(const std::filesystem::path& file, const std::optional<config::Settings>& stated,
                                const EarthField& field, const std::function<void(double)>& progress,
                                const record::TimeWindow& window) {
  const auto recording = record::Recording::open(file, window);
  config::Settings settings = stated.value_or(recording->settings());
  const record::PortMatch ports(recording->settings(), settings);
  settings.calibration.enabled = settings.calibration.automatic = true;
  settings.navigation.enabled = false;
  if (field.source != EarthField::Source::fitted) {
    const auto& [north_uT, east_uT, down_uT] = field.north_east_down_uT;
    settings.environment.declination_rad = std::atan2(east_uT, north_uT);
  }
  pipeline::Pipeline pipeline(settings);
  pipeline::Sink nobody;
  while (const auto entry = recording->next()) {
    ports.give(*entry, pipeline, nobody);
    progress(recording->progress());
  }
  pipeline.finish_calibration(nobody);
  return pipeline.calibration_report();
}

/// Reports a recording that cannot be compared with a model: its instruments are compared with each other
/// instead.
void say_without_causes(const Request& request, const Progress& progress, const std::string& why,
                        Diagnosis& answer) {
  answer.sentence = fmt::format("The causes of a gap cannot be found: {}.", why);
  calib::Report report = instruments_alone(
      request.missions.front(), request.settings, answer.field.value_or(EarthField{}),
      [&](double done) { progress("comparing the instruments with each other", done); }, request.window);
  if (!report.calibrators.empty()) answer.instruments_alone = std::move(report);
}

}  // namespace

std::unique_ptr<Study> study(const Request& request, const Progress& progress) {
  if (request.missions.empty()) throw std::invalid_argument("there is no recording to diagnose");
  auto result = std::make_unique<Study>(request);
  const Library& library = result->library;
  const unsigned threads = base::threads_or_cores(request.threads);
  Preparation preparation(result->request, library, progress, threads);
  Diagnosis& answer = result->diagnosis;
  result->prepared = preparation.prepare(request.missions.front(), answer);
  const std::string why_not =
      answer.remarks.empty() ? std::string("the recording is empty") : answer.remarks.back();
  std::vector<std::string> names{request.missions.front().filename().string()};
  for (std::size_t i = 1; i < request.missions.size(); ++i) {
    auto prepared = preparation.prepare(request.missions[i], answer);
    if (!prepared) continue;
    result->together.push_back(std::move(prepared));
    names.push_back(request.missions[i].filename().string());
  }
  for (const auto& file : request.holdouts) {
    auto prepared = preparation.prepare(file, answer);
    if (prepared) result->holdouts.push_back(std::move(prepared));
  }
  const auto began = std::chrono::steady_clock::now();
  if (result->prepared) {
    std::vector<const Prepared*> others;
    std::vector<JoinedRecording> parts;
    for (const auto& other : result->together) {
      others.push_back(other.get());
      parts.push_back(joined(other->model(library, threads), other->at));
    }
    result->found =
        diagnose_prepared({*result->prepared, library, result->request, progress, threads, others, parts},
                          result->holdouts, names, answer);
  } else {
    say_without_causes(request, progress, why_not, answer);
  }
  if (result->prepared && request.holdouts.empty() && !result->together.empty()) {
    answer.remarks.emplace_back(
        "no mission was held out: each recording was predicted by the others, which is weaker (--holdout "
        "OTHER.cap)");
  } else if (result->prepared && request.holdouts.empty()) {
    answer.remarks.emplace_back(
        "no mission was held out: blocks of this one had to do, which is weaker (--holdout OTHER.cap)");
  }
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return result;
}

Diagnosis diagnose(const Request& request, const Progress& progress) {
  return std::move(study(request, progress)->diagnosis);
}

}  // namespace navcal::gap
