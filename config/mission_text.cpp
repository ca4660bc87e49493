// SPDX-License-Identifier: Apache-2.0
#include "config/mission_text.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <vector>

#include "config/mission_options.h"

namespace navcal::config {
namespace {

constexpr double kDegrees_per_rad = 180 / std::numbers::pi;

double shown(double value) { return std::round(value * 1e4) / 1e4 + 0.0; }

std::string escaped_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

/// A number of a step with its key in the file, and the file's unit.
struct StepNumber {
  std::string_view key;
  std::optional<double> MissionStep::*value;
  double scale;
};

const std::vector<StepNumber>& step_numbers() {
  using S = MissionStep;
  static const std::vector<StepNumber> numbers{{"heading_deg", &S::heading_rad, kDegrees_per_rad},
                                               {"by_deg", &S::by_rad, kDegrees_per_rad},
                                               {"turns", &S::turns, 1},
                                               {"stations", nullptr, 1},
                                               {"rate_deg_s", &S::rate_rad_s, kDegrees_per_rad},
                                               {"depth_m", &S::depth_m, 1},
                                               {"rudder_deg", &S::rudder_rad, kDegrees_per_rad},
                                               {"elevator_deg", &S::elevator_rad, kDegrees_per_rad},
                                               {"fin1_deg", &S::fin1_rad, kDegrees_per_rad},
                                               {"fin2_deg", &S::fin2_rad, kDegrees_per_rad},
                                               {"fin3_deg", &S::fin3_rad, kDegrees_per_rad},
                                               {"reach_deg", &S::reach_rad, kDegrees_per_rad},
                                               {"amplitude_deg", &S::amplitude_rad, kDegrees_per_rad},
                                               {"shaft_rpm", &S::shaft_rps, 60},
                                               {"speed_m_s", &S::speed_m_s, 1},
                                               {"seconds", &S::seconds, 1},
                                               {"metres", &S::metres, 1}};
  return numbers;
}

std::string step_text(const MissionStep& step) {
  const auto& kinds = step_options()[0].choices;
  const auto& surfaces = step_options()[1].choices;
  std::string out = fmt::format("{{do = \"{}\"", kinds.at(static_cast<std::size_t>(step.kind)));
  const auto at = std::back_inserter(out);
  if (step.kind == StepKind::doublet) {
    fmt::format_to(at, ", on = \"{}\"", surfaces.at(static_cast<std::size_t>(step.on)));
  }
  for (const StepNumber& number : step_numbers()) {
    if (number.value == nullptr) {
      if (step.stations) fmt::format_to(at, ", stations = {}", *step.stations);
    } else if (const auto& value = step.*number.value) {
      fmt::format_to(at, ", {} = {}", number.key, shown(*value * number.scale));
    }
  }
  if (step.times) fmt::format_to(at, ", times = {}", *step.times);
  return out + '}';
}

}  // namespace

std::string mission_text(const Mission& mission, std::string_view head) {
  std::string out;
  const auto at = std::back_inserter(out);
  while (!head.empty()) {
    const auto end = head.find('\n');
    fmt::format_to(at, "# {}\n", head.substr(0, end));
    head = end == std::string_view::npos ? std::string_view() : head.substr(end + 1);
  }
  const MissionStart& start = mission.start;
  if (!mission.description.empty()) {
    fmt::format_to(at, "mission.description = \"{}\"\n", escaped_text(mission.description));
  }
  fmt::format_to(at, "mission.at_end = \"{}\"\n", mission.at_end == MissionEnd::repeat ? "repeat" : "hold");
  fmt::format_to(at, "start.heading_deg = {}\nstart.depth_m = {}\nstart.speed_m_s = {}\nstart.shaft_rpm = {}\n",
                 shown(start.heading_rad * kDegrees_per_rad), shown(start.depth_m), shown(start.speed_m_s),
                 shown(start.shaft_rps * 60));
  out += "\nstep = [\n";
  for (const MissionStep& step : mission.steps) fmt::format_to(at, "  {},\n", step_text(step));
  return out + "]\n";
}

}  // namespace navcal::config
