// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "base/gravity.h"
#include "report/simulators/transfer.h"

// Sources are named at the head of representation.cpp. Bodies have x forward, y to starboard and z down, the world
// is north, east, down; angles are in radians.
namespace navcal::report {
namespace {

/// Values that effects change; empty where none does.
struct StonefishParts {
  std::optional<Eigen::Vector3d> current_m_s;       ///< north, east, down
  std::optional<double> mass_kg;                    ///< of the base link
  std::optional<Eigen::Vector3d> antenna_m;         ///< place of the gps
  std::optional<double> compass_yaw_rad;            ///< heading of the compass less that of the vehicle
  std::optional<Eigen::Vector2d> inclinometer_rad;  ///< roll, pitch
  std::optional<double> thrust_at_rest;             ///< coefficient
  std::optional<double> fin_lift_per_rad;
  std::optional<std::array<double, 3>> fin_offset_rad;
};

std::string number(double value) { return fmt::format("{}", value + 0.0); }

std::string triple(const Eigen::Vector3d& v) {
  return fmt::format("{} {} {}", number(v.x()), number(v.y()), number(v.z()));
}

/// Adds the shares of the three fins in a deflection of rudder or elevator (docs/simulator.md).
void add_fin_offset(StonefishParts& parts, double angle_deg, const std::array<double, 3>& shares) {
  auto& offset_rad = parts.fin_offset_rad;
  if (!offset_rad) offset_rad.emplace();
  for (std::size_t i = 0; i < shares.size(); ++i)
    (*offset_rad)[i] += shares[i] * angle_deg * base::kRadiansPerDegree;
}

/// Applies one effect; answers why the scenario cannot have it, or an empty text.
std::string apply_to_stonefish(const TransferredEffect& effect, const CorrectedModel& model,
                               StonefishParts& parts) {
  constexpr double kElevatorShare = std::numbers::sqrt3 / 2;
  const std::string& name = effect.name();
  if (name == "water_current") {
    parts.current_m_s = {effect["north_m_s"], effect["east_m_s"], 0};
  } else if (name == "buoyancy") {
    const double mass_kg = model.vehicle.hull.mass_kg - effect["force_N"] / base::kGravity_m_s2;
    if (mass_kg <= 0) return "the mass would not be positive";
    parts.mass_kg = mass_kg;
  } else if (name == "gps_lever_arm") {
    parts.antenna_m = {effect["x_m"], effect["y_m"], 0};
  } else if (name == "compass_misalignment") {
    parts.compass_yaw_rad = parts.compass_yaw_rad.value_or(0) + effect["z_deg"] * base::kRadiansPerDegree;
  } else if (name == "declination") {
    parts.compass_yaw_rad = parts.compass_yaw_rad.value_or(0) - effect["angle_deg"] * base::kRadiansPerDegree;
  } else if (name == "tilt_offset") {
    parts.inclinometer_rad = base::kRadiansPerDegree * Eigen::Vector2d(effect["roll_deg"], effect["pitch_deg"]);
  } else if (name == "thrust_scale") {
    parts.thrust_at_rest = (1 + effect["scale"]) * model.vehicle.propeller.thrust_at_rest;
  } else if (name == "fin_gain") {
    parts.fin_lift_per_rad = (1 + effect["scale"]) * model.vehicle.fins.lift_slope_per_rad;
  } else if (name == "fin_offset") {
    add_fin_offset(parts, effect["angle_deg"], {-1, 0.5, 0.5});
  } else if (name == "elevator_offset") {
    add_fin_offset(parts, effect["angle_deg"], {0, kElevatorShare, -kElevatorShare});
  } else {
    return "this version of navcal has no conversion for it";
  }
  return {};
}

/// Attitude of a rudder in the body: x forward, y along the force of a positive angle, turned about the shaft.
/// `span` is the direction of the fin from the hull, (y, z).
Eigen::Matrix3d rudder_attitude(const Eigen::Vector2d& span, double offset_rad) {
  const double roll = std::atan2(span.x(), -span.y());
  return (Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(offset_rad, Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

void append_rudders(std::string& xml, const CorrectedModel& model, const StonefishParts& parts) {
  if (!parts.fin_lift_per_rad && !parts.fin_offset_rad) return;
  const auto& fins = model.vehicle.fins;
  constexpr double kShare = std::numbers::sqrt3 / 2;
  const std::array<Eigen::Vector2d, 3> spans{Eigen::Vector2d(0, -1), {kShare, 0.5}, {-kShare, 0.5}};
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const Eigen::Vector3d place(fins.station_m, fins.radius_m * spans[i].x(), fins.radius_m * spans[i].y());
    const double offset_rad = parts.fin_offset_rad ? (*parts.fin_offset_rad)[i] : 0;
    xml += fmt::format(
        "    <actuator name=\"Fin{}\" type=\"rudder\">\n"
        "      <specs lift_coeff=\"{}\" area=\"{}\" max_angle=\"{}\"/>\n"
        "      <origin xyz=\"{}\" rpy=\"{}\"/>\n"
        "    </actuator>\n",
        i + 1, number(parts.fin_lift_per_rad.value_or(fins.lift_slope_per_rad)), number(fins.area_m2),
        number(fins.limit_rad), triple(place), triple(fixed_axis_angles(rudder_attitude(spans[i], offset_rad))));
  }
}

void append_sensor(std::string& xml, std::string_view name, std::string_view type, std::string_view noise,
                   const Eigen::Vector3d& place_m, const Eigen::Vector3d& attitude_rad) {
  xml += fmt::format(
      "    <sensor name=\"{}\" type=\"{}\">\n"
      "      <noise {}/>\n"
      "      <origin xyz=\"{}\" rpy=\"{}\"/>\n"
      "    </sensor>\n",
      name, type, noise, triple(place_m), triple(attitude_rad));
}

void append_sensors(std::string& xml, const CorrectedModel& model, const StonefishParts& parts) {
  const auto& instruments = model.instruments;
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  if (parts.antenna_m) {
    append_sensor(xml, "GPS", "gps", fmt::format("ned_position=\"{}\"", number(instruments.gps.position_noise_m)),
                  *parts.antenna_m, origin);
  }
  if (parts.compass_yaw_rad) {
    append_sensor(xml, "Compass", "compass",
                  fmt::format("heading=\"{}\"", number(instruments.compass.heading_noise_rad())), origin,
                  {0, 0, *parts.compass_yaw_rad});
  }
  if (parts.inclinometer_rad) {
    const std::string noise = number(instruments.compass.tilt_noise_rad);
    append_sensor(xml, "Inclinometer", "imu", fmt::format("angle=\"{} {} 0\"", noise, noise), origin,
                  {parts.inclinometer_rad->x(), parts.inclinometer_rad->y(), 0});
  }
}

void append_robot(std::string& xml, const CorrectedModel& model, const StonefishParts& parts) {
  std::string robot;
  if (parts.mass_kg) {
    robot += fmt::format("    <base_link name=\"Vehicle\">\n      <mass value=\"{}\"/>\n    </base_link>\n",
                         number(*parts.mass_kg));
  }
  append_sensors(robot, model, parts);
  if (parts.thrust_at_rest) {  // nothing when reversed, as in navcal's vehicle
    robot += fmt::format(
        "    <actuator name=\"Thruster\" type=\"thruster\">\n"
        "      <thrust_model type=\"fluid_dynamics\">\n"
        "        <thrust_coeff forward=\"{}\" reverse=\"0\"/>\n"
        "      </thrust_model>\n"
        "    </actuator>\n",
        number(*parts.thrust_at_rest));
  }
  append_rudders(robot, model, parts);
  if (!robot.empty()) xml += "  <robot name=\"Vehicle\">\n" + robot + "  </robot>\n";
}

/// A comment of one paragraph. XML allows no "--" within.
std::string xml_comment(std::string paragraph) {
  constexpr std::size_t kLongestLine = 110;
  for (std::size_t at = 0; (at = paragraph.find("--", at)) != std::string::npos; ++at)
    paragraph.insert(at + 1, " ");
  return "<!--\n" + comment_lines(paragraph, "  ", kLongestLine) + "-->\n";
}

/// The text with anything that is not ASCII as a question mark: a file name may be invalid UTF-8.
std::string as_ascii(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) > 0x7f) c = '?';
  }
  return text;
}

}  // namespace

SimulatorFile stonefish_scenario(const CorrectedModel& model) {
  Transfer transfer(model.diagnosis, Simulator::stonefish);
  StonefishParts parts;
  std::vector<std::string> effect_texts;
  const std::vector<TransferredEffect> effects = transfer.effects();
  for (const TransferredEffect& effect : effects) {
    if (auto reason = apply_to_stonefish(effect, model, parts); !reason.empty()) {
      transfer.leave_out(effect.name(), std::move(reason));
      continue;
    }
    effect_texts.push_back(about(effect, Simulator::stonefish));
  }
  std::vector<std::string> head = about(model, transfer);
  head.emplace_back(
      "Elements of a scenario, to be taken over into yours: names of links, thrusters and rudders are examples, "
      "and geometry, materials and looks are missing.");
  std::string xml = "<?xml version=\"1.0\"?>\n";
  for (const auto& texts : {head, effect_texts}) {
    for (const std::string& paragraph : texts) xml += xml_comment(as_ascii(paragraph));
  }
  xml += "<scenario>\n";
  if (parts.current_m_s) {
    xml += fmt::format(
        "  <environment>\n    <ocean>\n      <current type=\"uniform\">\n        <velocity xyz=\"{}\"/>\n"
        "      </current>\n    </ocean>\n  </environment>\n",
        triple(*parts.current_m_s));
  }
  append_robot(xml, model, parts);
  return {xml + "</scenario>\n", summary_of(model.diagnosis, transfer)};
}

}  // namespace navcal::report
