// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/control/control_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

#include "autopilot/controllability.h"
#include "base/angles.h"
#include "sim/layout/control/mission_needs.h"
#include "sim/layout/layout_helm.h"

namespace navcal::sim {
namespace {

enum Freedom : std::size_t { kSurge, kSway, kHeave, kRoll, kPitch, kYaw };

constexpr double kReserve = 0.7;  ///< of the thrust, at the greatest speed
constexpr double kTrim_rad = 12 * base::kRadiansPerDegree;
const Eigen::Vector3d kLevel = Eigen::Vector3d::UnitZ();

autopilot::Wrench ahead(double speed_m_s) {
  autopilot::Wrench velocity = autopilot::Wrench::Zero();
  velocity[0] = speed_m_s;
  return velocity;
}

/// Adds the degrees of freedom that are independent of those that are commanded already.
void add_independent(const autopilot::Allocator& allocator, double speed_m_s, std::initializer_list<Freedom> wanted,
                     std::array<bool, 6>& commanded) {
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
  request.wanted[0] = -drag[0] / kReserve;
  if (allocator.allocate(request).reached[0] < (1 - kMissed) * request.wanted[0]) return false;
  request.wanted[0] = -drag[0];
  const autopilot::Wrench reached = allocator.allocate(request).reached;
  // d = (-sin pitch, 0, 1) turns the arm s of weight and buoyancy by s_z sin pitch, and roll likewise.
  const double most_Nm = std::sin(kTrim_rad) * held.restoring.arm_Nm.z();
  for (const Eigen::Index i : {Eigen::Index{kRoll}, Eigen::Index{kPitch}}) {
    const double moment_Nm = std::abs(reached[i] + drag[i] - vehicle.force(ahead(0), kLevel, held)[i]);
    if (!commanded[static_cast<std::size_t>(i)] && moment_Nm > most_Nm + 1e-9) return false;
  }
  return true;
}

double greatest_speed(const LayoutVehicle& vehicle, const autopilot::Allocator& allocator,
                      const std::array<bool, 6>& commanded) {
  constexpr double kFastest_m_s = 10;
  double low = 0, high = kFastest_m_s;
  for (int i = 0; i < 30; ++i) {
    const double middle = (low + high) / 2;
    (bears(vehicle, allocator, commanded, middle) ? low : high) = middle;
  }
  return low;
}

class ControlPlanner {
 public:
  ControlPlanner(const LayoutVehicle& vehicle, const autopilot::Allocator& allocator, const config::Mission& mission)
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
      refuse("no speed ahead is borne: thrust ahead upsets the vehicle, whose pitch or roll cannot be commanded and "
             "is not stable");
    }
    if (!plan_.commanded[kYaw]) need("yaw", needs_.yaw);
    if (!plan_.commanded[kPitch]) need("pitch", needs_.pitch);
    const auto& surfaces = vehicle_.layout().surfaces;
    for (std::size_t i = 0; i < 3; ++i) {
      if (needs_.fins[i] && i >= surfaces.size())
        refuse(fmt::format("there is no surface {}, which {} of the mission moves as fin{}", i + 1, *needs_.fins[i],
                           i + 1));
    }
    const double arm_Nm =
        vehicle_.hold(ActuatorValues::neutral(vehicle_.layout())).restoring.arm_Nm.z();
    for (const Freedom freedom : {kRoll, kPitch}) {
      if (!plan_.commanded[freedom] && arm_Nm < 0)
        refuse(fmt::format("{} cannot be commanded, and the vehicle is not stable in it: its centre of gravity is "
                           "above that of buoyancy",
                           autopilot::kDegreesOfFreedom[freedom]));
    }
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

ControlPlan plan_control(const LayoutVehicle& vehicle, const autopilot::Allocator& allocator,
                         const config::Mission& mission) {
  return ControlPlanner(vehicle, allocator, mission).plan();
}

}  // namespace navcal::sim
