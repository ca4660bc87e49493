// SPDX-License-Identifier: Apache-2.0
#include "web/page_track.h"

#include <fmt/format.h>

#include <iterator>

namespace navcal::web {

bool PageTrack::wants(double time_s) const {
  if (points_.empty()) return true;
  const double since_s = time_s - points_.back().time_s;
  // Times of a daemon that starts again without UTC go backwards.
  return since_s >= spacing_s_ || since_s < -kFirstSpacing_s;
}

void PageTrack::add(const Point& point) {
  if (!wants(point.time_s)) return;
  if (!points_.empty() && point.time_s < points_.back().time_s) clear();
  if (points_.size() >= kMaxPoints) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points_.size(); i += 2) points_[kept++] = points_[i];
    points_.resize(kept);
    spacing_s_ *= 2;
  }
  points_.push_back(point);
}

void PageTrack::clear() {
  points_.clear();
  spacing_s_ = kFirstSpacing_s;
}

void PageTrack::append_json(std::string& out) const {
  const auto append_std = [&out](double std_m) {
    if (std_m < 0) {
      out += ",null";
    } else {
      fmt::format_to(std::back_inserter(out), ",{:.2f}", std_m);
    }
  };
  out += '[';
  for (const Point& point : points_) {
    if (out.back() != '[') out += ',';
    fmt::format_to(std::back_inserter(out), "[{:.2f},{:.7f},{:.7f}", point.time_s, point.latitude_deg,
                   point.longitude_deg);
    append_std(point.north_std_m);
    append_std(point.east_std_m);
    out += ']';
  }
  out += ']';
}

}  // namespace navcal::web
