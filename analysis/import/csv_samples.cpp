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
  CsvSamples::Shape shape = CsvSamples::Shape::number;  ///< others: this is the first of three meanings in a row
};

constexpr std::array kTargets{
    Target{CsvMeaning::heading, "COMPASS", PortKind::compass, "heading_rad"},
    Target{CsvMeaning::pitch, "COMPASS", PortKind::compass, "pitch_rad"},
    Target{CsvMeaning::roll, "COMPASS", PortKind::compass, "roll_rad"},
    Target{CsvMeaning::compass_temperature, "COMPASS", PortKind::compass, "temperature_C"},
    Target{CsvMeaning::field_x, "COMPASS", PortKind::compass, "field_body_uT", CsvSamples::Shape::vector},
    Target{CsvMeaning::rate_x, "IMU", PortKind::imu, "rate_rad_s", CsvSamples::Shape::vector},
    Target{CsvMeaning::rate_yaw_b, "IMU", PortKind::imu, "yaw_rate_b_rad_s"},
    Target{CsvMeaning::imu_depth, "IMU", PortKind::imu, "depth_m"},
    Target{CsvMeaning::force_x, "IMU", PortKind::imu, "specific_force_m_s2", CsvSamples::Shape::vector},
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
    Target{CsvMeaning::bottom_velocity_x, "DVL", PortKind::dvl, "bottom_velocity_m_s", CsvSamples::Shape::vector},
    Target{CsvMeaning::water_velocity_x, "DVL", PortKind::dvl, "water_velocity_m_s", CsvSamples::Shape::vector},
    Target{CsvMeaning::rpm, "MOTOR", PortKind::motor, "rpm"},
    Target{CsvMeaning::rpm_commanded, "MOTOR", PortKind::motor, "rpm_commanded"},
    Target{CsvMeaning::fin_1, "MOTOR", PortKind::motor, "fins_rad", CsvSamples::Shape::three},
    Target{CsvMeaning::motor_current, "MOTOR", PortKind::motor, "current_A"},
    Target{CsvMeaning::voltage, "POWER", PortKind::battery, "voltage_V"},
    Target{CsvMeaning::current, "POWER", PortKind::battery, "current_A"},
};

/// Angles that are written from 0 to 360 degrees, whatever the file has.
bool is_heading(std::string_view key) { return key == "heading_rad" || key == "course_rad"; }

}  // namespace

CsvSamples::Group& CsvSamples::group_of(std::string_view class_name, std::string_view port) {
  const auto found = std::find_if(groups_.begin(), groups_.end(), [&](const Group& group) {
    return group.port == port && group.class_name == class_name;
  });
  if (found != groups_.end()) return *found;
  groups_.push_back(
      {std::string(class_name), std::string(port), fmt::format("{} {}", class_name, port), {}, {}, {}});
  return groups_.back();
}

CsvSamples::CsvSamples(const config::CsvMap& map) {
  const auto place_of = [&](CsvMeaning meaning, int instance) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < map.columns.size(); ++i) {
      if (map.columns[i].meaning == meaning && map.columns[i].instance == instance) return i;
    }
    return std::nullopt;
  };
  constexpr int kInstances = 9;
  for (const Target& target : kTargets) {
    for (int instance = 0; instance < kInstances; ++instance) {
      Member member{target.shape, {}, std::string(target.key)};
      const std::size_t count = target.shape == Shape::number ? 1 : member.columns.size();
      std::size_t found = 0;
      for (std::size_t i = 0; i < count; ++i) {
        member.columns[i] =
            place_of(static_cast<CsvMeaning>(static_cast<std::size_t>(target.meaning) + i), instance);
        if (member.columns[i]) ++found;
      }
      if (found == 0 || (target.shape == Shape::vector && found < count)) continue;
      group_of(target.class_name, port_name(target.port, instance)).members.push_back(std::move(member));
    }
  }
  for (std::size_t i = 0; i < map.columns.size(); ++i) {
    const auto& column = map.columns[i];
    if (column.meaning != CsvMeaning::sensor) continue;
    groups_.push_back({"SENSOR",
                       std::string(port_name(PortKind::sensors, column.instance)),
                       fmt::format("SENSOR {}", column.quantity),
                       {{Shape::number, {i}, "value"}},
                       column.quantity,
                       column.unit});
  }
}

bool CsvSamples::write(const Member& member, const std::vector<std::optional<double>>& values, LineWriter& line) {
  std::array<std::optional<double>, 3> three;
  for (std::size_t i = 0; i < three.size(); ++i) {
    if (member.columns[i]) three[i] = values[*member.columns[i]];
  }
  switch (member.shape) {
    case Shape::number:
      if (!three[0]) return false;
      line.number(member.key, is_heading(member.key) ? base::as_heading(*three[0]) : *three[0]);
      return true;
    case Shape::vector:
      if (!three[0] || !three[1] || !three[2]) return false;
      line.vector(member.key, {*three[0], *three[1], *three[2]});
      return true;
    case Shape::three:
      if (!three[0] && !three[1] && !three[2]) return false;
      line.three(member.key, three);
      return true;
  }
  return false;
}

void CsvSamples::emit(std::int64_t time_ns, const std::vector<std::optional<double>>& values,
                      ImportSink& sink) const {
  for (const Group& group : groups_) {
    LineWriter line(group.class_name);
    if (group.class_name == "SENSOR") line.text("quantity", group.quantity).text("unit", group.unit);
    if (group.class_name == "DVL") line.text("frame", "body");
    bool has_any = false;
    for (const Member& member : group.members) {
      if (write(member, values, line)) has_any = true;
    }
    // A position is a fix, although the file says nothing of its quality.
    if (has_any && group.class_name == "GPS") line.text("fix", "3d");
    if (has_any) sink.sample({group.message, group.port, time_ns}, line);
  }
}

}  // namespace navcal::analysis
