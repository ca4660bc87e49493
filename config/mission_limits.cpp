// SPDX-License-Identifier: Apache-2.0
#include "config/mission_limits.h"

#include <fmt/format.h>

#include <utility>

#include "config/complaints.h"
#include "config/option_lookup.h"

namespace navcal::config {
namespace {

constexpr Unit kMinutes{"min", 60, 1};
constexpr Unit kWattHours{"Wh"};

std::vector<Option<MissionLimits>> make_mission_limit_options() {
  using L = MissionLimits;
  const auto limits = table_of<L>("limits", std::identity());
  return {
      limits.number("minutes", &L::duration_s, kMinutes, 1, 120),
      limits.number("min_depth_m", &L::least_depth_m, kMetres, 0.15, 100),
      limits.number("max_depth_m", &L::greatest_depth_m, kMetres, 0.3, 1000),
      limits.number("max_range_m", &L::range_m, kMetres, 5, 10000),
      limits.number("max_speed_m_s", &L::speed_m_s, kMetresPerSecond, 0.3, 10),
      limits.number("max_shaft_rpm", &L::shaft_rps, kRpm, 60, 60000),
      limits.number("max_turn_deg_s", &L::turn_rad_s, kDegreesPerSecond, 5, 90),
      limits.number("energy_Wh", &L::energy_Wh, kWattHours, 0.1, 1e6),
      limits.number("supply_V", &L::supply_V, kVolts, 1, 1000),
      limits.number("hotel_A", &L::hotel_A, kAmperes, 0, 1000),
  };
}

}  // namespace

const std::vector<Option<MissionLimits>>& mission_limit_options() {
  static const std::vector<Option<MissionLimits>> options = make_mission_limit_options();
  return options;
}

MissionLimits parse_mission_limits(std::string_view toml, std::string_view name) {
  std::vector<Problem> problems;
  MissionLimits limits;
  unsigned depth_line = 1;
  for (const Entry& entry : read_document(toml, problems)) {
    if (auto refused = take_entry(mission_limit_options(), limits, entry)) {
      problems.push_back({entry.line, entry.name(), std::move(*refused)});
    }
    if (entry.name() == "limits.max_depth_m" || entry.name() == "limits.min_depth_m") depth_line = entry.line;
  }
  if (!(limits.least_depth_m < limits.greatest_depth_m)) {
    problems.push_back({depth_line, "limits.max_depth_m",
                        fmt::format("{} m is not more than the least depth, {} m", limits.greatest_depth_m,
                                    limits.least_depth_m)});
  }
  refuse(std::move(problems), name);
  return limits;
}

MissionLimits load_mission_limits(const std::filesystem::path& file) {
  return parse_mission_limits(content_of(file), file.native());
}

std::string mission_limits_file(const MissionLimits& limits) {
  std::string out =
      "# Limits of a planned mission: navcal gap next --limits FILE. What is not given is as here.\n[limits]\n";
  for (const Option<MissionLimits>& option : mission_limit_options()) {
    out += fmt::format("\n# {} ({})\n{} = {}\n", option.description, option.allowed(), option.key,
                       option.write(option.get(limits)));
  }
  return out;
}

}  // namespace navcal::config
