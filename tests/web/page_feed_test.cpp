// SPDX-License-Identifier: Apache-2.0
#include "web/page_feed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <nlohmann/json.hpp>

namespace navcal::web {
namespace {

using Json = nlohmann::json;

/// A browser that reads, or does not.
class FeedLink final : public PeerLink {
 public:
  bool send(Payload payload) override {
    queued_ += payload.bytes->size();
    all.push_back(std::move(payload));
    if (reads) queued_ = 0;
    return true;
  }
  void close(std::string_view) override {}
  [[nodiscard]] std::size_t queued_bytes() const override { return queued_; }
  [[nodiscard]] Json message(std::size_t i) const { return Json::parse(*all.at(i).bytes); }
  [[nodiscard]] Json last() const { return message(all.size() - 1); }
  void drain(Peer& peer) {
    queued_ = 0;
    reads = true;
    peer.on_drained();
  }

  std::vector<Payload> all;
  bool reads = true;

 private:
  std::size_t queued_ = 0;
};

class FakePlayer final : public Player {
 public:
  void command(std::string_view json) override { commands.emplace_back(json); }
  void viewer_came() override { ++viewers; }
  void append_state(std::string& out) const override { out += R"({"position_s":5})"; }
  std::vector<std::string> commands;
  int viewers = 0;
};

class PageFeedTest : public ::testing::Test {
 protected:
  static PageFeed::Settings settings() { return {.version = "1", .interval = std::chrono::milliseconds(1)}; }
  void make(PageFeed::Settings wanted = settings()) {
    feed = std::make_shared<PageFeed>(context.get_executor(), hub, std::move(wanted));
  }
  std::unique_ptr<Peer> open(FeedLink& link) {
    auto peer = PageFeed::make_viewer(feed, link);
    peer->on_open();
    return peer;
  }
  /// Runs the timers until `condition` holds.
  template <class Condition>
  void run_until(Condition condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!condition() && std::chrono::steady_clock::now() < end) context.run_one_for(std::chrono::seconds(1));
    ASSERT_TRUE(condition());
  }
  void publish(std::string_view topic, std::string_view message) { hub.publish({topic, "", {}, message}); }

  boost::asio::io_context context;
  Hub hub;
  std::shared_ptr<PageFeed> feed;
};

TEST_F(PageFeedTest, ASnapshotOnConnecting) {
  make();
  hub.set_link({true, ""});
  publish("/nav", R"({"n":1})");
  publish("/event", R"({"n":2})");
  FeedLink link;
  const auto peer = open(link);
  ASSERT_EQ(link.all.size(), 1U);
  const Json snapshot = link.last();
  EXPECT_EQ(snapshot["kind"], "snapshot");
  EXPECT_EQ(snapshot["version"], "1");
  EXPECT_EQ(snapshot["link"]["connected"], true);
  EXPECT_EQ(snapshot["records"][0][2]["n"], 1);
  EXPECT_EQ(snapshot["events"][0]["n"], 2);
  EXPECT_EQ(snapshot["recording"], false);
  EXPECT_FALSE(snapshot.contains("play"));
}

TEST_F(PageFeedTest, AllViewersGetTheSameBytes) {
  make();
  FeedLink a, b;
  const auto first = open(a), second = open(b);
  publish("/imu", R"({"n":1})");
  publish("/imu", R"({"n":2})");
  run_until([&] { return a.all.size() >= 2; });
  ASSERT_EQ(b.all.size(), a.all.size());
  EXPECT_EQ(a.all.back().bytes, b.all.back().bytes);
  EXPECT_EQ(a.last()["records"], Json::parse(R"([["/imu",null,{"n":2}]])"));
}

TEST_F(PageFeedTest, ANewViewerCostsTheOthersNoEvent) {
  make();
  FeedLink a, b;
  const auto first = open(a);
  publish("/event", R"({"n":1})");
  const auto second = open(b);
  run_until([&] { return a.all.size() >= 2; });
  EXPECT_EQ(a.message(1)["records"][0][2]["n"], 1);
  EXPECT_EQ(b.message(0)["events"][0]["n"], 1);
  publish("/event", R"({"n":2})");
  run_until([&] { return b.all.size() >= 2; });
  // The event of the snapshot is not told again.
  EXPECT_EQ(b.message(1)["records"].size(), 1U);
  EXPECT_EQ(b.message(1)["records"][0][2]["n"], 2);
}

TEST_F(PageFeedTest, WorksOnlyWhileSomebodyWatches) {
  make();
  EXPECT_EQ(hub.demand().rate_Hz, 1);
  FeedLink link;
  {
    const auto peer = open(link);
    EXPECT_EQ(hub.demand().rate_Hz, 20);
    EXPECT_TRUE(hub.demand().all_topics);
  }
  EXPECT_EQ(hub.demand().rate_Hz, 1);
  publish("/imu", "{}");
  context.run();  // ends, because no timer is left
  EXPECT_EQ(link.all.size(), 1U);
  context.restart();
  FeedLink next;
  const auto peer = open(next);
  publish("/imu", R"({"n":3})");
  run_until([&] { return next.all.size() >= 2; });
  EXPECT_EQ(next.last()["records"][0][2]["n"], 3);
}

TEST_F(PageFeedTest, WhoStallsIsToldWhatWasMissedAndBeginsAnew) {
  auto wanted = settings();
  wanted.most_unread_bytes = 1000;
  make(wanted);
  FeedLink good, bad;
  const auto reader = open(good), staller = open(bad);
  bad.reads = false;
  const std::string long_message = fmt::format(R"({{"text":"{}"}})", std::string(400, 'x'));
  while (feed->counters().frames_dropped < 5) {
    publish("/imu", long_message);
    const auto before = good.all.size();
    run_until([&] { return good.all.size() > before; });
  }
  const std::size_t held = bad.all.size();
  EXPECT_LT(held, good.all.size());
  publish("/imu", R"({"n":"newest"})");
  bad.drain(*staller);
  // Nobody else is told of it, but for what was new anyway.
  ASSERT_EQ(bad.all.size(), held + 2);
  EXPECT_EQ(bad.message(held),
            Json::parse(fmt::format(R"({{"kind":"dropped","frames":{}}})", feed->counters().frames_dropped)));
  EXPECT_EQ(bad.message(held + 1)["kind"], "snapshot");
  EXPECT_EQ(bad.message(held + 1)["records"][0][2]["n"], "newest");
  EXPECT_EQ(good.last()["kind"], "frame");
  publish("/imu", R"({"n":2})");
  run_until([&] { return bad.all.size() > held + 2; });
  EXPECT_EQ(bad.last()["records"][0][2]["n"], 2);
}

TEST_F(PageFeedTest, ALargeSnapshotIsNoReasonToDropFrames) {
  auto wanted = settings();
  wanted.most_unread_bytes = 1000;
  make(wanted);
  for (int i = 0; i < 100; ++i)
    hub.publish({"/imu", fmt::format("d{}", i), {}, fmt::format(R"({{"text":"{}"}})", std::string(100, 'x'))});
  FeedLink slow;
  slow.reads = false;
  const auto peer = open(slow);
  publish("/nav", R"({"n":1})");
  run_until([&] { return slow.all.size() >= 2; });
  EXPECT_EQ(feed->counters().frames_dropped, 0U);
}

TEST_F(PageFeedTest, TellsAtOnceThatTheLinkIsLost) {
  make();
  hub.set_link({true, ""});
  FeedLink link;
  const auto peer = open(link);
  hub.set_link({false, "navcald \"went\""});
  EXPECT_EQ(link.last()["link"], Json::parse(R"({"connected":false,"problem":"navcald \"went\""})"));
}

TEST_F(PageFeedTest, AnotherPlaceInARecordingIsASnapshotForAll) {
  make();
  FeedLink link;
  const auto peer = open(link);
  publish("/imu", R"({"n":1})");
  hub.forget();
  publish("/nav", R"({"n":2})");
  run_until([&] { return link.all.size() >= 2; });
  EXPECT_EQ(link.last()["kind"], "snapshot");
  EXPECT_EQ(link.last()["records"].size(), 1U);
  EXPECT_EQ(link.last()["records"][0][2]["n"], 2);
}

TEST_F(PageFeedTest, SnapshotsForPollingAreMadeSeldom) {
  make();
  const auto first = feed->snapshot();
  for (int i = 0; i < 100; ++i) EXPECT_NE(feed->snapshot(), nullptr);
  // At most one in half a second, on however slow a machine.
  EXPECT_LT(feed->counters().snapshots, 50U);
  EXPECT_EQ(Json::parse(*first)["kind"], "snapshot");
}

TEST_F(PageFeedTest, OnlyARecordingTakesCommands) {
  make();
  FeedLink link;
  open(link)->on_text(R"({"seek":5})");  // nothing happens
  FakePlayer player;
  auto wanted = settings();
  wanted.player = &player;
  make(wanted);
  FeedLink other;
  const auto peer = open(other);
  peer->on_text(R"({"seek":5})");
  EXPECT_EQ(player.commands, std::vector<std::string>{R"({"seek":5})"});
  EXPECT_EQ(player.viewers, 1);
  EXPECT_EQ(other.last()["play"]["position_s"], 5);
  EXPECT_EQ(other.last()["recording"], true);
}

TEST_F(PageFeedTest, AViewerMayOutliveTheFeed) {
  make();
  FeedLink link;
  const auto peer = open(link);
  feed.reset();
  peer->on_text("{}");
  peer->on_drained();
  EXPECT_EQ(hub.demand().rate_Hz, 0);
}

TEST_F(PageFeedTest, AHeartbeatWhileNothingComes) {
  make();
  FeedLink link;
  const auto peer = open(link);
  run_until([&] { return link.all.size() >= 2; });
  EXPECT_EQ(link.last()["kind"], "frame");
  EXPECT_EQ(link.last()["records"], Json::array());
}

}  // namespace
}  // namespace navcal::web
