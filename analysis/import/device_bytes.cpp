// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>

#include "analysis/import/import_log.h"
#include "analysis/import/mapped_file.h"
#include "analysis/log_builder.h"
#include "config/load.h"
#include "instruments/instrument.h"
#include "protocols/parsers.h"
#include "protocols/pd0.h"

namespace navcal::analysis {
namespace {

/// A time that the device states, and the first of the bytes that state it.
struct StatedTime {
  std::uint64_t offset = 0;
  std::int64_t utc_ns = 0;
};

/// Reads all frames for what becomes of them, and for the times.
class DeviceSurvey : private instruments::Receiver {
 public:
  DeviceSurvey(const config::PortSettings& port, ImportReport& report)
      : report_(report), instrument_(instruments::make_instrument(port)),
        is_pd0_(port.protocol == protocols::Protocol::pd0) {}

  void operator()(const protocols::Frame& frame) {
    frame_ = frame.offset;
    const std::uint64_t before = samples;
    const auto leader = is_pd0_ ? protocols::pd0::decode(frame.bytes).variable : std::nullopt;
    if (leader && is_valid(leader->date)) tick(clock, frame_, unix_ns(leader->date, leader->time));
    const auto verdict = instrument_->read(frame, *this);
    if (verdict == Verdict::begins) epoch_ = frame.offset;
    const std::string kind(frame.id.view());
    if (samples > before || verdict == Verdict::used || verdict == Verdict::begins) {
      auto& taken = report_.taken[{kind, report_.format}];
      ++taken.messages;
      taken.samples += samples - before;
    } else {
      ++report_.left[kind + (verdict == Verdict::ignored ? "" : " (out of range)")];
    }
  }

  std::uint64_t samples = 0;
  std::vector<StatedTime> times;  ///< later and later
  std::vector<StatedTime> clock;  ///< the same by the device's own clock, of any origin

 private:
  using Verdict = instruments::Instrument::Verdict;

  static void tick(std::vector<StatedTime>& times, std::uint64_t offset, std::int64_t time_ns) {
    if (times.empty() || (time_ns > times.back().utc_ns && offset > times.back().offset))
      times.push_back({offset, time_ns});
  }
  void on_measurement(const instruments::Measurement& measurement) override {
    ++samples;
    if (measurement.device_time_ns && measurement.clock == 0) tick(clock, frame_, *measurement.device_time_ns);
    if (!measurement.stated_utc_ns || !measurement.utc_is_known) return;
    StatedTime time{measurement.of_epoch ? epoch_ : frame_, *measurement.stated_utc_ns};
    // No recording is of the future: then nothing had rolled over, and the date holds as it was sent.
    constexpr std::int64_t kEpoch_ns = 1024LL * 7 * 86'400 * 1'000'000'000;
    const auto* const gps = std::get_if<instruments::GpsSample>(&measurement.value);
    while (gps != nullptr && gps->time_corrected && time.utc_ns > now_ns_) time.utc_ns -= kEpoch_ns;
    tick(times, time.offset, time.utc_ns);
  }

  ImportReport& report_;
  std::unique_ptr<instruments::Instrument> instrument_;
  bool is_pd0_;
  std::uint64_t frame_ = 0, epoch_ = 0;
  const std::int64_t now_ns_ =
      std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
};

}  // namespace

std::optional<protocols::Protocol> device_of(const std::filesystem::path& input) {
  const MappedFile file(input);
  const std::string_view head = file.bytes().substr(0, 65'536), ubx = "\xB5\x62";
  const bool is_text = head.starts_with("$") || input.extension() == ".nmea";
  if (input.extension() == ".ubx" || head.starts_with(ubx) || (is_text && head.find(ubx) != head.npos))
    return protocols::Protocol::ubx;
  return is_text ? std::optional(protocols::Protocol::nmea) : std::nullopt;
}

ImportReport import_bytes(const std::filesystem::path& input, protocols::Protocol protocol, int baud,
                          const std::filesystem::path& log, const record::Progress& progress) {
  const MappedFile file(input);
  const protocols::Bytes bytes(reinterpret_cast<const std::uint8_t*>(file.bytes().data()), file.bytes().size());
  config::Settings settings;
  settings.ports.push_back(config::default_port(std::string(name_of(protocol)), protocol,
                                                baud > 0 ? baud : config::default_baud(protocol)));
  auto& port = settings.ports.front();
  port.path = std::filesystem::absolute(input).string();
  ImportReport report;
  report.input = input.string();
  report.output = log.string();
  report.format = port.name;
  report.bytes = bytes.size();
  DeviceSurvey survey(port, report);
  auto parser = protocols::make_port_parser(protocol);
  std::visit(
      [&](auto& any) {
        any.feed(bytes, survey);
        report.damaged_bytes = any.counters().skipped_bytes;
        if (any.held() > 0) report.cut_at = any.position();
      },
      parser);
  if (report.taken.empty())
    throw record::BadRecording(fmt::format("{}: no frame of {} gives a sample", report.input, port.name));
  pipeline::UtcMapping mapping{pipeline::UtcMapping::Source::file, 0, kGpsBound_ns, 0};
  report.utc = ImportReport::Utc::of_gps;
  auto& times = survey.times;
  if (times.empty()) {
    report.utc = ImportReport::Utc::unknown;
    mapping.bound_ns = pipeline::UtcMapping::kUnknownBound;
    const bool advances = survey.clock.size() > 1;
    times = advances ? std::move(survey.clock) : std::vector{StatedTime{}};
    const std::int64_t first_ns = times.front().utc_ns;
    for (StatedTime& time : times) time.utc_ns += kStatedDate_ns - first_ns;
    report.remarks.push_back(advances ? "times are those of the device's own clock"
                                      : fmt::format("{}, at {} Bd", kNoTimes, port.baud));
  }

  // From a stated time on the bytes follow one another on the wire, until the next one.
  const std::int64_t byte_ns = 10'000'000'000 / port.baud, latency_ns = std::llround(port.latency_s * 1e9);
  const auto arrival_ns = [&](const StatedTime& from, std::uint64_t end) {
    return from.utc_ns + latency_ns +
           (static_cast<std::int64_t>(end) - static_cast<std::int64_t>(from.offset)) * byte_ns;
  };
  LogBuilder builder(settings, log);
  record::RawRead read;
  read.time_ns = mapping.at_ns = report.start_utc_ns = arrival_ns(times.front(), 0);
  builder.begin({read.time_ns, mapping});
  builder.tell("info", "import",
               fmt::format("of {} ({}){}{}", report.input, report.format, report.remarks.empty() ? "" : "; ",
                           fmt::join(report.remarks, "; ")));
  std::size_t at = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const bool is_last = i + 1 == times.size();
    const std::size_t end = is_last ? bytes.size() : times[i + 1].offset;
    const std::int64_t latest_ns = is_last ? INT64_MAX : times[i + 1].utc_ns + latency_ns;
    while (at < end) {
      constexpr std::size_t kRead = 32;
      const auto piece = bytes.subspan(at, std::min(kRead, end - at));
      at += piece.size();
      read.time_ns = std::max(read.time_ns, std::min(latest_ns, arrival_ns(times[i], at)));
      read.bytes.assign(piece.begin(), piece.end());
      builder.take(read);
      progress(static_cast<double>(at) / static_cast<double>(bytes.size()));
    }
  }
  report.duration_ns = read.time_ns - report.start_utc_ns;
  for (auto& [of, taken] : report.taken) taken.last_ns = report.duration_ns;
  const std::uint64_t written = builder.pipeline().statistics(0).samples;
  report.refused = survey.samples - std::min(written, survey.samples);
  if (report.refused > 0) report.left["sample (repeated, or out of range)"] = report.refused;
  if (!file.is_whole()) throw record::BadRecording(report.input + ": it was cut during the import");
  builder.commit();
  return report;
}

}  // namespace navcal::analysis
