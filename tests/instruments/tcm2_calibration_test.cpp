// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/instruments/tcm2_calibration_bench.h"

namespace navcal::instruments::test {
namespace {

constexpr const char* kWhole = "h h cc mpcal=e go h h mpcal=d go ";

TEST(Tcm2Calibration, SaysNothingBeforeItBegins) {
  Tcm2CalibrationBench bench;
  bench.run_for(5 * base::kSecond_ns);
  EXPECT_EQ(bench.transcript(), "");
  EXPECT_FALSE(bench.dialogue.busy());
  EXPECT_EQ(bench.dialogue.deadline_ns(), INT64_MAX);
  EXPECT_EQ(bench.dialogue.state(), "not begun");
}

TEST(Tcm2Calibration, TwoTurnsAndTheScore) {
  Tcm2CalibrationBench bench;
  bench.dialogue.begin(bench.now_ns);
  const std::int64_t began_ns = bench.now_ns;
  bench.run_for(10 * base::kSecond_ns);
  EXPECT_EQ(bench.dialogue.state().rfind("turned ", 0), 0U) << bench.dialogue.state();
  bench.run_for(600 * base::kSecond_ns);
  EXPECT_EQ(bench.transcript(), kWhole);
  const double took_s = static_cast<double>(bench.now_ns - began_ns) * 1e-9;
  EXPECT_NEAR(took_s, 120, 5) << "720 degrees at 6 degrees a second";
  ASSERT_TRUE(bench.horizontal());
  EXPECT_EQ(bench.horizontal(), 9);
  EXPECT_EQ(bench.dialogue.state(), "score H9V9M0.05");
  EXPECT_TRUE(bench.words_flow());
}

TEST(Tcm2Calibration, TurnsToEitherSideCount) {
  TurnCount count;
  double heading_rad = 0;
  for (int i = 0; i < 100; ++i) count.add(heading_rad += 0.05);
  for (int i = 0; i < 100; ++i) count.add(heading_rad -= 0.05);
  EXPECT_NEAR(count.turned_rad(), 10, 0.3);
}

TEST(Tcm2Calibration, NoiseIsNoTurn) {
  TurnCount count;
  for (int i = 0; i < 10000; ++i) count.add(i % 2 == 0 ? 0.04 : 6.25);
  EXPECT_EQ(count.turned_rad(), 0);
}

TEST(Tcm2Calibration, TheGyroGoesBeforeTheCompass) {
  Tcm2CalibrationBench bench(6);
  bench.dialogue.begin(bench.now_ns);
  std::int64_t turning_ns = 0;
  bench.run_for(600 * base::kSecond_ns, [&] {
    if (turning_ns == 0 && bench.dialogue.state().rfind("turned", 0) == 0) turning_ns = bench.now_ns;
    if (bench.now_ns % (50 * base::kMillisecond_ns) == 0)
      bench.dialogue.on_yaw_rate(-0.6283, bench.now_ns);  // 36 deg/s
  });
  EXPECT_NEAR(static_cast<double>(bench.now_ns - turning_ns) * 1e-9, 20, 2);
  EXPECT_TRUE(bench.horizontal());
}

TEST(Tcm2Calibration, TheOperatorMayEndItSooner) {
  Tcm2CalibrationBench bench;
  bench.dialogue.begin(bench.now_ns);
  bench.run_for(30 * base::kSecond_ns);
  bench.dialogue.stop(bench.now_ns);
  bench.run_for(5 * base::kSecond_ns);
  EXPECT_EQ(bench.transcript(), kWhole);
  ASSERT_TRUE(bench.horizontal());
  EXPECT_LT(bench.horizontal(), 9) << "180 degrees";
  EXPECT_TRUE(bench.words_flow());
}

TEST(Tcm2Calibration, CalledOffBeforeItTurned) {
  Tcm2CalibrationBench bench;
  bench.dialogue.begin(bench.now_ns);
  bench.run_for(200 * base::kMillisecond_ns);
  bench.dialogue.stop(bench.now_ns);
  bench.run_for(5 * base::kSecond_ns);
  EXPECT_EQ(bench.transcript(), "h h go ");
  EXPECT_EQ(bench.dialogue.state(), "failed: called off");
  EXPECT_TRUE(bench.words_flow());
}

TEST(Tcm2Calibration, AVehicleThatDoesNotTurnEndsByTime) {
  Tcm2CalibrationBench bench(0, 20 * base::kSecond_ns);
  bench.dialogue.begin(bench.now_ns);
  bench.run_for(60 * base::kSecond_ns);
  EXPECT_EQ(bench.transcript(), kWhole);
  ASSERT_TRUE(bench.horizontal());
  EXPECT_EQ(bench.horizontal(), 0);
}

TEST(Tcm2Calibration, MayBeHeldAgain) {
  Tcm2CalibrationBench bench(36);
  for (int i = 0; i < 2; ++i) {
    bench.sent.clear();
    bench.dialogue.begin(bench.now_ns);
    bench.run_for(60 * base::kSecond_ns);
    EXPECT_EQ(bench.transcript(), kWhole);
    EXPECT_TRUE(bench.horizontal());
  }
}

}  // namespace
}  // namespace navcal::instruments::test
