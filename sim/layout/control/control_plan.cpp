// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/control/control_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string_view>
#include <tuple>

#include "autopilot/controllability.h"
#include "base/angles.h"
#include "sim/vehicle/helm.h"

namespace navcal::sim {
namespace {

using config::MissionStep;
using config::StepKind;

std::string_view word_for(StepKind kind) {
  constexpr std::array<std::string_view, 12> kWords{"leg",  "turn",    "circle", "spiral", "zigzag",  "pirouette",
                                                    "dive", "surface", "speed",  "swing",  "doublet", "direct"};
  return kWords[static_cast<std::size_t>(kind)];
}

bool needs_surge(const MissionStep& step) {
  return step.speed_m_s || step.metres || (step.shaft_rps && *step.shaft_rps > 0);
}

bool turns(const MissionStep& step, double start_heading_rad) {
  switch (step.kind) {
    case StepKind::turn:
    case StepKind::circle:
    case StepKind::spiral:
    case StepKind::zigzag:
    case StepKind::pirouette:
    case StepKind::swing: return true;
    case StepKind::doublet: return step.on == config::Surface::rudder;
    default: break;
  }
  if (step.by_rad && *step.by_rad != 0) return true;
  if (step.rudder_rad && *step.rudder_rad != 0) return true;
  return step.heading_rad &&
         std::abs(std::remainder(*step.heading_rad - start_heading_rad, 2 * std::numbers::pi)) > 1e-9;
}

enum Freedom : std::size_t { kSurge, kSway, kHeave, kRoll, kPitch, kYaw };

/// Share of the thrust that balances the drag at the greatest speed. Thrusters that also turn the vehicle keep
/// more.
constexpr double kOfThrust = 0.95, kOfTurningThrust = 0.5;
constexpr double kTrim_rad = 12 * base::kRadiansPerDegree;
const Eigen::Vector3d kLevel = Eigen::Vector3d::UnitZ();

autopilot::Wrench ahead(double speed_m_s) {
  autopilot::Wrench velocity = autopilot::Wrench::Zero();
  velocity[0] = speed_m_s;
  return velocity;
}

/// Adds the degrees of freedom that are independent of those that are commanded already.
void add_independent(const autopilot::Allocator& allocator, double speed_m_s,
                     std::initializer_list<Freedom> wanted, std::array<bool, 6>& commanded) {
  constexpr double kIndependent = 0.3, kNothing = 1e-4;
  const Eigen::MatrixXd B = allocator.matrix(ahead(speed_m_s));
  const autopilot::Allocator::Limits limits = allocator.limits(ahead(speed_m_s));
  const Eigen::VectorXd most = limits.low.cwiseAbs().cwiseMax(limits.high.cwiseAbs());
  const Eigen::MatrixXd rows = allocator.row_scales(B, limits).asDiagonal() * B * most.asDiagonal();
  std::vector<Eigen::VectorXd> basis;
  const auto rest_of = [&](std::size_t freedom) {
    Eigen::VectorXd rest = rows.row(static_cast<Eigen::Index>(freedom)).transpose();
    for (const Eigen::VectorXd& unit : basis) rest -= unit.dot(rest) * unit;
    return rest;
  };
  for (std::size_t i = 0; i < 6; ++i) {
    if (!commanded[i]) continue;
    const Eigen::VectorXd rest = rest_of(i);
    if (rest.norm() > 0) basis.push_back(rest.normalized());
  }
  for (const Freedom freedom : wanted) {
    if (commanded[freedom]) continue;
    const double whole = rows.row(static_cast<Eigen::Index>(freedom)).norm();
    const Eigen::VectorXd rest = rest_of(freedom);
    if (!(whole > kNothing) || !(rest.norm() > kIndependent * whole)) continue;
    commanded[freedom] = true;
    basis.push_back(rest.normalized());
  }
}

/// Whether the vehicle can go straight ahead at this speed with the reserve and the trim.
bool bears(const LayoutVehicle& vehicle, const autopilot::Allocator& allocator,
           const std::array<bool, 6>& commanded, double speed_m_s) {
  constexpr double kMissed = 0.02;
  const LayoutVehicle::Held held = vehicle.hold(ActuatorValues::neutral(vehicle.layout()));
  const Vector6 drag = vehicle.force(ahead(speed_m_s), kLevel, held);
  autopilot::AllocationRequest request;
  request.velocity = ahead(speed_m_s);
  request.saturation = autopilot::Saturation::least_squares;
  for (std::size_t i = 0; i < 6; ++i) request.weights[static_cast<Eigen::Index>(i)] = commanded[i] ? 1 : 0;
  request.wanted[0] = -drag[0] / (vehicle.layout().surfaces.empty() ? kOfTurningThrust : kOfThrust);
  if (allocator.allocate(request).reached[0] < (1 - kMissed) * request.wanted[0]) return false;
  request.wanted[0] = -drag[0];
  const autopilot::Wrench reached = allocator.allocate(request).reached;
  const auto turns_back = [&](Eigen::Index freedom, double angle_rad) {
    const double c = std::cos(angle_rad), sine = std::sin(angle_rad);
    const bool is_pitch = freedom == Eigen::Index{kPitch};
    autopilot::Wrench velocity = ahead(is_pitch ? c * speed_m_s : speed_m_s);
    if (is_pitch) velocity[2] = sine * speed_m_s;
    const Eigen::Vector3d down = is_pitch ? Eigen::Vector3d(-sine, 0, c) : Eigen::Vector3d(0, sine, c);
    return angle_rad * (reached[freedom] + vehicle.force(velocity, down, held)[freedom]) < 0;
  };
  for (const Eigen::Index freedom : {Eigen::Index{kRoll}, Eigen::Index{kPitch}}) {
    if (commanded[static_cast<std::size_t>(freedom)]) continue;
    if (!turns_back(freedom, kTrim_rad) || !turns_back(freedom, -kTrim_rad)) return false;
  }
  return true;
}

/// The longest lag of what turns the vehicle, surfaces that move or else thrusters, and the period of the
/// autopilot.
double delay_of(const config::Layout& layout) {
  constexpr double kPeriod_s = 0.1;
  double lag_s = 0;
  for (const auto& surface : layout.surfaces) {
    if (surface.limit_rad > 0) lag_s = std::max(lag_s, surface.lag_s);
  }
  if (lag_s > 0) return lag_s + kPeriod_s;
  for (const auto& thruster : layout.thrusters) lag_s = std::max(lag_s, thruster.lag_s);
  return lag_s + kPeriod_s;
}

/// Whether what turns the vehicle across its way (Munk) grows slowly enough for the loops: exp(p t) with p times
/// the delay below 0.7, where p^2 is the moment for each radian of drift over the inertia.
bool keeps_to_its_way(const LayoutVehicle& vehicle, double speed_m_s) {
  constexpr double kFastest = 0.7, kDrift_rad = 0.02;
  const LayoutVehicle::Held held = vehicle.hold(ActuatorValues::neutral(vehicle.layout()));
  const Vector6 straight = vehicle.force(ahead(speed_m_s), kLevel, held);
  const double delay_s = delay_of(vehicle.layout());
  for (const auto& [moment, drift, sign] : {std::tuple(kPitch, kHeave, 1.0), std::tuple(kYaw, kSway, -1.0)}) {
    autopilot::Wrench velocity = ahead(speed_m_s);
    velocity[static_cast<Eigen::Index>(drift)] = sign * kDrift_rad * speed_m_s;
    const auto at = static_cast<Eigen::Index>(moment);
    const double square = (vehicle.force(velocity, kLevel, held) - straight)[at] / kDrift_rad / held.mass(at, at);
    if (square > 0 && std::sqrt(square) * delay_s > kFastest) return false;
  }
  return true;
}

/// Whether the pitch actuators hold a level course at this speed against weight and buoyancy, with a fifth to
/// spare.
bool holds_level(const LayoutVehicle& vehicle, const autopilot::Allocator& allocator,
                 const std::array<bool, 6>& commanded, double speed_m_s) {
  constexpr double kOfMoment = 0.8, kSteepest_rad = 25 * base::kRadiansPerDegree;
  const LayoutVehicle::Held held = vehicle.hold(ActuatorValues::neutral(vehicle.layout()));
  autopilot::AllocationRequest request;
  request.saturation = autopilot::Saturation::least_squares;
  for (std::size_t i = 0; i < 6; ++i) request.weights[static_cast<Eigen::Index>(i)] = commanded[i] ? 1 : 0;
  bool is_held = false;
  /// Force down at this pitch, with the moment that it needs as far as it can be had.
  const auto down_N = [&](double pitch_rad) {
    const double c = std::cos(pitch_rad), s = std::sin(pitch_rad);
    request.velocity = ahead(speed_m_s * c);
    request.velocity[2] = speed_m_s * s;
    const Vector6 drag = vehicle.force(request.velocity, {-s, 0, c}, held);
    request.wanted = {-drag[0], 0, 0, 0, -drag[4] / kOfMoment, 0};
    is_held = std::abs(allocator.allocate(request).reached[4] - request.wanted[4]) <=
              0.02 * std::abs(request.wanted[4]) + 1e-9;
    request.wanted[4] = -drag[4];
    const autopilot::Wrench reached = allocator.allocate(request).reached;
    return (drag[2] + reached[2]) * c - (drag[0] + reached[0]) * s;
  };
  double low = -kSteepest_rad, high = kSteepest_rad;
  for (int i = 0; i < 30; ++i) {
    const double middle = (low + high) / 2;
    (down_N(middle) > 0 ? low : high) = middle;
  }
  (void)down_N((low + high) / 2);
  return is_held;
}

double greatest_speed(const LayoutVehicle& vehicle, const autopilot::Allocator& allocator,
                      const std::array<bool, 6>& commanded) {
  constexpr double kFastest_m_s = 10;
  double low = 0, high = kFastest_m_s;
  for (int i = 0; i < 30; ++i) {
    const double middle = (low + high) / 2;
    const bool can = bears(vehicle, allocator, commanded, middle) && keeps_to_its_way(vehicle, middle);
    (can ? low : high) = middle;
  }
  return low;
}

class ControlPlanner {
 public:
  ControlPlanner(const LayoutVehicle& vehicle, const autopilot::Allocator& allocator,
                 const config::Mission& mission)
      : vehicle_(vehicle), allocator_(allocator), needs_(needs_of(mission)) {}

  [[nodiscard]] ControlPlan plan() {
    add_independent(allocator_, 0, {kSurge}, plan_.commanded);
    plan_.greatest_m_s = plan_.commanded[kSurge] ? greatest_speed(vehicle_, allocator_, plan_.commanded) : 0;
    plan_.usual_m_s = 0.7 * plan_.greatest_m_s;
    add_independent(allocator_, plan_.usual_m_s, {kYaw}, plan_.commanded);
    choose_depth();
    add_independent(allocator_, plan_.usual_m_s, {kRoll, kPitch, kSway}, plan_.commanded);
    if (plan_.commanded[kSurge]) {
      plan_.greatest_m_s = greatest_speed(vehicle_, allocator_, plan_.commanded);
      plan_.usual_m_s = 0.7 * plan_.greatest_m_s;
    }
    check();
    return plan_;
  }

 private:
  void choose_depth() {
    std::array<bool, 6> at_rest{};
    add_independent(allocator_, 0, {kSurge, kYaw, kHeave}, at_rest);
    if (at_rest[kHeave]) {
      plan_.depth = DepthControl::heave;
      plan_.commanded[kHeave] = true;
      return;
    }
    std::array<bool, 6> under_way = plan_.commanded;
    add_independent(allocator_, plan_.usual_m_s, {kPitch}, under_way);
    if (under_way[kPitch] && under_way[kSurge]) {
      plan_.depth = DepthControl::pitch;
      plan_.commanded = under_way;
    } else if (!vehicle_.layout().ballasts.empty()) {
      plan_.depth = DepthControl::ballast;
    } else {
      refuse("heave cannot be commanded, nor a pitch under way, which holding a depth needs");
    }
  }

  void check() const {
    // A speed that only creeps is none.
    constexpr double kLeast_m_s = 0.02;
    if (!plan_.commanded[kSurge]) need("surge", needs_.surge);
    if (plan_.commanded[kSurge] && plan_.greatest_m_s < kLeast_m_s) {
      refuse(
          "no speed ahead is borne: thrust ahead upsets the vehicle, whose pitch or roll cannot be commanded and "
          "is not stable");
    }
    if (plan_.depth == DepthControl::pitch &&
        !holds_level(vehicle_, allocator_, plan_.commanded, plan_.greatest_m_s))
      refuse(
          fmt::format("the moment of pitch does not hold a level course at {:.2f} m/s, the greatest speed, "
                      "against {:+.3g} N of net buoyancy: change body.buoyancy_N or body.mass_kg",
                      plan_.greatest_m_s, -net_weight_N()));
    if (!plan_.commanded[kYaw]) need("yaw", needs_.yaw);
    if (!plan_.commanded[kPitch]) need("pitch", needs_.pitch);
    const auto& surfaces = vehicle_.layout().surfaces;
    for (std::size_t i = 0; i < 3; ++i) {
      if (needs_.fins[i] && i >= surfaces.size())
        refuse(fmt::format("there is no surface {}, which {} of the mission moves as fin{}", i + 1,
                           *needs_.fins[i], i + 1));
    }
    const double arm_Nm = vehicle_.hold(ActuatorValues::neutral(vehicle_.layout())).restoring.arm_Nm.z();
    for (const Freedom freedom : {kRoll, kPitch}) {
      if (!plan_.commanded[freedom] && arm_Nm < 0)
        refuse(
            fmt::format("{} cannot be commanded, and the vehicle is not stable in it: its centre of gravity is "
                        "above that of buoyancy",
                        autopilot::kDegreesOfFreedom[freedom]));
    }
  }

  [[nodiscard]] double net_weight_N() const {
    return vehicle_.hold(ActuatorValues::neutral(vehicle_.layout())).restoring.net_weight_N;
  }

  void need(const char* freedom, const std::optional<std::string>& step) const {
    if (step) refuse(fmt::format("{} cannot be commanded, which {} of the mission needs", freedom, *step));
  }

  [[noreturn]] void refuse(const std::string& why) const {
    const std::string& name = vehicle_.layout().name;
    throw UnfitLayout(fmt::format("{}: {}", name.empty() ? "the layout" : name, why));
  }

  const LayoutVehicle& vehicle_;
  const autopilot::Allocator& allocator_;
  MissionNeeds needs_;
  ControlPlan plan_;
};

}  // namespace

std::string step_words(const config::Mission& mission, std::size_t step) {
  return fmt::format("step[{}] ({})", step + 1, word_for(mission.steps[step].kind));
}

MissionNeeds needs_of(const config::Mission& mission) {
  MissionNeeds needs;
  for (std::size_t i = 0; i < mission.steps.size(); ++i) {
    const MissionStep& step = mission.steps[i];
    const auto note = [&](std::optional<std::string>& need, bool is_needed) {
      if (is_needed && !need) need = step_words(mission, i);
    };
    note(needs.surge, needs_surge(step));
    note(needs.yaw, turns(step, mission.start.heading_rad));
    const bool is_doublet = step.kind == StepKind::doublet;
    note(needs.pitch,
         (is_doublet && step.on == config::Surface::elevator) || (step.elevator_rad && *step.elevator_rad != 0));
    const std::array fins{step.fin1_rad, step.fin2_rad, step.fin3_rad};
    for (std::size_t fin = 0; fin < 3; ++fin) {
      const auto on = static_cast<config::Surface>(static_cast<std::size_t>(config::Surface::fin1) + fin);
      note(needs.fins[fin], fins[fin].has_value() || (is_doublet && step.on == on));
    }
  }
  return needs;
}

ControlPlan plan_control(const LayoutVehicle& vehicle, const autopilot::Allocator& allocator,
                         const config::Mission& mission) {
  return ControlPlanner(vehicle, allocator, mission).plan();
}

}  // namespace navcal::sim
