// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "web/hub.h"
#include "web/outlets/pacer.h"
#include "web/outlets/signalk_model.h"
#include "web/peer.h"
#include "web/site.h"

namespace navcal::web {

/// True when `path` is what `pattern` says, in which * stands for any characters, also dots and none.
[[nodiscard]] bool matches_pattern(std::string_view pattern, std::string_view path);

/// What one Signal K client wants, by its messages `subscribe` and `unsubscribe`.
class SignalKSubscriptions {
 public:
  using Clock = Pacer::Clock;
  /// No path is sent more often.
  static constexpr std::chrono::milliseconds kMinPeriod{100};
  static constexpr std::size_t kMaxPatterns = 64;

  /// `self`: the context of this vessel, "vessels.urn:...".
  explicit SignalKSubscriptions(std::string self) : self_(std::move(self)) {}

  /// What a message of the client has changed or asks for.
  struct Outcome {
    bool has_new = false;              ///< there are new subscriptions: their newest values are due
    std::optional<std::string> reply;  ///< to a request that this server does not serve
  };
  /// Any text; what is not understood changes nothing.
  [[nodiscard]] Outcome take(std::string_view message);

  void subscribe(std::string pattern, Clock::duration period);
  /// True when the path is wanted and its time has come.
  [[nodiscard]] bool is_due(std::string_view path, Clock::time_point now);
  [[nodiscard]] bool is_wanted(std::string_view path) const { return period_of(path).has_value(); }
  [[nodiscard]] std::size_t patterns() const { return wanted_.size(); }

 private:
  struct Wanted {
    std::string pattern;
    Clock::duration period;
  };
  [[nodiscard]] bool is_self(const nlohmann::json& message) const;
  [[nodiscard]] bool take_subscribe(const nlohmann::json& list);
  void take_unsubscribe(const nlohmann::json& list);
  [[nodiscard]] std::optional<Clock::duration> period_of(std::string_view path) const;

  std::string self_;
  std::vector<Wanted> wanted_;
  std::map<std::string, Pacer, std::less<>> pacers_;  ///< by path
};

class SignalKFeed;

/// One client of the stream.
class SignalKPeer final : public Peer {
 public:
  SignalKPeer(std::shared_ptr<SignalKFeed> feed, PeerLink& link, std::string_view target);
  ~SignalKPeer() override;
  SignalKPeer(const SignalKPeer&) = delete;
  SignalKPeer& operator=(const SignalKPeer&) = delete;

  void on_open() override;
  void on_text(std::string_view text) override;
  /// Sends what the client wants of these, in one delta.
  void offer(const std::vector<SignalKUpdate>& updates);

 private:
  std::shared_ptr<SignalKFeed> feed_;
  PeerLink& link_;
  SignalKSubscriptions subscriptions_;
  std::set<std::string, std::less<>> described_;  ///< paths whose meta the client has
};

/// Reads records while there are clients, and hands each update to all of them.
class SignalKFeed final : public Subscriber, public std::enable_shared_from_this<SignalKFeed> {
 public:
  SignalKFeed(Hub& hub, std::string self, std::string version);

  void add(SignalKPeer& peer);
  void remove(SignalKPeer& peer);
  /// From now on there is no hub.
  void detach();

  [[nodiscard]] const std::string& self() const { return self_; }
  [[nodiscard]] std::string hello() const;
  [[nodiscard]] std::vector<SignalKUpdate> newest() const { return model_.newest(); }

  void on_record(const Record& record) override;
  void on_link(const Link& link) override;

 private:
  void publish(SignalKUpdate update);

  Hub* hub_;
  std::string self_, version_;
  SignalKModel model_;
  std::set<SignalKPeer*> peers_;
};

/// Serves Signal K (docs/wires.md): discovery at /signalk, deltas at /signalk/v1/stream, and the context of this
/// vessel at /signalk/v1/api/self. While nobody is connected, nothing is asked of navcald for it. `vessel`: the
/// part after "vessels." of the context, such as "urn:mrn:imo:mmsi:230012345". The feed is to be detached before
/// the hub goes; clients may outlive that.
[[nodiscard]] std::shared_ptr<SignalKFeed> add_signalk(Hub& hub, Site& site, const std::string& vessel,
                                                       const std::string& version);

/// A name that stays the same on this machine: derived from /etc/machine-id, which it does not disclose. Random
/// where there is no such file.
[[nodiscard]] std::string default_vessel();
/// Why `vessel` is no name of a vessel in Signal K; empty when it is one.
[[nodiscard]] std::string problem_of_vessel(const std::string& vessel);
/// The answer to `GET /signalk`. `host`: the Host header of the request.
[[nodiscard]] std::string signalk_discovery(std::string_view host, std::string_view version);

}  // namespace navcal::web
