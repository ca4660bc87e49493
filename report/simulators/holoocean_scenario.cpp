// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <tuple>

#include "base/angles.h"
#include "report/simulators/transfer.h"

// Sources are named at the head of representation.cpp. Places and angles of sensors, and the world, have x forward
// (north), y to port (west) and z up; the keys of the dynamics have z down.
namespace navcal::report {

/// The scenario with all that is the same for every vehicle. The first of its three fins points up; control_scheme
/// 1 is the agent's own dynamics.
const char* holoocean_text();  // holoocean_scenario.json

namespace {

using HoloOceanJson = nlohmann::ordered_json;

/// Parts of the scenario that the vehicle and effects change.
struct HoloOceanParts {
  HoloOceanJson &dynamics, &actuator, &imu, &depth, &gps, &magnetometer;
};

HoloOceanParts parts_of(HoloOceanJson& scenario) {
  HoloOceanJson &agent = scenario["agents"][0], &sensors = agent["sensors"];
  return {agent["dynamics"], agent["actuator"], sensors[1], sensors[2], sensors[3], sensors[4]};
}

/// From axes forward, starboard, down to forward, port, up.
Eigen::Vector3d with_z_up(const Eigen::Vector3d& v) { return {v.x(), -v.y(), -v.z()}; }

HoloOceanJson json_list(const Eigen::Vector3d& v) { return {v.x() + 0.0, v.y() + 0.0, v.z() + 0.0}; }

void set_sensor(HoloOceanJson& sensor, double rate_Hz, HoloOceanJson configuration) {
  sensor.update({{"Hz", rate_Hz}, {"configuration", std::move(configuration)}});
}

void set_vehicle(const HoloOceanParts& parts, const config::VehicleSettings& vehicle) {
  constexpr double kSecondsPerMinute = 60;
  const auto& [hull, fins, propeller] = std::tie(vehicle.hull, vehicle.fins, vehicle.propeller);
  parts.dynamics = {{"rho", vehicle.water.density_kg_m3},
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
  // The line of thrust over advance is given by its ends.
  const double most_advance = parts.actuator["Ja_max"];
  parts.actuator.update({{"fin_center", fins.radius_m},
                         {"fin_area", fins.area_m2},
                         {"x_fin", fins.station_m},
                         {"CL_delta", fins.lift_slope_per_rad},
                         {"deltaMax_fin_deg", fins.limit_rad * base::kDegreesPerRadian},
                         {"T_delta", fins.lag_s},
                         {"nMax", kSecondsPerMinute * vehicle.autopilot.shaft_limit_rps},
                         {"T_n", propeller.lag_s},
                         {"D_prop", propeller.diameter_m},
                         {"KT_0", propeller.thrust_at_rest},
                         {"KT_max", propeller.thrust_at_rest + propeller.thrust_slope * most_advance},
                         {"KQ_0", propeller.torque},
                         {"KQ_max", propeller.torque}});
}

/// The Earth's field as the magnetometer measures it: uT where the diagnosis states it.
Eigen::Vector3d holoocean_field(const gap::Diagnosis& diagnosis) {
  if (!diagnosis.field) return Eigen::Vector3d::UnitX();
  const auto& [north, east, down] = diagnosis.field->north_east_down_uT;
  return {north, east, down};
}

void set_sensors(const HoloOceanParts& parts, const CorrectedModel& model) {
  const auto& [imu, gps, magnetometer] =
      std::tie(model.instruments.imu, model.instruments.gps, model.instruments.compass);
  set_sensor(parts.imu, imu.timing.rate_Hz,
             {{"AccelSigma", imu.force_noise_m_s2}, {"AngVelSigma", imu.gyro_noise_rad_s}});
  set_sensor(parts.depth, imu.timing.rate_Hz, {{"Sigma", imu.depth_noise_m}});
  set_sensor(parts.gps, gps.timing.rate_Hz, {{"Sigma", gps.position_noise_m}, {"Depth", gps.antenna_depth_m}});
  set_sensor(parts.magnetometer, magnetometer.timing.rate_Hz,
             {{"MagneticVector", json_list(with_z_up(holoocean_field(model.diagnosis)))}});
  if (model.diagnosis.field) parts.magnetometer["configuration"]["Sigma"] = magnetometer.field_noise_uT;
}

/// Applies one effect; answers why the scenario, which is as before, cannot have it, or an empty text.
std::string apply_to_holoocean(const TransferredEffect& effect, const CorrectedModel& model,
                               const HoloOceanParts& parts) {
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
  auto scenario = HoloOceanJson::parse(holoocean_text());
  const HoloOceanParts parts = parts_of(scenario);
  set_vehicle(parts, model.vehicle);
  set_sensors(parts, model);
  const std::vector<TransferredEffect> effects = transfer.effects();
  for (const TransferredEffect& effect : effects) {
    if (auto reason = apply_to_holoocean(effect, model, parts); !reason.empty())
      transfer.leave_out(effect.name(), std::move(reason));
  }
  scenario["navcal"] = about_json(model, transfer);
  // A file name may be invalid UTF-8.
  return {scenario.dump(2, ' ', false, HoloOceanJson::error_handler_t::replace) + '\n',
          summary_of(model.diagnosis, transfer)};
}

}  // namespace navcal::report
