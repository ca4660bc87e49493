// SPDX-License-Identifier: Apache-2.0
#include "tests/identify/identification_case.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>

#include "autopilot/allocation.h"
#include "config/layout/layout_file.h"

namespace navcal::identify {
namespace {

const std::vector<ChannelNoise> kInertial{{Channel::rate_x, 20, 0.002}, {Channel::rate_y, 20, 0.002},
                                          {Channel::rate_z, 20, 0.002}, {Channel::force_x, 20, 0.02},
                                          {Channel::force_y, 20, 0.02}, {Channel::force_z, 20, 0.02}};
const std::vector<ChannelNoise> kAttitude{
    {Channel::roll, 10, 0.003}, {Channel::pitch, 10, 0.003}, {Channel::heading, 10, 0.01}};
const std::vector<ChannelNoise> kDoppler{
    {Channel::bottom_x, 5, 0.01}, {Channel::bottom_y, 5, 0.01}, {Channel::bottom_z, 5, 0.01}};
const ChannelNoise kDepth{Channel::gauge_depth, 10, 0.01};

void add(config::Layout& layout, const std::string& key, std::vector<double> stds) {
  config::LayoutUncertainty about;
  about.key = key;
  if (stds.size() == 1) {
    about.std = stds.front();
  } else {
    about.stds = std::move(stds);
  }
  layout.uncertainties.push_back(std::move(about));
}

config::Layout shipped(const std::string& name) {
  return config::load_layout(std::string(NAVCAL_SOURCE_DIR) + "/share/vehicles/" + name + ".toml");
}

std::vector<ChannelNoise> joined(std::initializer_list<std::vector<ChannelNoise>> parts) {
  std::vector<ChannelNoise> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

VehicleCase rov(const std::string& name, std::vector<ChannelNoise> channels) {
  VehicleCase of{name, shipped("bluerov2-heavy"), std::move(channels), false};
  of.prior.uncertainties.clear();
  of.prior.body.volume_m3 = 0;
  add(of.prior, "body.mass_kg", {0.3});
  add(of.prior, "body.buoyancy_N", {3});
  add(of.prior, "body.gravity_centre_m", {0.005, 0.005, 0.01});
  add(of.prior, "added_mass.matrix", {2, 2, 5, 0.06, 0.04, 0.07});
  add(of.prior, "damping.linear", {5, 5, 10, 0.1, 0.3, 0.1});
  add(of.prior, "damping.quadratic", {40, 60, 60, 0.4, 0.2, 0.5});
  for (std::size_t i = 0; i < of.prior.thrusters.size(); ++i)
    add(of.prior, "thruster[" + std::to_string(i + 1) + "].force_scale", {0.1});
  return of;
}

VehicleCase micro() {
  VehicleCase of{"micro", shipped("micro-auv"), joined({kInertial, kAttitude, {kDepth}}), false};
  of.prior.uncertainties.clear();
  const double mass = of.prior.body.mass_kg;
  add(of.prior, "body.mass_kg", {0.03 * mass});
  add(of.prior, "body.gravity_centre_m", {0.002, 0.002, 0.003});
  std::vector<double> added, linear, quadratic;
  for (std::size_t i = 0; i < 36; i += 7) {
    added.push_back(0.3 * of.prior.added_mass.matrix_kg[i]);
    linear.push_back(0.3 * of.prior.damping.linear[i]);
    quadratic.push_back(0.3 * of.prior.damping.quadratic[i]);
  }
  add(of.prior, "added_mass.matrix", added);
  add(of.prior, "damping.linear", linear);
  add(of.prior, "damping.quadratic", quadratic);
  for (std::size_t i = 0; i < of.prior.thrusters.size(); ++i) {
    add(of.prior, "thruster[" + std::to_string(i + 1) + "].force_scale", {0.1});
    add(of.prior, "thruster[" + std::to_string(i + 1) + "].lag_s", {0.2 * of.prior.thrusters[i].lag_s});
  }
  return of;
}

/// A ferry of 5 m and 1700 kg: two thrusters across, two ahead. Its forces are thought 40 % too large.
VehicleCase ferry() {
  VehicleCase of{"ferry", {}, {}, false};
  config::Layout& layout = of.prior;
  layout.name = "ferry";
  layout.water_density_kg_m3 = 1000;
  layout.body = {.mass_kg = 1700, .gravity_centre_m = {0, 0, 0.3}, .inertia_kg_m2 = {900, 3200, 3600, 0, 0, 0}};
  layout.body.is_neutral = true;
  layout.body.set_buoyancy(1000);
  const std::array<double, 6> added{150, 900, 1700, 300, 2000, 1800}, linear{60, 250, 2000, 900, 4000, 900};
  for (std::size_t i = 0; i < 6; ++i) {
    layout.added_mass.matrix_kg[7 * i] = added[i];
    layout.damping.linear[7 * i] = linear[i];
  }
  const std::array<config::LayoutVector, 4> places{{{1.8, 0, 0}, {-1.8, 0, 0}, {-2, 0.8, 0}, {-2, -0.8, 0}}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    config::LayoutThruster thruster;
    thruster.name = "t" + std::to_string(i + 1);
    thruster.place_m = places[i];
    thruster.direction = i < 2 ? config::LayoutVector{0, 1, 0} : config::LayoutVector{1, 0, 0};
    thruster.unit = config::CommandUnit::percent;
    thruster.low = -100;
    thruster.high = 100;
    thruster.table_command = {-100, 100};
    thruster.table_force_N = {-400, 400};
    thruster.force_scale = 1.4;
    layout.thrusters.push_back(thruster);
    add(layout, "thruster[" + std::to_string(i + 1) + "].force_scale", {0.7});
  }
  add(layout, "added_mass.matrix", {100, 500, 0, 0, 0, 1000});
  add(layout, "damping.linear", {60, 200, 0, 0, 0, 600});
  return of;
}

VehicleCase reference() {
  VehicleCase of{"reference", shipped("reference"),
                 joined({{{Channel::rate_x, 20, 0.0018},
                          {Channel::rate_y, 20, 0.0018},
                          {Channel::rate_z, 20, 0.0018},
                          {Channel::second_yaw_rate, 20, 0.0018},
                          {Channel::force_x, 20, 0.02},
                          {Channel::force_y, 20, 0.02},
                          {Channel::force_z, 20, 0.02},
                          {Channel::depth, 20, 0.02},
                          {Channel::north_velocity, 1, 0.1},
                          {Channel::east_velocity, 1, 0.1},
                          {Channel::north, 1, 1},
                          {Channel::east, 1, 1}},
                         kAttitude}),
                 true};
  add(of.prior, "body.mass_kg", {0.1});
  of.prior.body.is_neutral = true;
  add(of.prior, "body.gravity_centre_m", {0, 0, 0.002});
  add(of.prior, "body.inertia_kg_m2", {0.001, 0.03, 0.03, 0, 0, 0});
  add(of.prior, "added_mass.matrix", {0.03, 0.5, 0.5, 0, 0.05, 0.05});
  add(of.prior, "damping.linear", {0, 0, 0, 0.01, 0.15, 0.03});
  add(of.prior, "damping.axial.coefficient", {0.06});
  add(of.prior, "damping.cross_flow.coefficient", {0.2});
  add(of.prior, "damping.body_lift.slope_per_rad", {0.15});
  add(of.prior, "thruster[1].force_scale", {0.08});
  for (int i = 1; i <= 3; ++i) add(of.prior, "surface[" + std::to_string(i) + "].lift_slope_per_rad", {0.3});
  return of;
}

}  // namespace

VehicleCase vehicle_case(const std::string& name) {
  if (name == "rov") return rov(name, joined({kInertial, kAttitude, {kDepth}, kDoppler}));
  if (name == "rov-imu") return rov(name, joined({kInertial, kAttitude, {kDepth}}));
  if (name == "micro") return micro();
  if (name == "reference") return reference();
  if (name == "ferry") return ferry();
  throw std::invalid_argument("no vehicle " + name);
}

DrawnVehicle draw_vehicle(const VehicleCase& of, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto parameters = uncertain_parameters(of.prior);
  DrawnVehicle drawn{prior_values(parameters), {}};
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    double& value = drawn.truth[static_cast<Eigen::Index>(i)];
    do {
      value = parameters[i].prior + parameters[i].prior_std * normal(random);
    } while (value < parameters[i].low || value > parameters[i].high);
  }
  drawn.layout = with_values(of.prior, parameters, drawn.truth);
  return drawn;
}

RecordedMotion draw_recording(const VehicleCase& of, const config::Layout& truth, double seconds,
                              std::uint64_t seed, double instrument_errors) {
  auto random = std::make_shared<std::mt19937_64>(seed);
  auto allocator = std::make_shared<autopilot::Allocator>(of.prior);
  // The recording lacks what the vehicle cannot measure; nuisances of missing instruments do no harm.
  const Calibration stds = nuisance_stds(RecordedMotion{});
  std::normal_distribution<double> normal;
  SimulatedMotionRequest request;
  request.channels = of.channels;
  request.seconds = seconds;
  request.seed = seed + 1;
  request.reports_positions = of.reports_positions;
  // The errors have a generator of their own: the commands do not depend on how many there are. Nothing is late.
  std::mt19937_64 errors(seed + 2);
  for (Eigen::Index i = 0; i < kNuisances; ++i) {
    if (!is_delay(static_cast<Nuisance>(i))) request.calibration[i] = instrument_errors * stds[i] * normal(errors);
  }
  const bool has_fins = std::any_of(of.prior.surfaces.begin(), of.prior.surfaces.end(),
                                    [](const auto& surface) { return surface.limit_rad > 0; });
  request.start.position_m.z() = 5;
  if (has_fins) request.start.velocity[0] = 0.8;
  auto wanted = std::make_shared<autopilot::Wrench>(autopilot::Wrench::Zero());
  auto until_s = std::make_shared<double>(0);
  request.commands = [=](double time_s, const sim::Body& body) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    if (time_s >= *until_s) {
      *until_s = time_s + 2 + 2 * std::abs(uniform(*random));
      for (Eigen::Index i = 0; i < 6; ++i) (*wanted)[i] = uniform(*random);
      if (has_fins) (*wanted)[0] = 0.6 + 0.3 * (*wanted)[0];
    }
    autopilot::AllocationRequest allocation;
    allocation.velocity = body.velocity;
    const auto limits = allocator->limits(body.velocity);
    const Eigen::MatrixXd matrix = allocator->matrix(body.velocity);
    // Half of what each degree of freedom can have, with feedback that keeps the vehicle level and at its depth.
    for (Eigen::Index i = 0; i < 6; ++i) {
      const double most =
          matrix.row(i).cwiseAbs().dot(limits.high.cwiseMin(-limits.low).cwiseMax(0.3 * limits.high).transpose());
      double part = 0.35 * (*wanted)[i];
      if (i == 3) part = 0.1 * (*wanted)[i] - 0.8 * body.euler_rad.x() - 0.2 * body.velocity[3];
      if (i == 4) part = 0.15 * (*wanted)[i] - 1.5 * body.euler_rad.y() - 0.3 * body.velocity[4];
      if (i == 2) part += 0.05 * (5 - body.position_m.z());
      if (i == 4 && has_fins) part -= 0.1 * (5 - body.position_m.z());
      allocation.wanted[i] = std::clamp(part, -0.9, 0.9) * most;
    }
    if (has_fins) {
      allocation.wanted[1] = allocation.wanted[2] = 0;
      allocation.weights << 1, 0, 0, 0.1, 1, 1;
      allocation.wanted[0] = 1;
    }
    allocation.saturation = autopilot::Saturation::least_squares;
    const auto allocated = allocator->allocate(allocation);
    sim::ActuatorValues commands = sim::ActuatorValues::neutral(of.prior);
    commands.thrusters = allocated.thruster_commands;
    commands.surfaces_rad = allocated.surfaces_rad;
    if (has_fins) commands.thrusters[0] = of.prior.thrusters[0].high * (*wanted)[0] * 0.6;
    return commands;
  };
  return simulated_motion(truth, request);
}

RecordedMotion draw_steered(const config::Layout& truth, double seconds, std::uint64_t seed) {
  constexpr double kOrders_Hz = 10, kStation_s = 30, kGust_s = 12, kStep_s = 0.01, kChannels_Hz = 5;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  SimulatedMotionRequest request;
  request.seconds = seconds;
  request.seed = seed + 1;
  for (const auto& [channel, std] : std::initializer_list<std::pair<Channel, double>>{{Channel::roll, 0.003},
                                                                                      {Channel::pitch, 0.003},
                                                                                      {Channel::heading, 0.003},
                                                                                      {Channel::rate_x, 0.003},
                                                                                      {Channel::rate_y, 0.003},
                                                                                      {Channel::rate_z, 0.003},
                                                                                      {Channel::north, 0.05},
                                                                                      {Channel::east, 0.05},
                                                                                      {Channel::bottom_x, 0.02},
                                                                                      {Channel::bottom_y, 0.02},
                                                                                      {Channel::bottom_z, 0.02}})
    request.channels.push_back({channel, kChannels_Hz, std});
  const auto gusts = std::make_shared<std::vector<sim::Vector6>>();
  sim::Vector6 size = sim::Vector6::Zero(), gust = size;
  size << 0.08, 0.08, 0, 0, 0, 0.03;
  for (double time_s = 0; time_s < seconds + 1; time_s += kStep_s) {
    for (Eigen::Index i = 0; i < 6; ++i)
      gust[i] += -kStep_s / kGust_s * gust[i] + std::sqrt(2 * kStep_s / kGust_s) * size[i] * normal(random);
    gusts->push_back(gust);
  }
  request.disturbance = [=](double time_s) { return (*gusts)[static_cast<std::size_t>(time_s / kStep_s + 0.5)]; };
  const auto stations = std::make_shared<std::vector<Eigen::Vector3d>>();
  for (double time_s = 0; time_s < seconds + kStation_s; time_s += kStation_s)
    stations->push_back({0.7 * normal(random), 0.7 * normal(random), 0.1 * normal(random)});
  const auto sent = std::make_shared<std::vector<sim::ActuatorValues>>();
  const auto allocator = std::make_shared<autopilot::Allocator>(truth);
  const auto integral = std::make_shared<Eigen::Vector3d>(Eigen::Vector3d::Zero());
  request.commands = [=](double time_s, const sim::Body& body) {
    const Eigen::Vector3d& station = (*stations)[static_cast<std::size_t>(time_s / kStation_s)];
    const double yaw = body.euler_rad.z();
    const Eigen::Vector2d away = Eigen::Rotation2Dd(-yaw) * (station - body.position_m).head<2>();
    const Eigen::Vector3d error(away.x(), away.y(), std::remainder(station.z() - yaw, 2 * std::numbers::pi));
    *integral += error / kOrders_Hz;
    *integral = integral->cwiseMax(-20).cwiseMin(20);
    const Eigen::Vector3d velocity(body.velocity[0], body.velocity[1], body.velocity[5]);
    const Eigen::Vector3d wanted = 0.09 * error - 0.4 * velocity + 0.005 * *integral;
    autopilot::AllocationRequest allocation;
    allocation.weights << 1, 1, 0, 0, 0, 1;
    allocation.wanted << 1850 * wanted[0], 2600 * wanted[1], 0, 0, 0, 5400 * wanted[2];
    sim::ActuatorValues commands = sim::ActuatorValues::neutral(truth);
    commands.thrusters = allocator->allocate(allocation).thruster_commands;
    sent->push_back(commands);
    const auto late = static_cast<std::size_t>(kFerryDelay_s * kOrders_Hz + 0.5);
    return sent->size() > late ? (*sent)[sent->size() - 1 - late] : sim::ActuatorValues::neutral(truth);
  };
  RecordedMotion recorded = simulated_motion(truth, request);
  // The recording has the commands when they are sent.
  for (auto& [name, signal] : recorded.signals)
    for (double& time_s : signal.times_s) time_s -= kFerryDelay_s;
  return recorded;
}

Eigen::Vector3d force_over_mass(const config::Layout& of, const config::Layout& truth) {
  const auto of_layout = [](const config::Layout& layout) {
    const auto scale = [&](std::size_t a) {
      return (layout.thrusters[a].force_scale + layout.thrusters[a + 1].force_scale) / 2;
    };
    const auto& added = layout.added_mass.matrix_kg;
    return Eigen::Vector3d(scale(2) / (layout.body.mass_kg + added[0]),
                           scale(0) / (layout.body.mass_kg + added[7]),
                           scale(0) / (layout.body.inertia_kg_m2[2] + added[35]));
  };
  return of_layout(of).cwiseQuotient(of_layout(truth));
}

RecordedMotion part_of(const RecordedMotion& motion, double from_s, double to_s) {
  RecordedMotion part = motion;
  for (std::size_t c = 0; c < kChannels; ++c) {
    part.channels[c].clear();
    for (const Reading& reading : motion.channels[c]) {
      if (reading.time_s >= from_s && reading.time_s < to_s) part.channels[c].push_back(reading);
    }
  }
  part.duration_s = std::min(to_s, motion.duration_s);
  return part;
}

}  // namespace navcal::identify
