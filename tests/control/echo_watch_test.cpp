// SPDX-License-Identifier: Apache-2.0
#include "control/echo_watch.h"

#include <gtest/gtest.h>

namespace navcal::control {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kTransit_ns = 15 * kMillisecond_ns;

OrderRecord line(std::uint64_t sequence, std::int64_t sent_ns, int rpm) {
  OrderRecord record;
  record.sequence = sequence;
  record.sent_ns = sent_ns;
  record.sent = protocols::motor_card::Command{rpm, {}};
  return record;
}

class EchoWatchTest : public testing::Test {
 protected:
  void sent(std::uint64_t sequence, std::int64_t at_ms, int rpm) {
    watch_.sent(line(sequence, at_ms * kMillisecond_ns, rpm), out_);
  }
  void status(std::int64_t measured_ms, std::optional<double> rpm) {
    watch_.status(measured_ms * kMillisecond_ns, (measured_ms + 30) * kMillisecond_ns, rpm, out_);
  }
  /// "3 echoed" for each record that came since.
  std::vector<std::string> came() {
    std::vector<std::string> words;
    for (const auto& record : out_)
      words.push_back(std::to_string(record.sequence) + ' ' + std::string(name_of(record.outcome)));
    out_.clear();
    return words;
  }
  using Words = std::vector<std::string>;

  EchoWatch watch_{0.5, kTransit_ns};
  std::vector<OrderRecord> out_;
};

TEST_F(EchoWatchTest, TheNextStatusWithItsSpeedShowsALine) {
  sent(1, 100, 780);
  status(110, 780);
  EXPECT_EQ(came(), Words{}) << "measured before the line had reached the card";
  status(130, 700);
  EXPECT_EQ(came(), Words{}) << "another speed";
  status(230, std::nullopt);
  EXPECT_EQ(came(), Words{}) << "a card that does not say";
  status(330, 780);
  ASSERT_EQ(out_.size(), 1U);
  EXPECT_EQ(out_[0].echoed_ns, 360 * kMillisecond_ns);
  EXPECT_EQ(came(), Words{"1 echoed"});
  status(430, 780);
  EXPECT_EQ(came(), Words{}) << "once";
}

TEST_F(EchoWatchTest, OfSeveralLinesTheNewestThatFitsIsShownAndOlderOnesAreSuperseded) {
  sent(1, 0, 100);
  sent(2, 50, 200);
  sent(3, 100, 300);
  sent(4, 150, 400);
  status(140, 300);
  EXPECT_EQ(came(), (Words{"1 superseded", "2 superseded", "3 echoed"}));
  status(240, 400);
  EXPECT_EQ(came(), Words{"4 echoed"});
}

TEST_F(EchoWatchTest, AStatusMeasuredAsTheLineReachesTheCardShowsIt) {
  sent(1, 100, 780);
  watch_.status(100 * kMillisecond_ns + kTransit_ns - 1, 0, 780, out_);
  EXPECT_EQ(came(), Words{});
  watch_.status(100 * kMillisecond_ns + kTransit_ns, 0, 780, out_);
  EXPECT_EQ(came(), Words{"1 echoed"});
}

TEST_F(EchoWatchTest, OfMoreLinesThanItHoldsTheOldestIsSuperseded) {
  for (std::uint64_t i = 0; i < 2048; ++i) sent(i, 0, 1);
  EXPECT_EQ(came(), Words{});
  sent(2048, 0, 1);
  EXPECT_EQ(came(), Words{"0 superseded"});
}

// Twenty lines a second against ten statuses a second: a working card is never called deaf.
TEST_F(EchoWatchTest, ARampDoesNotLookLikeADeafCard) {
  for (int step = 0; step < 100; ++step) {
    sent(static_cast<std::uint64_t>(step), 50 * step, 10 * step);
    watch_.update(50 * step * kMillisecond_ns, out_);
    if (step % 2 == 1) status(50 * step - 20, 10 * (step - 1));
    ASSERT_FALSE(watch_.is_deaf()) << step;
  }
}

TEST_F(EchoWatchTest, ACardThatDoesNotShowAnOrderIsDeafUntilItDoes) {
  sent(1, 100, 780);
  EXPECT_EQ(watch_.deadline_ns(), 600 * kMillisecond_ns);
  watch_.update(600 * kMillisecond_ns - 1, out_);
  EXPECT_EQ(came(), Words{});
  EXPECT_FALSE(watch_.is_deaf());
  watch_.update(600 * kMillisecond_ns, out_);
  EXPECT_EQ(came(), Words{"1 not_echoed"});
  EXPECT_TRUE(watch_.is_deaf());
  status(700, 780);
  EXPECT_TRUE(watch_.is_deaf()) << "no line waits for it";
  sent(2, 800, 780);
  status(900, 780);
  EXPECT_EQ(came(), Words{"2 echoed"});
  EXPECT_FALSE(watch_.is_deaf());
}

TEST_F(EchoWatchTest, WhatWaitsIsGivenUpAtTheEnd) {
  sent(1, 0, 1);
  sent(2, 50, 2);
  watch_.give_up(out_);
  EXPECT_EQ(came(), (Words{"1 not_echoed", "2 not_echoed"}));
  EXPECT_FALSE(watch_.is_deaf()) << "the port went: that is no fault of the card's ears";
  EXPECT_EQ(watch_.deadline_ns(), kNever_ns);
}

TEST(EchoWatch, WithoutATimeOutNothingIsDeafAndNothingGrows) {
  EchoWatch watch(0, kTransit_ns);
  std::vector<OrderRecord> out;
  for (int i = 0; i < 1000; ++i) watch.sent(line(static_cast<std::uint64_t>(i), i * kMillisecond_ns, i), out);
  watch.update(1'000'000 * kMillisecond_ns, out);
  EXPECT_FALSE(watch.is_deaf());
  EXPECT_EQ(out.size(), 1000U - 64U);
  EXPECT_EQ(out.back().outcome, Outcome::superseded);
}

}  // namespace
}  // namespace navcal::control
