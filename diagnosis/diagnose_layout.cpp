// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/diagnose_layout.h"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>

#include "base/parallel.h"
#include "diagnosis/cause_search.h"
#include "diagnosis/held_out.h"
#include "diagnosis/layout_verdict.h"
#include "diagnosis/louder_channels.h"
#include "diagnosis/nominal_bank.h"

namespace navcal::diagnosis {
namespace {

using gap::Diagnosis;
using identify::RecordedMotion;

/// One diagnosis on its way.
class Diagnosing {
 public:
  /// `recordings` must outlive it. `window_s`: length of the windows of the replay.
  Diagnosing(const LayoutRequest& request, const LayoutRecordings& recordings, const LayoutProgress& progress,
             double window_s)
      : request_(request), recordings_(recordings), progress_(progress) {
    settings_.window_s = window_s;
    settings_.threads = base::threads_or_cores(request.threads);
  }

  Diagnosis run() {
    const auto begin = std::chrono::steady_clock::now();
    try {
      prepare();
      find();
      judge();
    } catch (const CannotSay& reason) {
      answer_.verdict = gap::Verdict::unknown;
      answer_.remarks.emplace_back(reason.what());
      answer_.sentence = "The recording cannot be diagnosed: " + std::string(reason.what()) + '.';
    }
    answer_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return std::move(answer_);
  }

 private:
  struct CannotSay : std::runtime_error {
    using std::runtime_error::runtime_error;
  };

  FittedRecording fitted(const std::vector<RecordedMotion>& one) const {
    try {
      return {request_.layout, library_, one, noise_, settings_};
    } catch (const std::invalid_argument& error) {
      throw CannotSay(error.what());
    }
  }

  void prepare() {
    recording_.push_back(recordings_.recording);
    answer_.duration_s = recording_.front().duration_s;
    for (const std::string& remark : recording_.front().remarks) answer_.remarks.push_back(remark);
    library_ = causes_of(request_.layout, recording_.front(), request_.excluded);
    for (const std::string& remark : library_.not_judged) answer_.remarks.push_back(remark);
    const FittedRecording mine = fitted(recording_);
    for (const std::string& oddity : mine.oddities()) answer_.remarks.push_back(oddity);
    priors_ = tolerances_of(library_, mine.nuisance_stds());
    if (recordings_.nominals.empty()) {
      nominal_ = fit(mine, "replay");
      simulate_bank(mine);
    } else {
      record_bank();
      nominal_ = fit(fitted(recording_), "replay");
    }
    priors_ = widened(std::move(priors_), library_, bank_);
  }

  RecordingFit fit(const FittedRecording& recording, std::string_view what) const {
    try {
      return recording.fit({}, nullptr, [&](double done) { progress_(what, done); });
    } catch (const identify::UnboundedReplay& error) {
      if (settings_.window_s > identify::kLeastWindow_s) throw;
      throw CannotSay(std::string("the layout cannot be replayed along the recording (") + error.what() +
                      "): is it this vehicle's?");
    }
  }

  void record_bank() {
    // The first pass finds the noise of the residuals, which contains what every model of a hull leaves out; the
    // second what the causes' estimates are under that noise.
    std::vector<std::vector<RecordedMotion>> nominals;
    for (const RecordedMotion& nominal : recordings_.nominals) nominals.push_back({nominal});
    const FittedRecording first = fitted(nominals.front());
    noise_ = first.noise_of(fit(first, "noise of " + nominals.front().front().name));
    for (const auto& one : nominals) bank_.add(fit(fitted(one), "nominal " + one.front().name), library_, priors_);
    answer_.remarks.push_back(
        fmt::format("the floor is that of {} nominal recording{}", bank_.size(), bank_.size() == 1 ? "" : "s"));
  }

  void simulate_bank(const FittedRecording& mine) {
    const auto simulated = simulate_nominal(request_.layout, library_, mine.recording(), nominal_, priors_,
                                            request_.simulated_nominals, request_.seed);
    for (std::size_t i = 0; i < simulated.size(); ++i) {
      const std::vector<RecordedMotion> one{simulated[i]};
      try {
        bank_.add(fitted(one).fit({}, nullptr,
                                  [&](double done) {
                                    progress_(
                                        "simulated nominal recordings",
                                        (static_cast<double>(i) + done) / static_cast<double>(simulated.size()));
                                  }),
                  library_, priors_);
      } catch (const CannotSay&) {
        continue;
      }
    }
    answer_.bank = {.missions = static_cast<int>(bank_.size()), .seed = request_.seed};
    if (bank_.size() < 3)
      throw CannotSay(
          fmt::format("only {} of {} simulated nominal recordings could be replayed: the vehicle cannot follow "
                      "the recorded commands without its controller; give nominal recordings (--nominal)",
                      bank_.size(), request_.simulated_nominals));
    answer_.remarks.emplace_back(
        "no nominal recording was given (--nominal): the floor is simulated, and what the layout leaves out of "
        "every vehicle counts as a gap");
  }

  void find() {
    const FittedRecording mine = fitted(recording_);
    found_ = search_causes(mine, nominal_, library_, priors_, [&](double done) { progress_("search", done); });
    answer_.where = louder_channels(nominal_, bank_);
    if (found_.sets.front().causes.empty()) return;
    for (const RecordedMotion& recording : recordings_.holdouts) {
      const std::vector<RecordedMotion> one{recording};
      const FittedRecording other = fitted(one);
      held_out_.push_back(held_out(other, fit(other, "held out " + recording.name), library_, priors_, found_));
    }
  }

  void judge() {
    const ExplainedWindows itself{0, nominal_.window_power, found_.best.window_power, nominal_.window_readings};
    answer_.gap.held_out = !held_out_.empty();
    answer_.gap.pooled =
        closure_of(held_out_.empty() ? std::span(&itself, 1) : std::span(held_out_.data(), held_out_.size()),
                   floor_of(bank_.powers).mean, request_.seed);
    write_verdict({library_, priors_, bank_, found_, held_out_}, answer_);
  }

  const LayoutRequest& request_;
  const LayoutRecordings& recordings_;
  const LayoutProgress& progress_;
  identify::FitSettings settings_;
  Diagnosis answer_;
  std::vector<RecordedMotion> recording_;  ///< one
  CauseLibrary library_;
  ColumnPriors priors_;
  identify::NoiseModel noise_;
  NominalBank bank_;
  RecordingFit nominal_;
  CauseSearchResult found_;
  std::vector<ExplainedWindows> held_out_;
};

}  // namespace

Diagnosis diagnose(const LayoutRequest& request, const LayoutRecordings& recordings,
                   const LayoutProgress& progress) {
  for (double window_s = identify::FitSettings{}.window_s;; window_s /= 2) {
    try {
      return Diagnosing(request, recordings, progress, window_s).run();
    } catch (const identify::UnboundedReplay&) {
      // The vehicle is unstable: it needs shorter windows, in all recordings alike. With the shortest ones the run
      // itself says that it cannot be replayed.
      if (window_s <= identify::kLeastWindow_s) throw;
    }
  }
}

LayoutRecordings load(const LayoutFiles& files, const LayoutProgress& progress) {
  const auto one = [&](const std::filesystem::path& file) {
    return identify::load_motion(
        file, [&](double done) { progress("reading " + file.filename().string(), done); }, files.settings);
  };
  LayoutRecordings recordings{one(files.recording), {}, {}};
  for (const auto& file : files.holdouts) recordings.holdouts.push_back(one(file));
  for (const auto& file : files.nominals) recordings.nominals.push_back(one(file));
  return recordings;
}

}  // namespace navcal::diagnosis
