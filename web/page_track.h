// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

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

}  // namespace navcal::web
