// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <memory>
#include <set>
#include <string>

#include "web/hub.h"
#include "web/page_state.h"
#include "web/peer.h"

namespace navcal::web {

/// Feeds the viewers of the page: twenty times a second one text with what is new, made once and shared by all.
/// Does nothing but keep the newest while nobody watches.
class PageFeed final : public Subscriber, public std::enable_shared_from_this<PageFeed> {
 public:
  struct Settings {
    std::string version;
    bool can_change = false;   ///< the server has a token
    bool has_track = false;    ///< a simulated track is served at track.json
    Player* player = nullptr;  ///< null: live
    std::chrono::milliseconds interval{50};
    /// A viewer that leaves more unread, beyond its snapshot, gets no frames until it has caught up.
    std::size_t most_unread_bytes = 256 << 10;
  };
  struct Counters {
    std::uint64_t frames = 0;          ///< made
    std::uint64_t frames_dropped = 0;  ///< over all viewers that did not read
    std::uint64_t snapshots = 0;
  };

  PageFeed(const boost::asio::any_io_executor& executor, Hub& hub, Settings settings);
  ~PageFeed() override;
  PageFeed(const PageFeed&) = delete;
  PageFeed& operator=(const PageFeed&) = delete;

  [[nodiscard]] static std::unique_ptr<Peer> make_viewer(const std::shared_ptr<PageFeed>& feed, PeerLink& link);
  /// Everything at once, as a viewer gets it on connecting; for those without WebSocket. They get one that is up
  /// to half a second old, however often they ask.
  [[nodiscard]] std::shared_ptr<const std::string> snapshot();

  void on_record(const Record& record) override;
  void on_link(const Link& link) override;
  void on_forget() override;

  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  class Viewer;
  void join(Viewer& viewer);
  void leave(Viewer& viewer);
  void welcome(Viewer& viewer);
  /// Everything, of this moment.
  [[nodiscard]] std::string whole() const;
  void schedule();
  void tick();
  void tell_news();
  void tell_all(std::string text);
  void append_state(std::string& out) const;

  Hub& hub_;
  Settings settings_;
  boost::asio::steady_timer timer_;
  PageState state_;
  std::set<Viewer*> viewers_;
  std::shared_ptr<const std::string> snapshot_;
  PageState::Time snapshot_made_;
  PageState::Time told_;  ///< when the viewers heard last
  bool ticking_ = false;
  bool forgot_ = false;  ///< viewers have to begin anew
  Counters counters_;
};

}  // namespace navcal::web
