// SPDX-License-Identifier: Apache-2.0
// A Port at a Unix socket to which several programs send lines.
#include "ports/sample_socket.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cstring>

#include "tests/ports/harness.h"

namespace navcal::ports::testing {
namespace {

struct SampleSocketPort : ::testing::Test {
  Folder folder;
  std::string path = (folder.path() / "samples").string();
  boost::asio::io_context io{1};
  Recorder recorder;
  config::PortSettings settings = [this] {
    config::PortSettings at;
    at.name = "injected";
    at.address = "unix-listen:" + path;
    return at;
  }();

  [[nodiscard]] bool until(const std::function<bool()>& condition) { return run_until(io, condition); }
  [[nodiscard]] base::Descriptor connected() const {
    base::Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path.data(), path.size());
    const int result = ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
    EXPECT_EQ(result, 0) << std::strerror(errno);
    return socket;
  }
  static void send(const base::Descriptor& socket, std::string_view text) {
    EXPECT_EQ(::send(socket.get(), text.data(), text.size(), 0), static_cast<ssize_t>(text.size()));
  }
};

TEST_F(SampleSocketPort, LinesOfSeveralSendersAreNotTorn) {
  Port port(io.get_executor(), settings, recorder);
  port.start();
  ASSERT_TRUE(until([&] { return !recorder.opened.empty(); }));
  EXPECT_EQ(recorder.opened[0].path, "unix-listen:" + path);
  const auto first = connected(), second = connected();
  send(first, "{\"a\":");
  send(second, "{\"b\":1}\n{\"b\":");
  ASSERT_TRUE(until([&] { return recorder.received == "{\"b\":1}\n"; })) << recorder.received;
  send(first, "1}\n");
  ASSERT_TRUE(until([&] { return recorder.received == "{\"b\":1}\n{\"a\":1}\n"; })) << recorder.received;
  send(second, "2}\n");
  ASSERT_TRUE(until([&] { return recorder.received.ends_with("{\"a\":1}\n{\"b\":2}\n"); })) << recorder.received;
  EXPECT_TRUE(recorder.lost.empty());
}

TEST_F(SampleSocketPort, OneSenderAfterTheOther) {
  Port port(io.get_executor(), settings, recorder);
  port.start();
  ASSERT_TRUE(until([&] { return !recorder.opened.empty(); }));
  std::string expected;
  for (int i = 0; i < 100; ++i) {
    const std::string line = "{\"i\":" + std::to_string(i) + "}\n";
    send(connected(), line);
    expected += line;
    ASSERT_TRUE(until([&] { return recorder.received == expected; })) << recorder.received;
  }
  send(connected(), "{\"cut\":");
  EXPECT_TRUE(until([&] { return recorder.received == expected + "{\"cut\":"; })) << "no byte is lost";
}

TEST_F(SampleSocketPort, MoreSendersThanMayBeConnectedTakeTurns) {
  Port port(io.get_executor(), settings, recorder);
  port.start();
  ASSERT_TRUE(until([&] { return !recorder.opened.empty(); }));
  std::vector<base::Descriptor> senders;
  for (std::size_t i = 0; i < kMostSenders; ++i) {
    senders.push_back(connected());
    send(senders.back(), "x\n");
    ASSERT_TRUE(until([&] { return recorder.received.size() == 2 * (i + 1); }));
  }
  const auto further = connected();
  send(further, "y\n");
  run_for(io, std::chrono::milliseconds(50));
  EXPECT_EQ(recorder.received.find('y'), std::string::npos);
  senders.pop_back();
  EXPECT_TRUE(until([&] { return recorder.received.ends_with("y\n"); }));
}

TEST_F(SampleSocketPort, MuchAtOnceAndLinesWithoutEndArriveWhole) {
  Port port(io.get_executor(), settings, recorder);
  port.start();
  ASSERT_TRUE(until([&] { return !recorder.opened.empty(); }));
  const auto sender = connected();
  std::string all(100'000, 'x');  // no line, and longer than any
  send(sender, all);
  ASSERT_TRUE(until([&] { return recorder.received.size() >= all.size() - 2048; }));
  std::string lines = "\n";
  for (int i = 0; i < 5'000; ++i) lines += "{\"number\":" + std::to_string(i) + "}\n";
  send(sender, lines);
  ASSERT_TRUE(until([&] { return recorder.received.size() == all.size() + lines.size(); }));
  EXPECT_EQ(recorder.received, all + lines);
}

TEST_F(SampleSocketPort, TheFileIsForOwnerAndGroupAndGoesWithThePort) {
  {
    Port port(io.get_executor(), settings, recorder);
    port.start();
    ASSERT_TRUE(until([&] { return !recorder.opened.empty(); }));
    struct stat found {};
    ASSERT_EQ(::stat(path.c_str(), &found), 0);
    EXPECT_EQ(found.st_mode & 0777, 0660U);
  }
  run_for(io, std::chrono::milliseconds(10));
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST_F(SampleSocketPort, ASocketThatIsInUseIsLeftAloneAndADeadOneIsReplaced) {
  auto first = open_sample_socket(path);
  ASSERT_TRUE(std::holds_alternative<std::unique_ptr<Line>>(first));
  const auto second = open_sample_socket(path);
  ASSERT_TRUE(std::holds_alternative<std::string>(second));
  EXPECT_NE(std::get<std::string>(second).find("Address already in use"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_socket(path));
  first = std::string();
  {
    // As a process leaves it that was killed.
    const base::Descriptor dead(::socket(AF_UNIX, SOCK_STREAM, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path.data(), path.size());
    ASSERT_EQ(::bind(dead.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  EXPECT_TRUE(std::holds_alternative<std::unique_ptr<Line>>(open_sample_socket(path)));
}

}  // namespace
}  // namespace navcal::ports::testing
