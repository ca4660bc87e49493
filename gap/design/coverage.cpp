// SPDX-License-Identifier: Apache-2.0
#include "gap/design/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/angles.h"

namespace navcal::gap {
namespace {

constexpr double kScale_s = 5, kSeen_s = 2;

/// A quantity in bands of equal width; values beyond belong to the outermost bands.
struct Bands {
  std::string_view name, unit;
  double first, width;
  int count;

  [[nodiscard]] int index(double value) const {
    return std::clamp(static_cast<int>(std::floor((value - first) / width)), 0, count - 1);
  }
  [[nodiscard]] std::string words(int i) const {
    const double from = first + i * width;
    return fmt::format("{} {:g} to {:g} {}", name, from, from + width, unit);
  }
};

enum Quantity7 : std::size_t { shaft, turn, deep, pitch, roll, head, since };
constexpr std::array<Bands, 7> kBands{{{"shaft speed", "rpm", 0, 150, 9},
                                       {"rate of turn", "deg/s", -52.5, 15, 7},
                                       {"depth", "m", 0, 1, 12},
                                       {"pitch", "deg", -35, 10, 7},
                                       {"roll", "deg", -15, 6, 5},
                                       {"heading", "deg", 0, 45, 8},
                                       {"time since the start", "s", 0, 120, 10}}};

Eigen::Index offset_of(std::size_t quantity) {
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < quantity; ++i) at += kBands[i].count;
  return at;
}

Eigen::Index joint_offset() { return offset_of(kBands.size()); }

void add(const std::array<double, 7>& values, Coverage& seconds) {
  for (std::size_t i = 0; i < kBands.size(); ++i)
    seconds[offset_of(i) + kBands[i].index(values[i])] += kInterval_s;
  const int row = kBands[shaft].index(values[shaft]), column = kBands[turn].index(values[turn]);
  seconds[joint_offset() + row * kBands[turn].count + column] += kInterval_s;
}

double heading_deg(double rad) {
  const double deg = std::fmod(rad * base::kDegreesPerRadian, 360);
  return deg < 0 ? deg + 360 : deg;
}

}  // namespace

Coverage no_coverage() {
  return Coverage::Zero(joint_offset() + Eigen::Index{kBands[shaft].count} * kBands[turn].count);
}

Coverage coverage_of(const Trajectory10Hz& course) {
  Coverage seconds = no_coverage();
  for (std::size_t i = 0; i < course.time_s.size(); ++i) {
    add({course.shaft_rps[i] * 60, course.yaw_rate_rad_s[i] * base::kDegreesPerRadian, course.depth_m[i],
         course.pitch_rad[i] * base::kDegreesPerRadian, course.roll_rad[i] * base::kDegreesPerRadian,
         heading_deg(course.heading_rad[i]), course.time_s[i]},
        seconds);
  }
  return seconds;
}

Coverage coverage_of(const PlannedPath& path, double from_s, double until_s) {
  Coverage seconds = no_coverage();
  for (std::size_t i = 0; i < path.time_s.size(); ++i) {
    if (path.time_s[i] < from_s || path.time_s[i] >= until_s) continue;
    add({path.shaft_rps[i] * 60, path.turn_rad_s[i] * base::kDegreesPerRadian, path.depth_m[i],
         path.pitch_rad[i] * base::kDegreesPerRadian, path.roll_rad[i] * base::kDegreesPerRadian,
         heading_deg(path.heading_rad[i]), path.time_s[i]},
        seconds);
  }
  return seconds;
}

double coverage_loss(const Coverage& seconds) { return (-seconds.array() / kScale_s).exp().sum(); }

std::vector<std::string> newly_covered(const Coverage& before, const Coverage& after) {
  std::vector<std::string> words;
  for (std::size_t quantity = 0; quantity < kBands.size(); ++quantity) {
    for (int i = 0; i < kBands[quantity].count; ++i) {
      const Eigen::Index at = offset_of(quantity) + i;
      if (before[at] < kSeen_s && after[at] >= kSeen_s) words.push_back(kBands[quantity].words(i));
    }
  }
  return words;
}

}  // namespace navcal::gap
