// SPDX-License-Identifier: Apache-2.0
// How long the emulated receiver searches by what it knows.
#include <gtest/gtest.h>

#include "sim/instruments/gps_receiver.h"
#include "tests/sim/drive.h"

namespace navcal::sim::testing {
namespace {

class GpsSearch : public ::testing::Test {
 protected:
  GpsSearch() { options_.gps.search_model = config::SearchModel::receiver_state; }
  void power() {
    receiver_ = std::make_unique<GpsReceiver>(options_, motion_, 7);
    receiver_->power_on(second_ns_);
  }
  void at_depth(double depth_m) { motion_.state.position_m[2] = depth_m; }
  void pass(std::int64_t seconds) {
    for (std::int64_t i = 0; i < seconds; ++i) measure();
  }
  /// Seconds until the first fix.
  int search_s() {
    for (int s = 1; s < 1000; ++s) {
      if (measure()) return s;
    }
    return 1000;
  }
  bool measure() {
    second_ns_ += kSecond_ns;
    return receiver_->measure(second_ns_).fixed;
  }
  static void expect_about(int search_s, double mean_s) {
    EXPECT_GE(search_s, 0.7 * mean_s - 1);
    EXPECT_LE(search_s, 1.3 * mean_s + 2);
  }

  Still motion_;
  GpsReceiver::Options options_;
  std::unique_ptr<GpsReceiver> receiver_;
  std::int64_t second_ns_ = kStart_ns;
};

TEST_F(GpsSearch, APowerOnIsColdAShortDiveHotAndALongOneWarm) {
  power();
  expect_about(search_s(), options_.gps.cold_start_s);
  pass(60);
  for (const auto& [dive_s, mean_s] : {std::pair(600, options_.gps.hot_start_s),
                                       {7100, options_.gps.hot_start_s},
                                       {15'000, options_.gps.warm_start_s}}) {
    at_depth(2);
    pass(dive_s);
    at_depth(0);
    expect_about(search_s(), mean_s);
    pass(60);
  }
}

TEST_F(GpsSearch, AfterThreeHoursSomeEphemeridesHaveExpired) {
  power();
  search_s();
  int warm = 0;
  constexpr int kDives = 60;
  for (int i = 0; i < kDives; ++i) {
    pass(5);
    at_depth(2);
    pass(10'800);
    at_depth(0);
    warm += search_s() > 25;
  }
  EXPECT_GT(warm, kDives / 5);
  EXPECT_LT(warm, kDives * 4 / 5);
  EXPECT_EQ(options_.gps.expired_probability(10'800), 0.5);
}

TEST_F(GpsSearch, TimeAndPositionMakeAColdStartWarmAndEitherAloneDoesNot) {
  power();
  pass(1);
  receiver_->learn_time();
  expect_about(search_s() + 1, options_.gps.cold_start_s);
  power();
  pass(1);
  receiver_->learn_position();
  receiver_->learn_time();
  expect_about(search_s(), options_.gps.warm_start_s);
}

TEST_F(GpsSearch, TheUniformModelDoesNotDependOnWhatItIsTold) {
  options_.gps.search_model = config::SearchModel::uniform;
  power();
  const int unaided_s = search_s();
  power();
  receiver_->learn_position();
  receiver_->learn_time();
  EXPECT_EQ(search_s(), unaided_s);
  EXPECT_LE(unaided_s, 10);
}

}  // namespace
}  // namespace navcal::sim::testing
