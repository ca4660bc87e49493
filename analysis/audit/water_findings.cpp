// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/audit/audit.h"

namespace navcal::analysis {
namespace {

constexpr double kLeastDepth_m = 0.5, kDive_m = 1, kFarFix_m = 25, kJumpSigmas = 6, kLongestStep_s = 5,
                 kZeros_pc = 1;
constexpr double kLeastSpeed_m_s = 0.5, kLeastRatio = 0.02, kApart_s = 2;
constexpr std::size_t kFewestFixes = 20;

/// Depth while a receiver has a fix: its antenna is out of the water then.
Finding surface_finding(const AuditedLog& log, const RecordedChannel& depth) {
  Finding finding{"depth.surface", "Depth at the surface", depth.port};
  finding.todo = "Compare with how deep the gauge hangs below the antenna; set it to zero at the surface.";
  Series surface;
  for (const RecordedChannel* fixes : log.all("north")) {
    for (const double time_s : fixes->series.time_s) {
      const auto value = value_at(depth.series, time_s, kApart_s);
      if (!value) continue;
      surface.time_s.push_back(time_s);
      surface.values.push_back(*value);
    }
  }
  const auto offset = mean_bounded(block_means(surface.time_s, surface.values));
  const double shallow_m = quantile(depth.series.values, 0.001);
  if (!offset && shallow_m < -kLeastDepth_m) {
    finding.certainty = Certainty::likely;
    finding.put_count(shallow_m, "m");
    finding.sentence = fmt::format("The least depth is {:.2f} m, which is above the water.", shallow_m);
    return finding;
  }
  const double upper_m = quantile(surface.values, 0.05), lower_m = quantile(surface.values, 0.95);
  // Fixes tell the surface only of a vehicle that has none below it.
  const bool is_surface =
      lower_m - upper_m < kLeastDepth_m && quantile(depth.series.values, 0.95) > lower_m + kDive_m;
  if (!offset || !is_surface)
    return finding.cannot(
        fmt::format("No dive between fixes says what the gauge shows at the surface; the least depth is {:.2f} m.",
                    shallow_m));
  finding.put(*offset, "m");
  finding.sentence = fmt::format("While a receiver has a fix the gauge shows {:.2f} m.", offset->value);
  // The gauge may hang below the antenna.
  if (finding.is_beyond(-kLeastDepth_m, kLeastDepth_m)) finding.certainty = Certainty::likely;
  return finding;
}

/// Readings that are exactly zero where a device has nothing to say.
Finding zeros_finding(Finding finding, const Series& first, const Series* second, const char* words) {
  double zeros = 0;
  const auto count = static_cast<double>(first.values.size());
  for (std::size_t i = 0; i < first.values.size(); ++i) {
    const bool other = second == nullptr || (i < second->values.size() && second->values[i] == 0);
    if (first.values[i] == 0 && other) ++zeros;
  }
  const double share = count > 0 ? 100 * zeros / count : 0;
  finding.put_count(share, "%");
  finding.sentence = fmt::format("{} of {} {} are exactly zero.", zeros, count, words);
  if (share <= kZeros_pc) return finding;
  finding.certainty =
      share < 100 ? Certainty::likely : Certainty::cannot_say;  // a device at rest may round to zero
  finding.todo = "Take zeros as no echo or no bottom lock; log the device's own validity.";
  return finding;
}

/// Fixes that their own velocities contradict.
Finding jumps_finding(const AuditedLog& log, const RecordedChannel& north) {
  Finding finding{"gps.jumps", "Jumps of the receiver", north.port};
  AuditPicture::Points misses;
  std::vector<double> misses_m, steps_s;
  const RecordedChannel* const east = log.find(north.port, "east");  // in the same samples as north
  for (std::size_t i = 1; east != nullptr && i < north.series.values.size(); ++i) {
    const double time_s = north.series.time_s[i], took_s = time_s - north.series.time_s[i - 1];
    const auto ahead_m_s = log.at(north.port, "velocity_north", time_s, 0);
    const auto aside_m_s = log.at(north.port, "velocity_east", time_s, 0);
    if (took_s <= 0 || took_s > kLongestStep_s || !ahead_m_s || !aside_m_s) continue;
    misses_m.push_back(std::hypot(north.series.values[i] - north.series.values[i - 1] - *ahead_m_s * took_s,
                                  east->series.values[i] - east->series.values[i - 1] - *aside_m_s * took_s));
    misses.emplace_back(time_s, misses_m.back());
    steps_s.push_back(took_s);
  }
  if (misses_m.size() < kFewestFixes) return finding.cannot("Too few fixes with a velocity follow one another.");
  if (quantile(steps_s, 0.9) > 1.6 * quantile(steps_s, 0.5))
    return finding.cannot(
        "The fixes have uneven times, so that a velocity does not tell where the next one is due.");
  // The median of a Rayleigh distribution is 1.18 sigma.
  const double limit_m = std::max(kFarFix_m, kJumpSigmas * quantile(misses_m, 0.5) / 1.18);
  const auto jumps = std::ranges::count_if(misses_m, [&](double miss_m) { return miss_m > limit_m; });
  const double largest_m = *std::max_element(misses_m.begin(), misses_m.end());
  finding.put_count(static_cast<double>(jumps), "");
  finding.sentence = fmt::format(
      "{} of {} fixes lie more than {:.0f} m from where the fix before and the velocity put them; the largest "
      "miss is {:.1f} m.",
      jumps, misses_m.size(), limit_m, largest_m);
  if (jumps == 0) return finding;
  finding.certainty = Certainty::found;
  finding.position_m = largest_m;
  finding.todo = "Refuse fixes that their velocities contradict; look at the sky that the antenna sees.";
  finding.picture = {
      "Fix less the fix before and the velocity", "seconds from the beginning", "m", {{"miss", misses}}};
  return finding;
}

/// Speed of a Doppler log against that of a receiver, where noise of either is small against the speed.
Finding doppler_scale(const AuditedLog& log, const std::string& port) {
  Finding finding{"dvl.scale", "Scale of the Doppler log", port};
  std::vector<double> time_s, ratios;
  for (const RecordedChannel* north : log.all("velocity_north")) {
    for (std::size_t i = 0; i < north->series.values.size(); ++i) {
      const double at_s = north->series.time_s[i];
      const auto east = log.at(north->port, "velocity_east", at_s, 0);
      const auto one = log.at(port, "bottom_velocity_1", at_s, kApart_s);
      const auto two = log.at(port, "bottom_velocity_2", at_s, kApart_s);
      const double ground_m_s = std::hypot(north->series.values[i], east.value_or(0));
      const double doppler_m_s = std::hypot(one.value_or(0), two.value_or(0));
      // Chosen by the speed with less noise: of slow runs a limit would keep the receiver's upward errors only.
      if (doppler_m_s < kLeastSpeed_m_s || ground_m_s <= 0) continue;
      time_s.push_back(at_s);
      ratios.push_back(std::log(ground_m_s / doppler_m_s));
    }
  }
  const auto mean = mean_bounded(block_means(time_s, ratios));
  if (!mean)
    return finding.cannot("Receiver and Doppler log have too few velocities at the same times.",
                          "Run at the surface with bottom lock for some minutes.");
  finding.put({std::exp(mean->value), std::exp(mean->low), std::exp(mean->high)}, "");
  finding.sentence = fmt::format("Speed of the receiver over that of the Doppler log is {:.3f}.", *finding.value);
  if (!finding.is_beyond(1 - kLeastRatio, 1 + kLeastRatio)) return finding;
  finding.certainty = Certainty::likely;
  finding.position_m = std::abs(*finding.value - 1) * log.speed_m_s() * kCostTime_s;
  finding.todo = "Check the speed of sound that the Doppler log reckons with.";
  return finding;
}

}  // namespace

std::vector<Finding> water_findings(const AuditedLog& log) {
  std::vector<Finding> findings;
  for (const char* quantity : {"depth", "gauge_depth"}) {
    for (const RecordedChannel* channel : log.all(quantity)) findings.push_back(surface_finding(log, *channel));
  }
  for (const RecordedChannel* channel : log.all("altitude"))
    findings.push_back(zeros_finding({"altimeter.zeros", "Zeros of the altimeter", channel->port}, channel->series,
                                     nullptr, "distances"));
  for (const RecordedChannel* channel : log.all("north")) findings.push_back(jumps_finding(log, *channel));
  for (const RecordedChannel* channel : log.all("bottom_velocity_1")) {
    const RecordedChannel* const second = log.find(channel->port, "bottom_velocity_2");
    findings.push_back(zeros_finding({"dvl.zeros", "Zeros of the Doppler log", channel->port}, channel->series,
                                     second != nullptr ? &second->series : nullptr, "velocities"));
    findings.push_back(doppler_scale(log, channel->port));
  }
  return findings;
}

}  // namespace navcal::analysis
