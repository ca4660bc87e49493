// SPDX-License-Identifier: Apache-2.0
#include "autopilot/allocation.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "autopilot/thrust_curve.h"

namespace navcal::autopilot {
namespace {

enum class Held { no, at_low, at_high };

/// The step of the free variables to the minimum with the others where they are.
Eigen::VectorXd free_step(const Eigen::MatrixXd& H, const Eigen::VectorXd& gradient,
                          const std::vector<Held>& held) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < H.rows(); ++i) {
    if (held[static_cast<std::size_t>(i)] == Held::no) free.push_back(i);
  }
  Eigen::VectorXd step = Eigen::VectorXd::Zero(H.rows());
  if (!free.empty()) {
    const Eigen::VectorXd reduced = Eigen::MatrixXd(H(free, free)).ldlt().solve(-gradient(free));
    step(free) = reduced;
  }
  return step;
}

Eigen::Vector3d allocation_vector(const config::LayoutVector& v) { return {v[0], v[1], v[2]}; }

/// Generalised force of a unit force along a direction at a place; its product with a velocity is the speed of the
/// place along the direction.
Wrench unit_force(const config::LayoutVector& place_m, const config::LayoutVector& direction) {
  const Eigen::Vector3d e = allocation_vector(direction).normalized();
  Wrench wrench;
  wrench << e, allocation_vector(place_m).cross(e);
  return wrench;
}

struct Flow {
  double along_m_s, across_m_s;
};

Flow flow_at(const config::LayoutSurface& surface, const Wrench& velocity) {
  return {unit_force(surface.place_m, surface.chord).dot(velocity),
          unit_force(surface.place_m, surface.normal).dot(velocity)};
}

Wrench thruster_column(const config::LayoutThruster& thruster, double density_kg_m3, const Wrench& velocity) {
  Wrench column = unit_force(thruster.place_m, thruster.direction);
  const double full = std::max(thruster.high, thruster.neutral());
  const Thrust thrust = thrust_at(thruster, density_kg_m3, full, column.dot(velocity));
  const Eigen::Vector3d axis = column.head<3>();
  if (thrust.force_N > 0) column.tail<3>() += thrust.torque_Nm / thrust.force_N * axis;
  return column;
}

}  // namespace

Eigen::VectorXd bounded_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, double eps,
                                      const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
  const Eigen::Index n = A.cols();
  if (n == 0) return {};
  const Eigen::MatrixXd H = A.transpose() * A + eps * eps * Eigen::MatrixXd::Identity(n, n);
  const Eigen::VectorXd c = A.transpose() * b;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n).cwiseMax(low).cwiseMin(high);
  std::vector<Held> held(static_cast<std::size_t>(n), Held::no);
  const double inwards = 1e-12 * (1 + c.cwiseAbs().maxCoeff());
  for (Eigen::Index round = 0; round < 10 * (n + 1); ++round) {
    const Eigen::VectorXd step = free_step(H, H * x - c, held);
    double part = 1;
    Eigen::Index blocking = -1;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double room = step[i] > 0 ? high[i] - x[i] : low[i] - x[i];
      if (step[i] != 0 && room / step[i] < part) {
        part = room / step[i];
        blocking = i;
      }
    }
    x = (x + part * step).cwiseMax(low).cwiseMin(high);
    if (blocking >= 0) {
      held[static_cast<std::size_t>(blocking)] = step[blocking] > 0 ? Held::at_high : Held::at_low;
      x[blocking] = step[blocking] > 0 ? high[blocking] : low[blocking];
      continue;
    }
    const Eigen::VectorXd gradient = H * x - c;
    double worst = inwards;
    Eigen::Index freed = -1;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Held where = held[static_cast<std::size_t>(i)];
      const double inward = where == Held::no ? 0 : where == Held::at_low ? -gradient[i] : gradient[i];
      if (inward > worst && low[i] < high[i]) {
        worst = inward;
        freed = i;
      }
    }
    if (freed < 0) break;
    held[static_cast<std::size_t>(freed)] = Held::no;
  }
  return x;
}

Allocator::Allocator(config::Layout layout)
    : layout_(std::move(layout)), dead_(layout_.thrusters.size() + layout_.surfaces.size()) {}

bool Allocator::set_dead(std::string_view name, bool is_dead) {
  for (std::size_t i = 0; i < dead_.size(); ++i) {
    const std::size_t thrusters = layout_.thrusters.size();
    if ((i < thrusters ? layout_.thrusters[i].name : layout_.surfaces[i - thrusters].name) != name) continue;
    dead_[i] = is_dead;
    return true;
  }
  return false;
}

Eigen::MatrixXd Allocator::matrix(const Wrench& velocity) const {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(6, static_cast<Eigen::Index>(dead_.size()));
  Eigen::Index column = 0;
  for (const auto& thruster : layout_.thrusters)
    matrix.col(column++) = thruster_column(thruster, layout_.water_density_kg_m3, velocity);
  for (const auto& surface : layout_.surfaces) {
    const Flow flow = flow_at(surface, velocity);
    const double pressure_N = 0.5 * layout_.water_density_kg_m3 * surface.area_m2 *
                              (flow.along_m_s * flow.along_m_s + flow.across_m_s * flow.across_m_s);
    matrix.col(column++) = pressure_N * surface.lift_slope_per_rad * unit_force(surface.place_m, surface.normal);
  }
  for (std::size_t i = 0; i < dead_.size(); ++i) {
    if (dead_[i]) matrix.col(static_cast<Eigen::Index>(i)).setZero();
  }
  return matrix;
}

Allocator::Limits Allocator::limits(const Wrench& velocity) const {
  Limits limits{Eigen::VectorXd::Zero(static_cast<Eigen::Index>(dead_.size())),
                Eigen::VectorXd::Zero(static_cast<Eigen::Index>(dead_.size()))};
  Eigen::Index i = 0;
  for (const auto& thruster : layout_.thrusters) {
    const double advance_m_s = unit_force(thruster.place_m, thruster.direction).dot(velocity);
    const auto force_at = [&](double command) {
      return thrust_at(thruster, layout_.water_density_kg_m3, effective_command(thruster, command), advance_m_s)
          .force_N;
    };
    const double low = force_at(thruster.low), high = force_at(thruster.high);
    limits.low[i] = std::min(low, high);
    limits.high[i++] = std::max(low, high);
  }
  for (const auto& surface : layout_.surfaces) {
    const Flow flow = flow_at(surface, velocity);
    const double inflow_rad = std::atan2(flow.across_m_s, std::max(std::abs(flow.along_m_s), 0.001));
    limits.low[i] = std::clamp(inflow_rad - surface.stall_rad, -surface.limit_rad, surface.limit_rad);
    limits.high[i++] = std::clamp(inflow_rad + surface.stall_rad, -surface.limit_rad, surface.limit_rad);
  }
  for (std::size_t k = 0; k < dead_.size(); ++k) {
    if (dead_[k]) limits.low[static_cast<Eigen::Index>(k)] = limits.high[static_cast<Eigen::Index>(k)] = 0;
  }
  return limits;
}

Wrench Allocator::row_scales(const Eigen::MatrixXd& matrix, const Limits& limits) const {
  double force_N = 0, lever_m = 0;
  const Eigen::VectorXd most = limits.low.cwiseAbs().cwiseMax(limits.high.cwiseAbs());
  const Wrench attainable = matrix.cwiseAbs() * most;
  force_N = attainable.head<3>().maxCoeff();
  for (const auto& thruster : layout_.thrusters)
    lever_m = std::max(lever_m, allocation_vector(thruster.place_m).norm());
  for (const auto& surface : layout_.surfaces)
    lever_m = std::max(lever_m, allocation_vector(surface.place_m).norm());
  if (!(force_N > 0)) force_N = 1;
  if (!(lever_m > 0)) lever_m = 1;
  Wrench scales;
  scales.head<3>().setConstant(1 / force_N);
  scales.tail<3>().setConstant(1 / (force_N * lever_m));
  return scales;
}

Eigen::VectorXd Allocator::solve(const AllocationRequest& request, const Eigen::MatrixXd& matrix,
                                 const Limits& limits, double part) const {
  const Eigen::VectorXd most = limits.low.cwiseAbs().cwiseMax(limits.high.cwiseAbs());
  const Eigen::VectorXd unit = (most.array() > 0).select(most, 1.0);
  const Wrench rows = request.weights.cwiseProduct(row_scales(matrix, limits));
  const Eigen::MatrixXd A = rows.asDiagonal() * matrix * unit.asDiagonal();
  constexpr double kRegularisation = 1e-5;
  const double eps = kRegularisation * std::max(A.norm(), 1e-9);
  const Eigen::VectorXd x = bounded_least_squares(A, rows.cwiseProduct(part * request.wanted), eps,
                                                  limits.low.cwiseQuotient(unit), limits.high.cwiseQuotient(unit));
  return x.cwiseProduct(unit).cwiseMax(limits.low).cwiseMin(limits.high);
}

Allocation Allocator::allocate(const AllocationRequest& request) const {
  const Eigen::MatrixXd B = matrix(request.velocity);
  const Limits within = limits(request.velocity);
  const Wrench rows = request.weights.cwiseProduct(row_scales(B, within));
  Allocation allocation;
  Eigen::VectorXd f = solve(request, B, within, 1);
  if (request.saturation == Saturation::keep_direction) {
    constexpr double kTolerance = 1e-6;
    const auto misses = [&](double part) {
      const Wrench error = rows.cwiseProduct(B * f - part * request.wanted);
      return error.norm() > kTolerance * rows.cwiseProduct(request.wanted).norm();
    };
    if (misses(1)) {
      double low = 0, high = 1;
      for (int i = 0; i < 30; ++i) {
        const double middle = (low + high) / 2;
        f = solve(request, B, within, middle);
        (misses(middle) ? high : low) = middle;
      }
      allocation.part = low;
      f = solve(request, B, within, low);
    }
  }
  allocation.reached = B * f;
  Eigen::Index i = 0;
  for (const auto& thruster : layout_.thrusters) {
    const double advance_m_s = unit_force(thruster.place_m, thruster.direction).dot(request.velocity);
    const bool is_dead = dead_[static_cast<std::size_t>(i)];
    allocation.thruster_commands.push_back(
        is_dead ? effective_command(thruster, thruster.neutral())
                : command_for(thruster, layout_.water_density_kg_m3, f[i], advance_m_s));
    ++i;
  }
  for (std::size_t k = 0; k < layout_.surfaces.size(); ++k) allocation.surfaces_rad.push_back(f[i++]);
  return allocation;
}

}  // namespace navcal::autopilot
