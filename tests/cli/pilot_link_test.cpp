// SPDX-License-Identifier: Apache-2.0
// The pilot's side of navcald's sockets, against a daemon that answers late or not at all.
#include "cli/live/pilot_link.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <stdexcept>
#include <string_view>
#include <thread>

#include "base/descriptor.h"
#include "tests/support/temporary_folder.h"

namespace navcal::cli {
namespace {

/// A daemon that grants the lease at once and answers the order after it `delay` later; never, if the delay is
/// negative.
class LateDaemon {
 public:
  explicit LateDaemon(std::chrono::milliseconds delay)
      : status_(::socket(AF_INET, SOCK_STREAM, 0)), control_(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof at;
    ::bind(status_.get(), reinterpret_cast<sockaddr*>(&at), length);
    ::listen(status_.get(), 1);
    ::getsockname(status_.get(), reinterpret_cast<sockaddr*>(&at), &length);
    address_.port = ntohs(at.sin_port);
    address_.control = folder_.path() / "control";
    sockaddr_un here{};
    here.sun_family = AF_UNIX;
    address_.control.string().copy(here.sun_path, sizeof here.sun_path - 1);
    ::bind(control_.get(), reinterpret_cast<sockaddr*>(&here), sizeof here);
    ::listen(control_.get(), 1);
    thread_ = std::thread([this, delay] { serve(delay); });
  }
  ~LateDaemon() { thread_.join(); }
  [[nodiscard]] const PilotLink::Address& address() const { return address_; }

 private:
  void serve(std::chrono::milliseconds delay) const {
    const base::Descriptor client(::accept(control_.get(), nullptr, nullptr));
    std::array<char, 4096> request{};
    const auto hear = [&] { return ::read(client.get(), request.data(), request.size()) > 0; };
    const auto answer = [&](std::string_view line) {
      ::send(client.get(), line.data(), line.size(), MSG_NOSIGNAL);
    };
    if (hear()) answer("{\"ok\":true,\"lease\":\"f00d\"}\n");
    if (hear() && delay.count() >= 0) {
      std::this_thread::sleep_for(delay);
      answer("{\"ok\":true,\"sent\":1700000000.5}\n");
    }
    while (hear()) continue;  // until the pilot leaves
  }

  test::TemporaryFolder folder_;
  base::Descriptor status_, control_;
  PilotLink::Address address_;
  std::thread thread_;
};

TEST(PilotLink, AnAnswerThatComesWithinTheLeaseIsTaken) {
  const LateDaemon daemon(std::chrono::milliseconds(700));
  PilotLink link(daemon.address());
  link.lease({.priority = 1, .timeout_s = 5});
  EXPECT_FALSE(link.order({}, 1700000000).has_value());
}

TEST(PilotLink, ADaemonThatNeverAnswersIsAnError) {
  const LateDaemon daemon(std::chrono::milliseconds(-1));
  PilotLink link(daemon.address());
  link.lease({.priority = 1, .timeout_s = 0.5});
  EXPECT_THROW((void)link.order({}, 1700000000), std::runtime_error);
}

}  // namespace
}  // namespace navcal::cli
