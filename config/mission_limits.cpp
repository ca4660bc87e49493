// SPDX-License-Identifier: Apache-2.0
#include "config/mission_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "config/complaints.h"
#include "config/document.h"
#include "config/suggestion.h"

namespace navcal::config {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

/// One key of the file: its range, in the unit that it states, and where it goes.
struct LimitKey {
  std::string_view name;
  double least = 0, greatest = 0;
  void (*set)(MissionLimits& limits, double value);
};

constexpr std::array kLimitKeys{
    LimitKey{"minutes", 0.5, 120, [](MissionLimits& l, double v) { l.duration_s = 60 * v; }},
    LimitKey{"least_depth_m", 0, 1000, [](MissionLimits& l, double v) { l.least_depth_m = v; }},
    LimitKey{"greatest_depth_m", 0, 1000, [](MissionLimits& l, double v) { l.greatest_depth_m = v; }},
    LimitKey{"radius_m", 5, 100'000, [](MissionLimits& l, double v) { l.radius_m = v; }},
    LimitKey{"least_shaft_rpm", 0, 6000, [](MissionLimits& l, double v) { l.least_shaft_rps = v / 60; }},
    LimitKey{"greatest_shaft_rpm", 1, 6000, [](MissionLimits& l, double v) { l.greatest_shaft_rps = v / 60; }},
    LimitKey{"greatest_turn_rate_deg_s", 1, 200,
             [](MissionLimits& l, double v) { l.greatest_turn_rate_rad_s = v * kRadians; }},
    LimitKey{"greatest_pitch_deg", 1, 80, [](MissionLimits& l, double v) { l.greatest_pitch_rad = v * kRadians; }},
    LimitKey{"energy_Wh", 0, 1e5, [](MissionLimits& l, double v) { l.energy_J = 3600 * v; }},
    LimitKey{"battery_V", 1, 1000, [](MissionLimits& l, double v) { l.battery_V = v; }}};

std::optional<double> number_of(const Entry& entry) {
  if (const auto* whole = std::get_if<std::int64_t>(&entry.value)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&entry.value)) return *real;
  return std::nullopt;
}

void take(const Entry& entry, MissionLimits& limits, std::vector<Problem>& problems) {
  const std::string name = entry.name();
  const auto* const key =
      std::find_if(kLimitKeys.begin(), kLimitKeys.end(), [&](const LimitKey& one) { return one.name == name; });
  if (key == kLimitKeys.end()) {
    std::vector<std::string> known;
    for (const LimitKey& one : kLimitKeys) known.emplace_back(one.name);
    problems.push_back({entry.line, name, "unknown key" + suggestion(name, known)});
    return;
  }
  const auto value = number_of(entry);
  if (!value || !(*value >= key->least && *value <= key->greatest)) {
    problems.push_back(
        {entry.line, name, fmt::format("a number from {} to {} is expected", key->least, key->greatest)});
    return;
  }
  key->set(limits, *value);
}

}  // namespace

MissionLimits parse_mission_limits(std::string_view toml, std::string_view name) {
  std::vector<Problem> problems;
  MissionLimits limits;
  for (const Entry& entry : read_document(toml, problems)) take(entry, limits, problems);
  if (problems.empty() && !(limits.least_depth_m < limits.greatest_depth_m)) {
    problems.push_back({1, "greatest_depth_m", "must be more than least_depth_m"});
  }
  if (problems.empty() && !(limits.least_shaft_rps < limits.greatest_shaft_rps)) {
    problems.push_back({1, "greatest_shaft_rpm", "must be more than least_shaft_rpm"});
  }
  refuse(std::move(problems), name);
  return limits;
}

MissionLimits load_mission_limits(const std::filesystem::path& file) {
  return parse_mission_limits(content_of(file), file.string());
}

}  // namespace navcal::config
