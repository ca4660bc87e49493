// SPDX-License-Identifier: Apache-2.0
#include "web/page_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "web/message_fields.h"

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

namespace {

/// Members beside topic and device that tell apart messages of which each stands for itself: the parts of a long
/// report, and the quantities of a mission sensor.
constexpr std::string_view kDistinguishing[] = {"part", "quantity"};

/// A row of `[[topic,device,message],...]` without its closing bracket. Names need no escapes.
void append_row(std::string& out, std::string_view topic, std::string_view device, std::string_view message) {
  if (out.back() != '[') out += ',';
  out.append("[\"").append(topic);
  if (device.empty()) {
    out += "\",null,";
  } else {
    out.append("\",\"").append(device).append("\",");
  }
  out += message;
}

}  // namespace

void PageState::take(const Record& record, Time now) {
  // The state of the calibrators (base64, for replay) is nothing to show; its change is an event as well.
  if (record.message.starts_with(R"({"class":"CALIBRATION")")) return;
  if (!nlohmann::json::accept(record.message)) {
    ++left_out_;
    return;
  }
  if (record.topic == "/event") return take_event(record.message);
  if (record.topic == "/nav" || record.topic == "/gps") take_place(record);
  key_.assign(record.topic).append(1, ' ').append(record.device);
  for (const std::string_view member : kDistinguishing) {
    if (record.topic == "/sensor" || member == "part")
      key_.append(1, ' ').append(member_text(record.message, member));
  }
  auto found = newest_.find(key_);
  if (found == newest_.end()) {
    if (newest_.size() >= kMaxRecords) {
      ++left_out_;
      return;
    }
    found =
        newest_.emplace(key_, Kept{std::string(record.topic), std::string(record.device), {}, now, false}).first;
  }
  Kept& kept = found->second;
  kept.message.assign(record.message);
  kept.taken = now;
  if (!kept.is_new) changed_.push_back(&kept);
  kept.is_new = true;
}

void PageState::clear() {
  changed_.clear();
  new_events_.clear();
  newest_.clear();
  events_.clear();
  track_.clear();
  fixes_.clear();
}

void PageState::take_event(std::string_view message) {
  if (events_.size() >= kMaxEvents) events_.pop_front();
  events_.emplace_back(message);
  // Without viewers nobody takes them.
  if (new_events_.size() < kMaxEvents) new_events_.emplace_back(message);
}

void PageState::take_place(const Record& record) {
  if (!record.utc_ns) return;
  const double time_s = static_cast<double>(*record.utc_ns) * 1e-9;
  const bool is_fix = record.topic == "/gps";
  PageTrack& track = is_fix ? fixes_ : track_;
  if (!track.wants(time_s)) return;
  const auto latitude = member_number(record.message, "lat"), longitude = member_number(record.message, "lon");
  if (!latitude || !longitude) return;
  PageTrack::Point point{time_s, *latitude, *longitude, -1, -1};
  if (is_fix) {
    point.north_std_m = point.east_std_m = member_number(record.message, "position_std_m").value_or(-1);
  } else {
    point.north_std_m = member_number(record.message, "north_std_m").value_or(-1);
    point.east_std_m = member_number(record.message, "east_std_m").value_or(-1);
  }
  track.add(point);
}

void PageState::append_news(std::string& out) {
  out += '[';
  for (const std::string& event : new_events_) {
    append_row(out, "/event", "", event);
    out += ']';
  }
  for (Kept* kept : changed_) {
    append_row(out, kept->topic, kept->device, kept->message);
    out += ']';
  }
  out += ']';
  forget_news();
}

void PageState::forget_news() {
  for (Kept* kept : changed_) kept->is_new = false;
  changed_.clear();
  new_events_.clear();
}

void PageState::append_all(std::string& out, Time now) const {
  out += R"("records":[)";
  for (const auto& [key, kept] : newest_) {
    append_row(out, kept.topic, kept.device, kept.message);
    const double age_s = std::chrono::duration<double>(now - kept.taken).count();
    fmt::format_to(std::back_inserter(out), ",{:.2f}]", std::max(0.0, age_s));
  }
  out += R"(],"events":[)";
  for (const std::string& event : events_) {
    if (out.back() != '[') out += ',';
    out += event;
  }
  out += R"(],"track":)";
  track_.append_json(out);
  out += R"(,"fixes":)";
  fixes_.append_json(out);
}

}  // namespace navcal::web
