// SPDX-License-Identifier: Apache-2.0
#include "web/page_feed.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

namespace navcal::web {
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

std::string json_string(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string link_json(const Link& link) {
  return fmt::format(R"({{"connected":{},"problem":{}}})", link.connected, json_string(link.problem));
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
  std::string text = fmt::format(
      R"({{"kind":"snapshot","version":{},"can_change":{},"has_track":{},"recording":{},)",
      json_string(settings_.version), settings_.can_change, settings_.has_track, settings_.player != nullptr);
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
