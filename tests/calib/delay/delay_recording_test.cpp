// SPDX-License-Identifier: Apache-2.0
#include "tests/calib/delay/delay_recording.h"

#include <gtest/gtest.h>

#include <string>

namespace navcal::calib::test {
namespace {

TEST(DelayRecording, TheBoardOfBroad34IsTenToFifteenMillisecondsLate) {
  const std::string file = NAVCAL_SHARED_DIR "/data/broad34.cap";
  const auto delay = field_delay_of(file);
  if (!delay) GTEST_SKIP() << file << " is absent";
  const Delay found = delay->estimate();
  EXPECT_GT(found.delay_s, 0.010);
  EXPECT_LT(found.delay_s, 0.015);
  EXPECT_LT(found.std_s, 0.002);
  EXPECT_GE(delay->field_steps(), 1U) << "the magnet came";
}

}  // namespace
}  // namespace navcal::calib::test
