// SPDX-License-Identifier: Apache-2.0
#include "control/lease_desk.h"

#include <gtest/gtest.h>

namespace navcal::control {
namespace {

const LeaseRequest kPilot{"pilot", 1, 0.5};
const LeaseRequest kOperator{"operator", 2, 1};

TEST(LeaseDesk, OneAtATimeAndTheRefusalNamesTheHolder) {
  LeaseDesk desk;
  EXPECT_EQ(desk.problem_with("a"), "no such lease");
  EXPECT_EQ(desk.grant(0, kPilot, "a", 1), "");
  EXPECT_EQ(desk.problem_with("a"), "");
  EXPECT_EQ(desk.grant(0, kPilot, "b", 2), "the lease is held by pilot (priority 1)");
  EXPECT_EQ(desk.grant(0, {"other", 0, 0.5}, "b", 2), "the lease is held by pilot (priority 1)");
  EXPECT_EQ(desk.holder()->token, "a");
  EXPECT_EQ(desk.holder()->expires_ns, 500'000'000);
}

TEST(LeaseDesk, AHigherPriorityTakesOverAndTheFormerHolderIsTold) {
  LeaseDesk desk;
  ASSERT_EQ(desk.grant(0, kPilot, "a", 1), "");
  EXPECT_EQ(desk.grant(10, kOperator, "b", 2), "");
  EXPECT_EQ(desk.problem_with("a"), "preempted by operator (priority 2)");
  EXPECT_EQ(desk.problem_with("b"), "");
  EXPECT_EQ(desk.grant(20, kPilot, "c", 1), "the lease is held by operator (priority 2)");
}

TEST(LeaseDesk, TheSameConnectionMayAskAnew) {
  LeaseDesk desk;
  ASSERT_EQ(desk.grant(0, kPilot, "a", 1), "");
  EXPECT_EQ(desk.grant(0, {"pilot", 0, 3}, "b", 1), "");
  EXPECT_EQ(desk.problem_with("a"), "another lease took its place");
  EXPECT_EQ(desk.holder()->priority, 0);
}

TEST(LeaseDesk, WhyTheLastSixteenEndedIsRemembered) {
  LeaseDesk desk;
  for (int i = 0; i < 20; ++i) {
    ASSERT_EQ(desk.grant(i, kPilot, std::to_string(i), 1), "");
    desk.end("end " + std::to_string(i));
  }
  EXPECT_EQ(desk.problem_with("3"), "no such lease");
  EXPECT_EQ(desk.problem_with("4"), "end 4");
  EXPECT_EQ(desk.problem_with("19"), "end 19");
  desk.end("nobody is there");
  EXPECT_EQ(desk.problem_with("4"), "end 4") << "an end without a holder changes nothing";
}

TEST(LeaseDesk, AnEmptyTokenIsNobodys) {
  LeaseDesk desk;
  EXPECT_EQ(desk.problem_with(""), "no such lease");
  ASSERT_EQ(desk.grant(0, kPilot, "a", 1), "");
  EXPECT_EQ(desk.problem_with(""), "no such lease");
}

}  // namespace
}  // namespace navcal::control
