// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "ports/holder.h"
#include "tests/ports/harness.h"

namespace navcal::ports::testing {
namespace {

struct PortRefusal : ::testing::Test {
  Folder folder;
  boost::asio::io_context io{1};
  Recorder recorder;

  std::string first_reason(const config::PortSettings& settings) {
    Port port(io.get_executor(), settings, recorder);
    port.start();
    EXPECT_TRUE(run_until(io, [&] { return !recorder.lost.empty(); }));
    EXPECT_TRUE(recorder.opened.empty());
    return recorder.lost.at(0);
  }
};

TEST_F(PortRefusal, ASecondOpenerIsToldWhoHoldsThePort) {
  PtyHost host(io.get_executor(), folder.path() / "compass", 9600, {});
  // Another process, as a second navcald would be.
  std::array<int, 2> ready{};
  ASSERT_EQ(::pipe(ready.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const base::Descriptor held = open_client(host.link());
    const bool locked = lock_device(held.get());
    if (::write(ready[1], locked ? "y" : "n", 1) != 1) ::_exit(1);
    for (;;) ::pause();
  }
  char answer = 0;
  ASSERT_EQ(::read(ready[0], &answer, 1), 1);
  ASSERT_EQ(answer, 'y');
  const std::string reason = first_reason(settings_for(host.link()));
  EXPECT_NE(reason.find("in use by ports_test (process " + std::to_string(child) + ")"), std::string::npos)
      << reason;
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  ::close(ready[0]);
  ::close(ready[1]);
  // The lock died with its owner, however that ended.
  Port port(io.get_executor(), settings_for(host.link()), recorder);
  port.start();
  EXPECT_TRUE(run_until(io, [&] { return recorder.opened.size() == 1; }));
}

TEST_F(PortRefusal, TheSamePortTwiceInOneConfiguration) {
  PtyHost host(io.get_executor(), folder.path() / "compass", 9600, {});
  Recorder other;
  Port port(io.get_executor(), settings_for(host.link()), other);
  port.start();
  ASSERT_TRUE(run_until(io, [&] { return !other.opened.empty(); }));
  const std::string reason = first_reason(settings_for(host.device()));
  EXPECT_NE(reason.find("in use by this process"), std::string::npos) << reason;
}

TEST_F(PortRefusal, AFileIsNoPort) {
  std::ofstream(folder.path() / "file") << "text";
  EXPECT_NE(first_reason(settings_for(folder.path() / "file")).find("is no serial port"), std::string::npos);
}

TEST_F(PortRefusal, AFolderIsNoPort) {
  const std::string reason = first_reason(settings_for(folder.path()));
  EXPECT_NE(reason.find(folder.path().string()), std::string::npos) << reason;
}

TEST_F(PortRefusal, AUsbSerialNumberThatIsNotThere) {
  config::PortSettings settings = settings_for({});
  settings.usb_serial = "NO-SUCH-ADAPTER";
  EXPECT_EQ(first_reason(settings), "no USB adapter with serial number NO-SUCH-ADAPTER is connected");
}

}  // namespace
}  // namespace navcal::ports::testing
