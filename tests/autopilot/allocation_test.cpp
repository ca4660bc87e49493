// SPDX-License-Identifier: Apache-2.0
// Allocation of wanted forces and moments to the actuators of any layout.
#include "autopilot/allocation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "autopilot/controllability.h"
#include "autopilot/thrust_curve.h"

namespace navcal::autopilot {
namespace {

config::LayoutThruster percent_thruster(std::string name, config::LayoutVector place,
                                        config::LayoutVector direction) {
  config::LayoutThruster thruster;
  thruster.name = std::move(name);
  thruster.place_m = place;
  thruster.direction = direction;
  thruster.unit = config::CommandUnit::percent;
  thruster.table_command = {-100, -5, 5, 100};
  thruster.table_force_N = {-30, 0, 0, 40};
  thruster.low = -100;
  thruster.high = 100;
  return thruster;
}

/// Four thrusters at 45 degrees in the plane and as many upright ones as wanted.
config::Layout vectored(int upright) {
  config::Layout layout;
  const double x = 0.16, y = 0.11, z = 0.085;
  layout.thrusters = {percent_thruster("1", {x, y, z}, {1, -1, 0}), percent_thruster("2", {x, -y, z}, {1, 1, 0}),
                      percent_thruster("3", {-x, y, z}, {1, 1, 0}),
                      percent_thruster("4", {-x, -y, z}, {1, -1, 0})};
  const double far = 0.2;
  const std::array<config::LayoutVector, 4> places{
      {{far, far, 0}, {far, -far, 0}, {-far, far, 0}, {-far, -far, 0}}};
  for (int i = 0; i < upright; ++i)
    layout.thrusters.push_back(
        percent_thruster(std::to_string(5 + i), places[static_cast<std::size_t>(i)], {0, 0, 1}));
  return layout;
}

config::Layout finned() {
  config::Layout layout;
  layout.thrusters = {percent_thruster("stern", {-0.5, 0, 0}, {1, 0, 0})};
  for (int i = 0; i < 3; ++i) {
    const double angle = 2.0943951023931953 * i;
    config::LayoutSurface fin;
    fin.name = "fin " + std::to_string(i);
    fin.place_m = {-0.4, 0.08 * std::sin(angle), -0.08 * std::cos(angle)};
    fin.normal = {0, std::cos(angle), std::sin(angle)};
    fin.area_m2 = 0.005;
    fin.lift_slope_per_rad = 3;
    fin.limit_rad = 0.4;
    layout.surfaces.push_back(fin);
  }
  return layout;
}

/// What the commands give by the thrust curves themselves, without surfaces.
Wrench given_by(const config::Layout& layout, const Allocation& allocation) {
  Wrench sum = Wrench::Zero();
  for (std::size_t i = 0; i < layout.thrusters.size(); ++i) {
    const auto& thruster = layout.thrusters[i];
    const double force = thrust_at(thruster, layout.water_density_kg_m3,
                                   effective_command(thruster, allocation.thruster_commands[i]), 0)
                             .force_N;
    const Eigen::Vector3d r(thruster.place_m[0], thruster.place_m[1], thruster.place_m[2]);
    const Eigen::Vector3d e =
        Eigen::Vector3d(thruster.direction[0], thruster.direction[1], thruster.direction[2]).normalized();
    sum.head<3>() += force * e;
    sum.tail<3>() += force * r.cross(e);
  }
  return sum;
}

Wrench random_wrench(std::mt19937& random, double force, double moment) {
  std::uniform_real_distribution<double> part(-1, 1);
  Wrench wrench;
  wrench << force * part(random), force * part(random), force * part(random), moment * part(random),
      moment * part(random), moment * part(random);
  return wrench;
}

TEST(BoundedLeastSquares, MeetsTheConditionsOfItsMinimum) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 300; ++trial) {
    const Eigen::Index n = 1 + trial % 9;
    const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(6, n, [&] { return normal(random); });
    const Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(6, [&] { return 3 * normal(random); });
    const Eigen::VectorXd low = Eigen::VectorXd::Constant(n, -0.4), high = Eigen::VectorXd::Constant(n, 0.7);
    const double eps = 1e-4;
    const Eigen::VectorXd x = bounded_least_squares(A, b, eps, low, high);
    const Eigen::VectorXd gradient = A.transpose() * (A * x - b) + eps * eps * x;
    for (Eigen::Index i = 0; i < n; ++i) {
      ASSERT_GE(x[i], low[i]);
      ASSERT_LE(x[i], high[i]);
      EXPECT_TRUE(x[i] == low[i] || gradient[i] < 1e-8) << "it would fall further: " << gradient[i];
      EXPECT_TRUE(x[i] == high[i] || gradient[i] > -1e-8) << "it would rise further: " << gradient[i];
    }
  }
}

TEST(Allocation, ReproducesWhatCanBeHad) {
  const config::Layout layout = vectored(4);
  const Allocator allocator(layout);
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    AllocationRequest request;
    request.wanted = random_wrench(random, 15, 1.5);
    const Allocation allocation = allocator.allocate(request);
    EXPECT_EQ(allocation.part, 1);
    EXPECT_NEAR((given_by(layout, allocation) - request.wanted).norm(), 0, 1e-4);
  }
}

TEST(Allocation, NeverExceedsLimitsAndKeepsTheDirection) {
  const config::Layout layout = vectored(4);
  const Allocator allocator(layout);
  std::mt19937 random(2);
  for (int trial = 0; trial < 200; ++trial) {
    AllocationRequest request;
    request.wanted = random_wrench(random, 3000, 300);
    const Allocation allocation = allocator.allocate(request);
    for (const double command : allocation.thruster_commands) {
      EXPECT_GE(command, -100);
      EXPECT_LE(command, 100);
    }
    EXPECT_LT(allocation.part, 1);
    EXPECT_GT(allocation.part, 0);
    const Wrench given = given_by(layout, allocation);
    EXPECT_NEAR(given.normalized().dot(request.wanted.normalized()), 1, 1e-6);
    double fullest = 0;
    for (const double command : allocation.thruster_commands) fullest = std::max(fullest, std::abs(command));
    EXPECT_GT(fullest, 99) << "no more could be had";
  }
}

TEST(Allocation, LeastSquaresComesAtLeastAsNearAsTheScaledWrench) {
  const Allocator allocator(vectored(4));
  std::mt19937 random(4);
  for (int trial = 0; trial < 50; ++trial) {
    AllocationRequest request;
    request.wanted = random_wrench(random, 300, 30);
    const Wrench kept = allocator.allocate(request).reached;
    request.saturation = Saturation::least_squares;
    const Wrench near = allocator.allocate(request).reached;
    const Wrench rows =
        allocator.row_scales(allocator.matrix(request.velocity), allocator.limits(request.velocity));
    EXPECT_LE(rows.cwiseProduct(near - request.wanted).norm(),
              rows.cwiseProduct(kept - request.wanted).norm() + 1e-6);
  }
}

TEST(Allocation, TheOthersTakeOverFromADeadThruster) {
  const config::Layout layout = vectored(4);
  Allocator allocator(layout);
  ASSERT_TRUE(allocator.set_dead("6"));
  EXPECT_FALSE(allocator.set_dead("nobody"));
  AllocationRequest request;
  request.wanted << 10, 0, 5, 0, 0, 0.5;
  const Allocation allocation = allocator.allocate(request);
  EXPECT_EQ(effective_command(layout.thrusters[5], allocation.thruster_commands[5]), 0);
  EXPECT_NEAR((given_by(layout, allocation) - request.wanted).norm(), 0, 1e-4);
  allocator.set_dead("6", false);
  EXPECT_NE(allocator.allocate(request).thruster_commands[5], 0);
}

TEST(Allocation, FinsAreAskedForWhatTheSpeedAllows) {
  const Allocator allocator(finned());
  AllocationRequest request;
  request.weights << 1, 0, 0, 1, 1, 1;
  request.wanted << 5, 0, 0, 0, 0, 0.5;
  request.velocity[0] = 1.5;
  const Allocation fast = allocator.allocate(request);
  EXPECT_EQ(fast.part, 1);
  EXPECT_NEAR(fast.reached[5], 0.5, 1e-6);
  EXPECT_NEAR(fast.surfaces_rad[1], fast.surfaces_rad[2], 1e-9) << "both lower fins alike";
  EXPECT_NEAR(fast.surfaces_rad[0], -2 * fast.surfaces_rad[1], 1e-6) << "no roll";
  request.velocity[0] = 0.1;
  const Allocation slow = allocator.allocate(request);
  EXPECT_LT(slow.part, 0.1);
  for (const double angle : slow.surfaces_rad) EXPECT_LE(std::abs(angle), 0.4);
  request.velocity[0] = 0;
  for (const double angle : allocator.allocate(request).surfaces_rad) EXPECT_EQ(angle, 0);
}

TEST(Controllability, SaysWhatCannotBeCommanded) {
  const Controllability all = controllability(Allocator(vectored(4)), Wrench::Zero());
  EXPECT_EQ(all.rank, 6);
  EXPECT_TRUE(all.missing.empty());
  EXPECT_LT(all.condition, 10);
  // Two upright thrusters, both at x = 0.2: heave and pitch in one.
  const Controllability coupled = controllability(Allocator(vectored(2)), Wrench::Zero());
  EXPECT_EQ(coupled.rank, 5);
  ASSERT_EQ(coupled.missing.size(), 1U);
  EXPECT_NE(coupled.missing[0].find("only together"), std::string::npos);
  Wrench ahead = Wrench::Zero();
  const Controllability at_rest = controllability(Allocator(finned()), ahead);
  EXPECT_EQ(at_rest.rank, 1);
  EXPECT_EQ(at_rest.missing, std::vector<std::string>{"sway, heave, roll, pitch, yaw cannot be commanded"});
  ahead[0] = 1;
  const Controllability under_way = controllability(Allocator(finned()), ahead);
  EXPECT_EQ(under_way.rank, 4);
  EXPECT_EQ(under_way.commands[0], Command::alone);
  EXPECT_EQ(under_way.commands[5], Command::with_others) << "with sway";
  EXPECT_EQ(under_way.missing,
            (std::vector<std::string>{"sway and yaw only together", "heave and pitch only together"}));
}

TEST(Controllability, ALayoutWithoutActuatorsCommandsNothing) {
  const Controllability nothing = controllability(Allocator(config::Layout{}), Wrench::Zero());
  EXPECT_EQ(nothing.rank, 0);
  EXPECT_EQ(nothing.missing.size(), 1U);
}

}  // namespace
}  // namespace navcal::autopilot
