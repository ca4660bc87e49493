// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/audit/findings.h"
#include "base/angles.h"

namespace navcal::analysis {
namespace {

/// The newest number of a series at a time, or nullopt where there is none within `most_s`.
std::optional<double> held_at(const Series& series, double time_s, double most_s) {
  const auto after = std::upper_bound(series.time_s.begin(), series.time_s.end(), time_s);
  if (after == series.time_s.begin()) return std::nullopt;
  const auto i = static_cast<std::size_t>(after - series.time_s.begin()) - 1;
  return time_s - series.time_s[i] <= most_s ? std::optional(series.values[i]) : std::nullopt;
}

/// Depth while a receiver has a fix: its antenna is out of the water then.
Finding surface_finding(const AuditedLog& log, const RecordedChannel& depth) {
  constexpr double kLeast_m = 0.5, kHeld_s = 1;
  Finding finding = finding_of("depth.surface", depth.port);
  Series at_surface;
  for (const auto& [port, fixes] : log.fixes) {
    for (const AuditedFix& fix : fixes) {
      if (!fix.valid) continue;
      if (const auto value = held_at(depth.series, fix.time_s, kHeld_s)) {
        at_surface.time_s.push_back(fix.time_s);
        at_surface.values.push_back(*value);
      }
    }
  }
  const auto offset = mean_bounded(block_means(at_surface.time_s, at_surface.values));
  if (!offset) {
    const double least_m = quantile(depth.series.values, 0.001);
    finding.certainty = Certainty::cannot_say;
    finding.sentence =
        fmt::format("No fix says when the vehicle was at the surface; the least depth is {:.2f} m.", least_m);
    if (least_m < -kLeast_m) {
      finding.certainty = Certainty::likely;
      put_value(finding, {least_m, least_m, least_m}, "m");
      finding.sentence = fmt::format("The gauge shows {:.2f} m, which is above the water.", least_m);
      finding.todo = "Set the gauge to zero at the surface.";
    }
    return finding;
  }
  put_value(finding, *offset, "m");
  finding.sentence = fmt::format("While a receiver has a fix the gauge shows {:.2f} m ({:.2f} to {:.2f}).",
                                 offset->value, offset->low, offset->high);
  if (offset->low > kLeast_m || offset->high < -kLeast_m) {
    finding.certainty = Certainty::likely;  // it may hang below the antenna
    finding.todo = "Compare with how deep the gauge hangs below the antenna; set it to zero at the surface.";
    finding.picture =
        AuditPicture{"Depth at the fixes", "seconds from the beginning", "m", "", {{"depth", {}, false}}};
    for (std::size_t i = 0; i < at_surface.values.size(); i += at_surface.values.size() / 2000 + 1)
      finding.picture->traces.front().points.emplace_back(at_surface.time_s[i], at_surface.values[i]);
  }
  return finding;
}

/// Distances to the bottom that are zero: no echo.
void append_zeros(std::vector<Finding>& findings, const RecordedChannel& channel, const std::string& name) {
  constexpr double kLeast = 0.01;
  const auto& values = channel.series.values;
  const auto zeros = std::count(values.begin(), values.end(), 0.0);
  const double share = static_cast<double>(zeros) / static_cast<double>(std::max(values.size(), std::size_t{1}));
  Finding finding = finding_of(name, channel.port);
  put_value(finding, {100 * share, 100 * share, 100 * share}, "%");
  finding.sentence = fmt::format("{} of {} distances are exactly zero.", zeros, values.size());
  if (share > kLeast) {
    finding.certainty = Certainty::found;
    finding.sentence += " The device writes zero for no echo.";
    finding.todo = "Leave them out: they are no distances.";
  }
  findings.push_back(std::move(finding));
}

/// Fixes that their own velocities contradict.
void append_receiver(std::vector<Finding>& findings, const std::string& port,
                     const std::vector<AuditedFix>& fixes) {
  constexpr double kFar_m = 25, kSigmas = 6, kLongest_s = 5;
  const auto valid = std::count_if(fixes.begin(), fixes.end(), [](const AuditedFix& fix) { return fix.valid; });
  if (valid == 0) {
    Finding none = finding_of("gps.jumps", port);
    none.certainty = Certainty::cannot_say;
    none.sentence = fmt::format("None of {} messages has a fix.", fixes.size());
    none.todo = "Wait for a fix before the mission; look at antenna and cable.";
    findings.push_back(std::move(none));
    return;
  }
  std::vector<double> misses_m, misses_s;
  const AuditedFix* before = nullptr;
  for (const AuditedFix& fix : fixes) {
    if (!fix.valid) continue;
    const double took_s = before == nullptr ? 0 : fix.time_s - before->time_s;
    if (took_s > 0 && took_s < kLongest_s && fix.speed_m_s && fix.course_rad) {
      const double north_m =
          fix.position_m[0] - before->position_m[0] - *fix.speed_m_s * std::cos(*fix.course_rad) * took_s;
      const double east_m =
          fix.position_m[1] - before->position_m[1] - *fix.speed_m_s * std::sin(*fix.course_rad) * took_s;
      misses_m.push_back(std::hypot(north_m, east_m));
      misses_s.push_back(fix.time_s);
    }
    before = &fix;
  }
  Finding finding = finding_of("gps.jumps", port);
  if (misses_m.size() < 20) {
    finding.certainty = Certainty::cannot_say;
    finding.sentence = "There are too few fixes with a velocity, one after the other.";
    findings.push_back(std::move(finding));
    return;
  }
  // The median of a Rayleigh distribution is 1.18 sigma.
  const double limit_m = std::max(kFar_m, kSigmas * quantile(misses_m, 0.5) / 1.18);
  const auto jumps = std::count_if(misses_m.begin(), misses_m.end(), [&](double miss) { return miss > limit_m; });
  const double largest_m = *std::max_element(misses_m.begin(), misses_m.end());
  put_value(finding, {static_cast<double>(jumps), static_cast<double>(jumps), static_cast<double>(jumps)}, "");
  finding.sentence = fmt::format(
      "{} of {} fixes lie more than {:.0f} m from where the fix before and the velocity put them; "
      "the largest miss is {:.1f} m.",
      jumps, misses_m.size(), limit_m, largest_m);
  if (jumps > 0) {
    finding.certainty = Certainty::found;
    finding.position_m = largest_m;
    finding.todo = "Refuse fixes that their velocities contradict; look at the sky that the antenna sees.";
    finding.picture = AuditPicture{
        "Fix less the fix before and the velocity", "seconds from the beginning", "m", "", {{"miss", {}, false}}};
    for (std::size_t i = 0; i < misses_m.size(); ++i)
      finding.picture->traces.front().points.emplace_back(misses_s[i], misses_m[i]);
  }
  findings.push_back(std::move(finding));
}

/// Speed of a Doppler log against that of a receiver. The ratio of sums over blocks: noise of either is small
/// against these speeds.
Finding doppler_scale(const AuditedLog& log, const std::string& port) {
  constexpr double kLeast_m_s = 0.5, kApart_s = 1, kLeast = 0.02;
  Finding finding = finding_of("dvl.scale", port);
  std::vector<double> time_s, logs;
  for (const auto& [receiver, fixes] : log.fixes) {
    for (const AuditedFix& fix : fixes) {
      if (!fix.valid || fix.speed_m_s.value_or(0) < kLeast_m_s) continue;
      double square = 0;
      bool known = true;
      for (const char* axis : {"bottom_velocity_1", "bottom_velocity_2"}) {
        const RecordedChannel* const channel = log.find(port, axis);
        const auto value = channel == nullptr ? std::nullopt : held_at(channel->series, fix.time_s, kApart_s);
        known = known && value.has_value();
        square += value.value_or(0) * value.value_or(0);
      }
      if (!known || square == 0) continue;
      time_s.push_back(fix.time_s);
      logs.push_back(std::log(*fix.speed_m_s / std::sqrt(square)));
    }
  }
  const auto mean = mean_bounded(block_means(time_s, logs));
  if (!mean) {
    finding.certainty = Certainty::cannot_say;
    finding.sentence = "Receiver and Doppler log have too few velocities at the same times.";
    finding.todo = "Run at the surface with bottom lock for some minutes.";
    return finding;
  }
  const Bounded scale{std::exp(mean->value), std::exp(mean->low), std::exp(mean->high)};
  put_value(finding, scale, "");
  finding.sentence = fmt::format("Speed of the receiver over that of the Doppler log: {:.3f} ({:.3f} to {:.3f}).",
                                 scale.value, scale.low, scale.high);
  if (scale.low > 1 + kLeast || scale.high < 1 - kLeast) {
    finding.certainty = Certainty::likely;
    finding.position_m = std::abs(scale.value - 1) * log.speed_m_s() * kCostTime_s;
    finding.todo = "Check the speed of sound that the Doppler log reckons with.";
  }
  return finding;
}

void append_doppler(std::vector<Finding>& findings, const AuditedLog& log, const RecordedChannel& first) {
  constexpr double kLeast = 0.01;
  const RecordedChannel* const second = log.find(first.port, "bottom_velocity_2");
  Finding finding = finding_of("dvl.zeros", first.port);
  std::size_t zeros = 0;
  const auto& values = first.series.values;
  for (std::size_t i = 0; i < values.size(); ++i)
    zeros += values[i] == 0 &&
                     (second == nullptr || (i < second->series.values.size() && second->series.values[i] == 0))
                 ? 1U
                 : 0U;
  const double share = static_cast<double>(zeros) / static_cast<double>(std::max(values.size(), std::size_t{1}));
  put_value(finding, {100 * share, 100 * share, 100 * share}, "%");
  finding.sentence = fmt::format("{} of {} velocities are exactly zero.", zeros, values.size());
  if (share > kLeast) {
    // A device at rest may round to zero, too.
    finding.certainty = share < 1 ? Certainty::likely : Certainty::cannot_say;
    finding.todo = "Take zeros as no bottom lock; log the device's own validity.";
    if (share < 1) finding.position_m = share * log.speed_m_s() * kCostTime_s;
  }
  findings.push_back(std::move(finding));
  findings.push_back(doppler_scale(log, first.port));
}

}  // namespace

std::vector<Finding> water_findings(const AuditedLog& log) {
  std::vector<Finding> findings;
  for (const char* quantity : {"depth", "gauge_depth"}) {
    for (const RecordedChannel* channel : log.all(quantity)) findings.push_back(surface_finding(log, *channel));
  }
  for (const RecordedChannel* channel : log.all("altitude")) append_zeros(findings, *channel, "altimeter.zeros");
  for (const auto& [port, fixes] : log.fixes) append_receiver(findings, port, fixes);
  for (const RecordedChannel* channel : log.all("bottom_velocity_1")) append_doppler(findings, log, *channel);
  return findings;
}

}  // namespace navcal::analysis
