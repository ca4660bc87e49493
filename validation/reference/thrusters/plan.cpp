// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/thrusters/plan.h"

#include <algorithm>
#include <cmath>

namespace navcal::reference::thrusters {
namespace {

Eigen::Matrix3d cross_matrix(const Vector3& r) {
  Eigen::Matrix3d S;
  S << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return S;
}

double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
  if (at <= x.front()) return y.front();
  if (at >= x.back()) return y.back();
  const auto above = static_cast<std::size_t>(std::ranges::upper_bound(x, at) - x.begin());
  return std::lerp(y[above - 1], y[above], (at - x[above - 1]) / (x[above] - x[above - 1]));
}

}  // namespace

double PlannedThruster::bollard_N(double order, double density_kg_m3) const {
  const double within = std::clamp(order, low, high);
  if (std::abs(within - neutral()) < dead_band) return 0;
  if (diameter_m <= 0) return interpolated(command, force_N, within);
  const double n = within / 60;
  const double forward = density_kg_m3 * n * std::abs(n) * std::pow(diameter_m, 4) * std::max(KT.front(), 0.0);
  return n < 0 ? reverse_efficiency * forward : forward;
}

Matrix6 inertia(const Plan& plan) {
  const Eigen::Matrix3d arm = plan.mass_kg * cross_matrix(plan.gravity_centre_m);
  Matrix6 M = plan.added_mass;
  M.topLeftCorner<3, 3>().diagonal().array() += plan.mass_kg;
  M.topRightCorner<3, 3>() -= arm;
  M.bottomLeftCorner<3, 3>() += arm;
  M.bottomRightCorner<3, 3>() += plan.inertia_kg_m2 - arm * cross_matrix(plan.gravity_centre_m);
  return M;
}

}  // namespace navcal::reference::thrusters
