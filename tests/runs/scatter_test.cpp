// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "runs/nominal_vehicle.h"

namespace navcal::runs {
namespace {

TEST(ScatterOfRuns, FindsBothVariances) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  constexpr int kSessions = 200, kRuns = 8;
  Eigen::MatrixXd values(kSessions * kRuns, 2);
  std::vector<std::vector<std::size_t>> sessions;
  for (int s = 0; s < kSessions; ++s) {
    auto& session = sessions.emplace_back();
    const double first = 2 * normal(random), second = 0.5 * first;
    for (int r = 0; r < kRuns; ++r) {
      const int row = s * kRuns + r;
      values.row(row) << 5 + first + normal(random), second + 3 * normal(random);
      session.push_back(static_cast<std::size_t>(row));
    }
  }
  const Scatter found = scatter_of(values, sessions, 4);
  EXPECT_EQ(found.sessions, std::size_t{kSessions});
  EXPECT_NEAR(found.mean[0], 5, 0.4);
  EXPECT_NEAR(found.session(0, 0), 4, 0.8);
  EXPECT_NEAR(found.session(1, 1), 1, 0.4);
  EXPECT_NEAR(found.run(0, 0), 1, 0.1);
  EXPECT_NEAR(found.run(1, 1), 9, 0.8);
}

TEST(ScatterOfRuns, WithOneSessionIsAssumedBetweenSessions) {
  Eigen::MatrixXd values(4, 1);
  values << 1, 2, 3, 4;
  const std::vector<std::vector<std::size_t>> sessions{{0, 1, 2, 3}};
  const Scatter found = scatter_of(values, sessions, 4);
  EXPECT_NEAR(found.run(0, 0), 5.0 / 3, 1e-12);
  EXPECT_NEAR(found.session(0, 0), 20.0 / 3, 1e-12);
}

TEST(SessionsOfRuns, DaysThatOverlapOnTheClockArePartedByBallast) {
  std::vector<RestState> rest;
  for (int i = 0; i < 10; ++i) {
    rest.push_back({1000.0 + 60 * i, 0.10, 0.02, 605});
    rest.push_back({1005.0 + 60 * i, 0.06, 0.03, 615});
  }
  const auto sessions = sessions_of(rest);
  ASSERT_EQ(sessions.size(), 2U);
  for (const auto& session : sessions) {
    EXPECT_EQ(session.size(), 10U);
    for (const std::size_t run : session) EXPECT_EQ(run % 2, session[0] % 2);
  }
}

TEST(SessionsOfRuns, ALongPauseEndsASession) {
  const std::vector<RestState> rest{{1000, 0.1, 0, 605}, {1060, 0.1, 0, 605}, {9000, 0.1, 0, 605}};
  EXPECT_EQ(sessions_of(rest).size(), 2U);
  EXPECT_TRUE(sessions_of({}).empty());
}

}  // namespace
}  // namespace navcal::runs
