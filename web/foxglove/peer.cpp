// SPDX-License-Identifier: Apache-2.0
#include "web/foxglove/peer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "base/utc_text.h"
#include "web/foxglove/channels.h"
#include "web/foxglove/protocol.h"

namespace navcal::web::foxglove {
namespace {

constexpr std::int64_t kBetweenReports_ns = 1'000'000'000;

/// A record that is older than the newest by more than this is not late: the clock stepped, or another part of a
/// recording is played.
constexpr std::int64_t kStep_ns = 10'000'000'000;

/// What all viewers share.
struct Shared {
  Hub& hub;
  std::string version;
  std::string session;
  Clock clock;
  Channels channels;
};

class Viewer final : public Peer, public Subscriber {
 public:
  Viewer(std::shared_ptr<Shared> shared, PeerLink& link) : shared_(std::move(shared)), link_(link) {}
  ~Viewer() override { shared_->hub.remove(*this); }
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  void on_open() override {
    shared_->hub.add(*this, {});
    link_.send_text(server_info("navcal", shared_->version, shared_->session));
    shared_->hub.repeat_newest([this](const Record& record) {
      ros_channels_ = shared_->channels.learn_ros(record, shared_->hub.published());
    });
    tell_channels();
    const Link& source = shared_->hub.link();
    if (!source.connected) tell(StatusLevel::warning, source.problem);
    if (told_.empty()) link_.send_text(advertise({}));
  }
  void on_text(std::string_view text) override {
    ClientMessage message = read_client_message(text);
    if (!message.subscribe.empty()) subscribe(message);
    if (!message.unsubscribe.empty()) unsubscribe(message);
    if (message.problems == 0) return;
    // One answer to one message, so that a client cannot make the server say more than it says itself.
    if (message.problems > 1) message.problem += fmt::format(", and {} other problems", message.problems - 1);
    tell(StatusLevel::error, message.problem);
  }
  void on_binary(std::string_view /*bytes*/) override {
    tell(StatusLevel::error, "this server only shows: it takes no binary messages");
  }
  void on_drained() override {
    if (channels_due_) tell_channels();
    const auto report = drops_.report(shared_->clock());
    if (report) link_.send_text(status(StatusLevel::warning, *report, "dropped"));
  }
  void on_record(const Record& record) override {
    const std::size_t channels = shared_->channels.learn_ros(record, shared_->hub.published());
    if (channels != std::exchange(ros_channels_, channels)) tell_channels();
    deliver(record, nullptr);
  }
  void on_link(const Link& state) override {
    if (!state.problem.empty()) tell(StatusLevel::warning, state.problem);
    tell_channels();
  }
  void on_topics() override { tell_channels(); }

 private:
  void tell(StatusLevel level, std::string_view message) { link_.send_text(status(level, message)); }
  /// Tells the client what has changed since it was last told. When its queue is full, this is done once it has
  /// read.
  void tell_channels() {
    const Hub& hub = shared_->hub;
    std::vector<const Channel*> available;
    if (hub.link().connected) available = shared_->channels.available(hub.topics());
    channels_due_ = !tell_gone(available) || !tell_new(available);
  }
  [[nodiscard]] bool tell_gone(const std::vector<const Channel*>& available) {
    std::vector<std::uint32_t> gone;
    for (const auto& [id, channel] : told_) {
      if (std::find(available.begin(), available.end(), channel) == available.end()) gone.push_back(id);
    }
    if (gone.empty()) return true;
    if (!link_.send_text(unadvertise(gone))) return false;
    ended_.clear();
    for (const std::uint32_t id : gone) {
      const Channel* channel = told_[id];
      told_.erase(id);
      const auto found = std::find_if(subscriptions_.begin(), subscriptions_.end(),
                                      [channel](const auto& entry) { return entry.second == channel; });
      if (found == subscriptions_.end()) continue;
      ended_.insert(found->first);
      subscriptions_.erase(found);
    }
    demand();
    return true;
  }
  [[nodiscard]] bool tell_new(const std::vector<const Channel*>& available) {
    std::vector<const Channel*> added;
    std::vector<std::string_view> announcements;
    for (const Channel* channel : available) {
      if (told_.contains(channel->id)) continue;
      added.push_back(channel);
      announcements.emplace_back(channel->announcement);
    }
    if (added.empty()) return true;
    if (!link_.send_text(advertise(announcements))) return false;
    for (const Channel* channel : added) told_[channel->id] = channel;
    return true;
  }
  void subscribe(ClientMessage& message) {
    std::set<const Channel*> added;
    for (const Subscription& wanted : message.subscribe) {
      const auto channel = told_.find(wanted.channel);
      if (channel == told_.end()) {
        note_problem(message, fmt::format("there is no channel {}", wanted.channel));
        continue;
      }
      const bool is_twice = std::any_of(subscriptions_.begin(), subscriptions_.end(),
                                        [&](const auto& entry) { return entry.second == channel->second; });
      if (is_twice) {
        note_problem(message, fmt::format("channel {} is subscribed already", wanted.channel));
      } else if (!subscriptions_.emplace(wanted.id, channel->second).second) {
        note_problem(message, fmt::format("the subscription id {} is in use", wanted.id));
      } else {
        ended_.erase(wanted.id);
        added.insert(channel->second);
      }
    }
    if (added.empty()) return;
    demand();
    repeat_newest(added);
  }
  void unsubscribe(ClientMessage& message) {
    bool changed = false;
    for (const std::uint32_t id : message.unsubscribe) {
      const bool is_known = subscriptions_.erase(id) > 0;
      changed = changed || is_known;
      if (!is_known && ended_.erase(id) == 0)
        note_problem(message, fmt::format("there is no subscription {}", id));
    }
    if (changed) demand();
  }
  void demand() {
    Demand needed;
    by_topic_.clear();
    for (const auto& [id, channel] : subscriptions_) {
      for (const std::string& topic : channel->sources) {
        needed.topics.insert(topic);
        by_topic_.emplace(topic, std::pair(id, channel));
      }
    }
    if (!needed.topics.empty()) needed.rate_Hz = std::nullopt;
    shared_->hub.change(*this, std::move(needed));
  }
  /// The newest messages of channels just subscribed. The time is told before: it is that of the newest record of
  /// all, because an old message must not turn the client's clock back.
  void repeat_newest(const std::set<const Channel*>& channels) {
    shared_->hub.repeat_newest([this](const Record& record) {
      if (record.utc_ns && *record.utc_ns > time_ns_) advance_time(*record.utc_ns);
    });
    shared_->hub.repeat_newest([&](const Record& record) { deliver(record, &channels); });
  }
  void deliver(const Record& record, const std::set<const Channel*>* only) {
    const auto [begin, end] = by_topic_.equal_range(record.topic);
    if (begin == end) return;
    const std::int64_t time_ns = time_of(record);
    for (auto entry = begin; entry != end; ++entry) {
      const auto& [id, channel] = entry->second;
      if (only != nullptr && !only->contains(channel)) continue;
      const auto payload = shared_->channels.message(*channel, record, time_ns, shared_->hub.published());
      if (!payload) continue;
      if (only == nullptr) advance_time(time_ns);
      Payload bytes{
          std::make_shared<const std::string>(message_data(id, static_cast<std::uint64_t>(time_ns), *payload)),
          true};
      if (!link_.send(std::move(bytes))) drops_.dropped(shared_->clock());
    }
  }
  /// Viewers take the last time that they were told as the time of each message.
  void advance_time(std::int64_t time_ns) {
    if (time_ns <= time_ns_ && time_ns_ - time_ns < kStep_ns) return;
    Payload bytes{std::make_shared<const std::string>(foxglove::time(static_cast<std::uint64_t>(time_ns))), true};
    if (link_.send(std::move(bytes))) time_ns_ = time_ns;
  }
  [[nodiscard]] std::int64_t time_of(const Record& record) const {
    if (record.utc_ns) return *record.utc_ns;
    return time_ns_ != 0 ? time_ns_ : shared_->clock();
  }

  std::shared_ptr<Shared> shared_;
  PeerLink& link_;
  std::size_t ros_channels_ = 0;
  std::map<std::uint32_t, const Channel*> told_;           ///< channels that the client knows of, by id
  std::map<std::uint32_t, const Channel*> subscriptions_;  ///< by the client's id
  std::set<std::uint32_t> ended_;  ///< subscriptions that ended with their channels: the client may end them, too
  std::multimap<std::string, std::pair<std::uint32_t, const Channel*>, std::less<>> by_topic_;
  std::int64_t time_ns_ = 0;  ///< the newest that the client was told; 0: none
  DropCount drops_;
  bool channels_due_ = false;  ///< the client's queue was full when it should have been told of channels
};

}  // namespace

void DropCount::dropped(std::int64_t now_ns) {
  if (since_report_++ == 0) first_ns_ = now_ns;
  last_ns_ = now_ns;
  ++total_;
}

std::optional<std::string> DropCount::report(std::int64_t now_ns) {
  if (since_report_ == 0) return std::nullopt;
  // A clock that stepped back must not keep the report back.
  if (reported_ns_ && now_ns >= *reported_ns_ && now_ns - *reported_ns_ < kBetweenReports_ns) return std::nullopt;
  std::string words = fmt::format(
      "{} messages were dropped from {} to {}, because this program did not read them in time; {} since it "
      "connected",
      since_report_, base::utc_text(first_ns_), base::utc_text(last_ns_), total_);
  since_report_ = 0;
  reported_ns_ = now_ns;
  return words;
}

std::int64_t system_time_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

WebSocketEndpoint endpoint(Hub& hub, std::string version, Clock clock) {
  std::random_device random;
  std::string session = fmt::format("{:08x}{:08x}", random(), random());
  const auto shared =
      std::make_shared<Shared>(Shared{hub, std::move(version), std::move(session), std::move(clock), {}});
  return {.path = "/",
          .subprotocols = {"foxglove.websocket.v1", "foxglove.sdk.v1"},
          .origins = {"https://app.foxglove.dev"},  // Foxglove itself
          .make_peer = [shared](PeerLink& link, std::string_view) -> std::unique_ptr<Peer> {
            return std::make_unique<Viewer>(shared, link);
          }};
}

}  // namespace navcal::web::foxglove
