// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/diagnose_layout.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

#include "base/parallel.h"
#include "diagnosis/cause_search.h"
#include "diagnosis/limits.h"
#include "diagnosis/nominal_bank.h"

namespace navcal::diagnosis {
namespace {

using gap::Diagnosis;
using identify::RecordedMotion;

constexpr std::string_view kUnit = "noise power";

struct ChannelFloor {
  double mean = 1, std = 0;
};

ChannelFloor floor_of(const NominalBank& bank, std::size_t channel) {
  std::vector<double> powers;
  for (const auto& one : bank.channel_powers) {
    if (one[channel] >= 0) powers.push_back(one[channel]);
  }
  if (powers.empty()) return {};
  const double n = static_cast<double>(powers.size());
  const double mean = std::accumulate(powers.begin(), powers.end(), 0.0) / n;
  double square = 0;
  for (const double power : powers) square += (power - mean) * (power - mean);
  return {mean, n > 1 ? std::sqrt(square / (n - 1)) : 0.1 * mean};
}

/// Channels whose noise power exceeds that of nominal recordings, most first.
std::vector<gap::WhereEntry> louder_channels(const RecordingFit& fit, const NominalBank& bank) {
  std::vector<gap::WhereEntry> louder;
  for (std::size_t c = 0; c < identify::kChannels; ++c) {
    const double power = fit.channel_power[c];
    if (power < 0) continue;
    const ChannelFloor floor = floor_of(bank, c);
    const double limit = std::max(floor.mean * kChannelFactor, floor.mean + kChannelScatter_sigma * floor.std);
    if (power <= limit) continue;
    const double z = (power - floor.mean) / std::max(floor.std, 0.02 * floor.mean);
    louder.push_back({std::string(identify::kChannelDescriptions[c].name), "whole recording", power, floor.mean,
                      std::string(kUnit), std::erfc(std::min(z, 30.0) / std::numbers::sqrt2)});
  }
  std::sort(louder.begin(), louder.end(),
            [](const auto& a, const auto& b) { return a.gap / a.floor > b.gap / b.floor; });
  return louder;
}

gap::EffectFinding finding_of(const Cause& cause, double probability, const Eigen::VectorXd& mean,
                              const Eigen::VectorXd& std) {
  gap::EffectFinding finding{};
  finding.name = cause.name;
  finding.of = cause.of;
  finding.probability = std::min(probability, 1.0);  // a sum of rounded shares
  finding.manoeuvre = cause.manoeuvre;
  for (const CauseParameter& parameter : cause.parameters) {
    finding.parameters.push_back(
        {parameter.name, mean[parameter.column] / parameter.per_unit, std[parameter.column] / parameter.per_unit});
  }
  return finding;
}

/// Prediction of a held-out recording with the found set, and how much of the gap goes away there.
struct HeldOut {
  double gain_nats = 0;
  std::vector<double> before_windows, after_windows, readings;
};

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
    if (const auto& best = found_.sets.front().causes; !best.empty()) hold_out(best);
  }

  /// Each held-out recording is predicted with the set's estimate, and without it.
  void hold_out(const CauseSet& best) {
    for (const RecordedMotion& held_out : recordings_.holdouts) {
      const std::vector<RecordedMotion> one{held_out};
      const FittedRecording other = fitted(one);
      const RecordingFit without = fit(other, "held out " + one.front().name);
      std::vector<ParameterPrior> priors;
      Eigen::VectorXd shift = Eigen::VectorXd::Zero(library_.columns());
      ColumnPriors with = priors_;
      for (const std::size_t cause : best) {
        for (const CauseParameter& parameter : library_.causes[cause].parameters) {
          const Eigen::Index column = parameter.column;
          shift[column] = found_.mean[column];
          // The mean of a nuisance's prior is zero: it may be as large as it was found.
          const double found = library_.causes[cause].is_instrument ? std::abs(found_.mean[column]) : 0;
          with.spike[column] = std::max(found_.std[column], priors_.spike[column]);
          priors.push_back({column,
                            std::clamp(found_.mean[column], parameter.low * parameter.per_unit,
                                       parameter.high * parameter.per_unit),
                            std::max(with.spike[column], found)});
        }
      }
      HeldOut held;
      held.before_windows = without.window_power;
      held.readings = without.window_readings;
      RecordingFit improved;
      try {
        improved = other.fit(priors, &without, [](double) {});
      } catch (const identify::UnboundedReplay&) {
        // With these effects the vehicle could not have moved as it did.
        held.gain_nats = -std::numeric_limits<double>::infinity();
        held.after_windows = without.window_power;
        held_out_.push_back(std::move(held));
        continue;
      }
      held.gain_nats = SetEvidence(improved.linear.about(shift), library_, with)({}) -
                       SetEvidence(without.linear, library_, priors_)({});
      held.after_windows = improved.window_power;
      held_out_.push_back(std::move(held));
    }
  }

  [[nodiscard]] double floor_power() const {
    return std::accumulate(bank_.powers.begin(), bank_.powers.end(), 0.0) / static_cast<double>(bank_.size());
  }

  void measure_gap() {
    std::vector<double> before, after, readings;
    const auto take = [&](const std::vector<double>& b, const std::vector<double>& a,
                          const std::vector<double>& n) {
      before.insert(before.end(), b.begin(), b.end());
      after.insert(after.end(), a.begin(), a.end());
      readings.insert(readings.end(), n.begin(), n.end());
    };
    for (const HeldOut& held : held_out_) take(held.before_windows, held.after_windows, held.readings);
    answer_.gap.held_out = !held_out_.empty();
    if (held_out_.empty()) take(nominal_.window_power, found_.best.window_power, nominal_.window_readings);
    const double floor = floor_power();
    const auto closure_of = [&](const auto& index) -> std::optional<double> {
      double b = 0, a = 0, n = 0;
      for (std::size_t i = 0; i < before.size(); ++i) {
        b += before[index(i)];
        a += after[index(i)];
        n += readings[index(i)];
      }
      if (b / n <= 1.05 * floor) return std::nullopt;
      return 1 - (a / n - floor) / (b / n - floor);
    };
    const double n = std::accumulate(readings.begin(), readings.end(), 0.0);
    gap::Closure& pooled = answer_.gap.pooled;
    pooled.before = std::accumulate(before.begin(), before.end(), 0.0) / n;
    pooled.after = std::accumulate(after.begin(), after.end(), 0.0) / n;
    pooled.floor = floor;
    pooled.closed = closure_of([](std::size_t i) { return i; });
    if (!pooled.closed) return;
    std::mt19937_64 random(request_.seed);
    std::vector<double> closures;
    for (int k = 0; k < 400; ++k) {
      std::vector<std::size_t> drawn(before.size());
      for (std::size_t& index : drawn) index = random() % before.size();
      if (const auto closure = closure_of([&](std::size_t i) { return drawn[i]; })) closures.push_back(*closure);
    }
    if (closures.size() < 40) return;
    std::sort(closures.begin(), closures.end());
    pooled.closed_ci = {closures[closures.size() / 40], closures[closures.size() - 1 - closures.size() / 40]};
  }

  void judge() {
    const ScoredSet& best = found_.sets.front();
    double none = 0, rivals = 0;
    for (const ScoredSet& one : found_.sets) {
      if (one.causes.empty())
        none = one.probability;
      else if (one.causes != best.causes)
        rivals += one.probability;
    }
    measure_gap();
    std::map<std::size_t, double> probabilities;
    for (const ScoredSet& one : found_.sets) {
      for (const std::size_t cause : one.causes) probabilities[cause] += one.probability;
    }
    const SetEvidence evidence(found_.best.linear, library_, priors_);
    std::vector<std::pair<double, std::size_t>> order;
    for (const auto& [cause, probability] : probabilities) order.emplace_back(probability, cause);
    std::sort(order.rbegin(), order.rend());
    for (const auto& [probability, cause] : order) {
      if (probability < 0.01) break;
      const auto posterior = evidence.posterior(best.causes.empty() ? CauseSet{cause} : best.causes);
      answer_.candidates.push_back(finding_of(library_.causes[cause], probability, posterior.mean, posterior.std));
    }
    const auto louder_after = louder_channels(found_.best, bank_);
    if (best.causes.empty() || (none > kNoGapBelow && louder_after.empty() && best.probability < kNamedFrom)) {
      if (louder_after.empty()) return say_no_gap();
      return say_unknown("no effect of the library explains it", louder_after);
    }
    std::vector<std::string> words;
    for (const std::size_t cause : best.causes) words.push_back(library_.causes[cause].words());
    const std::string names = fmt::format("{}", fmt::join(words, " and "));
    if (best.probability < kNamedFrom || rivals > kMostRivals)
      return say_unknown(
          fmt::format("the most probable cause, {}, has a probability of {:.2f} only", names, best.probability),
          louder_after);
    if (!louder_after.empty())
      return say_unknown(fmt::format("{} leaves {} louder than nominal", names, louder_after.front().channel),
                         louder_after);
    for (const std::size_t cause : best.causes) {
      for (const CauseParameter& parameter : library_.causes[cause].parameters) {
        const double strength = std::abs(found_.mean[parameter.column]) / (parameter.typical * parameter.per_unit);
        if (strength > kLargestStrength && parameter.high > kLargestStrength * parameter.typical)
          return say_unknown(fmt::format("{} would have {:.0f} times its typical strength", names, strength),
                             louder_after);
      }
    }
    double gain = 0;
    for (const HeldOut& held : held_out_) gain += held.gain_nats;
    if (!held_out_.empty() && gain < kHoldoutGain_nats)
      return say_unknown(fmt::format("{} does not improve the held-out recordings ({:+.1f} nats)", names, gain),
                         louder_after);
    answer_.verdict = gap::Verdict::explained;
    for (const std::size_t cause : best.causes)
      answer_.effects.push_back(finding_of(library_.causes[cause], probabilities[cause], found_.mean, found_.std));
    add_confusions(evidence, best.causes);
    answer_.sentence = fmt::format("The gap is explained by {}.", names);
    if (held_out_.empty())
      answer_.remarks.emplace_back("no held-out recording was given (--holdout): the answer is weaker");
  }

  void add_confusions(const SetEvidence& evidence, const CauseSet& best) {
    for (std::size_t i = 0; i < best.size(); ++i) {
      for (std::size_t other = 0; other < library_.causes.size(); ++other) {
        if (std::binary_search(best.begin(), best.end(), other)) continue;
        const double apart = evidence.separation(best[i], {other});
        if (apart >= kObservable_nats) continue;
        answer_.effects[i].confused_with.push_back(
            {library_.causes[other].words(), library_.causes[best[i]].manoeuvre, apart});
      }
    }
  }

  void say_no_gap() {
    answer_.verdict = gap::Verdict::no_gap;
    answer_.where.clear();
    answer_.sentence = "Nothing exceeds what nominal recordings show.";
  }

  void say_unknown(const std::string& reason, const std::vector<gap::WhereEntry>& louder) {
    answer_.verdict = gap::Verdict::unknown;
    answer_.sentence = "There is a gap, but its cause is not known: " + reason + '.';
    answer_.unexplained.push_back(reason);
    for (const gap::WhereEntry& entry : louder)
      answer_.unexplained.push_back(
          fmt::format("{}: noise power {:.2f}, nominal {:.2f}", entry.channel, entry.gap, entry.floor));
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
  std::vector<HeldOut> held_out_;
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
