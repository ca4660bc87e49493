// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/csv_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/angles.h"

namespace navcal::analysis {
namespace {

using config::CsvMeaning;
using protocols::samples_line::LineWriter;

/// Where a meaning goes: class, source instrument and key of the line.
struct Target {
  CsvMeaning meaning;
  std::string_view class_name;
  PortKind port;
  std::string_view key;
  int components = 1;  ///< 3: this is the x of a vector
};

constexpr std::array kTargets{
    Target{CsvMeaning::heading, "COMPASS", PortKind::compass, "heading_rad"},
    Target{CsvMeaning::pitch, "COMPASS", PortKind::compass, "pitch_rad"},
    Target{CsvMeaning::roll, "COMPASS", PortKind::compass, "roll_rad"},
    Target{CsvMeaning::field_x, "COMPASS", PortKind::compass, "field_body_uT", 3},
    Target{CsvMeaning::rate_x, "IMU", PortKind::imu, "rate_rad_s", 3},
    Target{CsvMeaning::force_x, "IMU", PortKind::imu, "specific_force_m_s2", 3},
    Target{CsvMeaning::lat, "GPS", PortKind::gps, "lat"},
    Target{CsvMeaning::lon, "GPS", PortKind::gps, "lon"},
    Target{CsvMeaning::height, "GPS", PortKind::gps, "height_m"},
    Target{CsvMeaning::height_msl, "GPS", PortKind::gps, "height_msl_m"},
    Target{CsvMeaning::speed, "GPS", PortKind::gps, "speed_m_s"},
    Target{CsvMeaning::course, "GPS", PortKind::gps, "course_rad"},
    Target{CsvMeaning::climb, "GPS", PortKind::gps, "climb_m_s"},
    Target{CsvMeaning::depth, "DEPTH", PortKind::depth, "depth_m"},
    Target{CsvMeaning::pressure, "DEPTH", PortKind::depth, "pressure_Pa"},
    Target{CsvMeaning::altitude, "ALTIMETER", PortKind::altimeter, "altitude_m"},
    Target{CsvMeaning::bottom_velocity_x, "DVL", PortKind::dvl, "bottom_velocity_m_s", 3},
    Target{CsvMeaning::water_velocity_x, "DVL", PortKind::dvl, "water_velocity_m_s", 3},
    Target{CsvMeaning::rpm, "MOTOR", PortKind::motor, "rpm"},
    Target{CsvMeaning::rpm_commanded, "MOTOR", PortKind::motor, "rpm_commanded"},
    Target{CsvMeaning::fin_1, "MOTOR", PortKind::motor, "fins_rad", 3},
    Target{CsvMeaning::voltage, "POWER", PortKind::battery, "voltage_V"},
    Target{CsvMeaning::current, "POWER", PortKind::battery, "current_A"},
};

/// Angles that are written from 0 to 360 degrees, whatever the file has.
bool is_heading(std::string_view key) { return key == "heading_rad" || key == "course_rad"; }

}  // namespace

CsvSamples::CsvSamples(const config::CsvMap& map) {
  const auto place_of = [&](CsvMeaning meaning, int instance) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < map.columns.size(); ++i) {
      if (map.columns[i].meaning == meaning && map.columns[i].instance == instance) return i;
    }
    return std::nullopt;
  };
  for (const Target& target : kTargets) {
    for (std::size_t i = 0; i < map.columns.size(); ++i) {
      const auto& column = map.columns[i];
      if (column.meaning != target.meaning) continue;
      const std::string port(port_name(target.port, column.instance));
      auto group = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) {
        return g.port == port && g.class_name == target.class_name;
      });
      if (group == groups_.end()) {
        groups_.push_back(
            {std::string(target.class_name), port, fmt::format("{} {}", target.class_name, port), {}, {}, {}});
        group = groups_.end() - 1;
      }
      Member member{i, {}, {}, std::string(target.key)};
      if (target.components == 3) {
        const auto next = [&](int n) { return static_cast<CsvMeaning>(static_cast<int>(target.meaning) + n); };
        member.second = place_of(next(1), column.instance);
        member.third = place_of(next(2), column.instance);
        if (!member.second || !member.third) continue;
      }
      group->members.push_back(std::move(member));
    }
  }
  for (std::size_t i = 0; i < map.columns.size(); ++i) {
    const auto& column = map.columns[i];
    if (column.meaning != CsvMeaning::sensor) continue;
    groups_.push_back({"SENSOR",
                       std::string(port_name(PortKind::sensors, column.instance)),
                       fmt::format("SENSOR {}", column.quantity),
                       {{i, {}, {}, "value"}},
                       column.quantity,
                       column.unit});
  }
}

void CsvSamples::emit(std::int64_t time_ns, const std::vector<std::optional<double>>& values,
                      ImportSink& sink) const {
  for (const Group& group : groups_) {
    LineWriter line(group.class_name);
    if (group.class_name == "SENSOR") line.text("quantity", group.quantity).text("unit", group.unit);
    if (group.class_name == "DVL") line.text("frame", "body");
    bool has_any = false;
    for (const Member& member : group.members) {
      const auto& value = values[member.first];
      if (!value) continue;
      if (member.second) {
        if (!values[*member.second] || !values[*member.third]) continue;
        line.vector(member.key, {*value, *values[*member.second], *values[*member.third]});
      } else {
        line.number(member.key, is_heading(member.key) ? base::as_heading(*value) : *value);
      }
      has_any = true;
    }
    // A position is a fix, although the file says nothing of its quality.
    if (has_any && group.class_name == "GPS") line.text("fix", "3d");
    if (has_any) sink.sample({group.message, group.port, time_ns}, line);
  }
}

}  // namespace navcal::analysis
