// SPDX-License-Identifier: Apache-2.0
#include "pipeline/port_stream.h"

#include <algorithm>
#include <cmath>

#include "base/durations.h"

namespace navcal::pipeline {
namespace {

// Longest pause between two bytes of one frame. It covers a USB adapter's latency timer (16 ms), an instrument
// that pauses to compute, and a late host: reads were observed 200 ms late under load, and the frame would be lost
// although it is whole. A longer margin would delay what follows a torn frame.
constexpr std::int64_t kSilenceMargin_ns = 250'000'000;

// A sample that was valid later than this after its arrival has a wrong time: clocks of programs on one vehicle
// agree better. To it comes how far off our own mapping may be, which is not taken for more than an hour.
constexpr std::int64_t kAhead_ns = base::kSecond_ns;
constexpr std::int64_t kMostBound_ns = 3600 * base::kSecond_ns;

// Dates before the pivot of the rollover (ICD section 2).
constexpr std::int64_t kDay_ns = 86'400 * base::kSecond_ns, kEpoch_ns = kDay_ns * 7 * 1024;

// NMEA receivers begin to send 0.05 to 0.5 s behind the second. Until the port's latency_ms says how late, UTC is
// as uncertain as this, one standard deviation.
constexpr double kUnknownDelay_s = 0.15;

double utc_std_s(const config::PortSettings& settings) {
  const bool is_unknown = settings.protocol == protocols::Protocol::nmea && settings.latency_s == 0;
  return is_unknown ? std::max(kUnknownDelay_s, settings.latency_std_s) : settings.latency_std_s;
}

// A stamp that would be better than the resolution of its time is not stated.
constexpr std::int64_t kLeastStd_ns = 1;

}  // namespace

PortStream::PortStream(std::uint16_t port, const config::PortSettings& settings, const StandardErrors& errors,
                       UtcMapping& mapping)
    : port_(port), latency_ns_(std::llround(settings.latency_s * 1e9)),
      latency_std_ns_(std::llround(settings.latency_std_s * 1e9)), nominal_rate_Hz_(settings.rate_Hz),
      parser_(protocols::make_port_parser(settings.protocol, settings.described ? &*settings.described : nullptr,
                                          settings.require_checksum)),
      track_(settings.baud), instrument_(instruments::make_instrument(settings)), mounting_(settings.mounting),
      clock_(settings.rate_Hz, settings.latency_std_s), gps_time_(utc_std_s(settings)), errors_(errors),
      mapping_(mapping) {}

void PortStream::bytes(std::int64_t arrival_ns, protocols::Bytes bytes, Sink& sink) {
  sink_ = &sink;
  last_arrival_ns_ = arrival_ns;
  track_.add(bytes.size(), arrival_ns);
  std::visit([&](auto& parser) { parser.feed(bytes, [this](const protocols::Frame& frame) { on_frame(frame); }); },
             parser_);
  sink_ = nullptr;
}

void PortStream::silence(Sink& sink) {
  sink_ = &sink;
  ++statistics_.silences;
  std::visit([&](auto& parser) { parser.silence([this](const protocols::Frame& frame) { on_frame(frame); }); },
             parser_);
  sink_ = nullptr;
}

std::int64_t PortStream::deadline_ns() const {
  const std::size_t missing = std::visit([](const auto& parser) { return parser.missing(); }, parser_);
  if (missing == 0) return std::numeric_limits<std::int64_t>::max();
  return last_arrival_ns_ + static_cast<std::int64_t>(missing) * track_.byte_ns() + kSilenceMargin_ns;
}

void PortStream::on_frame(const protocols::Frame& frame) {
  place_ = track_.locate(frame.offset, frame.end());
  paced_.reset();
  repeated_ = false;
  statistics_.last_frame_ns = place_.arrival_ns;
  sink_->on_frame(port_, frame, place_.arrival_ns);
  using Verdict = instruments::Instrument::Verdict;
  switch (instrument_->read(frame, *this)) {
    case Verdict::used: break;
    case Verdict::begins: epoch_start_ns_ = place_.start_ns; break;
    case Verdict::ignored: statistics_.unused.add(frame.id); break;
    case Verdict::foreign: statistics_.unused.add(protocols::FrameId("other systems")); break;
    case Verdict::out_of_range: ++statistics_.out_of_range; break;
    case Verdict::unsigned_: statistics_.unused.add(protocols::FrameId("not signed")); break;
    case Verdict::forged: statistics_.unused.add(protocols::FrameId("wrong signature")); break;
    case Verdict::replayed: statistics_.unused.add(protocols::FrameId("replayed")); break;
  }
}

void PortStream::on_measurement(const instruments::Measurement& measurement) {
  if (const auto* const gauge = std::get_if<instruments::DepthSample>(&measurement.value);
      gauge != nullptr && gauge->pressure_Pa && !pressures_.lets_in(*gauge->pressure_Pa)) {
    ++statistics_.out_of_range;
    return;
  }
  const std::int64_t observed_ns =
      (measurement.of_epoch ? epoch_start_ns_ : place_.start_ns) - measurement.age_ns.value_or(latency_ns_);
  instruments::Sample sample;
  sample.value = measurement.value;
  auto stated_utc_ns = measurement.stated_utc_ns;
  if (auto* const gps = std::get_if<instruments::GpsSample>(&sample.value);
      gps != nullptr && gps->time_corrected && stated_utc_ns && mapping_.source == UtcMapping::Source::file) {
    // Nothing had rolled over where the date as it was sent is that of the recording.
    const std::int64_t ahead_ns = *stated_utc_ns - mapping_.to_utc(observed_ns);
    const std::int64_t added_ns = (ahead_ns + kDay_ns) / kEpoch_ns * kEpoch_ns;
    if (added_ns > 0 && ahead_ns - added_ns < kDay_ns) {
      gps->time_utc_ns = stated_utc_ns = *stated_utc_ns - added_ns;
      gps->time_corrected = false;
    }
  }
  sample.port = port_;
  sample.stamp.arrival_ns = place_.arrival_ns;
  sample.stamp.validity_ns = observed_ns;
  sample.stamp.std_ns = clock_.arrival_std_ns();
  if (!measurement.paces && repeated_) return;
  if (!measurement.paces && paced_) {
    sample.stamp.validity_ns = paced_->time_ns;
    sample.stamp.std_ns = paced_->std_ns;
  } else if (measurement.paces || measurement.device_time_ns) {
    // An epoch may have begun before what else came of the same port.
    const std::int64_t tick_ns = measurement.of_epoch ? std::max(observed_ns, tick_ns_) : observed_ns;
    tick_ns_ = tick_ns;
    const double std_s = 1e-9 * static_cast<double>(latency_std_ns_);
    auto& clock = measurement.clock == 0
                      ? clock_
                      : others_.try_emplace(measurement.clock, nominal_rate_Hz_, std_s).first->second;
    const auto outcome = clock.update(
        {tick_ns, measurement.sequence, place_.backlog, measurement.device_time_ns, measurement.paces});
    if (outcome.news) tell_news(*outcome.news);
    repeated_ = measurement.paces && outcome.repeated;
    if (outcome.repeated) return;
    sample.stamp.validity_ns = outcome.time.time_ns;
    sample.stamp.std_ns = outcome.time.std_ns;
    if (measurement.paces) paced_ = outcome.time;
  }
  if (stated_utc_ns && measurement.utc_is_known) {
    if (const auto mapping = gps_time_.update(*stated_utc_ns, observed_ns, mapping_, measurement.in_leap_second)) {
      mapping_ = *mapping;
      sink_->on_mapping(mapping_);
    }
  }
  if (measurement.by_sender && !place(*measurement.by_sender, sample.stamp)) {
    ++statistics_.out_of_range;
    return;
  }
  sample.stamp.std_ns = std::max(sample.stamp.std_ns, kLeastStd_ns);
  if (measurement.by_sender) stated_utc_ns = measurement.by_sender->utc_ns;
  sample.stamp.arrival_utc_ns = mapping_.to_utc(sample.stamp.arrival_ns);
  sample.stamp.validity_utc_ns = stated_utc_ns ? *stated_utc_ns : mapping_.to_utc(sample.stamp.validity_ns);
  mounting_.to_body(sample.value);
  errors_.complete(sample);
  ++statistics_.samples;
  sink_->on_sample(sample);
}

bool PortStream::place(const instruments::SenderTime& time, instruments::Stamp& stamp) const {
  // No sender knows a time exactly: a stated error of 0 says nothing.
  const std::int64_t stated_ns = time.std_ns.value_or(0);
  if (stated_ns > 0 || latency_std_ns_ > 0) stamp.std_ns = stated_ns > 0 ? stated_ns : latency_std_ns_;
  // Without a mapping the sender's UTC says nothing of our clock.
  if (!time.utc_ns || mapping_.source == UtcMapping::Source::none) return true;
  stamp.validity_ns = *time.utc_ns - mapping_.offset_ns;
  const std::int64_t bound_ns = std::min(mapping_.bound_ns, kMostBound_ns);
  return stamp.validity_ns - stamp.arrival_ns <= kAhead_ns + bound_ns;
}

void PortStream::tell_news(instruments::ClockNews news) {
  const bool warning = news == instruments::ClockNews::rate || news == instruments::ClockNews::irregular;
  sink_->on_stream_event({.port = port_,
                          .time_ns = place_.arrival_ns,
                          .severity = warning ? "warning" : "info",
                          .name = instruments::name_of(news),
                          .message = instruments::words_for(news, nominal_rate_Hz_, clock_.state())});
}

PortStatistics PortStream::statistics() const {
  PortStatistics statistics = statistics_;
  std::visit(
      [&](const auto& parser) {
        statistics.bytes = parser.counters();
        statistics.held_bytes = parser.held();
      },
      parser_);
  statistics.lost = clock_.lost();
  statistics.repeated = clock_.repeated();
  statistics.clock = clock_.state();
  statistics.has_corrected_fields = instrument_->has_corrected_fields();
  return statistics;
}

}  // namespace navcal::pipeline
