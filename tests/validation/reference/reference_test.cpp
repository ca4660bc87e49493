// SPDX-License-Identifier: Apache-2.0
// This reality against the reference paths and the check values of the vehicle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/validation/reference/paths.h"
#include "validation/reference/vehicle.h"

namespace navcal::reference::testing {
namespace {

constexpr double kDegreesPerRadian = 57.29577951308232;

class ReferencePath : public ::testing::TestWithParam<int> {
 protected:
  [[nodiscard]] static std::string name() { return "/paths/path" + std::to_string(GetParam()) + ".csv"; }
};

TEST_P(ReferencePath, DrivenByTheirFinsAndShaftItIsTheSame) {
  const auto rows = read_rows(NAVCAL_SHARED_DIR + name());
  if (rows.empty()) GTEST_SKIP() << "the reference paths at 100 Hz are not here";
  Vehicle vehicle(Hull{}, {}, start_of(rows[0]));
  for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
    vehicle.hold(rows[k][13] / 60, fins_of(rows[k + 1]));
    vehicle.advance(rows[k + 1][0]);
  }
  EXPECT_NEAR(rows.back()[0], 50, 1e-9);
  EXPECT_LT(position_error_m(vehicle.snapshot(), rows.back()), 0.01);
  EXPECT_LT(heading_error_deg(vehicle.snapshot(), rows.back()), 0.05);
}

/// Ten rows a second tell the fins' way only roughly: good for a rough agreement, and for a machine without the
/// others.
TEST_P(ReferencePath, RoughlyTheSameByFixturesOfTenRowsASecond) {
  const auto rows = read_rows(NAVCAL_SOURCE_DIR "/fixtures" + name());
  ASSERT_FALSE(rows.empty());
  Vehicle vehicle(Hull{}, {}, start_of(rows[0]));
  double worst_m = 0, worst_deg = 0;
  constexpr int kParts = 5;
  for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
    const Row &from = rows[k], &to = rows[k + 1];
    for (int i = 0; i < kParts; ++i) {
      const double middle = (i + 0.5) / kParts;
      vehicle.hold(std::lerp(from[13], to[13], middle) / 60,
                   fins_of(from) + middle * (fins_of(to) - fins_of(from)));
      vehicle.advance(std::lerp(from[0], to[0], (i + 1.0) / kParts));
    }
    worst_m = std::max(worst_m, position_error_m(vehicle.snapshot(), to));
    worst_deg = std::max(worst_deg, heading_error_deg(vehicle.snapshot(), to));
  }
  EXPECT_LT(worst_m, 0.3);
  EXPECT_LT(worst_deg, 2);
}

INSTANTIATE_TEST_SUITE_P(All, ReferencePath, ::testing::Range(1, 9));

TEST(CheckValues, SpeedsStraightAhead) {
  for (const auto& [rev_s, speed_m_s] : {std::pair{10.0, 0.872}, {13.0, 1.134}, {16.0, 1.395}}) {
    Vehicle vehicle(Hull{}, {}, {});
    vehicle.hold(rev_s, Vector3::Zero());
    vehicle.advance(60);
    EXPECT_NEAR(vehicle.snapshot().velocity_m_s.x(), speed_m_s, 0.005 * speed_m_s);
  }
}

TEST(CheckValues, SteadyTurnWithTheFinsHardOver) {
  Vehicle vehicle(Hull{}, {}, {});
  vehicle.hold(13, Vector3(-25, 13.75, 13.75) / kDegreesPerRadian);
  vehicle.advance(60);
  const Snapshot s = vehicle.snapshot();
  vehicle.advance(61);
  const double turned_rad = std::remainder(vehicle.snapshot().heading_rad() - s.heading_rad(), 6.283185307179586);
  EXPECT_NEAR(s.rate_rad_s.z(), 0.8070, 0.005 * 0.8070);
  EXPECT_NEAR(turned_rad, 0.8270, 0.005 * 0.8270);
  EXPECT_NEAR(s.velocity_m_s.x(), 0.948, 0.005 * 0.948);
  EXPECT_NEAR(s.velocity_m_s.norm() / s.rate_rad_s.z(), 1.187, 0.005 * 1.187);
  EXPECT_NEAR(s.roll_rad() * kDegreesPerRadian, 3.0, 0.05);
  EXPECT_NEAR(s.pitch_rad() * kDegreesPerRadian, -12.3, 0.05);
}

}  // namespace
}  // namespace navcal::reference::testing
