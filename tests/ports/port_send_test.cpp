// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include "ports/pseudo_terminal.h"
#include "tests/ports/harness.h"

namespace navcal::ports::testing {
namespace {

struct PortSend : ::testing::Test {
  Folder folder;
  boost::asio::io_context io{1};
  std::string heard;
  std::unique_ptr<PtyHost> host;
  Recorder recorder;
  std::unique_ptr<Port> port;

  void SetUp() override {
    host = std::make_unique<PtyHost>(io.get_executor(), folder.path() / "compass", 9600,
                                     [this](std::int64_t, protocols::Bytes bytes) {
                                       heard.append(bytes.begin(), bytes.end());
                                       if (heard.size() == 2) host->write(bytes_of(":\r\n"));
                                     });
    port = std::make_unique<Port>(io.get_executor(), settings_for(host->link()), recorder);
    port->start();
    ASSERT_TRUE(run_until(io, [&] { return !recorder.opened.empty(); }));
  }
};

TEST_F(PortSend, ADialogue) {
  port->send(bytes_of("h\r"));
  ASSERT_TRUE(run_until(io, [&] { return recorder.received == ":\r\n"; }));
  port->send(bytes_of("ec=e\r"));
  port->send(bytes_of("go\r"));
  ASSERT_TRUE(run_until(io, [&] { return heard.size() == 10 && recorder.sent.size() == 10; }));
  EXPECT_EQ(heard, "h\rec=e\rgo\r");
  EXPECT_EQ(recorder.sent, heard) << "what is reported as sent is what was sent";
}

TEST_F(PortSend, TheQueueIsBounded) {
  const std::string line(100, 'q');
  for (int i = 0; i < 1000; ++i) port->send(bytes_of(line));
  ASSERT_TRUE(run_until(io, [&] { return recorder.sent.size() == 4000; }));
  run_for(io, std::chrono::milliseconds(100));
  EXPECT_EQ(heard.size(), 4000U) << "4 KiB, whole messages only";
  EXPECT_EQ(recorder.dropped.size(), 96'000U);
  port->send(bytes_of("next"));
  EXPECT_TRUE(run_until(io, [&] { return heard.size() == 4004; })) << "and it has room again";
}

TEST_F(PortSend, WhileThePortIsAwayNothingIsKept) {
  host->unplug();
  ASSERT_TRUE(run_until(io, [&] { return !recorder.lost.empty(); }));
  port->send(bytes_of("lost"));
  host->replug();
  ASSERT_TRUE(run_until(io, [&] { return recorder.opened.size() == 2; }));
  port->send(bytes_of("go"));
  ASSERT_TRUE(run_until(io, [&] { return heard.size() == 2; }));
  EXPECT_EQ(heard, "go");
  EXPECT_EQ(recorder.sent, "go");
  EXPECT_EQ(recorder.dropped, "lost");
}

TEST_F(PortSend, ADeviceThatDoesNotReadHoldsUpNothingElse) {
  // Nobody runs the host's side of this one: its buffer fills up.
  boost::asio::io_context never_run{1};
  PtyHost deaf(never_run.get_executor(), folder.path() / "deaf", 9600, {});
  Recorder other;
  Port second(io.get_executor(), settings_for(deaf.link()), other);
  second.start();
  ASSERT_TRUE(run_until(io, [&] { return !other.opened.empty(); }));
  for (int i = 0; i < 100; ++i) {
    second.send(bytes_of(std::string(4000, 'x')));
    run_for(io, std::chrono::milliseconds(1));
  }
  port->send(bytes_of("h\r"));
  EXPECT_TRUE(run_until(io, [&] { return recorder.received == ":\r\n"; }));
  EXPECT_LT(other.sent.size(), 400'000U);
  second.stop();
}

TEST_F(PortSend, ReadsAfterItWakeTheLoopNoMoreOftenThanBefore) {
  const PseudoTerminal device = make_pseudo_terminal(9600);
  Recorder other;
  Port second(io.get_executor(), settings_for(device.slave_name), other);
  second.start();
  ASSERT_TRUE(run_until(io, [&] { return !other.opened.empty(); }));
  const auto turns_of_a_read = [&] {
    const std::size_t before = other.received.size();
    EXPECT_EQ(::write(device.master.get(), "x", 1), 1);
    std::size_t turns = 0;
    while (other.received.size() == before) turns += io.run_one();
    for (int i = 0; i < 20; ++i) turns += io.poll();
    return turns;
  };
  const std::size_t before = turns_of_a_read();
  second.send(bytes_of("go"));
  ASSERT_TRUE(run_until(io, [&] { return other.sent == "go"; }));
  EXPECT_EQ(turns_of_a_read(), before);
  second.stop();
}

}  // namespace
}  // namespace navcal::ports::testing
