// SPDX-License-Identifier: Apache-2.0
#include "gap/watch/watch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/durations.h"
#include "base/enum_name.h"
#include "base/statistics.h"
#include "gap/thresholds.h"
#include "gap/verdict/where.h"

namespace navcal::gap {
namespace {

constexpr std::int64_t kWindow_ns = static_cast<std::int64_t>(kWindow_s * 1e9);
constexpr std::int64_t kSettling_ns = static_cast<std::int64_t>(kSettling_s * 1e9);
/// Samples and commands come late by up to this: fixes and the word on what became of a command.
constexpr std::int64_t kLate_ns = 2 * base::kSecond_ns;
/// A silence of all instruments, or a step of the clock, after which windows begin anew.
constexpr std::int64_t kBreak_ns = 10 * base::kSecond_ns;
/// Probability from which a cause is named: more than kNamedFrom, because pairs of effects are not scored. Set.
constexpr double kCauseNamedFrom = 0.9;
/// Statistic of the rest, nats, from which something is not explained. Set.
constexpr double kForeign_nats = 7;
/// Windows since its onset that a cause needs to be named.
constexpr std::uint64_t kLeastWindows = 2;
/// Newest windows over which the residual map is averaged.
constexpr std::size_t kMapWindows = 20;
constexpr std::size_t kMostWhere = 5;

constexpr std::array<std::string_view, kPowerChannels> kPowerNames{
    "compass.field", "compass.field", "compass.field", "compass.tilt", "compass.tilt", "imu.gyro",
    "imu.gyro",      "imu.gyro",      "imu.accel",     "imu.accel",    "imu.accel",    "imu.depth",
    "gps.position",  "gps.position",  "gps.velocity",  "gps.velocity"};

std::vector<Eigen::Index> watched_columns(const Library& library) {
  std::vector<Eigen::Index> columns = window_nuisances(library);
  const auto watched = parameter_indices(library, watched_effects(library));
  columns.insert(columns.end(), watched.begin(), watched.end());
  return columns;
}

}  // namespace

std::string_view name_of(WatchReport::Verdict verdict) {
  return base::enum_name<WatchReport::Verdict::unknown>(verdict, {"no_gap", "gap", "named", "unknown"});
}

Watch::Watch(const config::VehicleSettings& vehicle, const Library& library, const WatchReference& reference,
             const ReferenceRequest& request, const Options& options, Listener listener)
    : library_(library), reference_(reference), instruments_(request.instruments), field_(request.field),
      listener_(std::move(listener)),
      change_(library, reference.priors, watched_effects(library), reference.noise_factor),
      power_(reference.power), rest_of_leader_(reference.power),
      rest_of_all_(reference.power), problem_{vehicle, library, reference.bank.whitening, reference.priors,
                                              watched_columns(library)} {
  report_.threshold_nats = std::log(3600 / kWindow_s / options.false_alarms_per_h);
}

void Watch::on_sample(const instruments::Sample& sample) {
  const std::int64_t time_ns = sample.stamp.validity_ns;
  if (begin_ns_ && (time_ns > newest_ns_ + kBreak_ns || time_ns < newest_ns_ - kBreak_ns)) {
    finish();
    samples_.clear();
    orders_.clear();
    begin_ns_.reset();
  }
  if (!begin_ns_) {
    begin_ns_ = time_ns;
    newest_ns_ = time_ns;
  }
  newest_ns_ = std::max(newest_ns_, time_ns);
  // A receiver states the second itself; all others go by the mapping.
  const bool is_mapped = !std::holds_alternative<instruments::GpsSample>(sample.value);
  if (is_mapped && sample.stamp.validity_utc_ns != 0)
    utc_minus_stamps_ns_ = sample.stamp.validity_utc_ns - time_ns;
  samples_.push_back(sample);
  while (begin_ns_ && newest_ns_ >= *begin_ns_ + kSettling_ns + kWindow_ns + kLate_ns) judge_window();
}

void Watch::on_order(std::int64_t time_ns, const Order& order) { orders_.push_back({time_ns, order}); }

void Watch::finish() {
  while (begin_ns_ && newest_ns_ >= *begin_ns_ + kSettling_ns + kWindow_ns) judge_window();
}

void Watch::judge_window() {
  const std::int64_t begin_ns = *begin_ns_, end_ns = begin_ns + kSettling_ns + kWindow_ns;
  MissionGatherer gatherer;
  for (const instruments::Sample& sample : samples_) {
    if (sample.stamp.validity_ns >= begin_ns && sample.stamp.validity_ns < end_ns) gatherer.on_sample(sample);
  }
  for (const auto& [time_ns, order] : orders_) {
    if (time_ns >= begin_ns && time_ns < end_ns) gatherer.on_order(order, time_ns);
  }
  Mission mission = gatherer.take(begin_ns, {});
  mission.instruments = instruments_;
  mission.field = field_;
  mission.duration_s = kSettling_s + kWindow_s;
  for (const Order& order : mission.orders) {
    mission.order_times_s.push_back(order.time_s);
    mission.ordered_fins_rad.push_back(order.fins_rad);
  }
  find_silences(mission);
  begin_ns_ = begin_ns + kWindow_ns;
  std::erase_if(samples_, [&](const auto& sample) { return sample.stamp.validity_ns < *begin_ns_; });
  std::erase_if(orders_, [&](const auto& order) { return order.time_ns < *begin_ns_; });

  std::string shortcoming = mission.shortcoming();
  std::optional<Window> window;
  if (shortcoming.empty()) {
    window.emplace(problem_, std::move(mission), bias_rad_s_);
    if (!window->can_be_judged())
      shortcoming = "the instruments and the motor card have too little of the window in common";
  }
  if (!shortcoming.empty()) {
    ++report_.skipped;
    return tell(WatchEvent::Kind::skipped, end_ns + utc_minus_stamps_ns_, std::move(shortcoming));
  }
  begins_ns_.push_back(begin_ns + kSettling_ns + utc_minus_stamps_ns_);
  take(*window, end_ns + utc_minus_stamps_ns_);
}

double Watch::evidence_nats() const {
  // The mean of both statistics, whose expectations without a gap are at most the number of windows.
  return base::log_sum_exp(change_.log_statistic(), power_.log_statistic()) - std::log(2.0);
}

void Watch::take(Window& window, std::int64_t end_ns) {
  WindowEvidence evidence = window.evidence();
  bias_rad_s_ = evidence.bias_rad_s;
  change_.take(evidence.gram, evidence.score, evidence.measurements);
  power_.take(window.power_with(change_.mean()));
  explained_.push_back({change_.windows() - 1, std::move(evidence.explained_rms)});
  if (explained_.size() > kMapWindows) explained_.pop_front();
  report_.windows = change_.windows();
  report_.evidence_nats = evidence_nats();
  const bool is_new = !report_.alarm_ns && report_.evidence_nats >= report_.threshold_nats;
  if (is_new) {
    report_.alarm_ns = end_ns;
    report_.verdict = WatchReport::Verdict::gap;
  }
  if (report_.alarm_ns) look_for_cause(window);
  if (is_new) tell(WatchEvent::Kind::alarm, end_ns);
  if (report_.verdict == WatchReport::Verdict::named && leader_ != named_) {
    named_ = leader_;
    tell(WatchEvent::Kind::cause, end_ns);
  }
  if ((report_.verdict == WatchReport::Verdict::unknown) != is_unknown_) {
    is_unknown_ = !is_unknown_;
    if (is_unknown_) tell(WatchEvent::Kind::unknown, end_ns);
  }
  tell(WatchEvent::Kind::window, end_ns);
}

void Watch::look_for_cause(const Window& window) {
  const auto causes = change_.causes();
  report_.causes.clear();
  for (std::size_t i = 0; i < std::min(causes.size(), WatchReport::kMostCauses); ++i) {
    report_.causes.push_back({std::string(library_[causes[i].effect].name), causes[i].probability,
                              change_.strength(causes[i]), begins_ns_[causes[i].onset]});
  }
  const ChangeDetector::Cause& first = causes.front();
  if (leader_ != first.effect) {
    leader_ = first.effect;
    rest_of_leader_.restart();
  }
  rest_of_leader_.take(window.power_with(change_.mean_with(first)));
  rest_of_all_.take(window.power_with(change_.mean_with_all()));
  write_where(first.onset);
  // Power that rose without any evidence for an effect of the library is not explained by the leading one.
  const bool has_effect = change_.log_statistic() >= report_.threshold_nats;
  const bool is_explained = rest_of_leader_.log_statistic() < kForeign_nats;
  report_.unexplained =
      is_explained ? std::string() : std::string(kPowerNames[static_cast<std::size_t>(rest_of_leader_.loudest())]);
  if (!is_explained && rest_of_all_.log_statistic() > kForeign_nats) {
    report_.verdict = WatchReport::Verdict::unknown;
  } else if (has_effect && is_explained && first.probability >= kCauseNamedFrom &&
             change_.windows() - first.onset >= kLeastWindows) {
    report_.verdict = WatchReport::Verdict::named;
  } else {
    report_.verdict = WatchReport::Verdict::gap;
  }
}

void Watch::write_where(std::uint64_t onset) {
  Eigen::MatrixXd square;
  double count = 0;
  for (const Explained& one : explained_) {
    if (one.window < onset) continue;
    square = count > 0 ? Eigen::MatrixXd(square + one.rms.cwiseAbs2()) : Eigen::MatrixXd(one.rms.cwiseAbs2());
    count += 1;
  }
  report_.where.clear();
  if (count == 0) return;
  report_.where = residual_map((square / count).cwiseSqrt(), reference_.explained_rms);
  if (auto clear = significant_cells(report_.where); !clear.empty()) report_.where = std::move(clear);
  if (report_.where.size() > kMostWhere) report_.where.resize(kMostWhere);
}

void Watch::tell(WatchEvent::Kind kind, std::int64_t time_ns, std::string reason) {
  report_.newest_ns = time_ns;
  listener_({kind, time_ns, std::move(reason)});
}

Watch::State Watch::state() const {
  return {change_.state(), power_.log_channels(), begins_ns_, report_.skipped, report_.alarm_ns, bias_rad_s_};
}

void Watch::restore(State state) {
  if (state.begins_ns.size() != state.change.windows)
    throw std::invalid_argument("the state has another number of windows than it says");
  if (state.log_power.size() != kPowerChannels || !state.log_power.allFinite())
    throw std::invalid_argument("the state is of other channels");
  change_.restore(std::move(state.change));
  power_.restore(state.log_power);
  begins_ns_ = std::move(state.begins_ns);
  bias_rad_s_ = state.bias_rad_s;
  report_.windows = change_.windows();
  report_.skipped = state.skipped;
  report_.alarm_ns = state.alarm_ns;
  report_.evidence_nats = evidence_nats();
  if (report_.alarm_ns) report_.verdict = WatchReport::Verdict::gap;
}

}  // namespace navcal::gap
