// SPDX-License-Identifier: Apache-2.0
#include "ports/sysfs.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/ports/harness.h"

namespace navcal::ports {
namespace {

namespace fs = std::filesystem;

/// The part of /sys that an FTDI adapter has, made of ordinary files.
struct Sysfs : ::testing::Test {
  testing::Folder root;
  fs::path device = root.path() / "class/tty/ttyUSB0/device";

  void SetUp() override {
    fs::create_directories(device);
    fs::create_symlink("../../../../bus/usb-serial/drivers/ftdi_sio", device / "driver");
    std::ofstream(device / "latency_timer") << "9\n";
  }
};

TEST_F(Sysfs, DriverAndTimerOfAnAdapter) {
  const SysfsTty tty("/dev/ttyUSB0", root.path());
  EXPECT_EQ(tty.driver(), "ftdi_sio");
  EXPECT_EQ(tty.latency_timer_ms(), 9);
  EXPECT_TRUE(tty.set_latency_timer_ms(1));
  EXPECT_EQ(SysfsTty("ttyUSB0", root.path()).latency_timer_ms(), 1);
}

TEST_F(Sysfs, WithoutDeviceNothingIsKnownAndNothingIsMade) {
  const SysfsTty tty("/dev/ttyS7", root.path());
  EXPECT_EQ(tty.driver(), "");
  EXPECT_EQ(tty.latency_timer_ms(), std::nullopt);
  EXPECT_FALSE(tty.set_latency_timer_ms(1));
  EXPECT_FALSE(fs::exists(root.path() / "class/tty/ttyS7"));
}

}  // namespace
}  // namespace navcal::ports
