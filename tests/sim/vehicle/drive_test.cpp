// SPDX-License-Identifier: Apache-2.0
// The paths that the reference vehicle took, driven again by its fins and shaft.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "sim/vehicle/drive_helm.h"
#include "tests/sim/vehicle/runs.h"

namespace navcal::sim::testing {
namespace {

struct Miss {
  double position_m = 0, heading_deg = 0;
};

/// The greatest distance on the way; the heading at the end.
Miss miss_of(const std::filesystem::path& file) {
  const auto rows = load_path(file);
  const SimulatedMotion motion(config::VehicleSettings{}, std::make_unique<DriveHelm>(rows), {});
  Miss miss;
  EXPECT_NEAR(motion.duration_s(), rows.back().t_s - rows.front().t_s, 1e-6);
  for (const PathRow& row : rows) {
    const State state = motion.at(at_s(row.t_s - rows.front().t_s));
    miss.position_m = std::max(miss.position_m, std::hypot(state.position_m[0] - row.position_m[0],
                                                           state.position_m[1] - row.position_m[1],
                                                           state.position_m[2] - row.position_m[2]));
    miss.heading_deg = std::abs(state.euler_rad[2] - row.euler_rad[2]) * kDegrees;
  }
  return miss;
}

class Drive : public ::testing::TestWithParam<int> {
 protected:
  [[nodiscard]] std::string name() const { return "path" + std::to_string(GetParam()) + ".csv"; }
};

TEST_P(Drive, AReferencePathIsReproduced) {
  const auto file = std::filesystem::path(NAVCAL_SHARED_DIR) / "paths" / name();
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
  const Miss miss = miss_of(file);
  EXPECT_LT(miss.position_m, 1e-6);
  EXPECT_LT(miss.heading_deg, 1e-4);
}

TEST_P(Drive, OfARowEveryTenthOfASecondItIsStillNear) {
  const Miss miss = miss_of(std::filesystem::path(NAVCAL_SOURCE_DIR) / "fixtures" / "paths" / name());
  EXPECT_LT(miss.position_m, 0.05) << "fins move in a bend between rows";
  EXPECT_LT(miss.heading_deg, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Paths, Drive, ::testing::Range(1, 9));

TEST(Drive, AtItsOwnStepARecordedDriveComesBackToItsLastDigit) {
  const Miss miss = miss_of(std::filesystem::path(NAVCAL_SOURCE_DIR) / "fixtures" / "drive" / "zigzag.csv");
  EXPECT_LT(miss.position_m, 1e-6);
  EXPECT_LT(miss.heading_deg, 1e-4);
}

TEST(Drive, AfterTheLastRowFinsAndShaftStayAsTheyAre) {
  std::vector<PathRow> rows(2);
  rows[1].t_s = 1;
  rows[0].rpm = 600;
  rows[1].rpm = 780;
  rows[1].fins_rad = {-0.1, 0.05, 0.05};
  const SimulatedMotion motion(config::VehicleSettings{}, std::make_unique<DriveHelm>(rows), {});
  EXPECT_NEAR(motion.duration_s(), 1, 1e-9);
  EXPECT_NEAR(motion.at(at_s(0.5)).rpm, 690, 1e-9);
  EXPECT_NEAR(motion.at(at_s(60)).rpm, 780, 1e-9);
  EXPECT_NEAR(motion.at(at_s(60)).fins_rad[0], -0.1, 1e-12);
  EXPECT_NEAR(motion.at(at_s(60)).velocity_body_m_s[0], 1.05, 0.1) << "it has been going on";
}

}  // namespace
}  // namespace navcal::sim::testing
