// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/audit/findings.h"

namespace navcal::analysis {
namespace {

constexpr std::size_t kFewestReadings = 20;
constexpr double kMissing = 1.6;     ///< periods between readings from which on one is missing
constexpr double kIrregular = 0.05;  ///< share of such intervals from which on there is no rate
constexpr double kLongGap_s = 1, kLongGap_periods = 5;
constexpr double kMissingShare = 0.02, kRepeatedShare = 0.2, kLostShare = 0.005, kReversedShare = 0.001;
constexpr double kFrozen_s = 2;

struct Rhythm {
  double period_s = 0, jitter_s = 0, missing = 0, expected = 0;
  double longest_s = 0, longest_at_s = 0;
  std::size_t long_intervals = 0, reversed = 0, intervals = 0;
};

Rhythm rhythm_of(const std::vector<double>& time_s) {
  Rhythm rhythm;
  std::vector<double> intervals;
  for (std::size_t i = 1; i < time_s.size(); ++i) intervals.push_back(time_s[i] - time_s[i - 1]);
  rhythm.intervals = intervals.size();
  std::vector<double> forward = intervals;
  std::erase_if(forward, [](double interval) { return !(interval > 0); });
  rhythm.period_s = quantile(forward, 0.5);
  if (!(rhythm.period_s > 0)) return rhythm;
  double squares = 0, regular = 0;
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const double interval = intervals[i];
    if (interval < -rhythm.period_s / 2) ++rhythm.reversed;
    rhythm.expected += std::max(std::round(interval / rhythm.period_s), 1.0);
    if (interval > kMissing * rhythm.period_s) {
      ++rhythm.long_intervals;
      rhythm.missing += std::round(interval / rhythm.period_s) - 1;
    } else {
      squares += (interval - rhythm.period_s) * (interval - rhythm.period_s);
      ++regular;
    }
    if (interval <= rhythm.longest_s) continue;
    rhythm.longest_s = interval;
    rhythm.longest_at_s = time_s[i];
  }
  rhythm.jitter_s = regular > 0 ? std::sqrt(squares / regular) : 0;
  return rhythm;
}

AuditPicture intervals_picture(const AuditedStream& stream) {
  constexpr std::size_t kMost = 4000;
  AuditPicture picture{"Time between readings of " + stream.port,
                       "seconds from the beginning",
                       "s",
                       "One point for each reading: the time since the one before.",
                       {{"intervals", {}, false}}};
  const std::size_t step = stream.time_s.size() / kMost + 1;
  for (std::size_t i = 1; i < stream.time_s.size(); i += step) {
    double longest = 0;  // of those that one point stands for
    for (std::size_t j = i; j < std::min(i + step, stream.time_s.size()); ++j)
      longest = std::max(longest, stream.time_s[j] - stream.time_s[j - 1]);
    picture.traces.front().points.emplace_back(stream.time_s[i], longest);
  }
  return picture;
}

Finding counted(Finding finding, double value, std::string unit) {
  finding.certainty = Certainty::found;
  put_value(finding, {value, value, value}, std::move(unit));
  return finding;
}

Finding rhythm_finding(const AuditedStream& stream, const Rhythm& rhythm) {
  const std::string channel = stream.port;
  const double rate_Hz = 1 / rhythm.period_s;
  const double share = rhythm.missing / std::max(rhythm.expected, 1.0);
  Finding finding = finding_of("sampling.rate", channel);
  if (static_cast<double>(rhythm.long_intervals) > kIrregular * static_cast<double>(rhythm.intervals)) {
    finding =
        counted(finding_of("sampling.irregular", channel),
                100.0 * static_cast<double>(rhythm.long_intervals) / static_cast<double>(rhythm.intervals), "%");
    finding.sentence = fmt::format(
        "{} of {} intervals are longer than {} times their median of {:.3g} s; the longest has {:.3g} s.",
        rhythm.long_intervals, rhythm.intervals, kMissing, rhythm.period_s, rhythm.longest_s);
    finding.todo = "If the device is set to a fixed rate, look for a loaded bus or logger; else nothing.";
    finding.picture = intervals_picture(stream);
    return finding;
  }
  const bool has_gap = rhythm.longest_s > std::max(kLongGap_s, kLongGap_periods * rhythm.period_s);
  if (has_gap || share > kMissingShare) {
    finding = counted(finding_of("sampling.gaps", channel), 100 * share, "%");
    finding.sentence = fmt::format(
        "{:.0f} of {:.0f} readings at {:.3g} Hz are missing, in {} gaps; the longest has {:.3g} s, from {:.1f} s "
        "on.",
        rhythm.missing, rhythm.expected, rate_Hz, rhythm.long_intervals, rhythm.longest_s, rhythm.longest_at_s);
    finding.todo = "Look at the cable, the supply and the load of the logger at the time of the longest gap.";
    finding.picture = intervals_picture(stream);
    return finding;
  }
  put_value(finding, {rate_Hz, rate_Hz, rate_Hz}, "Hz");
  finding.sentence = fmt::format("{} readings, {:.4g} Hz, jitter {:.2g} ms, longest interval {:.3g} s.",
                                 stream.time_s.size(), rate_Hz, 1000 * rhythm.jitter_s, rhythm.longest_s);
  return finding;
}

void append_repeated(std::vector<Finding>& findings, const AuditedStream& stream, double rate_Hz) {
  if (stream.vectors < kFewestReadings) return;
  const double share = static_cast<double>(stream.repeated) / static_cast<double>(stream.vectors);
  if (share < kRepeatedShare && stream.longest_equal_s < kFrozen_s) return;
  Finding finding = counted(finding_of("sampling.repeated", stream.port), 100 * share, "%");
  finding.sentence = fmt::format(
      "{} of {} readings are equal to the one before in all axes, for up to {:.2g} s: new values come {:.3g} "
      "times a "
      "second, not {:.3g}.",
      stream.repeated, stream.vectors, stream.longest_equal_s, rate_Hz * (1 - share), rate_Hz);
  finding.todo = share < kRepeatedShare ? "Look at the bus of the sensor: it stopped for that time."
                                        : "Log at the rate of the sensor, or read the sensor faster.";
  findings.push_back(std::move(finding));
}

void append_reversed(std::vector<Finding>& findings, const AuditedStream& stream, const Rhythm& rhythm) {
  const double share =
      static_cast<double>(rhythm.reversed) / static_cast<double>(std::max(rhythm.intervals, std::size_t{1}));
  if (share <= kReversedShare) return;
  Finding finding = counted(finding_of("sampling.order", stream.port), 100 * share, "%");
  finding.sentence = fmt::format("{} of {} readings have a time before that of the reading before them.",
                                 rhythm.reversed, rhythm.intervals);
  finding.todo = "Take the time of the measurement, not of the transmission, and one clock for one sensor.";
  findings.push_back(std::move(finding));
}

}  // namespace

std::vector<Finding> sampling_findings(const AuditedLog& log) {
  std::vector<Finding> findings;
  for (const AuditedStream& stream : log.streams) {
    if (stream.kind == "sensor") continue;  // mission sensors send what and when they like
    if (stream.time_s.size() < kFewestReadings) {
      Finding few = finding_of("sampling.rate", stream.port);
      few.certainty = Certainty::cannot_say;
      few.sentence = fmt::format("There are only {} readings.", stream.time_s.size());
      findings.push_back(std::move(few));
      continue;
    }
    const Rhythm rhythm = rhythm_of(stream.time_s);
    if (!(rhythm.period_s > 0)) continue;
    findings.push_back(rhythm_finding(stream, rhythm));
    append_repeated(findings, stream, 1 / rhythm.period_s);
    append_reversed(findings, stream, rhythm);
  }
  for (const auto& [port, statistics] : log.ports) {
    const auto sent = static_cast<double>(statistics.samples + statistics.lost);
    if (sent < kFewestReadings || static_cast<double>(statistics.lost) <= kLostShare * sent) continue;
    Finding finding =
        counted(finding_of("sampling.lost", port), 100 * static_cast<double>(statistics.lost) / sent, "%");
    finding.sentence = fmt::format("{} frames are missing by their own numbers or times; {} gave samples.",
                                   statistics.lost, statistics.samples);
    finding.todo = "Look at the line's speed, cable and level; a buffer that overruns loses whole frames.";
    findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace navcal::analysis
