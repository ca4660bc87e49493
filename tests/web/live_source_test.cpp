// SPDX-License-Identifier: Apache-2.0
#include "web/live_source.h"

#include <gtest/gtest.h>

#include <boost/asio/read.hpp>
#include <thread>

#include "tests/support/free_port.h"
#include "tests/support/process.h"
#include "tests/web/web_server.h"

namespace navcal::web {
namespace {

/// navcald's status socket, served by the test.
class FakeStatus {
 public:
  explicit FakeStatus(std::uint16_t port)
      : acceptor_(context_, {boost::asio::ip::make_address("127.0.0.1"), port}), socket_(context_) {}
  void accept() { socket_ = acceptor_.accept(); }
  void send(std::string_view text) { boost::asio::write(socket_, boost::asio::buffer(text)); }
  /// The next line that the source sends.
  std::string line() {
    std::string got;
    char c = 0;
    boost::system::error_code closed;
    while (boost::asio::read(socket_, boost::asio::buffer(&c, 1), closed) == 1) {
      if (c == '\n') return got;
      got += c;
    }
    return "(closed)";
  }
  void hang_up() { socket_.close(); }

 private:
  boost::asio::io_context context_;
  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::ip::tcp::socket socket_;
};

struct Collected : Subscriber {
  void on_record(const Record& record) override { messages.emplace_back(record.message); }
  std::vector<std::string> messages;
};

/// navcald's answer to a policy; what it says of the policy is of no use to the source.
constexpr std::string_view kPolicyTaken = "{\"class\":\"WATCH\",\"enable\":true}\r\n";

class LiveSourceTest : public testing::Test {
 protected:
  void SetUp() override {
    source_ = std::make_shared<LiveSource>(context_.get_executor(),
                                           LiveSource::Settings{"127.0.0.1", std::to_string(port_)}, hub_);
    hub_.add(collected_, {false, {"/imu"}, 20.0});
    source_->start();
    thread_ = std::thread([this] { context_.run(); });
  }
  template <class Work>
  auto in_loop(Work work) {
    return test::run_in_loop(context_, std::move(work));
  }
  void TearDown() override {
    in_loop([&] {
      source_->stop();
      return 0;
    });
    thread_.join();
  }
  template <class Condition>
  bool becomes(Condition condition) {
    return navcal::test::eventually([&] { return in_loop(condition); });
  }

  const std::uint16_t port_ = navcal::test::free_port();
  boost::asio::io_context context_;
  Hub hub_;
  Collected collected_, viewer_;  ///< the hub knows them until the loop has ended
  std::shared_ptr<LiveSource> source_;
  std::thread thread_;
};

TEST_F(LiveSourceTest, AsksForWhatIsNeededAndAgainAfterARestartOfNavcald) {
  for (int round = 0; round < 2; ++round) {
    FakeStatus status(port_);
    status.accept();
    EXPECT_EQ(status.line(), "?RECORDS;");
    EXPECT_EQ(
        status.line(),
        R"(?WATCH={"enable":true,"json":true,"classes":["RECORD"],"topics":["/imu"],"rate_Hz":{"RECORD":20.0},"topic_rate_Hz":null};)");
    EXPECT_TRUE(becomes([&] { return hub_.link().connected; }));
    status.hang_up();
    EXPECT_TRUE(becomes([&] { return !hub_.link().connected; }));
    EXPECT_TRUE(in_loop([&] { return !hub_.link().problem.empty(); }));
  }
}

TEST_F(LiveSourceTest, AChangedDemandIsAskedForOnce) {
  FakeStatus status(port_);
  status.accept();
  status.line();
  status.line();
  status.send(kPolicyTaken);
  EXPECT_TRUE(becomes([&] { return hub_.link().connected; }));
  in_loop([&] {
    hub_.add(viewer_, {true, {}, std::nullopt});
    hub_.change(viewer_, {true, {}, std::nullopt});
    return 0;
  });
  EXPECT_EQ(
      status.line(),
      R"(?WATCH={"enable":true,"json":true,"classes":["RECORD"],"topics":null,"rate_Hz":null,"topic_rate_Hz":null};)");
  in_loop([&] {
    hub_.remove(viewer_);
    return 0;
  });
  status.send(kPolicyTaken);
  EXPECT_NE(status.line().find(R"(["/imu"])"), std::string::npos);
}

TEST_F(LiveSourceTest, WhatChangesBeforeNavcaldHasAnsweredIsAskedForInOneRequest) {
  FakeStatus status(port_);
  status.accept();
  status.line();
  status.line();
  EXPECT_TRUE(becomes([&] { return hub_.link().connected; }));
  in_loop([&] {
    Demand demand;
    hub_.add(viewer_, demand);
    for (const char* topic : {"/compass", "/gps", "/nav"}) {
      demand.topics.insert(topic);
      hub_.change(viewer_, demand);
    }
    return 0;
  });
  status.send("{\"class\":\"ERROR\",\"message\":\"not now\"}\n");
  EXPECT_NE(status.line().find(R"("topics":["/compass","/gps","/imu","/nav"])"), std::string::npos);
}

TEST_F(LiveSourceTest, RecordsTopicsAndLossesAreTakenAndGarbageIsCounted) {
  FakeStatus status(port_);
  status.accept();
  status.send("{\"class\":\"VERSION\"}\r\nno JSON\n");
  status.send(
      R"({"class":"RECORDS","topics":[{"topic":"/imu","schema_name":"navcal.Imu","schema":{"type":"object"}}]})"
      "\n");
  status.send(R"({"class":"RECORD","topic":"/imu","device":"imu","time":5.5,"message":{"a":1}})"
              "\n");
  status.send(R"({"class":"RECORD","topic":"/health","device":null,"time":5.5,"message":{"dropped":7}})"
              "\n");
  EXPECT_TRUE(becomes([&] { return collected_.messages.size() == 2; }));
  EXPECT_TRUE(in_loop([&] {
    return hub_.topics().size() == 1 && hub_.topics()[0].schema == R"({"type":"object"})" &&
           collected_.messages[0] == R"({"a":1})" && source_->counters().missed == 7 &&
           source_->counters().not_understood == 1;
  }));
}

TEST_F(LiveSourceTest, SchemasKeepTheOrderOfTheirMembersAndWrongTypesDoNoHarm) {
  FakeStatus status(port_);
  status.accept();
  const std::string schema = R"({"title":"z","type":"object","properties":{"b":{"type":"number"},"a":{}}})";
  status.send(
      R"({"class":"RECORDS","topics":[{"topic":7,"schema":{}},{"topic":"","schema":{}},3,{"topic":"/none"},)"
      R"({"topic":"/imu","schema_name":5,"schema":)" +
      schema + "}]}\n");
  status.send(R"({"class":"RECORD","topic":"/health","device":null,"time":5.5,"message":{"dropped":"many"}})"
              "\n");
  status.send(R"({"class":"RECORD","topic":"/imu","device":"imu","time":5.5,"message":{"a":1}})"
              "\n");
  EXPECT_TRUE(becomes([&] { return collected_.messages.size() == 2; }));
  EXPECT_TRUE(in_loop([&] {
    return hub_.topics().size() == 1 && hub_.topics()[0].schema == schema &&
           hub_.topics()[0].schema_name.empty() && source_->counters().missed == 0;
  }));
}

TEST_F(LiveSourceTest, APeerThatSendsNoLinesIsLeft) {
  FakeStatus status(port_);
  status.accept();
  std::thread sender([&] {
    try {
      for (int i = 0; i < 40; ++i) status.send(std::string(100'000, 'x'));
    } catch (const boost::system::system_error&) {
      // The source hung up, as it should.
    }
  });
  EXPECT_TRUE(becomes([&] { return hub_.link().problem.find("no lines") != std::string::npos; }));
  sender.join();
}

TEST(StatusSocket, HasAHostAndAPort) {
  const auto is = [](std::string_view text, const std::string& host, const std::string& port) {
    const auto settings = status_socket(text);
    return settings && settings->host == host && settings->port == port;
  };
  EXPECT_TRUE(is("auv:2947", "auv", "2947"));
  EXPECT_TRUE(is(":2948", "127.0.0.1", "2948"));
  EXPECT_TRUE(is("[::1]:2947", "::1", "2947"));
  EXPECT_FALSE(status_socket("localhost"));
}

}  // namespace
}  // namespace navcal::web
