// SPDX-License-Identifier: Apache-2.0
#include "daemon/calibration_store.h"

#include <gtest/gtest.h>

#include <fstream>

#include "config/load.h"
#include "tests/support/temporary_folder.h"

namespace navcal::daemon {
namespace {

class CalibrationStoreTest : public testing::Test {
 protected:
  CalibrationStoreTest() {
    settings_.log.directory = folder_.path() / "log";
    settings_.ports.push_back(config::default_port("compass", protocols::Protocol::tcm2, 38400));
    settings_.ports.push_back(config::default_port("imu", protocols::Protocol::imu_card, 57600));
  }
  void save(std::string state) const {
    CalibrationStore store(settings_);
    store.save(std::move(state));
    store.stop();
  }
  [[nodiscard]] std::filesystem::path file() const { return settings_.log.directory / "calibration.state"; }

  test::TemporaryFolder folder_;
  config::Settings settings_;
};

TEST_F(CalibrationStoreTest, GivesBackTheNewestState) {
  EXPECT_FALSE(CalibrationStore(settings_).load());
  save("first");
  {
    CalibrationStore store(settings_);
    for (int i = 0; i < 100; ++i) store.save("state " + std::to_string(i));
    store.stop();
    store.save("too late");
  }
  CalibrationStore store(settings_);
  EXPECT_EQ(store.load(), "state 99");
  EXPECT_TRUE(store.take_notices().empty());
}

TEST_F(CalibrationStoreTest, ADamagedFileIsToldKeptAsideAndNotFatal) {
  save("a state");
  std::fstream(file(), std::ios::in | std::ios::out | std::ios::binary).seekp(40).put('!');
  CalibrationStore store(settings_);
  EXPECT_FALSE(store.load());
  const auto notices = store.take_notices();
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_NE(notices[0].find("its checksum is wrong"), std::string::npos) << notices[0];
  EXPECT_NE(notices[0].find("begin anew"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(file().string() + ".damaged"));
  EXPECT_FALSE(std::filesystem::exists(file()));
  store.save("another");
  store.stop();
  EXPECT_EQ(CalibrationStore(settings_).load(), "another");
}

TEST_F(CalibrationStoreTest, AStateOfOtherInstrumentsIsVoidAndSaysWhatChanged) {
  save("a state");
  settings_.ports[1].imu_card.scale[1] = -10;
  CalibrationStore store(settings_);
  EXPECT_FALSE(store.load());
  const auto notices = store.take_notices();
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_NE(notices[0].find("the instruments were changed"), std::string::npos) << notices[0];
  EXPECT_NE(notices[0].find("10 -10 10"), std::string::npos) << notices[0];
  EXPECT_TRUE(std::filesystem::exists(file().string() + ".void"));
}

TEST_F(CalibrationStoreTest, WhatDoesNotConcernTheInstrumentsDoesNotVoidIt) {
  save("a state");
  settings_.ports[0].path = "/dev/ttyS7";
  settings_.ports[0].latency_s = 0.06;
  settings_.calibration.margin = 0.2;
  settings_.environment.declination_rad = 0.03;
  settings_.ports.push_back(config::default_port("gps", protocols::Protocol::oncore, 9600));
  EXPECT_EQ(CalibrationStore(settings_).load(), "a state");
}

TEST_F(CalibrationStoreTest, AFolderThatCannotBeWrittenIsToldOnce) {
  settings_.log.directory = "/proc/nowhere";
  CalibrationStore store(settings_);
  store.save("a state");
  store.stop();
  ASSERT_EQ(store.take_notices().size(), 1U);
}

}  // namespace
}  // namespace navcal::daemon
