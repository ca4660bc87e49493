// SPDX-License-Identifier: Apache-2.0
#include "pipeline/port_stream.h"

#include <cmath>

namespace navcal::pipeline {
namespace {

// Longest pause between two bytes of one frame. It covers a USB adapter's latency timer (16 ms), an instrument
// that pauses to compute, and a late host: reads were observed 200 ms late under load, and the frame would be lost
// although it is whole. A longer margin would delay what follows a torn frame.
constexpr std::int64_t kSilenceMargin_ns = 250'000'000;

}  // namespace

PortStream::PortStream(std::uint16_t port, const config::PortSettings& settings, const StandardErrors& errors,
                       UtcMapping& mapping)
    : port_(port),
      latency_ns_(std::llround(settings.latency_s * 1e9)),
      nominal_rate_Hz_(settings.rate_Hz),
      parser_(protocols::make_port_parser(settings.protocol, settings.described ? &*settings.described : nullptr)),
      track_(settings.baud),
      instrument_(instruments::make_instrument(settings)),
      mounting_(settings.mounting),
      clock_(settings.rate_Hz, settings.latency_std_s),
      gps_time_(settings.latency_std_s),
      errors_(errors),
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
  statistics_.last_frame_ns = place_.arrival_ns;
  sink_->on_frame(port_, frame, place_.arrival_ns);
  if (instrument_->read(frame, *this) == instruments::Instrument::Verdict::out_of_range)
    ++statistics_.out_of_range;
}

void PortStream::on_measurement(const instruments::Measurement& measurement) {
  const std::int64_t observed_ns = place_.start_ns - latency_ns_;
  instruments::Sample sample;
  sample.port = port_;
  sample.stamp.arrival_ns = place_.arrival_ns;
  sample.stamp.validity_ns = observed_ns;
  if (measurement.paces) {
    const auto outcome = clock_.update({observed_ns, measurement.sequence, place_.backlog});
    if (outcome.news) tell_news(*outcome.news);
    tick_ = outcome.repeated ? std::nullopt : std::optional(outcome.time);
  }
  if (measurement.paces || measurement.of_tick_before) {
    if (!tick_) return;
    sample.stamp.validity_ns = tick_->time_ns;
    sample.stamp.std_ns = tick_->std_ns;
  }
  if (measurement.stated_utc_ns && measurement.utc_is_known) {
    if (const auto mapping = gps_time_.update(*measurement.stated_utc_ns, observed_ns, mapping_)) {
      mapping_ = *mapping;
      sink_->on_mapping(mapping_);
    }
  }
  sample.stamp.arrival_utc_ns = mapping_.to_utc(sample.stamp.arrival_ns);
  sample.stamp.validity_utc_ns =
      measurement.stated_utc_ns ? *measurement.stated_utc_ns : mapping_.to_utc(sample.stamp.validity_ns);
  sample.value = measurement.value;
  mounting_.to_body(sample.value);
  errors_.complete(sample);
  ++statistics_.samples;
  sink_->on_sample(sample);
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
  return statistics;
}

}  // namespace navcal::pipeline
