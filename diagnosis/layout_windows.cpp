// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/layout_windows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "base/parallel.h"
#include "diagnosis/layout_verdict.h"
#include "diagnosis/limits.h"
#include "gap/data/mission.h"
#include "gap/watch/live_records.h"
#include "gap/watch/watch.h"
#include "identify/filter/filtered_replay.h"
#include "record/log/checksum.h"
#include "record/seen_recordings.h"

namespace navcal::diagnosis {
namespace {

/// Nominal windows that a channel needs so that its power is tested, and relative standard deviation of a power at
/// least: few windows hardly tell it. Errors of fixes last longer than a window: their power is not tested.
constexpr std::size_t kFewestWindows = 4;
constexpr double kLeastScatter = 0.1;
constexpr auto kTested = static_cast<Eigen::Index>(identify::Channel::north);
/// The model's error is raised in such steps until the windows of no nominal recording have more evidence of a
/// change, beyond the logarithm of their number, nats.
constexpr double kErrorStep = 1.25, kLargestError = 2, kQuiet_nats = 2;

std::vector<gap::WatchedCause> watched_causes(const CauseLibrary& library) {
  std::vector<gap::WatchedCause> all;
  for (const Cause& cause : library.causes) {
    gap::WatchedCause watched{cause.words(), cause.columns(), Eigen::VectorXd(std::ssize(cause.parameters))};
    for (std::size_t i = 0; i < cause.parameters.size(); ++i) {
      const CauseParameter& parameter = cause.parameters[i];
      watched.typical[static_cast<Eigen::Index>(i)] = parameter.typical * parameter.per_unit;
      // An actuator can lose all that it gives.
      if (cause.is_of_actuator() && parameter.name == "scale")
        watched.most = std::max(watched.most, -parameter.low / parameter.typical);
    }
    // A dead actuator is a weak one.
    if (!cause.parameters.front().is_switch()) all.push_back(std::move(watched));
  }
  return all;
}

/// Standard deviations between recordings of the nuisances that no cause is: biases, the current of the water.
Eigen::MatrixXd root_of_new(const CauseLibrary& library, const ColumnScatter& scatter) {
  Eigen::VectorXd stds = Eigen::VectorXd::Zero(library.columns());
  stds.tail<identify::kNuisances>() = scatter.session.tail<identify::kNuisances>();
  for (const Cause& cause : library.causes) stds(cause.columns()).setZero();
  return stds.asDiagonal();
}

Eigen::VectorXd channels_of(const RecordingPower& power) {
  Eigen::VectorXd of_channel(identify::kChannels);
  for (std::size_t c = 0; c < identify::kChannels; ++c) {
    of_channel[static_cast<Eigen::Index>(c)] =
        power.of_channel[c] < 0 ? std::numeric_limits<double>::quiet_NaN() : power.of_channel[c];
  }
  return of_channel;
}

}  // namespace

LayoutWindows::LayoutWindows(LayoutWatchRequest request, const gap::Progress& progress)
    : request_(std::move(request)) {
  if (request_.nominals.empty())
    throw std::invalid_argument("the watch of a layout needs recordings without a gap (--nominal)");
  if (!request_.settings) request_.settings = record::Recording::open(request_.nominals.front())->settings();
  settings_ = gap::samples_only(*request_.settings);
  instruments_ = devices::without_mounting(devices::instrument_model(settings_));
  record::SeenRecordings seen;
  std::vector<std::string> repeated;
  std::erase_if(request_.nominals, [&](const auto& file) { return !seen.is_new(file, repeated); });
  std::vector<identify::RecordedMotion>& motions = study_.recordings.nominals;
  for (const std::filesystem::path& file : request_.nominals) {
    motions.push_back(identify::load_motion(
        file, [&](double done) { progress("reading " + file.filename().string(), done); }, request_.settings));
    if (request_.field_uT) identify::set_field(motions.back(), *request_.field_uT);
  }
  study_.library = causes_of(request_.layout, motions.front(), {});
  std::erase_if(study_.library.causes, [](const Cause& cause) { return cause.name == "water_current"; });
  study_.source =
      std::make_unique<FilteredSource>(request_.layout, study_.library, base::threads_or_cores(request_.threads));
  study_.bank = bank_of(*study_.source, study_.library, motions, motions.front(),
                        [&](double done) { progress("nominal recordings", done); });
  declination_rad_ = motions.front().declination_rad;
  new_root_ = root_of_new(study_.library, study_.bank.scatter);
  model_.causes = watched_causes(study_.library);
  model_.root = study_.bank.prior.root;
  model_.settling_s = identify::FilteredReplay::kUnjudged_s;
  model_.recordings = static_cast<int>(motions.size());
  for (const auto& channel : identify::kChannelDescriptions) model_.channels.push_back(channel.name);
  learn(progress);
}

void LayoutWindows::learn(const gap::Progress& progress) {
  for (const std::filesystem::path& file : request_.nominals) {
    nominal_.emplace_back();
    gap::Watch watch(*this, {}, [&](const gap::WatchEvent& event) {
      if (event.kind != gap::WatchEvent::Kind::window) return;
      nominal_.back().push_back({linear_, measurements()});
      nominal_powers_.push_back(power_);
    });
    gap::watch_recording(file, request_.settings, watch, [&](double done) {
      progress("windows of " + file.filename().string(), done);
      return true;
    });
  }
  std::vector<Eigen::VectorXd> powers;
  for (const RecordingPower& power : nominal_powers_) powers.push_back(channels_of(power));
  if (powers.empty())
    throw std::invalid_argument(fmt::format("the nominal recordings have no window of {} s that can be judged",
                                            gap::kWindow_s + model_.settling_s));
  const gap::NominalPower power = gap::nominal_power(powers, kTested, kFewestWindows, kLeastScatter);
  model_.power = power.detector;
  model_.noise_factor = power.mean;
  model_.windows = static_cast<int>(powers.size());
  while (model_.model_error < kLargestError && !is_quiet(model_.model_error)) model_.model_error *= kErrorStep;
  model_.most_looked_at = 4;
}

bool LayoutWindows::is_quiet(double model_error) const {
  for (std::size_t i = 0; i < nominal_.size(); ++i) {
    // The vehicle by the other recordings.
    const JointPrior prior = study_.bank.prior_by_others(i);
    gap::ChangeDetector detector(model_.causes, prior.root, model_.noise_factor, model_error);
    for (const NominalWindow& window : nominal_[i]) {
      const Likelihood here = window.linear.about(prior.mean - study_.bank.prior.mean).blurred(new_root_);
      detector.take(here.information, here.score, window.measurements);
      if (detector.log_statistic() > std::log(static_cast<double>(detector.windows())) + kQuiet_nats) return false;
    }
  }
  return true;
}

identify::RecordedMotion LayoutWindows::motion_of(std::span<const instruments::Sample> samples,
                                                  std::span<const gap::TimedOrder> orders, std::int64_t begin_ns) {
  identify::RecordedMotion motion = identify::motion_of(samples, begin_ns, settings_, instruments_);
  motion.name = "window";
  for (const auto& [time_ns, order] : orders) {
    motion.order_times_s.push_back(static_cast<double>(time_ns - begin_ns) * 1e-9);
    motion.ordered_fins_rad.push_back(order.fins_rad);
  }
  if (request_.field_uT) identify::set_field(motion, *request_.field_uT);
  // A window without a fix says nothing of it.
  if (!motion.declination_rad) motion.declination_rad = declination_rad_;
  declination_rad_ = motion.declination_rad;
  return motion;
}

std::string LayoutWindows::take(std::span<const instruments::Sample> samples,
                                std::span<const gap::TimedOrder> orders, std::int64_t begin_ns) {
  window_.reset();
  motion_ = motion_of(samples, orders, begin_ns);
  for (std::size_t c = 0; c < static_cast<std::size_t>(kTested); ++c) {
    const auto has = [&](const identify::RecordedMotion& motion) { return !motion.channels[c].empty(); };
    if (!has(motion_) && std::ranges::all_of(study_.recordings.nominals, has))
      return fmt::format("no {}, which all nominal recordings have", identify::kChannelDescriptions[c].name);
  }
  try {
    window_ = study_.source->compared(motion_, study_.bank.prior.mean);
    const auto fit = window_->fit(study_.bank.prior.mean);
    if (!fit) throw cannot_follow(motion_);
    linear_ = fit->linear.about(study_.bank.prior.mean);
    auto power = power_at(Eigen::VectorXd::Zero(study_.library.columns()));
    if (!power) throw cannot_follow(motion_);
    power_ = std::move(*power);
  } catch (const std::invalid_argument& problem) {
    return problem.what();
  }
  return {};
}

std::optional<RecordingPower> LayoutWindows::power_at(const Eigen::VectorXd& values) const {
  const JointPrior own{values, new_root_};
  return window_->power(study_.bank.prior.mean + own.posterior_mean(linear_));
}

double LayoutWindows::measurements() const {
  return std::accumulate(power_.readings_of_channel.begin(), power_.readings_of_channel.end(), 0.0);
}

gap::WindowEvidence LayoutWindows::evidence() {
  const Likelihood left = linear_.blurred(new_root_);
  return {left.information, left.score, measurements(), channels_of(power_)};
}

Eigen::VectorXd LayoutWindows::power_with(const Eigen::VectorXd& values) {
  const auto power = power_at(values);
  if (!power) return Eigen::VectorXd::Constant(identify::kChannels, std::numeric_limits<double>::quiet_NaN());
  return channels_of(*power);
}

std::vector<gap::WhereEntry> LayoutWindows::where(std::uint64_t /*windows*/) const {
  auto louder = louder_channels(power_, nominal_powers_);
  for (gap::WhereEntry& entry : louder) entry.regime = "newest window";
  return louder;
}

void LayoutWindows::look(std::span<const instruments::Sample> samples, std::span<const gap::TimedOrder> orders,
                         std::int64_t begin_ns, gap::WatchReport& report) {
  study_.recordings.recording = motion_of(samples, orders, begin_ns);
  study_.diagnosis = {};
  try {
    find_causes(study_, [this](std::string_view, double) {
      if (request_.is_ended()) throw std::invalid_argument("ended");
    });
  } catch (const std::invalid_argument&) {
    return;  // more windows may be judged, or none
  }
  const gap::Diagnosis& found = study_.diagnosis;
  using enum gap::WatchReport::Verdict;
  report.verdict = gap;
  if (found.verdict == gap::Verdict::explained) report.verdict = named;
  if (found.kind == gap::UnknownKind::outside) report.verdict = unknown;
  report.causes.clear();
  for (const gap::EffectFinding& finding : found.effects.empty() ? found.candidates : found.effects) {
    const auto cause = std::ranges::find(study_.library.causes, finding.words(), &Cause::words);
    double strength = 0;
    for (std::size_t i = 0; i < finding.parameters.size(); ++i)
      strength = std::max(strength, std::abs(finding.parameters[i].value / cause->parameters[i].typical));
    report.causes.push_back({finding.words(), finding.probability, strength});
  }
  report.unexplained = found.unexplained.empty() ? "" : found.unexplained.front();
}

std::string LayoutWindows::identity() const {
  const auto bytes = [](const auto& numbers) {
    return std::string_view(reinterpret_cast<const char*>(numbers.data()),
                            static_cast<std::size_t>(numbers.size()) * sizeof(double));
  };
  return fmt::format("layout {:08x} {:08x}", record::crc32c(bytes(study_.bank.prior.mean)),
                     record::crc32c(bytes(study_.bank.prior.root)));
}

}  // namespace navcal::diagnosis
