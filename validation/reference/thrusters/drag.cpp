// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/thrusters/drag.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace navcal::reference::thrusters {
namespace {

struct Node {
  double at, weight;  ///< on -1 to 1; weights add up to 2
};
constexpr double kThird = 0.7745966692414834;
constexpr std::array<Node, 3> kGauss3{{{-kThird, 5.0 / 9}, {0, 8.0 / 9}, {kThird, 5.0 / 9}}};
constexpr std::array<Node, 5> kGauss5{{{-0.9061798459386640, 0.2369268850561891},
                                       {-0.5384693101056831, 0.4786286704993665},
                                       {0, 0.5688888888888889},
                                       {0.5384693101056831, 0.4786286704993665},
                                       {0.9061798459386640, 0.2369268850561891}}};
/// Of the drag about an axis so much may come from the points at most.
constexpr double kMostOfTurning = 0.9;

}  // namespace

Drag::Drag(const Plan& plan, double share)
    : linear_(plan.linear), quadratic_(plan.quadratic), lift_(plan.lift), axial_kg_m_(plan.axial_kg_m),
      body_lift_kg_m_(plan.body_lift_kg_m), body_lift_m_(plan.body_lift_m) {
  spread_slices(plan);
  for (const int across : {1, 2}) spread_diagonal(across, plan.size_m.x(), share);
}

void Drag::spread_slices(const Plan& plan) {
  const double half = plan.density_kg_m3 / 2 * plan.crossflow;
  for (const Slice& slice : plan.slices) {
    for (const Node& node : kGauss3) {
      const double area = half * slice.length_m * node.weight / 2;
      points_.push_back(
          {slice.x_m + node.at * slice.length_m / 2, area * slice.height_m, area * slice.width_m, true});
    }
  }
}

void Drag::spread_diagonal(int across, double length_m, double share) {
  const int turning = across == 1 ? 5 : 4;
  const double whole = quadratic_(across, across);
  if (!(length_m > 0 && whole > 0 && share > 0)) return;
  double per_drag = 0;  // of turning, for a drag of 1
  for (const Node& node : kGauss5) per_drag += node.weight / 2 * std::pow(std::abs(node.at) * length_m / 2, 3);
  const double there = kMostOfTurning * std::max(quadratic_(turning, turning), 0.0);
  const double spread = std::min(share * whole, there / per_drag);
  for (const Node& node : kGauss5) {
    const double drag = spread * node.weight / 2;
    points_.push_back({node.at * length_m / 2, across == 1 ? drag : 0, across == 2 ? drag : 0, false});
  }
  quadratic_(across, across) -= spread;
  quadratic_(turning, turning) -= spread * per_drag;
}

Wrench Drag::operator()(const Flow& flow, const Vector6& factors) const {
  Vector6 nu;
  nu << flow.velocity_m_s, flow.rate_rad_s;
  const double ahead = std::abs(nu(0));
  Wrench sum = -(linear_ * nu) - quadratic_ * nu.cwiseAbs().cwiseProduct(nu) - ahead * (lift_ * nu);
  sum(0) -= axial_kg_m_ * ahead * nu(0);
  const double side = -body_lift_kg_m_ * ahead * nu(1), down = -body_lift_kg_m_ * ahead * nu(2);
  sum(1) += side;
  sum(2) += down;
  sum(4) -= body_lift_m_ * down;
  sum(5) += body_lift_m_ * side;
  for (const Point& point : points_) {
    const double v = nu(1) + point.x_m * nu(5), w = nu(2) - point.x_m * nu(4);
    const double across = std::hypot(v, w);
    const double Y = -point.sway_kg_m * (point.is_round ? across : std::abs(v)) * v;
    const double Z = -point.heave_kg_m * (point.is_round ? across : std::abs(w)) * w;
    sum(1) += Y;
    sum(2) += Z;
    sum(4) -= point.x_m * Z;
    sum(5) += point.x_m * Y;
  }
  return sum.cwiseProduct(factors);
}

}  // namespace navcal::reference::thrusters
