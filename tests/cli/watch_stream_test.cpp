// SPDX-License-Identifier: Apache-2.0
#include "cli/live/watch_stream.h"

#include <gtest/gtest.h>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <future>

namespace navcal::cli {
namespace {

namespace asio = boost::asio;
using Clock = std::chrono::steady_clock;

constexpr int kLines = 200'000;

/// A daemon that sends its lines to who asks, and goes away.
class Sender {
 public:
  [[nodiscard]] std::string port() const { return std::to_string(acceptor_.local_endpoint().port()); }
  /// Returns once the kernel has taken all lines.
  void serve() {
    asio::ip::tcp::socket socket = acceptor_.accept();
    std::string request, lines;
    asio::read_until(socket, asio::dynamic_buffer(request), '\n');
    for (int i = 0; i < kLines; ++i) lines += std::to_string(i) + std::string(100, ' ') + '\n';
    asio::write(socket, asio::buffer(lines));
    acceptor_.close();
  }

 private:
  asio::io_context io_;
  asio::ip::tcp::acceptor acceptor_{io_, {asio::ip::address_v4::loopback(), 0}};
};

// The reader was the thread that judges: during a look of a minute, navcald had to leave out 4050 reports.
TEST(ReadAhead, TakesAllLinesWhileItsUserIsBusy) {
  Sender sender;
  ReadAhead stream(WatchStream("127.0.0.1", sender.port(), "?\n"));
  auto served = std::async(std::launch::async, [&] { sender.serve(); });
  ASSERT_EQ(served.wait_for(std::chrono::minutes(2)), std::future_status::ready) << "nobody reads";
  served.get();
  for (int i = 0; i < kLines; ++i) {
    const auto item = stream.next(Clock::now() + std::chrono::minutes(1));
    ASSERT_TRUE(item && item->line);
    ASSERT_EQ(std::stoi(*item->line), i);
  }
  const auto end = stream.next(Clock::now() + std::chrono::minutes(1));
  ASSERT_TRUE(end);
  EXPECT_FALSE(end->line || end->is_connected);
  EXPECT_FALSE(end->problem.empty());
  EXPECT_FALSE(stream.next(Clock::now()));
}

TEST(ReadAhead, EndsWhileADaemonSaysNothing) {
  Sender silent;
  ReadAhead stream(WatchStream("127.0.0.1", silent.port(), "?\n"));
  EXPECT_FALSE(stream.next(Clock::now() + std::chrono::milliseconds(10)));
}

}  // namespace
}  // namespace navcal::cli
