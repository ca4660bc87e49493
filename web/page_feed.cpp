// SPDX-License-Identifier: Apache-2.0
#include "web/page_feed.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "record/json/json_members.h"
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

namespace {

/// A viewer that hears nothing for a few times this long knows that the connection is dead.
constexpr auto kHeartbeat = std::chrono::seconds(1);
constexpr auto kSnapshotLife = std::chrono::milliseconds(500);
constexpr double kWatchedRate_Hz = 20;
/// While nobody watches, the newest values and the track are kept for the next viewer.
constexpr double kUnwatchedRate_Hz = 1;

Demand demand_at(double rate_Hz) {
  Demand demand;
  demand.all_topics = true;
  demand.rate_Hz = rate_Hz;
  return demand;
}

std::string link_json(const Link& link) {
  return fmt::format(R"({{"connected":{},"problem":{}}})", link.connected,
                     record::json_text(nlohmann::json(link.problem)));
}

}  // namespace

/// One browser.
class PageFeed::Viewer final : public Peer {
 public:
  Viewer(std::weak_ptr<PageFeed> feed, PeerLink& link) : feed_(std::move(feed)), link_(link) {}
  ~Viewer() override {
    if (const auto feed = feed_.lock()) feed->leave(*this);
  }
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  void on_open() override {
    if (const auto feed = feed_.lock()) feed->join(*this);
  }
  void on_text(std::string_view text) override {
    const auto feed = feed_.lock();
    if (feed && feed->settings_.player != nullptr) feed->settings_.player->command(text);
  }
  void on_drained() override {
    const auto feed = feed_.lock();
    if (missed_ > 0 && feed) feed->welcome(*this);
  }

  /// False when the frame was dropped.
  bool send(const Payload& payload, std::size_t most_unread_bytes) {
    const bool is_behind = missed_ > 0 || link_.queued_bytes() > most_unread_bytes + snapshot_bytes_;
    if (!is_behind && link_.send(payload)) return true;
    ++missed_;
    return false;
  }
  void begin_anew(Payload snapshot) {
    if (missed_ > 0) link_.send_text(fmt::format(R"({{"kind":"dropped","frames":{}}})", missed_));
    missed_ = 0;
    snapshot_bytes_ = snapshot.bytes->size();
    if (!link_.send(std::move(snapshot))) ++missed_;
  }

 private:
  std::weak_ptr<PageFeed> feed_;
  PeerLink& link_;
  std::uint64_t missed_ = 0;  ///< frames since the viewer stopped to read
  std::size_t snapshot_bytes_ = 0;
};

PageFeed::PageFeed(const boost::asio::any_io_executor& executor, Hub& hub, Settings settings)
    : hub_(hub), settings_(std::move(settings)), timer_(executor) {
  hub_.add(*this, demand_at(kUnwatchedRate_Hz));
}

PageFeed::~PageFeed() { hub_.remove(*this); }

std::unique_ptr<Peer> PageFeed::make_viewer(const std::shared_ptr<PageFeed>& feed, PeerLink& link) {
  return std::make_unique<Viewer>(feed, link);
}

void PageFeed::join(Viewer& viewer) {
  welcome(viewer);
  viewers_.insert(&viewer);
  if (settings_.player != nullptr) settings_.player->viewer_came();
  if (viewers_.size() > 1) return;
  hub_.change(*this, demand_at(kWatchedRate_Hz));
  schedule();
}

void PageFeed::leave(Viewer& viewer) {
  if (viewers_.erase(&viewer) == 0 || !viewers_.empty()) return;
  hub_.change(*this, demand_at(kUnwatchedRate_Hz));
}

/// The others get first what is new: the snapshot contains it, and the next frame must not repeat it.
void PageFeed::welcome(Viewer& viewer) {
  if (state_.has_news()) tell_news();
  viewer.begin_anew({std::make_shared<const std::string>(whole()), false});
  ++counters_.snapshots;
}

void PageFeed::append_state(std::string& out) const {
  fmt::format_to(std::back_inserter(out), R"("link":{})", link_json(hub_.link()));
  if (settings_.player == nullptr) return;
  out += R"(,"play":)";
  settings_.player->append_state(out);
}

std::string PageFeed::whole() const {
  std::string text =
      fmt::format(R"({{"kind":"snapshot","version":{},"can_change":{},"has_track":{},"recording":{},)",
                  record::json_text(nlohmann::json(settings_.version)), settings_.can_change, settings_.has_track,
                  settings_.player != nullptr);
  append_state(text);
  text += ',';
  state_.append_all(text, std::chrono::steady_clock::now());
  return text + '}';
}

std::shared_ptr<const std::string> PageFeed::snapshot() {
  const auto now = std::chrono::steady_clock::now();
  if (!snapshot_ || now - snapshot_made_ >= kSnapshotLife) {
    snapshot_ = std::make_shared<const std::string>(whole());
    snapshot_made_ = now;
    ++counters_.snapshots;
  }
  return snapshot_;
}

void PageFeed::on_record(const Record& record) { state_.take(record, std::chrono::steady_clock::now()); }

void PageFeed::on_link(const Link&) {
  snapshot_.reset();
  std::string text = R"({"kind":"frame",)";
  append_state(text);
  tell_all(text + R"(,"records":[]})");
}

void PageFeed::on_forget() {
  state_.clear();
  snapshot_.reset();
  forgot_ = true;
}

void PageFeed::schedule() {
  if (ticking_) return;
  ticking_ = true;
  timer_.expires_after(settings_.interval);
  timer_.async_wait([weak = weak_from_this()](boost::system::error_code error) {
    const auto self = weak.lock();
    if (error || !self) return;
    self->ticking_ = false;
    self->tick();
  });
}

void PageFeed::tick() {
  if (viewers_.empty()) return;
  schedule();
  if (forgot_) {
    forgot_ = false;
    state_.forget_news();
    const Payload payload{std::make_shared<const std::string>(whole()), false};
    for (Viewer* viewer : std::set(viewers_)) viewer->begin_anew(payload);
    return;
  }
  if (state_.has_news() || std::chrono::steady_clock::now() - told_ >= kHeartbeat) tell_news();
}

void PageFeed::tell_news() {
  std::string text = R"({"kind":"frame",)";
  append_state(text);
  text += R"(,"records":)";
  state_.append_news(text);
  text += '}';
  ++counters_.frames;
  tell_all(std::move(text));
}

void PageFeed::tell_all(std::string text) {
  told_ = std::chrono::steady_clock::now();
  const Payload payload{std::make_shared<const std::string>(std::move(text)), false};
  for (Viewer* viewer : std::set(viewers_)) {
    if (!viewer->send(payload, settings_.most_unread_bytes)) ++counters_.frames_dropped;
  }
}

}  // namespace navcal::web
