// SPDX-License-Identifier: Apache-2.0
#include "pipeline/surface_advice.h"

#include <gtest/gtest.h>

#include "devices/instrument_model.h"
#include "nav/navigator.h"

namespace navcal::pipeline {
namespace {

/// North at 0.872 m/s, with fixes once a second for as long as wanted.
class SurfaceAdviceTest : public testing::Test {
 protected:
  void run(int seconds, bool fixes) {
    for (int i = 0; i < seconds * 10; ++i) {
      time_ns_ += 100'000'000;
      navigator_.take(nav::ShaftReading{time_ns_, 10});
      navigator_.take(nav::RateReading{time_ns_});
      navigator_.take(nav::CompassReading{time_ns_, 0.0, 0.0, 0.0, true});
      if (fixes && i % 10 == 0) navigator_.take(nav::FixReading{time_ns_, {0, 0}, 1, {}, 0.1});
    }
  }
  [[nodiscard]] std::optional<SurfaceAdvice> advice(double max_error_m) const {
    return surface_advice(navigator_, gps_, max_error_m);
  }
  nav::Navigator navigator_{nav::Options{}};
  devices::GpsModel gps_;
  std::int64_t time_ns_ = 1'000'000'000;
};

TEST_F(SurfaceAdviceTest, ThereIsNoneBeforeTheFirstFix) {
  run(5, false);
  EXPECT_FALSE(advice(50));
}

TEST_F(SurfaceAdviceTest, WithoutABoundOnlyTheErrorIsStated) {
  run(5, true);
  ASSERT_TRUE(advice(0));
  EXPECT_FALSE(advice(0)->within_s);
  EXPECT_GT(advice(0)->error_m, 1);
}

TEST_F(SurfaceAdviceTest, ComesTrueInTheErrorModel) {
  run(5, true);
  const double within_s = advice(60)->within_s.value();
  EXPECT_GT(within_s, 20);
  EXPECT_LT(within_s, 2000);
  run(static_cast<int>(within_s), false);
  EXPECT_NEAR(advice(60)->within_s.value(), 0, 10);
  EXPECT_NEAR(advice(60)->error_m, 60, 1);
  run(60, false);
  EXPECT_EQ(advice(60)->within_s, 0);
  EXPECT_GT(advice(60)->error_m, 60);
}

TEST_F(SurfaceAdviceTest, AnErrorThatIsNeverReachedIsNotPredictedBeyondTheHorizon) {
  run(5, true);
  EXPECT_EQ(advice(1e9)->within_s, kLongestAdvice_s);
}

TEST_F(SurfaceAdviceTest, ALongerSearchLeavesLessTime) {
  run(5, true);
  const double short_s = advice(60)->within_s.value();
  gps_.longest_search_s = 40;
  EXPECT_NEAR(advice(60)->within_s.value(), short_s - 30, 2);
}

TEST(SurfaceNewsWatch, TellsOfEachOnceInAStretch) {
  SurfaceNewsWatch watch;
  const auto take = [&](double within_s, bool reckoned = true) {
    return watch.take(SurfaceAdvice{10, within_s}, reckoned);
  };
  EXPECT_EQ(take(300), SurfaceNews::none);
  EXPECT_EQ(take(59), SurfaceNews::near);
  EXPECT_EQ(take(58), SurfaceNews::none);
  EXPECT_EQ(take(0), SurfaceNews::overdue);
  EXPECT_EQ(take(0), SurfaceNews::none);
  EXPECT_EQ(take(30, false), SurfaceNews::none) << "there are fixes";
  EXPECT_EQ(take(0), SurfaceNews::overdue) << "the next stretch";
  EXPECT_EQ(watch.take(std::nullopt, true), SurfaceNews::none);
  EXPECT_EQ(watch.take(SurfaceAdvice{10, std::nullopt}, true), SurfaceNews::none);
}

TEST(SurfaceNewsWatch, SaysWhatToDo) {
  EXPECT_EQ(words_for(SurfaceAdvice{20, 58.2}, 30),
            "surface within 58 s to keep the position error below 30 m (95 %)");
  EXPECT_EQ(words_for(SurfaceAdvice{41, 0}, 30),
            "surface now: the position error may be 41 m at the next fix, and 30 m is allowed (95 %)");
}

}  // namespace
}  // namespace navcal::pipeline
