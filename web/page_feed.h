// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "web/hub.h"
#include "web/peer.h"
#include "web/record.h"

namespace navcal::web {

/// Places in the order of their times, of bounded number: when there is no room, every second one is left out, and
/// from then on they lie twice as far apart in time.
class PageTrack {
 public:
  struct Point {
    double time_s = 0;  ///< UTC
    double latitude_deg = 0, longitude_deg = 0;
    double north_std_m = -1, east_std_m = -1;  ///< negative: unknown
  };
  static constexpr std::size_t kMaxPoints = 2000;
  static constexpr double kFirstSpacing_s = 1;

  /// Whether a point of this time would be taken. One that is earlier than the last begins a new track.
  [[nodiscard]] bool wants(double time_s) const;
  void add(const Point& point);
  void clear();
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  /// `[[time,lat,lon,north_std,east_std],...]`, null for an unknown error.
  void append_json(std::string& out) const;

 private:
  std::vector<Point> points_;
  double spacing_s_ = kFirstSpacing_s;
};

/// What the page shows: the newest record of each topic and device, the last events, the track; and what of it is
/// new since the last frame. No clock of its own, no ports.
class PageState {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::size_t kMaxEvents = 200;
  /// Bounds what one peer that names ever new devices can cost.
  static constexpr std::size_t kMaxRecords = 512;

  /// A message that is not valid JSON in UTF-8 is left out, because it would spoil the frame of all viewers.
  void take(const Record& record, Time now);
  void clear();

  [[nodiscard]] bool has_news() const { return !changed_.empty() || !new_events_.empty(); }
  /// Appends the records that are new since the last call as `[[topic,device,message],...]`: the newest of each
  /// topic and device, and all events.
  void append_news(std::string& out);
  void forget_news();
  /// Appends the members `records` (`[[topic,device,message,age_s],...]`), `events`, `track` and `fixes`.
  void append_all(std::string& out, Time now) const;

  [[nodiscard]] std::uint64_t left_out() const { return left_out_; }

 private:
  struct Kept {
    std::string topic, device, message;
    Time taken;
    bool is_new = false;
  };
  void take_event(std::string_view message);
  void take_place(const Record& record);

  std::map<std::string, Kept, std::less<>> newest_;
  std::vector<Kept*> changed_;
  std::deque<std::string> events_;
  std::vector<std::string> new_events_;
  PageTrack track_, fixes_;
  std::string key_;
  std::uint64_t left_out_ = 0;
};

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
