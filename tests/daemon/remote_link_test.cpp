// SPDX-License-Identifier: Apache-2.0
// The vehicle's end of the remote link over TCP, with a daemon that answers late.
#include "daemon/remote_link.h"

#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <vector>

#include "tests/daemon/link_operator.h"
#include "tests/support/free_port.h"

namespace navcal::daemon {
namespace {

/// A daemon that answers when the test does.
class LateOwner final : public RemoteOwner {
 public:
  struct Asked {
    ControlRequest request;
    std::uint64_t client;
    Reply reply;
  };
  link::Report remote_report(std::int64_t) override { return {}; }
  void remote_answer(const ControlRequest& request, const ControlOrigin& origin, Reply reply) override {
    asked.push_back({request, origin.client, std::move(reply)});
  }
  void remote_client_gone(std::uint64_t client) override { gone.push_back(client); }
  void end_every_lease() override {}
  bool is_in_charge(std::uint64_t) const override { return false; }
  void on_remote_event(std::int64_t, std::string_view, std::string_view, std::string_view) override {}
  void on_remote_dead(std::int64_t, bool) override {}

  std::vector<Asked> asked;
  std::vector<std::uint64_t> gone;
};

class LateAnswers : public testing::Test {
 protected:
  void SetUp() override {
    config::RemoteSettings settings;
    const std::uint16_t port = navcal::test::free_port();
    settings.listen = "127.0.0.1:" + std::to_string(port);
    settings.orders_without_key = true;
    link_.emplace(context_.get_executor(), settings, owner_);
    link_->start();
    operator_.emplace(tcp_to(port), "");
    operator_->work = [this] { context_.poll(); };
    ASSERT_TRUE(operator_->connect());
  }
  void TearDown() override {
    if (link_) link_->stop();
    context_.poll();
  }
  /// Gives a command and waits until the daemon has been asked `count` times.
  void give(link::Command::Kind kind, std::size_t count) {
    link::Command command;
    command.kind = kind;
    command.holder = "operator";
    ASSERT_TRUE(operator_->host.command(remote_now_ns(), command));
    ASSERT_TRUE(operator_->until([&] { return owner_.asked.size() == count; }));
  }
  link::CommandAnswer next_answer() {
    std::optional<link::CommandAnswer> answer;
    EXPECT_TRUE(operator_->until([&] { return (answer = operator_->host.take_answer()).has_value(); }));
    return answer.value_or(link::CommandAnswer{});
  }

  static constexpr const char* kGranted = R"({"ok":true,"lease":"the token","timeout_s":5})";
  using Kind = link::Command::Kind;

  boost::asio::io_context context_;
  LateOwner owner_;
  std::optional<RemoteLink> link_;
  std::optional<Operator> operator_;
};

TEST_F(LateAnswers, ALeaseThatIsSentAgainMeanwhileIsAskedForOnceAndAnswered) {
  give(Kind::lease, 1);
  const auto sent = operator_->host.counters().sent_bytes;
  // Longer than the command takes to be sent again; the bytes are more than those of a ping.
  ASSERT_TRUE(operator_->until([&] { return operator_->host.counters().sent_bytes > sent + 100; }));
  ASSERT_EQ(owner_.asked.size(), 1U);
  owner_.asked[0].reply(kGranted);
  EXPECT_TRUE(next_answer().is_ok);
  give(Kind::order, 2);
  EXPECT_EQ(owner_.asked[1].request.lease, "the token");
  EXPECT_TRUE(owner_.gone.empty());
}

TEST_F(LateAnswers, AStopDoesNotWaitForALeaseAndALeaseThatComesAfterItEnds) {
  give(Kind::lease, 1);
  give(Kind::stop, 2);
  EXPECT_EQ(owner_.asked[1].request.command, ControlCommand::motor_stop);
  EXPECT_EQ(owner_.asked[1].request.by, "operator");
  owner_.asked[1].reply(R"({"ok":true})");
  EXPECT_TRUE(next_answer().is_ok);
  owner_.asked[0].reply(kGranted);
  EXPECT_EQ(owner_.gone, std::vector<std::uint64_t>{owner_.asked[0].client});
  give(Kind::order, 3);
  EXPECT_EQ(owner_.asked[2].request.lease, "");
}

TEST_F(LateAnswers, ALeaseOfAnOperatorWhoHasLeftEnds) {
  give(Kind::lease, 1);
  operator_->host.bye();
  ASSERT_TRUE(operator_->until([&] { return owner_.gone.size() == 1; }));
  owner_.asked[0].reply(kGranted);
  EXPECT_EQ(owner_.gone, (std::vector<std::uint64_t>{owner_.asked[0].client, owner_.asked[0].client}));
}

TEST_F(LateAnswers, AnAnswerAfterTheEndGoesNowhere) {
  give(Kind::lease, 1);
  link_->stop();
  context_.poll();
  link_.reset();
  owner_.asked[0].reply(kGranted);
  EXPECT_TRUE(owner_.gone.empty());
}

}  // namespace
}  // namespace navcal::daemon
