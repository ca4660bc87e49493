// SPDX-License-Identifier: Apache-2.0
#include "gap/design/coverage.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "base/angles.h"

namespace navcal::gap {
namespace {

constexpr double kLeastTime_s = 5;

/// What regimes depend on, at one instant.
struct SailedInstant {
  double turn_rate_rad_s = 0, depth_m = 0, pitch_rad = 0, heading_rad = 0, shaft_rps = 0;
};

/// Adds up the time in each regime.
class RegimeTimes {
 public:
  explicit RegimeTimes(const config::MissionLimits& limits) : limits_(limits) {}

  void add(const SailedInstant& now, double seconds) {
    turn(now.turn_rate_rad_s * base::kDegreesPerRadian, seconds);
    depth(now.depth_m, seconds);
    const double pitch_deg = now.pitch_rad * base::kDegreesPerRadian;
    if (pitch_deg > 8) times_["nose more than 8 degrees up"] += seconds;
    if (pitch_deg < -8) times_["nose more than 8 degrees down"] += seconds;
    if (now.shaft_rps < 1) {
      times_["motor off"] += seconds;
    } else {
      const double from = limits_.least_shaft_rps, range = limits_.greatest_shaft_rps - from;
      const int third = static_cast<int>(std::clamp(3 * (now.shaft_rps - from) / range, 0.0, 2.0));
      times_[fmt::format("shaft {:.0f} to {:.0f} rpm", 60 * (from + third * range / 3),
                         60 * (from + (third + 1) * range / 3))] += seconds;
    }
    constexpr std::array kQuadrants{"north", "east", "south", "west"};
    const double quarter = std::remainder(now.heading_rad, 2 * M_PI) / (M_PI / 2);
    times_[fmt::format("headings to the {}",
                       kQuadrants[static_cast<std::size_t>(std::lround(quarter) + 4) % 4])] += seconds;
  }

  [[nodiscard]] std::set<std::string> sailed() const {
    std::set<std::string> names;
    for (const auto& [name, seconds] : times_) {
      if (seconds >= kLeastTime_s) names.insert(name);
    }
    return names;
  }

 private:
  void turn(double rate_deg_s, double seconds) {
    constexpr std::array kEdges_deg_s{0.0, 4.0, 12.0, 25.0, 1e3};
    const double rate = std::abs(rate_deg_s);
    if (rate < kEdges_deg_s[1]) return void(times_["straight courses"] += seconds);
    for (std::size_t i = 1; i + 1 < kEdges_deg_s.size(); ++i) {
      if (rate >= kEdges_deg_s[i + 1]) continue;
      const char* const side = rate_deg_s > 0 ? "starboard" : "port";
      times_[i + 2 == kEdges_deg_s.size() ? fmt::format("turns beyond {:.0f} deg/s to {}", kEdges_deg_s[i], side)
                                          : fmt::format("turns of {:.0f} to {:.0f} deg/s to {}", kEdges_deg_s[i],
                                                        kEdges_deg_s[i + 1], side)] += seconds;
      return;
    }
  }
  void depth(double depth_m, double seconds) {
    if (depth_m < 0.35) return void(times_["at the surface"] += seconds);
    const double third_m = (limits_.greatest_depth_m - limits_.least_depth_m) / 3;
    const int third = static_cast<int>(std::clamp((depth_m - limits_.least_depth_m) / third_m, 0.0, 2.0));
    times_[fmt::format("{:.1f} to {:.1f} m deep", limits_.least_depth_m + third * third_m,
                       limits_.least_depth_m + (third + 1) * third_m)] += seconds;
  }

  const config::MissionLimits& limits_;
  std::map<std::string, double> times_;
};

}  // namespace

std::set<std::string> regimes_sailed(const Trajectory10Hz& course, const config::MissionLimits& limits) {
  RegimeTimes times(limits);
  for (std::size_t i = 0; i < course.time_s.size(); ++i) {
    times.add({course.yaw_rate_rad_s[i], course.depth_m[i], course.pitch_rad[i], course.heading_rad[i],
               course.shaft_rps[i]},
              0.1);
  }
  return times.sailed();
}

std::set<std::string> regimes_sailed(const std::vector<PlannedInstant>& track,
                                     const config::MissionLimits& limits) {
  RegimeTimes times(limits);
  for (const PlannedInstant& now : track) {
    times.add({now.turn_rate_rad_s, now.depth_m, now.pitch_rad, now.heading_rad, now.shaft_rps}, 1);
  }
  return times.sailed();
}

}  // namespace navcal::gap
