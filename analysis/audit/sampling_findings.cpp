// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/audit/audit.h"

namespace navcal::analysis {
namespace {

constexpr std::size_t kFewestReadings = 20;
constexpr double kMissing = 1.6;      ///< periods between readings from which on one is missing
constexpr double kIrregular_pc = 20;  ///< share of such intervals from which on there is no rate
constexpr double kLongGap_s = 1, kLongGap_periods = 5, kFrozen_s = 2, kFrozen_periods = 10, kFewestMissing = 5;
constexpr double kSeldom_s = 2;  ///< period of a vehicle that samples now and then, by design
constexpr double kMissing_pc = 2, kRepeated_pc = 20, kLost_pc = 0.5, kReversed_pc = 0.1;

double percent(double part, double whole) { return whole > 0 ? 100 * part / whole : 0; }

struct Rhythm {
  double period_s = 0, mean_s = 0, jitter_s = 0, missing = 0, expected = 0;
  double longest_s = 0, longest_at_s = 0;
  double intervals = 0, long_ones = 0, reversed = 0;
};

Rhythm rhythm_of(const std::vector<double>& time_s) {
  Rhythm rhythm;
  std::vector<double> forward;
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    if (time_s[i] > time_s[i - 1]) forward.push_back(time_s[i] - time_s[i - 1]);
  }
  rhythm.period_s = quantile(forward, 0.5);
  if (!(rhythm.period_s > 0)) return rhythm;
  double squares = 0, regular = 0;
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    const double interval_s = time_s[i] - time_s[i - 1];
    ++rhythm.intervals;
    if (interval_s < -rhythm.period_s / 2) ++rhythm.reversed;
    const double periods = std::max(std::round(interval_s / rhythm.period_s), 1.0);
    rhythm.expected += periods;
    if (interval_s > kMissing * rhythm.period_s) {
      ++rhythm.long_ones;
      rhythm.missing += periods - 1;
    } else {
      squares += (interval_s - rhythm.period_s) * (interval_s - rhythm.period_s);
      ++regular;
    }
    if (interval_s <= rhythm.longest_s) continue;
    rhythm.longest_s = interval_s;
    rhythm.longest_at_s = time_s[i - 1];
  }
  rhythm.mean_s = (time_s.back() - time_s.front()) / rhythm.intervals;
  rhythm.jitter_s = regular > 0 ? std::sqrt(squares / regular) : 0;
  return rhythm;
}

/// One point stands for the longest of some intervals.
AuditPicture intervals_picture(const std::vector<double>& time_s) {
  AuditPicture::Points points;
  const std::size_t step = time_s.size() / 2000 + 1;
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    const double interval_s = time_s[i] - time_s[i - 1];
    if (i % step == 1 || step == 1) points.emplace_back(time_s[i], interval_s);
    points.back().second = std::max(points.back().second, interval_s);
  }
  return {"Time between readings",
          "seconds from the beginning",
          "time between readings, s",
          {{"intervals", std::move(points)}}};
}

Finding rhythm_finding(const AuditedStream& stream, const Rhythm& rhythm) {
  Finding finding{"sampling.rate", "Rate", stream.channel};
  const double rate_Hz = 1 / rhythm.period_s, missing_pc = percent(rhythm.missing, rhythm.expected);
  if (const double share = percent(rhythm.long_ones, rhythm.intervals); share > kIrregular_pc) {
    finding = {"sampling.irregular", "Irregular readings", stream.channel, Certainty::found};
    finding.put_count(share, "%");
    finding.sentence = fmt::format(
        "{} of {} intervals are longer than {} times their median of {:.3g} s; the longest is {:.3g} s.",
        rhythm.long_ones, rhythm.intervals, kMissing, rhythm.period_s, rhythm.longest_s);
    finding.todo = "If the device is set to a fixed rate, look for a loaded bus or logger.";
  } else if (rhythm.longest_s > std::max(kLongGap_s, kLongGap_periods * rhythm.period_s) ||
             (missing_pc > kMissing_pc && rhythm.missing >= kFewestMissing)) {
    finding = {"sampling.gaps", "Gaps", stream.channel, Certainty::found};
    finding.put_count(missing_pc, "%");
    finding.sentence = fmt::format(
        "{} of {} readings at {:.3g} Hz are missing, in {} gaps; the longest is {:.3g} s, from {:.1f} s on.",
        rhythm.missing, rhythm.expected, rate_Hz, rhythm.long_ones, rhythm.longest_s, rhythm.longest_at_s);
    finding.todo = "Look at cable, supply and load of the logger at the time of the longest gap.";
    const bool is_seldom = rhythm.period_s > kSeldom_s;
    // Commands may be logged when they change.
    if (is_seldom || stream.kind == "motor") finding.certainty = Certainty::likely;
    if (is_seldom)
      finding.todo = "None where the vehicle samples so by design: in parts of a dive, or to save power.";
  } else {
    finding.put_count(rate_Hz, "Hz");
    finding.sentence = fmt::format("{} readings, {:.4g} Hz, jitter {:.3f} ms, longest interval {:.3g} s.",
                                   stream.time_s.size(), rate_Hz, 1000 * rhythm.jitter_s, rhythm.longest_s);
    return finding;
  }
  finding.picture = intervals_picture(stream.time_s);
  return finding;
}

}  // namespace

std::vector<Finding> sampling_findings(const AuditedLog& log) {
  std::vector<Finding> findings;
  const auto count = [&](std::string name, std::string title, std::string channel, double share) -> Finding& {
    findings.push_back({std::move(name), std::move(title), std::move(channel), Certainty::found});
    findings.back().put_count(share, "%");
    return findings.back();
  };
  if (!log.states_times)
    findings.push_back(Finding{"sampling.times", "Times", "all"}.cannot(
        "The file states no times: rates, gaps, repeated readings and delays cannot be judged."));
  for (const AuditedStream& stream : log.streams) {
    if (!log.states_times) break;
    if (stream.kind == "sensor") continue;  // mission sensors send what and when they like
    const Rhythm rhythm = rhythm_of(stream.time_s);
    if (stream.time_s.size() < kFewestReadings || !(rhythm.period_s > 0)) {
      findings.push_back({"sampling.rate", "Rate", stream.channel, Certainty::cannot_say});
      findings.back().sentence = fmt::format("There are only {} readings.", stream.time_s.size());
      continue;
    }
    findings.push_back(rhythm_finding(stream, rhythm));
    const auto repeated = static_cast<double>(stream.repeated), vectors = static_cast<double>(stream.vectors);
    if (const double share = percent(repeated, vectors);
        share > kRepeated_pc || stream.longest_equal_s > std::max(kFrozen_s, kFrozen_periods * rhythm.mean_s)) {
      Finding& finding = count("sampling.repeated", "Repeated readings", stream.channel, share);
      finding.sentence = fmt::format(
          "{} of {} readings equal the one before in all axes, for up to {:.3g} s: new values come {:.3g} times a "
          "second, not {:.3g}.",
          repeated, vectors, stream.longest_equal_s, (1 - share / 100) / rhythm.mean_s, 1 / rhythm.mean_s);
      finding.todo = share > kRepeated_pc ? "Log at the rate of the sensor, or read the sensor faster."
                                          : "Look at the bus of the sensor: it stopped for that time.";
    }
    if (const double share = percent(rhythm.reversed, rhythm.intervals); share > kReversed_pc) {
      Finding& finding = count("sampling.order", "Times in disorder", stream.channel, share);
      finding.sentence = fmt::format("{} of {} readings have a time before that of the reading before them.",
                                     rhythm.reversed, rhythm.intervals);
      finding.todo = "Take the time of the measurement, not of the transmission, and one clock for one sensor.";
    }
  }
  for (const auto& [port, statistics] : log.ports) {
    const auto lost = static_cast<double>(statistics.lost), taken = static_cast<double>(statistics.samples);
    if (taken < kFewestReadings || percent(lost, lost + taken) <= kLost_pc) continue;
    Finding& finding = count("sampling.lost", "Lost frames", port, percent(lost, lost + taken));
    finding.sentence =
        fmt::format("{} frames are missing by their own numbers or times; {} gave samples.", lost, taken);
    finding.todo = "Look at the line's speed, cable and level; a buffer that overruns loses whole frames.";
  }
  return findings;
}

}  // namespace navcal::analysis
