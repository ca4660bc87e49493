// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/sources.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include "gap/data/mission_piece.h"
#include "gap/sources/held_out_error.h"
#include "gap/sources/source_evidence.h"
#include "gap/thresholds.h"

namespace navcal::gap {

double loudest_piece_s(const Eigen::VectorXd& residual, const Layout& layout,
                       const std::vector<double>& fix_times_s, double length_s) {
  const Eigen::Index grid = layout.intervals * kEvidenceChannels;
  // Power up to each interval.
  std::vector<double> power(static_cast<std::size_t>(layout.intervals) + 1, 0);
  for (Eigen::Index i = 0; i < layout.intervals; ++i) {
    power[static_cast<std::size_t>(i) + 1] =
        residual.segment(i * kEvidenceChannels, kEvidenceChannels).squaredNorm();
  }
  for (std::size_t i = 0; i < fix_times_s.size(); ++i) {
    const auto row = grid + static_cast<Eigen::Index>(i) * kFixChannels;
    const double place = fix_times_s[i] / kInterval_s;
    if (!(place >= 0) || place >= static_cast<double>(layout.intervals)) continue;
    power[static_cast<std::size_t>(place) + 1] += residual.segment(row, kFixChannels).squaredNorm();
  }
  for (std::size_t i = 1; i < power.size(); ++i) power[i] += power[i - 1];
  const auto length = static_cast<std::size_t>(length_s / kInterval_s);
  std::size_t best = 0;
  for (std::size_t from = 0; from + length < power.size(); ++from) {
    if (power[from + length] - power[from] > power[best + length] - power[best]) best = from;
  }
  return static_cast<double>(best) * kInterval_s;
}

namespace {

SourceFinding finding_of(const SourceFit& fit, const std::vector<Covariate>& covariates) {
  SourceFinding finding{std::string(fit.source->name), std::string(fit.source->words), fit.gain_nats, {}};
  for (const ErrorTerm& term : fit.terms) {
    const Covariate& covariate = covariates[term.covariate];
    const ErrorComponent& component = *term.component;
    finding.errors.push_back({std::string(component.name),
                              std::string(component.channel),
                              std::string(covariate.regime),
                              covariate.name,
                              {covariate.families.begin(), covariate.families.end()},
                              component.per_si * term.coefficient,
                              component.per_si * term.std_error,
                              std::string(component.unit),
                              std::abs(term.coefficient) / component.typical});
  }
  return finding;
}

const ErrorSource& source_named(std::string_view name) {
  return *std::ranges::find(error_sources(), name, &ErrorSource::name);
}

/// Shows how far the search for the source is.
std::function<void(double)> shown_by(const Progress& progress) {
  return [&progress](double done) { progress("looking for the source", done); };
}

std::vector<const ErrorSource*> all_sources() {
  std::vector<const ErrorSource*> all;
  for (const ErrorSource& source : error_sources()) all.push_back(&source);
  return all;
}

/// Whether the first of some fits is so far ahead that more data would not change it.
bool is_clear(const std::vector<SourceFit>& fits) {
  if (fits.empty() || fits[0].gain_nats < kClearSource_nats) return false;
  return fits.size() == 1 || fits[0].gain_nats - fits[1].gain_nats > kClearLead_nats;
}

/// The sources of a recording in the piece of it that shows the gap best; empty if it has to be judged as a whole.
std::vector<SourceFinding> findings_in_piece(const Prepared& recording, const DiagnosisProblem& problem,
                                             const Linearised& nominal, const Priors& priors) {
  constexpr double kWorthwhile = 1.5;
  const Mission& whole = recording.mission;
  if (!whole.silences.empty() || whole.duration_s < kWorthwhile * kSourcePiece_s) return {};
  const double begin_s = recording.course.time_s.front();
  std::vector<double> fix_times_s = whole.fix_times_s();
  for (double& time_s : fix_times_s) time_s -= begin_s;
  const double from_s =
      begin_s + loudest_piece_s(nominal.residual, layout_of(*recording.replay), fix_times_s, kSourcePiece_s);
  const Mission piece = piece_of(whole, from_s, from_s + kSourcePiece_s);
  if (!piece.silences.empty() || !piece.shortcoming().empty()) return {};
  const Replay replay(piece, problem.request.vehicle);
  const ResidualModel model{replay, problem.library, recording.bank.whitening, problem.threads};
  Trajectory10Hz course;
  (void)replay.run(problem.library.model(recording.at), &course);
  if (course.time_s.empty()) return {};
  const Linearised of_piece = linearise(model, recording.at);
  const std::vector<Covariate> covariates = covariates_of(course);
  const auto fits = SourceEvidence({model, of_piece, priors, covariates, course.time_s.front()})
                        .ranked(all_sources(), shown_by(problem.progress));
  std::vector<SourceFinding> findings;
  if (!is_clear(fits)) return findings;
  for (const SourceFit& fit : fits) findings.push_back(finding_of(fit, covariates));
  return findings;
}

/// The sources of one recording.
class RecordingSources {
 public:
  /// References must outlive it.
  RecordingSources(const Prepared& recording, const DiagnosisProblem& problem, const FoundEffects& found)
      : problem_(problem), recording_(recording), model_(recording.model(problem.library, problem.threads)),
        nominal_(problem.others.empty() ? found.nominal : own_.emplace(linearise(model_, recording.at))),
        covariates_(covariates_of(recording.course)), of_{model_, nominal_, found.priors, covariates_,
                                                          recording.course.time_s.front()} {}
  RecordingSources(const RecordingSources&) = delete;
  RecordingSources& operator=(const RecordingSources&) = delete;

  /// Judges the piece of the recording that shows the gap best, and all of it where the piece does not decide.
  [[nodiscard]] std::vector<SourceFinding> findings() {
    std::vector<SourceFinding> findings = findings_in_piece(recording_, problem_, nominal_, of_.priors);
    if (!findings.empty()) return findings;
    for (const SourceFit& fit : evidence().ranked(all_sources(), shown_by(problem_.progress))) {
      findings.push_back(finding_of(fit, covariates_));
    }
    return findings;
  }

  /// Descriptions by one source with all covariates: by one term, by two and so on.
  [[nodiscard]] std::vector<SourceFit> descriptions(const ErrorSource& source) {
    problem_.progress("describing what is unknown", 0);
    return evidence().descriptions(source);
  }
  [[nodiscard]] SourceFinding finding(const SourceFit& fit) const { return finding_of(fit, covariates_); }

  /// The one of some descriptions that predicts the recordings held out best. Empty where none predicts anything.
  [[nodiscard]] std::optional<Proposal> proposal(const std::vector<SourceFit>& descriptions,
                                                 const std::vector<std::unique_ptr<Prepared>>& holdouts) const {
    std::vector<Proposal> all;
    for (const SourceFit& fit : descriptions) all.push_back({finding(fit), !holdouts.empty(), 0, {}});
    double measurements = 0;
    const auto judge_on = [&](const Prepared& judged, const std::vector<HeldOutError>& errors) {
      const auto& powers = judged.bank.powers;
      const double floor = std::accumulate(powers.begin(), powers.end(), 0.0) / static_cast<double>(powers.size());
      for (std::size_t i = 0; i < all.size(); ++i) {
        all[i].held_out_gain_nats += errors[i].gain_nats;
        all[i].power.before += errors[i].before;
        all[i].power.after += errors[i].after;
        all[i].power.floor += errors[i].measurements * floor;
      }
      if (!errors.empty()) measurements += errors.front().measurements;
    };
    for (const auto& other : holdouts) {
      judge_on(*other, predict_other(descriptions, of_, other->model(problem_.library, problem_.threads),
                                     other->at, other->course));
    }
    if (holdouts.empty()) {
      std::vector<HeldOutError> errors;
      for (const SourceFit& fit : descriptions) errors.push_back(predict_blocks(fit, of_));
      judge_on(recording_, errors);
    }
    std::optional<Proposal> best;
    for (Proposal& each : all) {
      for (double* power : {&each.power.before, &each.power.after, &each.power.floor}) *power /= measurements;
      if (each.held_out_gain_nats > (best ? best->held_out_gain_nats : 0)) best = std::move(each);
    }
    return best;
  }

 private:
  /// Of the whole recording; replays it when it is first needed.
  [[nodiscard]] const SourceEvidence& evidence() {
    if (!evidence_) evidence_.emplace(of_);
    return *evidence_;
  }

  const DiagnosisProblem& problem_;
  const Prepared& recording_;
  ResidualModel model_;
  std::optional<Linearised> own_;  ///< where several recordings were linearised together, without their biases
  const Linearised& nominal_;
  std::vector<Covariate> covariates_;
  SourceProblem of_;
  std::optional<SourceEvidence> evidence_;
};

/// Adds the findings of another recording.
void add(std::vector<SourceFinding> findings, std::vector<SourceFinding>& all) {
  for (SourceFinding& finding : findings) {
    const auto same =
        std::ranges::find_if(all, [&](const SourceFinding& each) { return each.name == finding.name; });
    if (same == all.end()) {
      all.push_back(std::move(finding));
    } else {
      same->gain_nats += finding.gain_nats;
    }
  }
}

/// Largest gain first; behind the others those that close nothing on a channel of their own.
void sort_by_gain(Diagnosis& answer) {
  for (SourceFinding& finding : answer.sources) {
    const auto is_among = [&](const std::vector<WhereEntry>& cells) {
      return std::ranges::any_of(finding.errors, [&](const ErrorFinding& error) {
        return std::ranges::any_of(cells, [&](const WhereEntry& cell) { return cell.channel == error.channel; });
      });
    };
    finding.closes_nothing = !answer.where.empty() && is_among(answer.map) && !is_among(answer.where);
  }
  std::ranges::stable_sort(answer.sources, [](const auto& a, const auto& b) {
    return a.closes_nothing == b.closes_nothing ? a.gain_nats > b.gain_nats : b.closes_nothing;
  });
}

}  // namespace

void write_sources(const DiagnosisProblem& problem, const FoundEffects& found,
                   const std::vector<std::unique_ptr<Prepared>>& holdouts, Diagnosis& answer) {
  std::vector<SourceFinding>& sources = answer.sources;
  RecordingSources first(problem.prepared, problem, found);
  add(first.findings(), sources);
  for (const Prepared* other : problem.others) add(RecordingSources(*other, problem, found).findings(), sources);
  sort_by_gain(answer);
  if (answer.verdict != Verdict::unknown || sources.empty()) return;
  // Close rivals are compared by their best descriptions.
  std::vector<std::vector<SourceFit>> descriptions;
  const double least_nats = kLeastRival * sources.front().gain_nats;
  for (std::size_t i = 0; i < std::min(sources.size(), kSourcesInFull); ++i) {
    if (sources[i].gain_nats < least_nats) break;
    descriptions.push_back(first.descriptions(source_named(sources[i].name)));
    if (descriptions.back().empty()) continue;
    SourceFinding full = first.finding(descriptions.back().back());
    if (full.gain_nats > sources[i].gain_nats) sources[i] = std::move(full);
  }
  sort_by_gain(answer);
  const auto leader = std::ranges::find_if(descriptions, [&](const auto& fits) {
    return !fits.empty() && fits.front().source->name == sources.front().name;
  });
  if (leader != descriptions.end()) answer.proposal = first.proposal(*leader, holdouts);
}

void put_source_first(Diagnosis& answer) {
  if (answer.sources.empty() || answer.sources.front().gain_nats < kObservable_nats ||
      answer.sources.front().closes_nothing)
    return;
  const SourceFinding& source = answer.sources.front();
  const ErrorFinding& error = source.errors.front();
  if (error.channel.empty()) return;
  const auto is_there = [&](const WhereEntry& entry) { return entry.channel == error.channel; };
  if (std::ranges::none_of(answer.where, is_there)) {
    // Without a gap, evidence of exp(g) has at most the probability exp(-g) (Markov's inequality), for each
    // source.
    const double chance = static_cast<double>(error_sources().size()) * std::exp(-source.gain_nats);
    answer.where.insert(answer.where.begin(), {error.channel, error.regime, std::abs(error.rms), error.std_error,
                                               error.unit, std::min(1.0, chance)});
    return;
  }
  std::stable_partition(answer.where.begin(), answer.where.end(), is_there);
}

}  // namespace navcal::gap
