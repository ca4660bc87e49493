// SPDX-License-Identifier: Apache-2.0
#include "identify/replay/replayed_motion.h"

#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "sim/layout/restoring.h"

namespace navcal::identify {
namespace {

constexpr double kSteepest_rad = 88 * base::kRadiansPerDegree;
constexpr double kFastest_m_s = 50, kFastestTurn_rad_s = 50;

bool is_sane(const sim::Body& body) {
  // Written so that NaN is not.
  return body.velocity.head<3>().cwiseAbs().maxCoeff() < kFastest_m_s &&
         body.velocity.tail<3>().cwiseAbs().maxCoeff() < kFastestTurn_rad_s &&
         std::abs(body.euler_rad.y()) < kSteepest_rad && body.position_m.allFinite() && body.velocity.allFinite();
}

}  // namespace

sim::Body body_of(const StateVector& state) { return {state.segment<3>(0), state.segment<3>(3), state.tail<6>()}; }

StateVector state_of(const sim::Body& body) {
  StateVector state;
  state << body.position_m, body.euler_rad, body.velocity;
  return state;
}

MotionPoint ReplayedMotion::at(double time_s) const {
  const double place = std::clamp((time_s - begin_s) / kStep_s, 0.0, static_cast<double>(points.size() - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(place), points.size() - 2);
  const double s = place - static_cast<double>(i);
  const MotionPoint &a = points[i], &b = points[i + 1];
  MotionPoint point;
  point.body.position_m = a.body.position_m + s * (b.body.position_m - a.body.position_m);
  point.body.euler_rad = a.body.euler_rad + s * (b.body.euler_rad - a.body.euler_rad);
  point.body.velocity = (1 + 2 * s) * (1 - s) * (1 - s) * a.body.velocity +
                        s * (1 - s) * (1 - s) * kStep_s * a.acceleration + s * s * (3 - 2 * s) * b.body.velocity +
                        s * s * (s - 1) * kStep_s * b.acceleration;
  point.acceleration = a.acceleration + s * (b.acceleration - a.acceleration);
  return point;
}

std::optional<ReplayedMotion> replay(const sim::LayoutVehicle& vehicle, const ActuatorTrajectory& actuators,
                                     double delay_s, double begin_s, std::size_t steps, const StateVector& begin) {
  ReplayedMotion motion{begin_s, {}};
  motion.points.reserve(steps + 1);
  sim::ActuatorValues held = sim::ActuatorValues::neutral(vehicle.layout());
  sim::Body body = body_of(begin);
  for (std::size_t k = 0; k < steps; ++k) {
    if (!is_sane(body)) return std::nullopt;
    const double time_s = begin_s + ReplayedMotion::kStep_s * static_cast<double>(k);
    actuators.at(time_s + ReplayedMotion::kStep_s / 2 - delay_s, held);
    const auto step = vehicle.step(body, held, ReplayedMotion::kStep_s);
    motion.points.push_back({body, step.acceleration});
    body = step.body;
  }
  if (!is_sane(body)) return std::nullopt;
  actuators.at(begin_s + ReplayedMotion::kStep_s * static_cast<double>(steps) - delay_s, held);
  const sim::LayoutVehicle::Held at_end = vehicle.hold(held);
  motion.points.push_back(
      {body, at_end.mass_inverse * vehicle.force(body.velocity, sim::down_of(body.euler_rad), at_end)});
  return motion;
}

}  // namespace navcal::identify
