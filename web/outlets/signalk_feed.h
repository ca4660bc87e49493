// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "web/hub.h"
#include "web/outlets/signalk_model.h"
#include "web/outlets/signalk_subscription.h"
#include "web/peer.h"

namespace navcal::web {

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

}  // namespace navcal::web
