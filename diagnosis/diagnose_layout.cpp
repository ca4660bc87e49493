// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/diagnose_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <span>
#include <stdexcept>

#include "base/parallel.h"
#include "diagnosis/held_out.h"
#include "diagnosis/layout_verdict.h"
#include "diagnosis/steady_source.h"
#include "gap/verdict/recordings_apart.h"
#include "record/seen_recordings.h"
#include "sim/layout/layout_of.h"

namespace navcal::diagnosis {
namespace {

using gap::Diagnosis;
using identify::RecordedMotion;

std::string file_name(const RecordedMotion& recording) {
  return std::filesystem::path(recording.name).filename().string();
}
/// Remarks on one of several recordings begin with the name of its file.
std::string subject(const RecordedMotion& recording, const LayoutRecordings& recordings) {
  return recordings.others.empty() ? "" : file_name(recording) + ": ";
}

/// Several recordings that were judged together, and what was found in them.
struct Judged {
  const CauseLibrary& library;
  const ModelSource& source;
  const NominalBank& bank;
  const CauseSearchResult& found;
  const gap::Progress& progress;
};

/// Predicts each of several recordings by the others.
std::vector<ExplainedRecording> predicted_by_others(const Judged& of, std::vector<RecordingModel*> parts) {
  std::vector<ExplainedRecording> explained;
  const JointPrior prior = of.bank.prior_of(parts.size() - 1);
  Eigen::VectorXd at = of.found.best.at;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    of.progress("prediction of " + parts.front()->recording().name, 0);
    const auto others = of.source.joined(std::span(parts).subspan(1))->fit(at.tail(prior.mean.size()));
    if (others) {
      CauseSearchResult by_others = of.found;
      by_others.changes = prior.of_changes(others->linear);
      explained.push_back(held_out(*parts.front(), of.bank.prior, of.library, by_others));
    }
    std::rotate(parts.begin(), parts.begin() + 1, parts.end());
    std::rotate(at.begin(), at.begin() + of.library.columns(), at.end());
  }
  return explained;
}

/// Writes the estimates of each of several recordings, whether they differ, and, if they do, what is found in each
/// one alone.
void write_apart(const Judged& of, std::span<RecordingModel* const> parts, Diagnosis& answer) {
  const CauseSet& best = of.found.sets.front().causes;
  std::vector<SetEvidence::Posterior> estimates;
  const Eigen::VectorXd& at = of.found.best.at;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    answer.recordings.push_back({file_name(parts[i]->recording()), {}, {}});
    // `at` has the departures of one recording only if the source puts the scatter into the likelihood.
    const Eigen::Index first = static_cast<Eigen::Index>(i) * of.library.columns() % at.size();
    const auto here = parts[i]->fit(at.segment(first, of.library.columns()));
    if (!here) throw cannot_follow(parts[i]->recording());
    estimates.push_back(SetEvidence(of.bank.prior.of_changes(here->linear), of.library).posterior(best));
  }
  Eigen::Index first = 0;
  for (const std::size_t cause : best) {
    const Eigen::Index count = std::ssize(of.library.causes[cause].parameters);
    std::vector<gap::EffectFinding> findings;
    std::vector<gap::OwnEstimate> own;
    for (const SetEvidence::Posterior& each : estimates) {
      findings.push_back(finding_of(of.library.causes[cause], 0, each));
      own.push_back({each.mean.segment(first, count), each.covariance.block(first, first, count, count)});
    }
    gap::write_own_estimates(std::move(findings), own, answer);
    first += count;
  }
  const bool differ = std::ranges::any_of(answer.differences, &gap::EffectDifference::differs);
  if (of.bank.powers.empty() || (!differ && answer.verdict != gap::Verdict::unknown)) return;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i]->hold(of.bank.prior.mean);
    const auto alone = search_causes(*parts[i], of.bank.prior, of.library,
                                     [&](double done) { of.progress(answer.recordings[i].recording, done); });
    answer.recordings[i].alone = gap::RecordingFinding::Alone{{}, alone.sets.front().probability};
    for (const std::size_t cause : alone.sets.front().causes)
      answer.recordings[i].alone->effects.push_back(of.library.causes[cause].words());
  }
  // A cause that has another size in each recording, and that none of them has by itself, is none: it only takes
  // up what they disagree in.
  const bool contradict = std::ranges::any_of(answer.differences, [&](const gap::EffectDifference& each) {
    return each.differs && std::ranges::none_of(answer.recordings, [&](const gap::RecordingFinding& finding) {
             return std::ranges::count(finding.alone->effects, each.words()) > 0;
           });
  });
  if (contradict && answer.verdict == gap::Verdict::explained) {
    answer.verdict = gap::Verdict::unknown;
    answer.kind = gap::UnknownKind::outside;
    answer.effects.clear();
  }
  const std::string sentence = answer.sentence;
  gap::write_alone(answer);
  // That one of them alone shows too little is no contradiction.
  if (answer.kind != gap::UnknownKind::outside) answer.sentence = sentence;
}

/// Models of the recordings that can be judged; of others a remark says why not. Throws where there is none.
std::vector<std::unique_ptr<RecordingModel>> those_judged(const LayoutRecordings& recordings,
                                                          const ModelSource& source, const NominalBank& bank,
                                                          Diagnosis& answer) {
  std::vector<std::unique_ptr<RecordingModel>> judged;
  answer.duration_s = 0;
  for (const RecordedMotion* recording : recordings.together()) {
    try {
      judged.push_back(source.compared(*recording, bank.prior.mean));
    } catch (const std::invalid_argument& error) {
      if (recordings.others.empty()) throw;
      answer.remarks.push_back("left out: " + std::string(error.what()));
      continue;
    }
    answer.duration_s += recording->duration_s;
    for (const std::string& oddity : judged.back()->oddities())
      answer.remarks.push_back(subject(*recording, recordings) + oddity);
  }
  if (judged.empty())
    throw std::invalid_argument("none of the recordings can be judged; " + answer.remarks.back());
  return judged;
}

void leave_out(std::span<const gap::Quantity> quantities, RecordedMotion& motion) {
  using enum gap::Quantity;
  constexpr std::array<std::optional<gap::Quantity>, identify::kChannels> kMeasured{
      rates, rates, rates, second_yaw_rate, force, force, force, tilt, tilt, heading, depth, depth, {}, {}, {},
      {},    {},    {},    fixes,           fixes, fixes, fixes};
  for (std::size_t c = 0; c < kMeasured.size(); ++c) {
    if (std::find(quantities.begin(), quantities.end(), kMeasured[c]) != quantities.end())
      motion.channels[c].clear();
  }
}

}  // namespace

std::vector<const RecordedMotion*> LayoutRecordings::together() const {
  std::vector<const RecordedMotion*> all{&recording};
  for (const RecordedMotion& other : others) all.push_back(&other);
  return all;
}

config::Layout layout_of(const config::VehicleSettings& vehicle) { return sim::layout_of(vehicle); }

void find_causes(LayoutStudy& study, const gap::Progress& progress) {
  const LayoutRecordings& recordings = study.recordings;
  const CauseLibrary& library = study.library;
  Diagnosis& answer = study.diagnosis;
  answer.remarks.insert(answer.remarks.end(), library.not_judged.begin(), library.not_judged.end());
  NominalBank& bank = study.bank;
  if (bank.recordings.empty()) {
    bank = bank_of(*study.source, library, recordings.nominals, recordings.recording,
                   [&](double done) { progress("nominal recordings", done); });
  }
  if (bank.interval_s) answer.remarks.push_back(identify::thinned_warning(*bank.interval_s));
  answer.remarks.push_back(
      bank.powers.empty()
          ? std::string("no nominal recording was given (--nominal): there is no floor, and no cause is named")
      : bank.powers.size() == 1 ? "the floor is that of 1 nominal recording, which does not show how recordings "
                                  "differ: give more (--nominal)"
                                : fmt::format("the floor is that of {} nominal recordings", bank.powers.size()));
  std::vector<std::unique_ptr<RecordingModel>> compared = those_judged(recordings, *study.source, bank, answer);
  std::vector<RecordingModel*> parts;
  for (const auto& one : compared) parts.push_back(one.get());
  const bool are_several = parts.size() > 1;
  if (are_several) {
    compared.push_back(study.source->joined(parts));
    bank.expect(parts.size(), library);
  }
  RecordingModel& mine = *compared.back();
  const JointPrior prior = bank.prior_of(parts.size());
  const CauseSearchResult& found =
      study.found.emplace(search_causes(mine, prior, library, [&](double done) { progress("search", done); }));
  ExplainedRecording itself;
  auto before = mine.power(mine.own_departures(prior, found.none));
  if (!before) before = mine.power(prior.mean);
  itself.before = before.value_or(RecordingPower{});
  const auto with = [&](const CauseSet& set) {
    ExplainedRecording changed = itself;
    const Eigen::VectorXd by =
        prior.in_each(SetEvidence(found.changes, library).posterior(set).among(library.columns()));
    changed.after =
        mine.power(mine.own_departures(prior, found.best.linear.about(by)) + by).value_or(itself.before);
    return changed;
  };
  itself = with(found.sets.front().causes);
  answer.where = louder_channels(itself.before, bank.powers);
  answer.where.insert(answer.where.end(), itself.before.apart.begin(), itself.before.apart.end());
  const Judged judged{library, *study.source, bank, found, progress};
  std::vector<ExplainedRecording> explained;
  if (!found.sets.front().causes.empty()) {
    for (const RecordedMotion& other : recordings.holdouts) {
      progress("held out " + other.name, 0);
      explained.push_back(held_out(*study.source->compared(other, bank.prior.mean), bank.prior, library, found));
    }
    if (are_several && explained.empty()) explained = predicted_by_others(judged, parts);
  }
  answer.gap.held_out = !explained.empty() && !recordings.holdouts.empty();
  answer.gap.pooled =
      closure_of(explained.empty() ? std::span(&itself, 1) : std::span(explained.data(), explained.size()),
                 bank.floor().mean, study.request.seed);
  const auto closure = [&](const CauseSet& set) {
    const ExplainedRecording one = with(set);
    return closure_of(std::span(&one, 1), bank.floor().mean, study.request.seed);
  };
  write_verdict({library, bank, found, itself.after, explained, closure, itself.before.mean_square}, answer);
  if (!are_several) return;
  if (!explained.empty() && recordings.holdouts.empty())
    answer.remarks.emplace_back(
        "no recording was held out: each was predicted by the others, which is weaker (--holdout)");
  write_apart(judged, parts, answer);
}

std::unique_ptr<LayoutStudy> study(LayoutRequest request, LayoutRecordings recordings,
                                   const gap::Progress& progress) {
  const auto begin = std::chrono::steady_clock::now();
  auto study = std::make_unique<LayoutStudy>();
  study->request = std::move(request);
  study->recordings = std::move(recordings);
  const config::Layout& layout = study->request.layout;
  Diagnosis& answer = study->diagnosis;
  for (const RecordedMotion* recording : study->recordings.together()) {
    answer.duration_s += recording->duration_s;
    for (const std::string& remark : recording->remarks)
      answer.remarks.push_back(subject(*recording, study->recordings) + remark);
  }
  const Diagnosis empty = answer;
  // Why the recording is not judged so; empty: it is.
  const auto judge = [&](const auto& make_source) -> std::string {
    try {
      make_source();
      find_causes(*study, progress);
      return {};
    } catch (const std::invalid_argument& error) {
      answer = empty;
      study->bank = {};
      study->found.reset();
      return error.what();
    }
  };
  // An excluded name that is no cause is the caller's fault.
  const CauseLibrary library = causes_of(layout, study->recordings.recording, study->request.excluded);
  study->library = library;
  std::string reason = "asked for (--steady)";
  if (!study->request.is_steady) {
    reason = judge([&] {
      study->source =
          std::make_unique<FilteredSource>(layout, study->library, base::threads_or_cores(study->request.threads));
    });
  }
  if (!reason.empty()) {
    const std::string why_not = judge([&] {
      study->library = steady_causes_of(layout, study->recordings.together(), library);
      study->source = std::make_unique<SteadySource>(layout, study->library);
    });
    answer.remarks.push_back("judged by mean forces over steady stretches alone: " + reason);
    if (!why_not.empty()) {
      answer.verdict = gap::Verdict::unknown;
      answer.remarks.back() = reason;
      if (why_not != reason) answer.remarks.push_back("by mean forces over steady stretches: " + why_not);
      answer.sentence =
          "The recording cannot be diagnosed: " + (study->request.is_steady ? why_not : reason) + '.';
    }
  }
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return study;
}

Diagnosis diagnose(const LayoutRequest& request, const LayoutRecordings& recordings,
                   const gap::Progress& progress) {
  return std::move(study(request, recordings, progress)->diagnosis);
}

std::unique_ptr<LayoutStudy> study(const gap::Request& files, LayoutRequest request,
                                   const std::vector<std::filesystem::path>& nominals,
                                   const gap::Progress& progress) {
  if (files.bank_missions != gap::Request{}.bank_missions)
    throw std::invalid_argument("--bank: the floor of a layout is that of nominal recordings (--nominal)");
  record::SeenRecordings seen;
  std::vector<std::string> repeated;
  const auto load = [&](std::span<const std::filesystem::path> of) {
    std::vector<RecordedMotion> motions;
    for (const std::filesystem::path& file : of) {
      if (!seen.is_new(file, repeated)) continue;
      motions.push_back(identify::load_motion(
          file, [&](double done) { progress("reading " + file.filename().string(), done); }, files.settings,
          files.window));
      if (files.field_uT) identify::set_field(motions.back(), *files.field_uT);
      leave_out(files.without, motions.back());
    }
    return motions;
  };
  const std::span missions(files.missions);
  LayoutRecordings recordings{std::move(load(missions.first(1)).front()), {}, {}, load(missions.subspan(1))};
  recordings.holdouts = load(files.holdouts);
  recordings.nominals = load(nominals);
  request.excluded = files.excluded;
  request.seed = files.bank_seed;
  request.threads = files.threads;
  auto made = study(std::move(request), std::move(recordings), progress);
  auto& remarks = made->diagnosis.remarks;
  remarks.insert(remarks.end(), repeated.begin(), repeated.end());
  return made;
}

Diagnosis diagnose(const gap::Request& files, LayoutRequest request,
                   const std::vector<std::filesystem::path>& nominals, const gap::Progress& progress) {
  return std::move(study(files, std::move(request), nominals, progress)->diagnosis);
}

}  // namespace navcal::diagnosis
