// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

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

}  // namespace navcal::web
