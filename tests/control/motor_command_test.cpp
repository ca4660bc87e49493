// SPDX-License-Identifier: Apache-2.0
// Leases, limits, rate, slew and safe state with a simulated clock.
#include "control/motor_command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace navcal::control {
namespace {

constexpr std::int64_t kMs = 1'000'000;
const LeaseRequest kPilot{"pilot", 1, 0.5};
const LeaseRequest kOperator{"operator", 2, 1};

config::CommandSettings settings() {
  config::CommandSettings made;
  made.slew_rpm_s = 0;
  made.slew_fin_deg_s = 0;
  made.safe_fins_deg = {0, 1, -1};
  return made;
}

class MotorCommandTest : public testing::Test {
 protected:
  explicit MotorCommandTest(const config::CommandSettings& made = settings()) : command_(made) {
    command_.port_opened(0);
  }
  /// What goes out up to `until_ms`, at the times that the machine asks for: "500:780" for 780 rpm at 500 ms.
  std::vector<std::string> lines(std::int64_t until_ms) {
    std::vector<std::string> out;
    for (;;) {
      while (const auto line = command_.next(now_ns_)) {
        out.push_back(std::to_string(now_ns_ / kMs) + ':' + std::to_string(line->command.rpm) +
                      (line->source == Source::safe ? " safe" : ""));
      }
      if (command_.deadline_ns() > until_ms * kMs) break;
      EXPECT_GE(command_.deadline_ns(), now_ns_);
      now_ns_ = command_.deadline_ns();
    }
    now_ns_ = until_ms * kMs;
    return out;
  }
  std::string order(double rpm, std::string_view token = "a") {
    return command_.order(now_ns_, now_ns_, token, {rpm, {}});
  }
  std::string lease(const LeaseRequest& request = kPilot, std::string token = "a", std::uint64_t client = 1) {
    return command_.lease(now_ns_, request, std::move(token), client);
  }
  using Lines = std::vector<std::string>;

  MotorCommand command_;
  std::int64_t now_ns_ = 0;
};

TEST_F(MotorCommandTest, NothingIsSentBeforeTheFirstLease) {
  EXPECT_EQ(lines(100'000), Lines{});
  EXPECT_EQ(order(100), "no such lease");
  EXPECT_EQ(command_.release(now_ns_, "a"), "no such lease");
  EXPECT_EQ(lines(200'000), Lines{});
}

TEST_F(MotorCommandTest, AnOrderGoesOutAtOnceAndRenewsTheLease) {
  ASSERT_EQ(lease(), "");
  EXPECT_EQ(lines(100), Lines{});
  for (int i = 0; i < 20; ++i) {
    ASSERT_EQ(order(100 + i), "");
    EXPECT_EQ(lines(200 + 100 * i), Lines{std::to_string(100 + 100 * i) + ':' + std::to_string(100 + i)});
  }
  EXPECT_EQ(command_.sequence(), 20U);
}

TEST_F(MotorCommandTest, AnOrderThatIsTheSameGoesOutToo) {
  ASSERT_EQ(lease(), "");
  ASSERT_EQ(order(100), "");
  EXPECT_EQ(lines(100), Lines{"0:100"});
  ASSERT_EQ(order(100), "");
  EXPECT_EQ(lines(200), Lines{"100:100"});
}

TEST_F(MotorCommandTest, SilenceEndsTheLeaseInTheSafeStateUntilTheCardShowsIt) {
  ASSERT_EQ(lease(), "");
  ASSERT_EQ(order(780), "");
  EXPECT_EQ(lines(499), Lines{"0:780"});
  EXPECT_TRUE(command_.is_card_commanded());
  EXPECT_EQ(lines(1700), (Lines{"500:0 safe", "1000:0 safe", "1500:0 safe"}));
  EXPECT_EQ(command_.last_line()->command.fins_deg, (std::array<double, 3>{0, 1, -1}));
  EXPECT_FALSE(command_.holder());
  command_.safe_echoed();
  EXPECT_EQ(lines(10'000), Lines{});
  EXPECT_FALSE(command_.is_card_commanded());
  EXPECT_EQ(order(780), "the lease expired: no order came for 0.5 s");
}

// The machine must not depend on being asked in time.
TEST_F(MotorCommandTest, AnOrderThatComesAfterTheTimeOutFindsTheLeaseExpired) {
  ASSERT_EQ(lease(), "");
  ASSERT_EQ(order(780), "");
  EXPECT_EQ(lines(100), Lines{"0:780"});
  now_ns_ = 500 * kMs;
  EXPECT_EQ(order(900), "the lease expired: no order came for 0.5 s");
  EXPECT_EQ(lines(501), Lines{"500:0 safe"});
}

TEST_F(MotorCommandTest, ReleaseClosedConnectionAndShutDownAllEndInTheSafeState) {
  for (int way = 0; way < 3; ++way) {
    ASSERT_EQ(lease(), "") << way;
    ASSERT_EQ(order(500), "") << way;
    EXPECT_EQ(lines(now_ns_ / kMs + 10).size(), 1U) << way;
    if (way == 0) {
      EXPECT_EQ(command_.release(now_ns_, "a"), "");
    } else if (way == 1) {
      command_.client_gone(now_ns_, 2, "gone");
      EXPECT_EQ(lines(now_ns_ / kMs + 10), Lines{}) << "somebody else's connection";
      command_.client_gone(now_ns_, 1, "gone");
    } else {
      command_.shut_down(now_ns_);
    }
    const auto at = std::to_string(now_ns_ / kMs);
    EXPECT_EQ(lines(now_ns_ / kMs + 10), Lines{at + ":0 safe"}) << way;
    command_.safe_echoed();
    EXPECT_NE(order(500), "") << way;
  }
}

TEST_F(MotorCommandTest, ALeaseWithoutOrdersEndsInTheSafeStateOnce) {
  ASSERT_EQ(lease(), "");
  EXPECT_EQ(lines(600), Lines{"500:0 safe"});
  command_.safe_echoed();
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(lease(), "");
    ASSERT_EQ(command_.release(now_ns_, "a"), "");
  }
  EXPECT_EQ(lines(2000), Lines{}) << "leases that come and go fill no line";
}

TEST_F(MotorCommandTest, TheOperatorTakesOverAndTheProgramIsTold) {
  ASSERT_EQ(lease(), "");
  ASSERT_EQ(order(780), "");
  EXPECT_EQ(lines(100), Lines{"0:780"});
  ASSERT_EQ(lease(kOperator, "b", 2), "");
  EXPECT_EQ(lines(200), Lines{}) << "what was ordered stays until the operator orders";
  EXPECT_EQ(order(700, "a"), "preempted by operator (priority 2)");
  EXPECT_EQ(lease(kPilot, "c", 1), "the lease is held by operator (priority 2)");
  EXPECT_EQ(order(0, "b"), "");
  EXPECT_EQ(lines(300), Lines{"200:0"});
  command_.client_gone(now_ns_, 1, "gone");
  EXPECT_EQ(command_.holder()->name, "operator") << "the pilot's connection is nobody's concern now";
  EXPECT_EQ(lines(1201), Lines{"1200:0 safe"});
}

TEST_F(MotorCommandTest, AnOperatorWhoTakesOverAndSaysNothingEndsInTheSafeState) {
  ASSERT_EQ(lease(), "");
  ASSERT_EQ(order(780), "");
  ASSERT_EQ(lease(kOperator, "b", 2), "");
  EXPECT_EQ(lines(1001), (Lines{"0:780", "500:0 safe", "1000:0 safe"}))
      << "the pilot's order held for its own time";
}

TEST_F(MotorCommandTest, WhatIsBeyondLimitsOrNoNumberIsRefusedWithTheReason) {
  ASSERT_EQ(lease(), "");
  EXPECT_EQ(order(1201), "shaft_rpm 1201 is beyond 1200");
  EXPECT_EQ(order(-1201), "shaft_rpm -1201 is beyond 1200");
  EXPECT_EQ(order(std::numeric_limits<double>::quiet_NaN()), "shaft_rpm is no number");
  EXPECT_EQ(order(std::numeric_limits<double>::infinity()), "shaft_rpm is no number");
  EXPECT_EQ(command_.order(now_ns_, now_ns_, "a", {0, {0, 25.1, 0}}), "fins_deg[1] 25.1 is beyond 25");
  EXPECT_EQ(command_.order(now_ns_, now_ns_, "a", {0, {0, 0, -std::numeric_limits<double>::quiet_NaN()}}),
            "fins_deg[2] is no number");
  EXPECT_EQ(lines(499), Lines{});
  EXPECT_EQ(command_.sequence(), 0U);
  EXPECT_EQ(order(1200), "");
  EXPECT_EQ(order(-1200), "");
  EXPECT_EQ(command_.order(now_ns_, now_ns_, "a", {0, {25, -25, 0}}), "");
}

TEST_F(MotorCommandTest, ARefusedOrderDoesNotRenewTheLease) {
  ASSERT_EQ(lease(), "");
  for (; now_ns_ < 499 * kMs; now_ns_ += 10 * kMs) ASSERT_NE(order(5000), "");
  EXPECT_EQ(lines(600), Lines{"500:0 safe"});
}

TEST_F(MotorCommandTest, AFloodIsRefusedAndTheLeaseLives) {
  ASSERT_EQ(lease(), "");
  int taken = 0;
  std::string last;
  for (int i = 0; i < 20'000; ++i) {
    const auto refusal = order(100);
    taken += refusal.empty() ? 1 : 0;
    if (!refusal.empty()) last = refusal;
    while (command_.next(now_ns_)) continue;
    now_ns_ += kMs / 5;
  }
  EXPECT_EQ(last, "more than 40 orders a second");
  EXPECT_NEAR(taken, 40 * 4 + 10, 5);
  EXPECT_TRUE(command_.holder());
  // Whoever takes over begins with what the flood has not used up.
  ASSERT_EQ(lease(kOperator, "b", 2), "");
  EXPECT_EQ(order(0, "b"), "");
}

TEST_F(MotorCommandTest, WhileThePortIsAwayOrdersAreRefusedAndTheSafeStateWaits) {
  ASSERT_EQ(lease(), "");
  ASSERT_EQ(order(780), "");
  EXPECT_EQ(lines(100), Lines{"0:780"});
  command_.port_lost("the device is gone");
  EXPECT_EQ(order(700), "the motor card is away: the device is gone");
  EXPECT_EQ(lines(1000), Lines{});
  EXPECT_FALSE(command_.holder());
  command_.port_opened(now_ns_);
  EXPECT_EQ(lines(1001), Lines{"1000:0 safe"});
}

TEST_F(MotorCommandTest, APortThatComesBackInTimeGoesOn) {
  ASSERT_EQ(lease(), "");
  ASSERT_EQ(order(780), "");
  EXPECT_EQ(lines(100), Lines{"0:780"});
  command_.port_lost("the device is gone");
  command_.port_opened(200 * kMs);
  now_ns_ = 200 * kMs;
  EXPECT_EQ(order(790), "");
  EXPECT_EQ(lines(300), Lines{"200:790"});
}

TEST_F(MotorCommandTest, WhatAnEarlierRunLeftIsMadeSafe) {
  command_.commanded_before(0);
  EXPECT_EQ(lines(1), Lines{"0:0 safe"});
  MotorCommand later(settings());
  later.commanded_before(0);
  EXPECT_FALSE(later.next(5)) << "not before the port is open";
  later.port_opened(7);
  EXPECT_EQ(later.next(7)->source, Source::safe);
}

TEST_F(MotorCommandTest, ALeakEndsTheLeaseOfAProgramAndOnlyAnOperatorMayTakeChargeUntilItIsOver) {
  ASSERT_EQ(lease(), "");
  ASSERT_EQ(order(780), "");
  EXPECT_EQ(lines(0), Lines{"0:780"});
  command_.leak(now_ns_, "leak_aft");
  EXPECT_EQ(lines(1), Lines{"0:0 safe"});
  EXPECT_EQ(order(780), "the vehicle has a leak: leak_aft");
  EXPECT_EQ(lease(), "leak_aft stands: only an operator (priority 2 or more) may take charge");
  ASSERT_EQ(lease(kOperator, "b", 2), "");
  EXPECT_EQ(order(300, "b"), "");
  EXPECT_EQ(lines(2), Lines{"1:300"});
  command_.leak(now_ns_, "leak_forward");
  EXPECT_EQ(order(310, "b"), "") << "a second leak does not end the operator's lease";
  ASSERT_EQ(command_.release(now_ns_, "b"), "");
  command_.leak(now_ns_, "");
  EXPECT_EQ(lease(), "");
}

TEST_F(MotorCommandTest, ALeakWithNobodyInChargeSendsNothing) {
  command_.leak(now_ns_, "leak_aft");
  EXPECT_EQ(lines(1000), Lines{});
  ASSERT_EQ(command_.take_events().size(), 1U);
}

TEST_F(MotorCommandTest, AnOrderEndsTheRepetitionOfTheSafeState) {
  ASSERT_EQ(lease(), "");
  EXPECT_EQ(lines(600), Lines{"500:0 safe"});
  EXPECT_TRUE(command_.is_card_commanded()) << "until the card has shown the safe state";
  ASSERT_EQ(lease({"pilot", 1, 5}), "");
  ASSERT_EQ(order(780), "");
  EXPECT_EQ(lines(2000), Lines{"600:780"});
  command_.safe_echoed();
  EXPECT_TRUE(command_.is_card_commanded()) << "an old status does not end an order";
}

TEST_F(MotorCommandTest, AtTheEndTheSafeStateIsSentAtOnceIfTheCardMayObeyAnotherOrder) {
  EXPECT_EQ(lines(100), Lines{});
  ASSERT_EQ(lease(), "");
  ASSERT_EQ(command_.release(now_ns_, "a"), "");
  EXPECT_EQ(lines(200), Lines{"100:0 safe"});
  command_.shut_down(now_ns_);
  EXPECT_EQ(lines(201), Lines{"200:0 safe"});
}

TEST_F(MotorCommandTest, AnOrderThatThePortDidNotTakeIsNotSentAsANewOneLater) {
  ASSERT_EQ(lease(), "");
  ASSERT_EQ(order(780), "");
  command_.port_lost("the device is gone");
  command_.port_opened(now_ns_);
  for (const auto& line : {command_.next(50 * kMs), command_.next(51 * kMs)})
    EXPECT_TRUE(!line || line->source != Source::order);
}

TEST(MotorCommand, RepeatsTheSafeStateAtTheTimeOutOfTheEchoOrTwiceASecond) {
  for (const double timeout_s : {0.0, 0.3}) {
    config::CommandSettings made = settings();
    made.echo_timeout_s = timeout_s;
    MotorCommand command(made);
    command.commanded_before(0);
    command.port_opened(0);
    EXPECT_TRUE(command.next(0));
    EXPECT_EQ(command.deadline_ns(), timeout_s > 0 ? 300 * kMs : 500 * kMs);
  }
}

TEST_F(MotorCommandTest, EventsTellWhoIsInChargeAndWhatALeakDoes) {
  std::string events;
  const auto take = [&] {
    events.clear();
    for (const auto& event : command_.take_events())
      events += std::string(event.severity) + ' ' + std::string(event.name) + ' ' + event.message + '\n';
    return events;
  };
  ASSERT_EQ(lease(), "");
  EXPECT_EQ(take(), "info motor.lease pilot (priority 1) is in charge, time-out 0.5 s\n");
  ASSERT_EQ(lease(), "");
  EXPECT_EQ(take(), "info motor.lease pilot (priority 1) is in charge, time-out 0.5 s\n") << "the same connection";
  ASSERT_EQ(lease(kOperator, "b", 2), "");
  EXPECT_EQ(
      take(),
      "warning motor.lease operator (priority 2) is in charge instead of pilot (priority 1), time-out 1 s\n");
  command_.leak(now_ns_, "aft");
  EXPECT_EQ(take(), "warning motor.leak aft: operator (priority 2) stays in charge\n");
  command_.leak(now_ns_, "");
  EXPECT_EQ(take(), "");
  ASSERT_EQ(command_.release(now_ns_, "b"), "");
  EXPECT_EQ(take(),
            "warning motor.safe operator (priority 2): the lease was released; the safe state is ordered\n");
}

class LeakIsAnAlarmTest : public MotorCommandTest {
 protected:
  LeakIsAnAlarmTest()
      : MotorCommandTest([] {
          auto made = settings();
          made.on_leak = config::OnLeak::alarm;
          return made;
        }()) {}
};

TEST_F(LeakIsAnAlarmTest, NothingElseHappens) {
  ASSERT_EQ(lease(), "");
  static_cast<void>(command_.take_events());
  command_.leak(now_ns_, "leak_aft");
  EXPECT_EQ(order(780), "");
  EXPECT_TRUE(command_.take_events().empty());
  EXPECT_EQ(lease(), "");
}

TEST_F(MotorCommandTest, WhoeverTakesOverMayOrderAtOnceHoweverManyOrdersCameBefore) {
  ASSERT_EQ(lease(), "");
  while (order(100).empty()) continue;
  ASSERT_EQ(lease(kOperator, "b", 2), "");
  EXPECT_EQ(order(0, "b"), "");
}

TEST_F(MotorCommandTest, ALeakSaysWhoseLeaseEnds) {
  ASSERT_EQ(lease(), "");
  static_cast<void>(command_.take_events());
  command_.leak(now_ns_, "aft");
  EXPECT_EQ(command_.take_events().at(0).message, "aft: the lease of pilot (priority 1) ends");
}

TEST_F(MotorCommandTest, LeasesAtTheLimitsAreGranted) {
  EXPECT_EQ(lease({"p", 0, 0.2}), "");
  EXPECT_EQ(lease({std::string(64, 'x'), 1000, 5}), "");
}

TEST_F(MotorCommandTest, LeasesThatMakeNoSenseAreRefused) {
  EXPECT_EQ(lease({"", 1, 0.5}), "holder is a name of 1 to 64 bytes");
  EXPECT_EQ(lease({std::string(65, 'x'), 1, 0.5}), "holder is a name of 1 to 64 bytes");
  EXPECT_EQ(lease({"p", -1, 0.5}), "priority is 0 to 1000");
  EXPECT_EQ(lease({"p", 1001, 0.5}), "priority is 0 to 1000");
  EXPECT_EQ(lease({"p", 1, 0.1}), "timeout_s is 0.2 to 5");
  EXPECT_EQ(lease({"p", 1, 5.1}), "timeout_s is 0.2 to 5");
  EXPECT_EQ(lease({"p", 1, std::numeric_limits<double>::quiet_NaN()}), "timeout_s is 0.2 to 5");
  EXPECT_FALSE(command_.holder());
}

class ShapedMotorCommandTest : public MotorCommandTest {
 protected:
  static config::CommandSettings shaped() {
    auto made = settings();
    made.slew_rpm_s = 1000;
    made.safe_fins_deg = {};
    return made;
  }
  ShapedMotorCommandTest() : MotorCommandTest(shaped()) {}
};

TEST_F(ShapedMotorCommandTest, TheWayToAnOrderIsSentTwentyTimesASecondAndTheSafeStateAtOnce) {
  ASSERT_EQ(lease(), "");
  now_ns_ = 100 * kMs;
  ASSERT_EQ(order(180), "");
  EXPECT_EQ(lines(290), (Lines{"100:50", "150:100", "200:150", "250:180"}));
  EXPECT_FALSE(command_.is_shaping());
  EXPECT_EQ(lines(700), Lines{"600:0 safe"}) << "a stop is not shaped";
  ASSERT_EQ(lease(), "");
  ASSERT_EQ(order(-100), "");
  EXPECT_EQ(lines(800), (Lines{"700:-50", "750:-100"})) << "on from the safe state";
}

TEST(MotorCommand, TheFirstOrderIsReachedFromTheSafeState) {
  auto made = settings();
  made.slew_fin_deg_s = 100;
  MotorCommand command(made);
  command.port_opened(0);
  ASSERT_EQ(command.lease(0, kPilot, "a", 1), "");
  ASSERT_EQ(command.order(0, 0, "a", {0, {0, 25, 0}}), "");
  EXPECT_EQ(command.next(50 * kMs)->command.fins_deg, (std::array<double, 3>{0, 6, 0}));
}

TEST(RoundedForCard, WholeRevolutionsAndTenthsOfADegreeWithoutANegativeZero) {
  const auto rounded = rounded_for_card({-99.5, {12.34, -12.36, -0.01}});
  EXPECT_EQ(rounded.rpm, -100);
  EXPECT_EQ(rounded.fins_deg, (std::array<double, 3>{12.3, -12.4, 0}));
  EXPECT_FALSE(std::signbit(rounded.fins_deg[2]));
}

// Whatever controllers do: after the last time-out the card was last sent the safe state, and nothing was sent
// that is beyond the limits.
TEST_F(ShapedMotorCommandTest, AtTheEndTheShaftStands) {
  std::mt19937 random(7);  // NOLINT: the same orders in every run
  const auto draw = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::vector<std::string> tokens{"none"};
  bool open = true;
  for (int i = 0; i < 20'000; ++i) {
    now_ns_ += draw(60) * kMs;
    const auto client = static_cast<std::uint64_t>(draw(4));
    switch (draw(8)) {
      case 0:
        tokens.push_back(std::to_string(i));
        static_cast<void>(command_.lease(now_ns_, {"x", draw(3), 0.2 + 0.1 * draw(5)}, tokens.back(), client));
        break;
      case 1: static_cast<void>(command_.release(now_ns_, tokens[tokens.size() - 1])); break;
      case 2: command_.client_gone(now_ns_, client, "gone"); break;
      case 3:
        open ? command_.port_lost("x") : command_.port_opened(now_ns_);
        open = !open;
        break;
      default:
        static_cast<void>(command_.order(now_ns_, now_ns_ - draw(100) * kMs,
                                         tokens[tokens.size() - 1 - static_cast<std::size_t>(draw(1))],
                                         {draw(3000) - 1500.0, {draw(60) - 30.0, 0, 0}}));
    }
    for (int n = 0;; ++n) {
      ASSERT_LT(n, 3) << "next() must come to an end";
      const auto line = command_.next(now_ns_);
      if (!line) break;
      ASSERT_TRUE(open);
      ASSERT_LE(std::abs(line->command.rpm), 1200);
      ASSERT_LE(std::abs(line->command.fins_deg[0]), 25);
    }
  }
  if (!open) command_.port_opened(now_ns_);
  const bool commanded = command_.last_line().has_value();
  ASSERT_TRUE(commanded);
  lines(now_ns_ / kMs + 2000);
  EXPECT_FALSE(command_.holder());
  EXPECT_EQ(command_.last_line()->source, Source::safe);
  EXPECT_EQ(command_.last_line()->command.rpm, 0);
}

TEST_F(MotorCommandTest, NewLeasesAndRefusedOrdersDoNotHoldTheLastOrder) {
  ASSERT_EQ(lease(), "");
  ASSERT_EQ(order(600), "");
  EXPECT_EQ(lines(100), Lines{"0:600"});
  Lines out;
  for (int i = 1; i < 20; ++i) {
    EXPECT_NE(order(99'999, std::to_string(i - 1)), "");
    ASSERT_EQ(lease(kPilot, std::to_string(i)), "");
    for (auto& line : lines(100 + 100 * i)) out.push_back(std::move(line));
  }
  ASSERT_FALSE(out.empty());
  EXPECT_EQ(out.front(), "500:0 safe");
}

TEST_F(MotorCommandTest, ATakeoverThatNeverOrdersDoesNotInheritTheOrder) {
  ASSERT_EQ(lease(), "");
  ASSERT_EQ(order(600), "");
  EXPECT_EQ(lines(300), Lines{"0:600"});
  ASSERT_EQ(lease({"operator", 2, 5}, "b", 2), "");
  EXPECT_EQ(lines(900), Lines{"500:0 safe"});
  EXPECT_EQ(command_.holder()->name, "operator") << "who is in charge all the same";
  ASSERT_EQ(order(100, "b"), "");
  EXPECT_EQ(lines(1000), Lines{"900:100"});
}

TEST_F(MotorCommandTest, ATakeoverThatOrdersInTimeIsSmooth) {
  ASSERT_EQ(lease(), "");
  ASSERT_EQ(order(600), "");
  EXPECT_EQ(lines(300), Lines{"0:600"});
  ASSERT_EQ(lease({"operator", 2, 5}, "b", 2), "");
  ASSERT_EQ(order(590, "b"), "");
  EXPECT_EQ(lines(2000), Lines{"300:590"});
}

TEST_F(MotorCommandTest, AnOrderCountsFromTheTimeAtWhichItWasSent) {
  ASSERT_EQ(lease(), "");
  EXPECT_EQ(lines(400), Lines{});
  ASSERT_EQ(command_.order(now_ns_, now_ns_ - 300 * kMs, "a", {600, {}}), "");
  EXPECT_EQ(lines(1000), (Lines{"400:600", "600:0 safe"}));
}

TEST_F(MotorCommandTest, AnOrderThatWaitedLongerThanTheLeaseIsNeverSent) {
  ASSERT_EQ(lease(), "");
  EXPECT_EQ(lines(499), Lines{});
  ASSERT_EQ(command_.order(now_ns_, now_ns_ - 499 * kMs, "a", {600, {}}), "");
  now_ns_ = 500 * kMs;
  EXPECT_EQ(lines(600), Lines{"500:0 safe"});
}

TEST_F(MotorCommandTest, WhoeverStopsNeedsNoLease) {
  ASSERT_EQ(lease(kOperator), "");
  ASSERT_EQ(order(600), "");
  EXPECT_EQ(lines(100), Lines{"0:600"});
  EXPECT_EQ(command_.stop(now_ns_, "the page"), "");
  EXPECT_EQ(lines(200), Lines{"100:0 safe"});
  EXPECT_EQ(order(600), "stopped by the page");
  command_.safe_echoed();
  EXPECT_EQ(command_.stop(now_ns_, "the page"), "") << "again, though nobody is in charge";
  EXPECT_EQ(lines(300), Lines{"200:0 safe"});
  command_.port_lost("unplugged");
  EXPECT_NE(command_.stop(now_ns_, "the page").find("unplugged"), std::string::npos);
  EXPECT_EQ(lines(400), Lines{});
  command_.port_opened(now_ns_);
  EXPECT_EQ(lines(500), Lines{"400:0 safe"});
}

TEST_F(MotorCommandTest, ACardThatTurnsAfterItShowedTheSafeStateGetsItAgain) {
  command_.shown(now_ns_, 600);
  EXPECT_EQ(lines(50), Lines{}) << "of another's order, before the first lease, nothing is said";
  ASSERT_EQ(lease(), "");
  ASSERT_EQ(order(600), "");
  ASSERT_EQ(command_.release(now_ns_, "a"), "");
  EXPECT_EQ(lines(100), Lines{"50:0 safe"});
  command_.safe_echoed();
  command_.shown(now_ns_, 0);
  EXPECT_EQ(lines(200), Lines{});
  command_.shown(now_ns_, 600);
  EXPECT_EQ(lines(300), Lines{"200:0 safe"});
  EXPECT_TRUE(command_.is_card_commanded());
}

TEST_F(MotorCommandTest, NobodyIsInChargeOfAProgramThatStops) {
  ASSERT_EQ(lease(), "");
  ASSERT_EQ(order(600), "");
  command_.shut_down(now_ns_);
  EXPECT_EQ(lease(kOperator, "b", 2), "navcald stops");
  EXPECT_EQ(order(600), "navcald stops");
  EXPECT_EQ(command_.next(now_ns_)->source, Source::safe);
  EXPECT_TRUE(command_.is_card_commanded()) << "until a status shows it";
}

}  // namespace
}  // namespace navcal::control
