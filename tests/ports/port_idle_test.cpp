// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <termios.h>

#include "tests/ports/harness.h"

namespace navcal::ports::testing {
namespace {

using std::chrono::milliseconds;
/// A loop that spins would use all of the two seconds.
constexpr milliseconds kObserved{2000};
constexpr milliseconds kIdle{500};

struct PortIdle : ::testing::Test {
  Folder folder;
  boost::asio::io_context io{1};
  PtyHost host{io.get_executor(), folder.path() / "compass", 9600, {}};
  Recorder recorder;
  Port port{io.get_executor(), settings_for(host.link()), recorder};

  void SetUp() override {
    port.start();
    ASSERT_TRUE(run_until(io, [&] { return !recorder.opened.empty(); }));
  }
  std::chrono::microseconds cpu_used() {
    const auto before = cpu_time();
    run_for(io, kObserved);
    return cpu_time() - before;
  }
};

TEST_F(PortIdle, ASilentLineCostsNothing) { EXPECT_LT(cpu_used(), kIdle); }

TEST_F(PortIdle, AHungUpLineCostsNothing) {
  host.unplug();
  EXPECT_LT(cpu_used(), kIdle);
  EXPECT_FALSE(recorder.lost.empty());
}

TEST_F(PortIdle, ADeviceThatComesAndGoesUnopenedCostsNothing) {
  port.stop();  // the host's own side, waiting for a client
  EXPECT_LT(cpu_used(), kIdle);
}

TEST_F(PortIdle, ReadsOfZeroBytesDoNotSpinAndHealThemselves) {
  // Somebody sets the line to lines-and-keys; every end-of-file key then reads as zero bytes from a living device.
  const base::Descriptor other = open_client(host.link());
  termios cooked{};
  ASSERT_EQ(tcgetattr(other.get(), &cooked), 0);
  cooked.c_lflag |= ICANON;
  cooked.c_cc[VEOF] = 4;
  ASSERT_EQ(tcsetattr(other.get(), TCSANOW, &cooked), 0);
  const auto before = cpu_time();
  host.write(bytes_of(std::string(2000, '\4')));
  ASSERT_TRUE(run_until(io, [&] { return recorder.opened.size() == 2; }));
  EXPECT_LT(cpu_time() - before, kIdle);
  ASSERT_FALSE(recorder.lost.empty());
  EXPECT_NE(recorder.lost[0].find("although the device is there"), std::string::npos) << recorder.lost[0];
  host.write(bytes_of("raw again"));
  EXPECT_TRUE(run_until(io, [&] { return recorder.received.find("raw again") != std::string::npos; }));
}

}  // namespace
}  // namespace navcal::ports::testing
