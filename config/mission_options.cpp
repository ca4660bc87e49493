// SPDX-License-Identifier: Apache-2.0
#include "config/mission_options.h"

#include "config/text_rules.h"

namespace navcal::config {
namespace {

using M = Mission;
using Step = MissionStep;

/// A key that a step need not have. `InFile` is its type in the file.
template <class InFile, class T>
Option<Step> step_option(OptionInfo info, std::optional<T> Step::*value) {
  const Unit unit = info.unit;
  info.description = option_text(kUntitled<Step>, info.key);
  const auto get = [value, unit](const Step& step) {
    const auto& given = step.*value;
    if (!given) return Value(Unsupported{"nothing"});
    return Value(static_cast<InFile>(*given * unit.denominator / unit.numerator));
  };
  const auto set = [value, unit](Step& step, const Value& given) {
    step.*value = to_inside<T>(static_cast<double>(std::get<InFile>(given)), unit);
  };
  return {std::move(info), get, set};
}

Option<Step> number(std::string_view key, std::optional<double> Step::*value, Unit unit, double low, double high) {
  return step_option<double>({.key = key, .kind = Kind::real, .unit = unit, .low = low, .high = high}, value);
}

Option<Step> count(std::string_view key, std::optional<int> Step::*value, double low, double high) {
  return step_option<std::int64_t>({.key = key, .kind = Kind::integer, .low = low, .high = high}, value);
}

std::vector<Option<M>> make_mission_options() {
  const auto table = table_of<M>("mission", std::identity());
  const auto start = table_of<M>("start", &M::start);
  return {
      table.text("description", &M::description, is_printable, "a text without control characters"),
      table.choice("at_end", &M::at_end, {"repeat", "hold"}),
      start.number("heading_deg", &MissionStart::heading_rad, kDegrees, -360, 360),
      start.number("depth_m", &MissionStart::depth_m, kMetres, 0, 1000),
      start.number("speed_m_s", &MissionStart::speed_m_s, kMetresPerSecond, 0, 10),
      start.number("shaft_rpm", &MissionStart::shaft_rps, kRpm, 0, 60000),
  };
}

std::vector<Option<Step>> make_step_options() {
  const auto step = table_of<Step>("", std::identity());
  return {
      step.choice("do", &Step::kind,
                  {"leg", "turn", "circle", "spiral", "zigzag", "pirouette", "dive", "surface", "speed", "swing",
                   "doublet", "direct"}),
      step.choice("on", &Step::on, {"rudder", "elevator", "fin1", "fin2", "fin3"}),
      number("heading_deg", &Step::heading_rad, kDegrees, -360, 360),
      number("by_deg", &Step::by_rad, kDegrees, -36000, 36000),
      number("turns", &Step::turns, kNoUnit, -1000, 1000),
      count("stations", &Step::stations, 2, 360),
      number("rate_deg_s", &Step::rate_rad_s, kDegreesPerSecond, 0.1, 90),
      number("depth_m", &Step::depth_m, kMetres, 0, 1000),
      number("rudder_deg", &Step::rudder_rad, kDegrees, -50, 50),
      number("elevator_deg", &Step::elevator_rad, kDegrees, -50, 50),
      number("fin1_deg", &Step::fin1_rad, kDegrees, -80, 80),
      number("fin2_deg", &Step::fin2_rad, kDegrees, -80, 80),
      number("fin3_deg", &Step::fin3_rad, kDegrees, -80, 80),
      number("reach_deg", &Step::reach_rad, kDegrees, 1, 170),
      number("amplitude_deg", &Step::amplitude_rad, kDegrees, -50, 50),
      number("shaft_rpm", &Step::shaft_rps, kRpm, 0, 60000),
      number("speed_m_s", &Step::speed_m_s, kMetresPerSecond, 0.05, 10),
      number("seconds", &Step::seconds, kSeconds, 0.1, 1e6),
      number("metres", &Step::metres, kMetres, 0.1, 1e6),
      count("times", &Step::times, 1, 10000),
  };
}

}  // namespace

const std::vector<Option<M>>& mission_options() {
  static const std::vector<Option<M>> options = make_mission_options();
  return options;
}

const std::vector<Option<Step>>& step_options() {
  static const std::vector<Option<Step>> options = make_step_options();
  return options;
}

const StepRule& rule_of(StepKind kind) {
  // In the order of StepKind.
  static const std::vector<StepRule> rules{
      {{{"seconds", "metres"}}, {{"heading_deg", "by_deg"}, {"depth_m"}, {"shaft_rpm", "speed_m_s"}}},
      {{{"heading_deg", "by_deg"}}, {{"rate_deg_s"}, {"depth_m"}, {"shaft_rpm", "speed_m_s"}}},
      {{{"turns"}}, {{"rate_deg_s"}, {"depth_m"}, {"shaft_rpm", "speed_m_s"}}},
      {{{"turns"}, {"depth_m"}}, {{"rate_deg_s"}, {"shaft_rpm", "speed_m_s"}}},
      {{{"rudder_deg"}, {"reach_deg"}, {"times"}}, {{"depth_m"}, {"shaft_rpm", "speed_m_s"}}},
      {{{"turns"}, {"rudder_deg"}}, {{"depth_m"}, {"shaft_rpm", "speed_m_s"}}},
      {{{"depth_m"}}, {{"heading_deg", "by_deg"}, {"seconds"}, {"shaft_rpm", "speed_m_s"}}},
      {{{"seconds"}}, {{"heading_deg", "by_deg"}, {"shaft_rpm", "speed_m_s"}}},
      {{{"seconds"}, {"shaft_rpm", "speed_m_s"}}, {}},
      {{{"stations"}, {"seconds"}}, {{"rate_deg_s"}, {"depth_m"}, {"shaft_rpm", "speed_m_s"}}},
      {{{"on"}, {"amplitude_deg"}, {"seconds"}}, {{"times"}, {"shaft_rpm", "speed_m_s"}}},
      {{{"seconds"}},
       {{"rudder_deg", "fin1_deg"},
        {"elevator_deg", "fin2_deg"},
        {"elevator_deg", "fin3_deg"},
        {"rudder_deg", "fin2_deg"},
        {"rudder_deg", "fin3_deg"},
        {"elevator_deg", "fin1_deg"},
        {"shaft_rpm"}}},
  };
  return rules.at(static_cast<std::size_t>(kind));
}

}  // namespace navcal::config
