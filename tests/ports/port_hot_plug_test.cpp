// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/ports/harness.h"

namespace navcal::ports::testing {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

struct PortHotPlug : ::testing::Test {
  Folder folder;
  boost::asio::io_context io{1};
  Recorder recorder;

  bool opened(std::size_t times) {
    return run_until(io, [&] { return recorder.opened.size() == times; });
  }
};

TEST_F(PortHotPlug, LossIsNoticedAtOnceAndTheDeviceIsBackUnderItsName) {
  PtyHost host(io.get_executor(), folder.path() / "compass", 9600, {});
  Port port(io.get_executor(), settings_for(host.link()), recorder);
  port.start();
  ASSERT_TRUE(opened(1));
  host.unplug();
  // The kernel wakes the port: no poll interval is in this, so the limit is far above what it needs.
  ASSERT_TRUE(run_until(
      io, [&] { return !recorder.lost.empty(); }, milliseconds(2000)));
  EXPECT_NE(recorder.lost[0].find("gone"), std::string::npos) << recorder.lost[0];
  run_for(io, milliseconds(500));
  host.replug();
  const std::int64_t returned = monotonic_ns();
  ASSERT_TRUE(opened(2));
  EXPECT_LT(monotonic_ns() - returned, 1'000'000'000);
  host.write(bytes_of("again"));
  EXPECT_TRUE(run_until(io, [&] { return recorder.received == "again"; }));
}

TEST_F(PortHotPlug, TheSameLinkMayLeadToAnotherDevice) {
  PtyHost first(io.get_executor(), folder.path() / "a", 9600, {});
  PtyHost second(io.get_executor(), folder.path() / "b", 9600, {});
  const fs::path link = folder.path() / "by-name";
  fs::create_symlink(first.link(), link);
  Port port(io.get_executor(), settings_for(link), recorder);
  port.start();
  ASSERT_TRUE(opened(1));
  fs::remove(link);
  fs::create_symlink(second.link(), link);
  first.unplug();
  ASSERT_TRUE(opened(2));
  EXPECT_EQ(recorder.opened[1].path, second.device());
  second.write(bytes_of("here"));
  EXPECT_TRUE(run_until(io, [&] { return recorder.received == "here"; }));
}

TEST_F(PortHotPlug, AUdevNameIsFoundLikeAPath) {
  PtyHost host(io.get_executor(), folder.path() / "compass", 9600, {});
  config::PortSettings settings = settings_for({});
  settings.udev_name = host.device().substr(std::string("/dev/").size());  // relative to /dev
  Port port(io.get_executor(), settings, recorder);
  port.start();
  EXPECT_TRUE(opened(1));
}

TEST_F(PortHotPlug, ADeviceThatComesLaterIsFound) {
  Port port(io.get_executor(), settings_for(folder.path() / "later" / "compass"), recorder);
  port.start();
  ASSERT_TRUE(run_until(io, [&] { return !recorder.lost.empty(); }));
  EXPECT_NE(recorder.lost[0].find("no such device"), std::string::npos) << recorder.lost[0];
  run_for(io, milliseconds(700));
  EXPECT_EQ(recorder.lost.size(), 1U) << "told once, not at every attempt";
  PtyHost host(io.get_executor(), folder.path() / "later" / "compass", 9600, {});
  EXPECT_TRUE(opened(1));
}

TEST_F(PortHotPlug, AHundredCyclesLeakNoDescriptor) {
  PtyHost host(io.get_executor(), folder.path() / "compass", 9600, {});
  Port port(io.get_executor(), settings_for(host.link()), recorder);
  port.start();
  ASSERT_TRUE(opened(1));
  const std::size_t before = open_descriptors();
  for (std::size_t cycle = 0; cycle < 100; ++cycle) {
    host.unplug();
    host.replug();
    ASSERT_TRUE(opened(cycle + 2)) << cycle;
    host.write(bytes_of("x"));
    ASSERT_TRUE(run_until(io, [&] { return recorder.received.size() == cycle + 1; })) << cycle;
  }
  EXPECT_EQ(open_descriptors(), before);
}

}  // namespace
}  // namespace navcal::ports::testing
