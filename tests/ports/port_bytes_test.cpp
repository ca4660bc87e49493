// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <termios.h>

#include <algorithm>
#include <random>

#include "ports/raw_mode.h"
#include "tests/ports/harness.h"

namespace navcal::ports::testing {
namespace {

struct PortBytes : ::testing::Test {
  Folder folder;
  boost::asio::io_context io{1};
  PtyHost host{io.get_executor(), folder.path() / "compass", 9600, {}};
  Recorder recorder;
};

std::string random_bytes(std::mt19937& random, std::size_t n) {
  std::string bytes(n, '\0');
  for (char& byte : bytes)
    byte = static_cast<char>(random());  // every value: nothing may be taken for a control key
  return bytes;
}

TEST_F(PortBytes, ComeThroughIntactHoweverTheyAreCut) {
  std::mt19937 random(1);
  Port port(io.get_executor(), settings_for(host.link()), recorder);
  port.start();
  ASSERT_TRUE(run_until(io, [&] { return !recorder.opened.empty(); }));
  std::string written;
  std::uniform_int_distribution<std::size_t> length(1, 5000);
  for (int i = 0; i < 100; ++i) {
    const std::string piece =
        random_bytes(random, i % 3 == 0 ? 1 + static_cast<std::size_t>(i) % 7 : length(random));
    written += piece;
    ASSERT_EQ(host.write(bytes_of(piece)), piece.size());
    if (i % 4 != 0) {
      ASSERT_TRUE(run_until(io, [&] { return recorder.received.size() == written.size(); }));
    }
    ASSERT_TRUE(run_until(io, [&] { return written.size() - recorder.received.size() < 5000; }));
  }
  ASSERT_TRUE(run_until(io, [&] { return recorder.received.size() == written.size(); }));
  EXPECT_EQ(recorder.received, written);
  EXPECT_TRUE(std::is_sorted(recorder.arrivals_ns.begin(), recorder.arrivals_ns.end()));
}

TEST_F(PortBytes, OneWakeUpForOneRecord) {
  Port port(io.get_executor(), settings_for(host.link()), recorder);
  port.start();
  ASSERT_TRUE(run_until(io, [&] { return !recorder.opened.empty(); }));
  for (std::size_t i = 1; i <= 20; ++i) {
    const std::int64_t before = monotonic_ns();
    host.write(bytes_of("$C328.3T22.3*2E\r\n"));
    ASSERT_TRUE(run_until(io, [&] { return recorder.received.size() == i * 17; }));
    EXPECT_GE(recorder.arrivals_ns.back(), before);
    EXPECT_LE(recorder.arrivals_ns.back(), monotonic_ns());
  }
  EXPECT_EQ(recorder.arrivals_ns.size(), 20U);
}

TEST_F(PortBytes, WhatCameWhileTheLineWasOpenedIsKept) {
  const base::Descriptor other = open_client(host.link());  // somebody has it open, so that the host is heard
  host.write(bytes_of("early"));
  Port port(io.get_executor(), settings_for(host.link()), recorder);
  port.start();
  ASSERT_TRUE(run_until(io, [&] { return recorder.received == "early"; }));
}

TEST_F(PortBytes, TheLineIsRawAtTheConfiguredSpeedAndGivenBackAsItWas) {
  {
    const base::Descriptor client = open_client(host.link());
    termios cooked{};
    ASSERT_EQ(tcgetattr(client.get(), &cooked), 0);
    cooked.c_lflag |= ICANON;
    cfsetspeed(&cooked, B4800);
    ASSERT_EQ(tcsetattr(client.get(), TCSANOW, &cooked), 0);
  }
  Port port(io.get_executor(), settings_for(host.link(), 38400), recorder);
  port.start();
  ASSERT_TRUE(run_until(io, [&] { return !recorder.opened.empty(); }));
  EXPECT_EQ(host.client_baud(), 38400);
  EXPECT_TRUE(recorder.opened[0].pseudo_terminal);
  EXPECT_EQ(recorder.opened[0].path, host.device());
  EXPECT_EQ(recorder.opened[0].low_latency, "not applicable on a pseudo-terminal");
  port.stop();
  EXPECT_EQ(host.client_baud(), 4800);
}

TEST_F(PortBytes, NothingIsReportedAfterStopEvenFromWithinAReport) {
  Port port(io.get_executor(), settings_for(host.link()), recorder);
  recorder.at_bytes = [&] { port.stop(); };
  port.start();
  ASSERT_TRUE(run_until(io, [&] { return !recorder.opened.empty(); }));
  host.write(bytes_of(std::string(9000, 'x')));
  ASSERT_TRUE(run_until(io, [&] { return !recorder.received.empty(); }));
  const std::size_t received = recorder.received.size();
  host.write(bytes_of("more"));
  host.unplug();
  run_for(io, std::chrono::milliseconds(300));
  EXPECT_EQ(recorder.received.size(), received);
  EXPECT_TRUE(recorder.lost.empty());
}

}  // namespace
}  // namespace navcal::ports::testing
