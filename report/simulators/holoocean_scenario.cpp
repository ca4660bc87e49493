// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "base/angles.h"
#include "report/simulators/transfer.h"

// Sources are named at the head of representation.cpp. Places and angles of sensors, and the world, have x forward
// (north), y to port (west) and z up; the keys of the dynamics have z down.
namespace navcal::report {
namespace {

using HoloOceanJson = nlohmann::ordered_json;

/// Scenario in parts that effects change.
struct HoloOceanParts {
  HoloOceanJson dynamics, actuator, imu, depth, gps, magnetometer;
};

/// From axes forward, starboard, down to forward, port, up.
Eigen::Vector3d with_z_up(const Eigen::Vector3d& v) { return {v.x(), -v.y(), -v.z()}; }

HoloOceanJson json_list(const Eigen::Vector3d& v) { return {v.x() + 0.0, v.y() + 0.0, v.z() + 0.0}; }

HoloOceanJson holoocean_sensor(const char* type, double rate_Hz, HoloOceanJson configuration) {
  return {{"sensor_type", type}, {"Hz", rate_Hz}, {"configuration", std::move(configuration)}};
}

HoloOceanJson holoocean_dynamics(const config::VehicleSettings& vehicle) {
  const auto& hull = vehicle.hull;
  return {{"rho", vehicle.water.density_kg_m3},
          {"mass", hull.mass_kg},
          {"length", hull.length_m},
          {"diam", hull.diameter_m},
          {"r_bg", {0, 0, hull.gravity_below_m}},
          {"r_bb", {0, 0, 0}},
          {"area_fraction", hull.lift_area_factor},
          {"zeta_roll", vehicle.damping.roll_ratio},
          {"zeta_pitch", vehicle.damping.pitch_ratio},
          {"T_yaw", 1 / vehicle.damping.yaw_per_s},
          {"r44", hull.roll_added_factor},
          {"Cd", hull.axial_drag}};
}

HoloOceanJson holoocean_actuator(const config::VehicleSettings& vehicle) {
  // The first of three fins points up; the line of thrust over advance is given by its ends.
  constexpr double kFirstFin_deg = 270, kMostAdvance = 0.6632, kSecondsPerMinute = 60;
  const auto& fins = vehicle.fins;
  const auto& propeller = vehicle.propeller;
  return {{"fin_count", 3},
          {"fin_offset_deg", kFirstFin_deg},
          {"fin_center", fins.radius_m},
          {"fin_area", fins.area_m2},
          {"x_fin", fins.station_m},
          {"CL_delta", fins.lift_slope_per_rad},
          {"deltaMax_fin_deg", fins.limit_rad * base::kDegreesPerRadian},
          {"T_delta", fins.lag_s},
          {"nMax", kSecondsPerMinute * vehicle.autopilot.shaft_limit_rps},
          {"T_n", propeller.lag_s},
          {"D_prop", propeller.diameter_m},
          {"KT_0", propeller.thrust_at_rest},
          {"KT_max", propeller.thrust_at_rest + propeller.thrust_slope * kMostAdvance},
          {"KQ_0", propeller.torque},
          {"KQ_max", propeller.torque},
          {"w", 0},
          {"t_prop", 0},
          {"Ja_max", kMostAdvance}};
}

/// The Earth's field as the magnetometer measures it: uT where the diagnosis states it.
Eigen::Vector3d holoocean_field(const gap::Diagnosis& diagnosis) {
  if (!diagnosis.field) return Eigen::Vector3d::UnitX();
  const auto& [north, east, down] = diagnosis.field->north_east_down_uT;
  return {north, east, down};
}

HoloOceanParts holoocean_parts(const CorrectedModel& model) {
  const auto& instruments = model.instruments;
  HoloOceanParts parts;
  parts.dynamics = holoocean_dynamics(model.vehicle);
  parts.actuator = holoocean_actuator(model.vehicle);
  parts.imu = holoocean_sensor(
      "IMUSensor", instruments.imu.timing.rate_Hz,
      {{"AccelSigma", instruments.imu.force_noise_m_s2}, {"AngVelSigma", instruments.imu.gyro_noise_rad_s}});
  parts.depth =
      holoocean_sensor("DepthSensor", instruments.imu.timing.rate_Hz, {{"Sigma", instruments.imu.depth_noise_m}});
  parts.gps =
      holoocean_sensor("GPSSensor", instruments.gps.timing.rate_Hz,
                       {{"Sigma", instruments.gps.position_noise_m}, {"Depth", instruments.gps.antenna_depth_m}});
  HoloOceanJson compass{{"MagneticVector", json_list(with_z_up(holoocean_field(model.diagnosis)))}};
  if (model.diagnosis.field) compass["Sigma"] = instruments.compass.field_noise_uT;
  parts.magnetometer =
      holoocean_sensor("MagnetometerSensor", instruments.compass.timing.rate_Hz, std::move(compass));
  return parts;
}

/// Applies one effect; answers why the scenario cannot have it, or an empty text.
std::string apply_to_holoocean(const TransferredEffect& effect, const CorrectedModel& model,
                               HoloOceanParts& parts) {
  const auto scale = [&](const char* key, double factor) {
    parts.actuator[key] = factor * parts.actuator[key].get<double>();
  };
  const std::string& name = effect.name();
  if (name == "compass_misalignment") {
    const Eigen::Vector3d turn_rad =
        base::kRadiansPerDegree * with_z_up({effect["x_deg"], effect["y_deg"], effect["z_deg"]});
    const double angle = turn_rad.norm();
    if (angle == 0) return {};
    const Eigen::Matrix3d R = Eigen::AngleAxisd(angle, turn_rad / angle).toRotationMatrix();
    parts.magnetometer["rotation"] = json_list(base::kDegreesPerRadian * fixed_axis_angles(R));
  } else if (name == "declination") {
    const Eigen::AngleAxisd turn(effect["angle_deg"] * base::kRadiansPerDegree, Eigen::Vector3d::UnitZ());
    parts.magnetometer["configuration"]["MagneticVector"] =
        json_list(with_z_up(turn * holoocean_field(model.diagnosis)));
  } else if (name == "gps_lever_arm") {
    parts.gps["location"] = json_list(with_z_up({effect["x_m"], effect["y_m"], 0}));
  } else if (name == "thrust_scale") {
    for (const char* key : {"KT_0", "KT_max"}) scale(key, 1 + effect["scale"]);
  } else if (name == "fin_gain") {
    scale("CL_delta", 1 + effect["scale"]);
  } else if (name == "fin_lag") {
    parts.actuator["T_delta"] = model.vehicle.fins.lag_s + effect["tau_s"];
  } else if (name == "yaw_damping") {
    const double damping_per_s = model.vehicle.damping.yaw_per_s + effect["per_s"];
    if (damping_per_s <= 0) return "damping that is not positive has no time constant";
    parts.dynamics["T_yaw"] = 1 / damping_per_s;
  } else {
    return "this version of navcal has no conversion for it";
  }
  return {};
}

HoloOceanJson about_json(const CorrectedModel& model, const Transfer& transfer) {
  HoloOceanJson effects = HoloOceanJson::array(), left_out = HoloOceanJson::array();
  for (const auto& effect : transfer.effects()) effects.push_back(about(effect, Simulator::holoocean));
  for (const auto& [effect, reason] : transfer.left_out())
    left_out.push_back({{"name", effect}, {"reason", reason}});
  std::vector<std::string> text = about(model, transfer);
  text.emplace_back(
      "HoloOcean's torpedo is another model than navcal's vehicle: keys without a counterpart have HoloOcean's "
      "defaults.");
  if (!model.diagnosis.field)
    text.emplace_back(
        "The diagnosis states no field of the Earth: MagneticVector is a unit vector without noise.");
  return {{"about", std::move(text)}, {"effects", std::move(effects)}, {"left_out", std::move(left_out)}};
}

}  // namespace

SimulatorFile holoocean_scenario(const CorrectedModel& model) {
  Transfer transfer(model.diagnosis, Simulator::holoocean);
  HoloOceanParts parts = holoocean_parts(model);
  const std::vector<TransferredEffect> effects = transfer.effects();
  for (const TransferredEffect& effect : effects) {
    const HoloOceanParts before = parts;
    if (auto reason = apply_to_holoocean(effect, model, parts); !reason.empty()) {
      parts = before;
      transfer.leave_out(effect.name(), std::move(reason));
    }
  }
  constexpr int kCustomDynamics = 1, kTicksPerSecond = 200;
  constexpr double kStartDepth_m = 5;
  const HoloOceanJson dynamics_sensor{{"sensor_type", "DynamicsSensor"},
                                      {"configuration", {{"UseCOM", true}, {"UseRPY", false}}}};
  const HoloOceanJson agent{{"agent_name", "auv0"},
                            {"agent_type", "TorpedoAUV"},
                            {"sensors",
                             {dynamics_sensor, std::move(parts.imu), std::move(parts.depth), std::move(parts.gps),
                              std::move(parts.magnetometer)}},
                            {"control_scheme", kCustomDynamics},
                            {"location", {0, 0, -kStartDepth_m}},
                            {"rotation", {0, 0, 0}},
                            {"fossen_model", "torpedo"},
                            {"control_mode", "manualControl"},
                            {"dynamics", std::move(parts.dynamics)},
                            {"actuator", std::move(parts.actuator)}};
  const HoloOceanJson scenario{{"name", "navcal"},
                               {"world", "OpenWater"},
                               {"package_name", "Ocean"},
                               {"main_agent", "auv0"},
                               {"ticks_per_sec", kTicksPerSecond},
                               {"navcal", about_json(model, transfer)},
                               {"agents", HoloOceanJson::array({agent})}};
  // A file name may be invalid UTF-8.
  return {scenario.dump(2, ' ', false, HoloOceanJson::error_handler_t::replace) + '\n',
          summary_of(model.diagnosis, transfer)};
}

}  // namespace navcal::report
