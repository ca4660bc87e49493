// SPDX-License-Identifier: Apache-2.0
#include "sim/path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "config/error.h"
#include "sim/rotation.h"
#include "tests/sim/drive.h"

namespace navcal::sim::testing {
namespace {

std::int64_t path_time_ns(double t_s) { return kStart_ns + static_cast<std::int64_t>(std::llround(t_s * 1e9)); }

/// Position is the integral of velocity and attitude that of the rates, everywhere and across the end.
void expect_consistent(const Motion& motion, double from_s, double to_s, double step_s, double velocity_tolerance,
                       double rate_tolerance) {
  for (double t = from_s; t < to_s; t += step_s) {
    constexpr double kHalf_s = 0.01;
    const State before = motion.at(path_time_ns(t - kHalf_s)), now = motion.at(path_time_ns(t)),
                after = motion.at(path_time_ns(t + kHalf_s));
    const Vector3 velocity = R_world_from_body(now.euler_rad) * now.velocity_body_m_s;
    Vector3 euler_rate{};
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_NEAR((after.position_m[i] - before.position_m[i]) / (2 * kHalf_s), velocity[i], velocity_tolerance)
          << t;
      euler_rate[i] = (after.euler_rad[i] - before.euler_rad[i]) / (2 * kHalf_s);
    }
    euler_rate[2] = std::remainder(euler_rate[2] * 2 * kHalf_s, 2 * std::numbers::pi) / (2 * kHalf_s);
    const Vector3 rates = body_rates(now.euler_rad, euler_rate);
    for (std::size_t i = 0; i < 3; ++i) ASSERT_NEAR(rates[i], now.rate_rad_s[i], rate_tolerance) << t;
  }
}

TEST(Path, TheDefaultOneClosesAndIsConsistentAcrossItsEnd) {
  const PathMotion motion(default_path(), kStart_ns);
  EXPECT_TRUE(motion.closed());
  expect_consistent(motion, 0.5, 2.2 * motion.duration_s(), 0.37, 2e-3, 2e-3);
}

TEST(Path, TheDefaultOneTurnsBothWaysAndDivesBelowTheReachOfGps) {
  double least = 0, greatest = 0, deepest = 0, shallowest = 100;
  for (const PathRow& row : default_path()) {
    least = std::min(least, row.rate_rad_s[2]);
    greatest = std::max(greatest, row.rate_rad_s[2]);
    deepest = std::max(deepest, row.position_m[2]);
    shallowest = std::min(shallowest, row.position_m[2]);
  }
  EXPECT_LT(least, -0.4);
  EXPECT_GT(greatest, 0.4);
  EXPECT_GT(deepest, 1);
  EXPECT_GT(shallowest, 0);
  EXPECT_LT(shallowest, 0.35);
}

std::vector<PathRow> open_path() {
  std::vector<PathRow> rows;
  for (int i = 0; i <= 100; ++i) {  // a right turn at 0.5 rad/s, level
    PathRow row;
    row.t_s = i * 0.01;
    row.euler_rad = {0, 0, 0.5 * row.t_s};
    row.velocity_body_m_s = {1, 0, 0};
    row.rate_rad_s = {0, 0, 0.5};
    row.position_m = {std::sin(0.5 * row.t_s) / 0.5, (1 - std::cos(0.5 * row.t_s)) / 0.5, 0.2};
    rows.push_back(row);
  }
  return rows;
}

TEST(Path, AnyOtherGoesOnWithItsLastTurn) {
  const PathMotion motion(open_path(), kStart_ns);
  EXPECT_FALSE(motion.closed());
  expect_consistent(motion, 0.1, 60, 0.21, 1e-4, 1e-6);
  const State late = motion.at(path_time_ns(50));
  EXPECT_NEAR(late.position_m[0], std::sin(25.0) / 0.5, 1e-6);
  EXPECT_NEAR(late.position_m[1], (1 - std::cos(25.0)) / 0.5, 1e-6);
  EXPECT_NEAR(late.specific_force_m_s2[1], 0.5, 1e-9) << "the turn is felt";
}

struct PathFile : ::testing::Test {
  std::filesystem::path file =
      std::filesystem::temp_directory_path() /
      ("navcal-path-" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
       ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv");
  ~PathFile() override { std::filesystem::remove(file); }
  void write(std::string_view rows) const {
    std::ofstream(file) << "t,x,y,z,phi,theta,psi,u,v,w,p,q,r,rpm,fin1,fin2,fin3\n" << rows;
  }
  std::string complaint() const {
    try {
      (void)load_path(file);
    } catch (const config::Error& error) {
      return error.what();
    }
    return {};
  }
};

TEST_F(PathFile, WrappedYawIsUnwrapped) {
  write("0,0,0,0,0,0,3.1,1,0,0,0,0,0,720,0,0,0\r\n0.1,0,0,0,0,0,-3.1,1,0,0,0,0,0,720,0,0,0\n");
  const auto rows = load_path(file);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_NEAR(rows[1].euler_rad[2], 2 * std::numbers::pi - 3.1, 1e-12);
}

TEST_F(PathFile, ComplaintsNameFileAndLine) {
  write("0,0,0,0,0,0,0,1,0,0,0,0,0,720,0,0,0\n0,0,0,0,0,0,0,1,0,0,0,0,0,720,0,0,0\n");
  EXPECT_NE(complaint().find(file.string() + ":3: the time does not increase"), std::string::npos) << complaint();
  write("0,0,0,0,0,0,0,1,0,0,0,0,0,720,0,0\n");
  EXPECT_NE(complaint().find(":2: not 17 numbers"), std::string::npos) << complaint();
  write("0,0,0,0,0,0,0,1,0,0,0,0,nan,720,0,0,0\n");
  EXPECT_NE(complaint().find(":2: not 17 numbers"), std::string::npos) << complaint();
  write("");
  EXPECT_NE(complaint().find("two rows"), std::string::npos) << complaint();
  std::filesystem::remove(file);
  EXPECT_NE(complaint().find("cannot be read"), std::string::npos);
}

TEST(Path, ThePathsOfTheReferenceVehicleAreConsistent) {
  const std::filesystem::path file = std::filesystem::path(NAVCAL_SHARED_DIR) / "paths" / "path3.csv";
  if (!std::filesystem::exists(file)) {
    std::printf("%s is absent\n", file.c_str());
    GTEST_SKIP();
  }
  const PathMotion motion(load_path(file), kStart_ns);
  EXPECT_FALSE(motion.closed());
  expect_consistent(motion, 5, 49.9, 0.5, 5e-3, 2e-2);
  expect_consistent(motion, 50.1, 80, 0.5, 5e-3, 2e-2);
}

}  // namespace
}  // namespace navcal::sim::testing
