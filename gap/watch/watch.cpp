// SPDX-License-Identifier: Apache-2.0
#include "gap/watch/watch.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "base/durations.h"
#include "base/enum_name.h"
#include "base/statistics.h"

namespace navcal::gap {
namespace {

constexpr std::int64_t kWindow_ns = static_cast<std::int64_t>(kWindow_s * 1e9);
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
constexpr std::size_t kMostWhere = 5;

std::int64_t time_of(const instruments::Sample& sample) { return sample.stamp.validity_ns; }
std::int64_t time_of(const TimedOrder& order) { return order.time_ns; }

template <class Timed>
std::vector<Timed> between(const std::deque<Timed>& all, std::int64_t begin_ns, std::int64_t end_ns) {
  std::vector<Timed> some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some),
               [&](const Timed& one) { return time_of(one) >= begin_ns && time_of(one) < end_ns; });
  return some;
}

}  // namespace

std::string_view name_of(WatchReport::Verdict verdict) {
  return base::enum_name<WatchReport::Verdict::unknown>(verdict, {"no_gap", "gap", "named", "unknown"});
}

Watch::Watch(WindowSource& source, const Options& options, Listener listener)
    : source_(source), listener_(std::move(listener)),
      settling_ns_(static_cast<std::int64_t>(source.model().settling_s * 1e9)),
      change_(source.model().causes, source.model().root, source.model().noise_factor, source.model().model_error),
      power_(source.model().power), rest_of_leader_(power_), rest_of_all_(power_) {
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
  while (begin_ns_ && newest_ns_ >= *begin_ns_ + settling_ns_ + kWindow_ns + kLate_ns) judge_window();
}

void Watch::on_order(std::int64_t time_ns, const Order& order) { orders_.push_back({time_ns, order}); }

void Watch::finish() {
  while (begin_ns_ && newest_ns_ >= *begin_ns_ + settling_ns_ + kWindow_ns) judge_window();
}

void Watch::judge_window() {
  const std::int64_t begin_ns = *begin_ns_, end_ns = begin_ns + settling_ns_ + kWindow_ns;
  std::string shortcoming =
      source_.take(between(samples_, begin_ns, end_ns), between(orders_, begin_ns, end_ns), begin_ns);
  begin_ns_ = begin_ns + kWindow_ns;
  const auto kept_ns = *begin_ns_ - static_cast<std::int64_t>(source_.model().most_looked_at) * kWindow_ns;
  const auto is_over = [&](const auto& one) { return time_of(one) < kept_ns; };
  std::erase_if(samples_, is_over);
  std::erase_if(orders_, is_over);
  if (!shortcoming.empty()) {
    ++report_.skipped;
    return tell(WatchEvent::Kind::skipped, end_ns + utc_minus_stamps_ns_, std::move(shortcoming));
  }
  begins_ns_.push_back(begin_ns + settling_ns_ + utc_minus_stamps_ns_);
  take(end_ns + utc_minus_stamps_ns_);
}

double Watch::evidence_nats() const {
  // The mean of both statistics, whose expectations without a gap are at most the number of windows.
  return base::log_sum_exp(change_.log_statistic(), power_.log_statistic()) - std::log(2.0);
}

void Watch::take(std::int64_t end_ns) {
  const WindowEvidence evidence = source_.evidence();
  change_.take(evidence.gram, evidence.score, evidence.measurements);
  power_.take(source_.power_with(change_.mean()));
  report_.windows = change_.windows();
  report_.evidence_nats = evidence_nats();
  const bool is_new = !report_.alarm_ns && report_.evidence_nats >= report_.threshold_nats;
  if (is_new) {
    report_.alarm_ns = end_ns;
    report_.verdict = WatchReport::Verdict::gap;
  }
  if (report_.alarm_ns) look_for_cause();
  if (report_.where.size() > kMostWhere) report_.where.resize(kMostWhere);
  if (is_new) tell(WatchEvent::Kind::alarm, end_ns);
  if (report_.verdict == WatchReport::Verdict::named && report_.causes.front().effect != named_) {
    named_ = report_.causes.front().effect;
    tell(WatchEvent::Kind::cause, end_ns);
  }
  if ((report_.verdict == WatchReport::Verdict::unknown) != is_unknown_) {
    is_unknown_ = !is_unknown_;
    if (is_unknown_) tell(WatchEvent::Kind::unknown, end_ns);
  }
  tell(WatchEvent::Kind::window, end_ns);
}

/// At the windows behind that of the alarm, in which a change may have begun: behind the first, second, fourth one
/// and so on, because that takes long.
void Watch::look_closer() {
  const auto alarm =
      std::lower_bound(begins_ns_.begin(), begins_ns_.end(), *report_.alarm_ns - kWindow_ns / 2) - 1;
  const auto since = static_cast<std::uint64_t>(begins_ns_.end() - alarm) - 1;
  report_.where = source_.where(since);
  if (!std::has_single_bit(since)) return;
  const auto windows = static_cast<std::int64_t>(std::min(since, source_.model().most_looked_at));
  const std::int64_t begin_ns = *begin_ns_ - windows * kWindow_ns, end_ns = *begin_ns_ + settling_ns_;
  source_.look(between(samples_, begin_ns, end_ns), between(orders_, begin_ns, end_ns), begin_ns, report_);
  report_.causes.resize(std::min(report_.causes.size(), WatchReport::kMostCauses));
  for (WatchReport::Cause& cause : report_.causes) cause.since_ns = *alarm;
}

void Watch::look_for_cause() {
  if (source_.model().most_looked_at > 0) return look_closer();
  const auto causes = change_.causes();
  report_.causes.clear();
  for (std::size_t i = 0; i < std::min(causes.size(), WatchReport::kMostCauses); ++i) {
    report_.causes.push_back({change_.name(causes[i]), causes[i].probability, change_.strength(causes[i]),
                              begins_ns_[causes[i].onset]});
  }
  const ChangeDetector::Cause& first = causes.front();
  if (leader_ != first.candidate) {
    leader_ = first.candidate;
    rest_of_leader_.restart();
  }
  // Power that rose without any evidence for an effect of the library is not explained by the leading one.
  const bool has_effect = change_.log_statistic() >= report_.threshold_nats;
  rest_of_leader_.take(source_.power_with(change_.mean_with(first)));
  rest_of_all_.take(source_.power_with(change_.mean_with_all()));
  report_.where = source_.where(change_.windows() - first.onset);
  const bool is_explained = rest_of_leader_.log_statistic() < kForeign_nats;
  report_.unexplained =
      is_explained ? std::string()
                   : std::string(source_.model().channels[static_cast<std::size_t>(rest_of_leader_.loudest())]);
  if (!is_explained && rest_of_all_.log_statistic() > kForeign_nats) {
    report_.verdict = WatchReport::Verdict::unknown;
  } else if (has_effect && is_explained && first.probability >= kCauseNamedFrom &&
             change_.windows() - first.onset >= kLeastWindows) {
    report_.verdict = WatchReport::Verdict::named;
  } else {
    report_.verdict = WatchReport::Verdict::gap;
  }
}

void Watch::tell(WatchEvent::Kind kind, std::int64_t time_ns, std::string reason) {
  report_.newest_ns = time_ns;
  listener_({kind, time_ns, std::move(reason)});
}

Watch::State Watch::state() const {
  return {change_.state(), power_.log_channels(), begins_ns_, report_.skipped, report_.alarm_ns, source_.learnt()};
}

void Watch::restore(State state) {
  if (state.begins_ns.size() != state.change.windows)
    throw std::invalid_argument("the state has another number of windows than it says");
  power_.restore(state.log_power);
  change_.restore(std::move(state.change));
  source_.restore(state.of_source);
  begins_ns_ = std::move(state.begins_ns);
  report_.windows = change_.windows();
  report_.skipped = state.skipped;
  report_.alarm_ns = state.alarm_ns;
  report_.evidence_nats = evidence_nats();
  if (report_.alarm_ns) report_.verdict = WatchReport::Verdict::gap;
}

}  // namespace navcal::gap
