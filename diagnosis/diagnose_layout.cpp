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
#include "diagnosis/cause_search.h"
#include "diagnosis/held_out.h"
#include "diagnosis/layout_verdict.h"
#include "diagnosis/nominal_bank.h"
#include "diagnosis/steady_recording.h"

namespace navcal::diagnosis {
namespace {

using gap::Diagnosis;
using identify::RecordedMotion;

void find_causes(const LayoutRequest& request, const LayoutRecordings& recordings, const CauseLibrary& library,
                 ModelSource& source, const LayoutProgress& progress, Diagnosis& answer) {
  const RecordedMotion& recording = recordings.recording;
  answer.remarks.insert(answer.remarks.end(), library.not_judged.begin(), library.not_judged.end());
  const NominalBank bank = bank_of(source, library, recordings.nominals, recording,
                                   [&](double done) { progress("nominal recordings", done); });
  answer.remarks.push_back(
      bank.powers.empty()
          ? std::string("no nominal recording was given (--nominal): there is no floor, and no cause is named")
      : bank.powers.size() == 1 ? "the floor is that of 1 nominal recording, which does not show how recordings "
                                  "differ: give more (--nominal)"
                                : fmt::format("the floor is that of {} nominal recordings", bank.powers.size()));
  const auto compared = source.compared(recording, bank.prior.mean);
  const RecordingModel& mine = *compared;
  for (const std::string& oddity : mine.oddities()) answer.remarks.push_back(oddity);
  const CauseSearchResult found =
      search_causes(mine, bank.prior, library, [&](double done) { progress("search", done); });
  ExplainedRecording itself;
  itself.before = mine.power(mine.own_departures(bank.prior, found.none)).value_or(RecordingPower{});
  const auto with = [&](const CauseSet& set) {
    ExplainedRecording changed = itself;
    const auto by = SetEvidence(found.changes, library).posterior(set).among(library.columns());
    changed.after =
        mine.power(mine.own_departures(bank.prior, found.best.linear.about(by)) + by).value_or(itself.before);
    return changed;
  };
  itself = with(found.sets.front().causes);
  answer.where = louder_channels(itself.before, bank.powers);
  answer.where.insert(answer.where.end(), itself.before.apart.begin(), itself.before.apart.end());
  std::vector<ExplainedRecording> explained;
  if (!found.sets.front().causes.empty()) {
    for (const RecordedMotion& other : recordings.holdouts) {
      progress("held out " + other.name, 0);
      explained.push_back(held_out(*source.compared(other, bank.prior.mean), bank.prior, library, found));
    }
  }
  answer.gap.held_out = !explained.empty();
  answer.gap.pooled =
      closure_of(explained.empty() ? std::span(&itself, 1) : std::span(explained.data(), explained.size()),
                 bank.floor().mean, request.seed);
  const auto closure = [&](const CauseSet& set) {
    const ExplainedRecording one = with(set);
    return closure_of(std::span(&one, 1), bank.floor().mean, request.seed);
  };
  write_verdict({library, bank, found, itself.after, explained, closure, itself.before.mean_square}, answer);
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

Diagnosis diagnose(const LayoutRequest& request, const LayoutRecordings& recordings,
                   const LayoutProgress& progress) {
  const auto begin = std::chrono::steady_clock::now();
  Diagnosis answer;
  answer.duration_s = recordings.recording.duration_s;
  answer.remarks = recordings.recording.remarks;
  const Diagnosis empty = answer;
  // Why the recording is not judged so; empty: it is.
  const auto judge = [&](const auto& find) -> std::string {
    try {
      find();
      return {};
    } catch (const std::invalid_argument& error) {
      answer = empty;
      return error.what();
    }
  };
  // An excluded name that is no cause is the caller's fault.
  const CauseLibrary library = causes_of(request.layout, recordings.recording, request.excluded);
  std::string reason = "asked for (--steady)";
  if (!request.is_steady) {
    reason = judge([&] {
      FilteredSource source(request.layout, library, base::threads_or_cores(request.threads));
      find_causes(request, recordings, library, source, progress, answer);
    });
  }
  if (!reason.empty()) {
    const std::string why_not = judge([&] {
      const CauseLibrary told = steady_causes_of(request.layout, recordings.recording, library);
      SteadySource source(request.layout, told);
      find_causes(request, recordings, told, source, progress, answer);
    });
    answer.remarks.push_back("judged by mean forces over steady stretches alone: " + reason);
    if (!why_not.empty()) {
      answer.verdict = gap::Verdict::unknown;
      answer.remarks.back() = reason;
      if (why_not != reason) answer.remarks.push_back("by mean forces over steady stretches: " + why_not);
      answer.sentence = "The recording cannot be diagnosed: " + (request.is_steady ? why_not : reason) + '.';
    }
  }
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return answer;
}

LayoutRecordings load(const LayoutFiles& files, const LayoutProgress& progress) {
  const auto one = [&](const std::filesystem::path& file) {
    RecordedMotion motion = identify::load_motion(
        file, [&](double done) { progress("reading " + file.filename().string(), done); }, files.settings,
        files.window);
    leave_out(files.without, motion);
    return motion;
  };
  LayoutRecordings recordings{one(files.recording), {}, {}};
  for (const auto& file : files.holdouts) recordings.holdouts.push_back(one(file));
  for (const auto& file : files.nominals) recordings.nominals.push_back(one(file));
  return recordings;
}

}  // namespace navcal::diagnosis
