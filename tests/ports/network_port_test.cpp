// SPDX-License-Identifier: Apache-2.0
// A Port whose device is reached through the network; real sockets on the loopback.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <optional>

#include "tests/ports/harness.h"

namespace navcal::ports::testing {
namespace {

using boost::asio::ip::tcp;
using boost::asio::ip::udp;
const auto kLoopback = boost::asio::ip::make_address("127.0.0.1");

config::PortSettings settings_at(std::string address) {
  config::PortSettings settings;
  settings.name = "gps";
  settings.address = std::move(address);
  return settings;
}

/// A number that is free now: bound once and given back.
std::uint16_t free_number(boost::asio::io_context& io) {
  return tcp::acceptor(io, {kLoopback, 0}).local_endpoint().port();
}

struct NetworkPort : ::testing::Test {
  boost::asio::io_context io{1};
  Recorder recorder;

  [[nodiscard]] bool until(const std::function<bool()>& condition) { return run_until(io, condition); }
  [[nodiscard]] bool opened(std::size_t times) {
    return until([&] { return recorder.opened.size() >= times; });
  }
};

/// A converter of serial lines that is connected to; one connection at a time.
struct Converter {
  explicit Converter(boost::asio::io_context& io, std::uint16_t number = 0) : acceptor(io, {kLoopback, number}) {
    acceptor.async_accept([this](const boost::system::error_code& error, tcp::socket accepted) {
      if (!error) socket.emplace(std::move(accepted));
    });
  }
  [[nodiscard]] std::string address() const {
    return fmt::format("tcp:127.0.0.1:{}", acceptor.local_endpoint().port());
  }

  tcp::acceptor acceptor;
  std::optional<tcp::socket> socket;
};

void write(tcp::socket& socket, std::string_view text) {
  boost::asio::write(socket, boost::asio::buffer(text.data(), text.size()));
}

TEST_F(NetworkPort, ConnectsReadsAndWrites) {
  Converter converter(io);
  Port port(io.get_executor(), settings_at(converter.address()), recorder);
  port.start();
  ASSERT_TRUE(opened(1) && until([&] { return converter.socket.has_value(); }));
  EXPECT_EQ(recorder.opened[0].path, converter.address());
  EXPECT_TRUE(recorder.opened[0].is_network);
  EXPECT_TRUE(recorder.lost.empty());

  std::string written;
  for (std::size_t size = 1; size < 300'000; size *= 3) {
    const std::string piece(size, static_cast<char>('a' + size % 26));
    written += piece;
    boost::asio::async_write(*converter.socket, boost::asio::buffer(piece), [](const auto&, std::size_t) {});
    ASSERT_TRUE(until([&] { return recorder.received.size() == written.size(); }));
  }
  EXPECT_EQ(recorder.received, written);

  port.send(bytes_of("poll"));
  ASSERT_TRUE(until([&] { return recorder.sent == "poll"; }));
  EXPECT_TRUE(port.send_now(bytes_of("now")));
  std::string heard(7, '\0');
  boost::asio::read(*converter.socket, boost::asio::buffer(heard));
  EXPECT_EQ(heard, "pollnow");
}

TEST_F(NetworkPort, ARefusedConnectionSaysSoOnceAndIsTriedAgain) {
  const std::uint16_t number = free_number(io);
  Port port(io.get_executor(), settings_at(fmt::format("tcp:127.0.0.1:{}", number)), recorder);
  port.start();
  ASSERT_TRUE(until([&] { return !recorder.lost.empty(); }));
  EXPECT_EQ(recorder.lost[0], fmt::format("tcp:127.0.0.1:{}: Connection refused", number));
  run_for(io, std::chrono::milliseconds(1200));
  EXPECT_EQ(recorder.lost.size(), 1U);
  Converter converter(io, number);
  EXPECT_TRUE(opened(1));
}

TEST_F(NetworkPort, AConnectionThatEndsIsMadeAgain) {
  std::optional<Converter> converter(std::in_place, io);
  const std::uint16_t number = converter->acceptor.local_endpoint().port();
  Port port(io.get_executor(), settings_at(converter->address()), recorder);
  port.start();
  ASSERT_TRUE(opened(1) && until([&] { return converter->socket.has_value(); }));
  write(*converter->socket, "before");
  ASSERT_TRUE(until([&] { return recorder.received == "before"; }));
  converter.reset();
  ASSERT_TRUE(until([&] { return !recorder.lost.empty(); }));
  EXPECT_NE(recorder.lost[0].find("closed the connection"), std::string::npos) << recorder.lost[0];
  port.send(bytes_of("nobody hears this"));
  EXPECT_FALSE(port.send_now(bytes_of("nor this")));
  converter.emplace(io, number);
  ASSERT_TRUE(opened(2) && until([&] { return converter->socket.has_value(); }));
  write(*converter->socket, " after");
  ASSERT_TRUE(until([&] { return recorder.received == "before after"; }));
}

TEST_F(NetworkPort, WritingToAPeerThatHasGoneEndsNothingButTheConnection) {
  Converter converter(io);
  Port port(io.get_executor(), settings_at(converter.address()), recorder);
  port.start();
  ASSERT_TRUE(opened(1) && until([&] { return converter.socket.has_value(); }));
  converter.socket->set_option(boost::asio::socket_base::linger(true, 0));
  converter.socket->close();  // with a reset: what is written now would raise SIGPIPE
  for (int i = 0; i < 3; ++i) (void)port.send_now(bytes_of("order"));
  EXPECT_TRUE(until([&] { return !recorder.lost.empty(); }));
}

TEST_F(NetworkPort, AStoppedPortReportsNothingAndGivesItsSocketsBack) {
  const tcp::acceptor first_of_all(io, {kLoopback, 0});  // Asio opens its own descriptors with the first socket
  const std::size_t before = open_descriptors();
  {
    Converter converter(io);
    const std::uint16_t number = free_number(io);
    Port connected(io.get_executor(), settings_at(converter.address()), recorder);
    Port waiting(io.get_executor(), settings_at(fmt::format("tcp-listen:127.0.0.1:{}", number)), recorder);
    connected.start();
    waiting.start();
    ASSERT_TRUE(opened(1) && until([&] { return converter.socket.has_value() && !recorder.lost.empty(); }));
    connected.stop();
    waiting.stop();
    const std::size_t lost = recorder.lost.size();
    run_for(io, std::chrono::milliseconds(50));
    EXPECT_EQ(recorder.lost.size(), lost);
  }
  run_for(io, std::chrono::milliseconds(10));
  EXPECT_EQ(open_descriptors(), before);
}

struct Listening : NetworkPort {
  std::uint16_t number = free_number(io);
  Port port{io.get_executor(), settings_at(fmt::format("tcp-listen:127.0.0.1:{}", number)), recorder};

  void SetUp() override {
    port.start();
    ASSERT_TRUE(until([&] { return !recorder.lost.empty(); }));
    EXPECT_NE(recorder.lost[0].find("waiting for a device that connects"), std::string::npos) << recorder.lost[0];
  }
  tcp::socket device() {
    tcp::socket socket(io);
    socket.connect({kLoopback, number});
    return socket;
  }
};

TEST_F(Listening, ADeviceThatConnectsIsHeard) {
  tcp::socket first = device();
  ASSERT_TRUE(opened(1));
  write(first, "fix");
  ASSERT_TRUE(until([&] { return recorder.received == "fix"; }));
  first.close();
  ASSERT_TRUE(until([&] { return recorder.lost.size() >= 2; }));
  tcp::socket second = device();
  ASSERT_TRUE(opened(2));
  write(second, "again");
  EXPECT_TRUE(until([&] { return recorder.received == "fixagain"; }));
}

// A converter that lost its power does not close its old connection, and must not be locked out by it.
TEST_F(Listening, ANewConnectionTakesThePlaceOfTheOldOne) {
  tcp::socket first = device();
  ASSERT_TRUE(opened(1));
  tcp::socket second = device();
  ASSERT_TRUE(opened(2));
  EXPECT_NE(recorder.lost.back().find("another device has connected"), std::string::npos) << recorder.lost.back();
  write(second, "second");
  EXPECT_TRUE(until([&] { return recorder.received == "second"; }));
}

TEST_F(Listening, APlaceThatIsTakenSaysSo) {
  Recorder other;
  Port twice(io.get_executor(), settings_at(fmt::format("tcp-listen:127.0.0.1:{}", number)), other);
  twice.start();
  ASSERT_TRUE(until([&] { return !other.lost.empty(); }));
  EXPECT_EQ(other.lost[0], fmt::format("tcp-listen:127.0.0.1:{}: Address already in use", number));
}

struct DatagramPort : NetworkPort {
  udp::socket sender{io, {kLoopback, 0}};
  udp::endpoint to{kLoopback, free_number(io)};
  Port port{io.get_executor(), settings_at(fmt::format("udp:127.0.0.1:{}", to.port())), recorder};

  void SetUp() override {
    port.start();
    ASSERT_TRUE(opened(1));
  }
  void send(const std::string& text) { sender.send_to(boost::asio::buffer(text), to); }
};

TEST_F(DatagramPort, EachDatagramIsReadWholeAndInOrder) {
  for (const std::size_t size : {1U, 100U, 5000U, 60'000U}) {
    recorder.received.clear();
    send(std::string(size, 'x'));
    ASSERT_TRUE(until([&] { return recorder.received.size() == size; })) << size;
  }
  recorder.received.clear();
  const std::size_t reads = recorder.arrivals_ns.size();
  for (const char* const text : {"one ", "two ", "three"}) send(text);
  ASSERT_TRUE(until([&] { return recorder.received == "one two three"; }));
  EXPECT_EQ(recorder.arrivals_ns.size(), reads + 3);
}

TEST_F(DatagramPort, AnEmptyDatagramIsNoEnd) {
  send("");
  send("a");
  ASSERT_TRUE(until([&] { return recorder.received == "a"; }));
  EXPECT_TRUE(recorder.lost.empty());
}

TEST_F(DatagramPort, AnswersGoToTheLastSender) {
  EXPECT_FALSE(port.send_now(bytes_of("to nobody")));
  send("hello");
  ASSERT_TRUE(until([&] { return recorder.received == "hello"; }));
  EXPECT_TRUE(port.send_now(bytes_of("answer")));
  std::string heard(6, '\0');
  sender.receive(boost::asio::buffer(heard));
  EXPECT_EQ(heard, "answer");
}

TEST_F(DatagramPort, EachMessageIsADatagram) {
  port.send(bytes_of("to nobody"));
  EXPECT_EQ(recorder.dropped, "to nobody");
  send("hello");
  ASSERT_TRUE(until([&] { return recorder.received == "hello"; }));
  for (const char* const text : {"one", "more"}) port.send(bytes_of(text));
  std::string heard(100, '\0');
  EXPECT_EQ(sender.receive(boost::asio::buffer(heard)), 3U);
  EXPECT_EQ(sender.receive(boost::asio::buffer(heard)), 4U);
  EXPECT_EQ(recorder.sent, "onemore");
}

TEST_F(DatagramPort, ASenderThatHasGoneDoesNotEndThePort) {
  send("hello");
  ASSERT_TRUE(until([&] { return recorder.received == "hello"; }));
  sender.close();
  for (int i = 0; i < 3; ++i) (void)port.send_now(bytes_of("answer"));  // comes back as "connection refused"
  run_for(io, std::chrono::milliseconds(50));
  EXPECT_TRUE(recorder.lost.empty());
  udp::socket other(io, {kLoopback, 0});
  other.send_to(boost::asio::buffer("again", 5), to);
  EXPECT_TRUE(until([&] { return recorder.received == "helloagain"; }));
}

}  // namespace
}  // namespace navcal::ports::testing
