// SPDX-License-Identifier: Apache-2.0
#include "base/service_manager.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "tests/support/temporary_folder.h"

namespace navcal::base {
namespace {

/// Sets a variable for the time of a test.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
  ~Variable() { unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

/// A manager's end of the notification socket; `name` as in $NOTIFY_SOCKET.
class Manager {
 public:
  explicit Manager(const std::string& name) : descriptor_(socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::copy(name.begin(), name.end(), address.sun_path);
    if (name[0] == '@') address.sun_path[0] = '\0';
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    bound_ = bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), length) == 0;
  }
  ~Manager() { close(descriptor_); }
  Manager(const Manager&) = delete;
  Manager& operator=(const Manager&) = delete;

  [[nodiscard]] bool bound() const { return bound_; }
  [[nodiscard]] std::string heard() const {
    std::string text(256, '\0');
    const ssize_t size = recv(descriptor_, text.data(), text.size(), 0);
    return size < 0 ? "nothing" : text.substr(0, static_cast<std::size_t>(size));
  }

 private:
  int descriptor_;
  bool bound_ = false;
};

TEST(ServiceManager, HearsWhatIsSaidOverAPathAndAnAbstractSocket) {
  const test::TemporaryFolder folder;
  for (const std::string& name :
       {(folder.path() / "notify").string(), "@navcal-test-" + std::to_string(getpid())}) {
    const Manager manager(name);
    ASSERT_TRUE(manager.bound()) << name;
    const Variable variable("NOTIFY_SOCKET", name);
    notify_manager("READY=1", IfBusy::wait);
    EXPECT_EQ(manager.heard(), "READY=1") << name;
    EXPECT_EQ(manager.heard(), "nothing") << name;
  }
}

TEST(ServiceManager, ThatIsNotThereOrDoesNotReadHoldsNothingUp) {
  notify_manager("READY=1");
  for (const std::string& name : {std::string("/nowhere/at/all"), std::string("relative"), std::string(),
                                  std::string("@"), std::string(300, 'x'), "/" + std::string(300, 'x')}) {
    const Variable variable("NOTIFY_SOCKET", name);
    notify_manager("READY=1");
  }
  const test::TemporaryFolder folder;
  const std::string name = folder.path() / "notify";
  const Manager manager(name);
  const Variable variable("NOTIFY_SOCKET", name);
  for (int i = 0; i < 10'000; ++i) notify_manager("WATCHDOG=1");
  EXPECT_EQ(manager.heard(), "WATCHDOG=1");
}

TEST(ServiceManager, SaysHowLongItWaitsForThisProcess) {
  EXPECT_EQ(watchdog_limit().count(), 0);
  const Variable limit("WATCHDOG_USEC", "5000000");
  EXPECT_EQ(watchdog_limit(), std::chrono::seconds(5));
  {
    const Variable mine("WATCHDOG_PID", std::to_string(getpid()));
    EXPECT_EQ(watchdog_limit(), std::chrono::seconds(5));
  }
  for (const std::string& other : {std::to_string(getpid() + 1), std::string("me"), std::string()}) {
    const Variable variable("WATCHDOG_PID", other);
    EXPECT_EQ(watchdog_limit().count(), 0) << other;
  }
  for (const char* wrong : {"", "-1", "soon", "5 s", "99999999999999999999999"}) {
    const Variable variable("WATCHDOG_USEC", wrong);
    EXPECT_EQ(watchdog_limit().count(), 0) << wrong;
  }
}

TEST(ServiceManager, HandsOverOnlyToThisProcessAndOnce) {
  EXPECT_EQ(take_handed_over(), 0);
  struct Case {
    std::string pid, count;
  };
  for (const auto& [pid, count] :
       {Case{std::to_string(getpid() + 1), "1"}, Case{std::to_string(getpid()), "-1"},
        Case{std::to_string(getpid()), "many"}, Case{"", "1"}, Case{std::to_string(getpid()), "1000000"}}) {
    const Variable of("LISTEN_PID", pid), so_many("LISTEN_FDS", count);
    EXPECT_EQ(take_handed_over(), 0) << pid << " " << count;
  }
  const int descriptor = dup(STDERR_FILENO);  // some descriptor from 3 on, so that the first ones are open
  ASSERT_GE(descriptor, kFirstHandedOver);
  const int count = descriptor - kFirstHandedOver + 1;
  const Variable of("LISTEN_PID", std::to_string(getpid())), so_many("LISTEN_FDS", std::to_string(count));
  EXPECT_EQ(take_handed_over(), count);
  EXPECT_EQ(fcntl(descriptor, F_GETFD) & FD_CLOEXEC, FD_CLOEXEC);
  EXPECT_EQ(take_handed_over(), 0);
  close(descriptor);
}

TEST(ServiceManager, TellsListeningSocketsFromOthers) {
  const int listening = socket(AF_INET, SOCK_STREAM, 0), quiet = socket(AF_INET, SOCK_STREAM, 0);
  ASSERT_EQ(listen(listening, 1), 0);
  EXPECT_TRUE(is_listening(listening, AF_INET));
  EXPECT_FALSE(is_listening(listening, AF_UNIX));
  EXPECT_FALSE(is_listening(quiet, AF_INET));
  EXPECT_FALSE(is_listening(STDERR_FILENO, AF_INET));
  EXPECT_FALSE(is_listening(-1, AF_INET));
  close(listening);
  close(quiet);
}

}  // namespace
}  // namespace navcal::base
