// SPDX-License-Identifier: Apache-2.0
#include "web/viewer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/interruptible.h"
#include "record/json/json_members.h"
#include "record/json/mapping_json.h"
#include "record/log/log_reader.h"
#include "record/recording.h"
#include "web/access.h"
#include "web/listener.h"
#include "web/message_fields.h"
#include "web/page.h"
#include "web/server.h"

namespace navcal::web {
namespace {

constexpr std::size_t kProgressEvery = 4096;
/// The configuration is not shown, and has no place in time.
constexpr std::string_view kNotShown = "/config";

constexpr auto kPlayTick = std::chrono::milliseconds(20);
/// Messages in one tick from which on samples are left out: each is read from the file.
constexpr std::size_t kManyMessages = 400;
/// How many of the last messages of each topic a viewer needs: several devices and quantities share a topic.
constexpr std::size_t kLastOfTopic = 32;
constexpr std::size_t kLastEvents = 200;
constexpr std::size_t kTrackPoints = 1000;

bool is_kept_at_any_speed(std::string_view topic) {
  return topic == "/event" || topic == "/health" || topic == "/calib" || topic == "/time" || topic == "/nav";
}

}  // namespace

RecordedLog::RecordedLog(const std::filesystem::path& file, const Progress& progress) {
  if (!record::is_log(file)) throw record::BadRecording(file.string() + ": it is no log (.mcap)");
  read(file, progress);
  if (entries_.empty()) throw record::BadRecording(file.string() + ": the log has no messages to show");
  // Two ports may hand over in the other order than their bytes came.
  std::ranges::stable_sort(entries_, {}, &Entry::time_ns);
  file_ = base::Descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
}

void RecordedLog::read(const std::filesystem::path& file, const Progress& progress) {
  record::LogReader reader(record::open_file(file), file.string());
  std::map<std::uint16_t, std::uint16_t> topic_of_channel;
  std::size_t count = 0;
  while (const auto message = reader.next()) {
    if (++count % kProgressEvery == 0 && progress) progress(reader.progress());
    const auto& channel = reader.channels().at(message->channel);
    if (channel.raw || channel.topic == kNotShown) continue;
    auto known = topic_of_channel.find(message->channel);
    if (known == topic_of_channel.end()) {
      known = topic_of_channel.emplace(message->channel, static_cast<std::uint16_t>(topics_.size())).first;
      topics_.push_back(channel.topic);
    }
    entries_.push_back({static_cast<std::int64_t>(message->log_time_ns),
                        message->offset + record::kRecordHead + record::kMessageHead,
                        static_cast<std::uint32_t>(message->data.size()), known->second});
  }
  remarks_ = reader.remarks();
}

std::string_view RecordedLog::text(const Entry& entry) {
  text_.resize(entry.length);
  const ssize_t n = ::pread(file_.get(), text_.data(), entry.length, static_cast<off_t>(entry.offset));
  return n == static_cast<ssize_t>(entry.length) ? std::string_view(text_) : std::string_view();
}

RecordedSource::RecordedSource(const boost::asio::any_io_executor& executor, Hub& hub, RecordedLog log,
                               std::string name, double speed)
    : timer_(executor), hub_(hub), log_(std::move(log)), name_(std::move(name)), speed_(speed) {
  hub_.set_link({true, ""});
}

void RecordedSource::start() {
  ticked_ = std::chrono::steady_clock::now();
  schedule();
}

void RecordedSource::stop() {
  stopped_ = true;
  timer_.cancel();
}

void RecordedSource::schedule() {
  timer_.expires_after(kPlayTick);
  timer_.async_wait([weak = weak_from_this()](boost::system::error_code error) {
    const auto self = weak.lock();
    if (error || !self || self->stopped_) return;
    const auto now = std::chrono::steady_clock::now();
    self->advance(now - self->ticked_);
    self->ticked_ = now;
    self->schedule();
  });
}

void RecordedSource::advance(std::chrono::nanoseconds elapsed) {
  if (!playing_ || !has_viewer_) return;
  const double step_ns = static_cast<double>(elapsed.count()) * speed_;
  const auto end_ns = log_.entries().back().time_ns - log_.entries().front().time_ns;
  position_ns_ = step_ns > static_cast<double>(end_ns - position_ns_)
                     ? end_ns
                     : position_ns_ + static_cast<std::int64_t>(step_ns);
  publish_due();
  if (next_ >= log_.entries().size()) playing_ = false;
}

void RecordedSource::publish_due() {
  const auto& entries = log_.entries();
  const std::int64_t until_ns = entries.front().time_ns + position_ns_;
  const auto later = [](std::int64_t time_ns, const RecordedLog::Entry& entry) { return time_ns < entry.time_ns; };
  const auto from = entries.begin() + static_cast<std::ptrdiff_t>(next_);
  const auto end =
      static_cast<std::size_t>(std::upper_bound(from, entries.end(), until_ns, later) - entries.begin());
  const std::size_t every = (end - next_) / kManyMessages + 1;
  for (; next_ < end; ++next_) {
    if (every == 1 || next_ % every == 0 || is_kept_at_any_speed(log_.topics()[entries[next_].topic]))
      publish(entries[next_]);
  }
}

void RecordedSource::publish_before(std::size_t end) {
  const auto& entries = log_.entries();
  std::vector<std::vector<std::size_t>> of_topic(log_.topics().size());
  for (std::size_t i = 0; i < end; ++i) of_topic[entries[i].topic].push_back(i);
  std::vector<std::size_t> wanted;
  for (std::size_t topic = 0; topic < of_topic.size(); ++topic) {
    const auto& all = of_topic[topic];
    const std::string& name = log_.topics()[topic];
    const std::size_t last = std::min(all.size(), name == "/event" ? kLastEvents : kLastOfTopic);
    if (name == "/nav" || name == "/gps") {
      const std::size_t every = all.size() / kTrackPoints + 1;
      for (std::size_t i = 0; i + last < all.size(); i += every) wanted.push_back(all[i]);
    }
    wanted.insert(wanted.end(), all.end() - static_cast<std::ptrdiff_t>(last), all.end());
  }
  std::sort(wanted.begin(), wanted.end());
  for (const std::size_t i : wanted) publish(entries[i]);
}

void RecordedSource::publish(const RecordedLog::Entry& entry) {
  const std::string_view message = log_.text(entry);
  if (message.empty()) return;
  const std::string& topic = log_.topics()[entry.topic];
  const bool is_of_device = topic != "/event" && topic != "/health" && topic != "/calib" && topic != "/time";
  hub_.publish({topic, is_of_device ? member_text(message, "device") : std::string_view(),
                record::nanoseconds(member_text(message, "time")), message});
}

void RecordedSource::command(std::string_view json) {
  const auto request = nlohmann::json::parse(json, nullptr, false);
  if (!request.is_object()) return;
  if (request.contains("play") && request["play"].is_boolean()) set_playing(request["play"].get<bool>());
  if (request.contains("seek") && request["seek"].is_number()) seek(request["seek"].get<double>());
  if (request.contains("speed") && request["speed"].is_number()) set_speed(request["speed"].get<double>());
}

void RecordedSource::seek(double position_s) {
  position_ns_ = static_cast<std::int64_t>(std::clamp(position_s, 0.0, duration_s()) * 1e9);
  const auto& entries = log_.entries();
  const auto end = std::upper_bound(
      entries.begin(), entries.end(), entries.front().time_ns + position_ns_,
      [](std::int64_t time_ns, const RecordedLog::Entry& entry) { return time_ns < entry.time_ns; });
  hub_.forget();
  next_ = static_cast<std::size_t>(end - entries.begin());
  publish_before(next_);
}

void RecordedSource::set_speed(double speed) { speed_ = std::clamp(speed, kLeastSpeed, kGreatestSpeed); }

void RecordedSource::set_playing(bool playing) {
  // At the end there is nothing to play but the whole again.
  if (playing && next_ >= log_.entries().size()) seek(0);
  playing_ = playing;
}

double RecordedSource::position_s() const { return static_cast<double>(position_ns_) * 1e-9; }

double RecordedSource::duration_s() const {
  return static_cast<double>(log_.entries().back().time_ns - log_.entries().front().time_ns) * 1e-9;
}

void RecordedSource::append_state(std::string& out) const {
  fmt::format_to(std::back_inserter(out),
                 R"({{"file":{},"playing":{},"speed":{},"position_s":{:.3f},"duration_s":{:.3f},"begin":{:.3f}}})",
                 record::json_text(nlohmann::json(name_)), playing_, speed_, position_s(), duration_s(),
                 static_cast<double>(log_.entries().front().time_ns) * 1e-9);
}

void view_recording(const ViewerSettings& settings) {
  boost::asio::io_context context(1);
  // From here on a signal no longer ends the program: what the caller has made for this has to be removed.
  boost::asio::signal_set signals(context);
  for (const int signal : base::ending_signals()) signals.add(signal);
  RecordedLog log(settings.log, settings.progress);
  for (const std::string& remark : log.remarks()) settings.remark(remark);
  const Access access;
  Hub hub;
  Site site;
  const auto source =
      std::make_shared<RecordedSource>(context.get_executor(), hub, std::move(log), settings.name, settings.speed);
  PageFeed::Settings page_settings{.version = settings.version, .player = source.get()};
  const auto page = add_page(site, context.get_executor(), hub, std::move(page_settings));
  const auto server =
      std::make_shared<Server>(listen(context.get_executor(), "127.0.0.1", settings.port), site, access);
  signals.async_wait([&](boost::system::error_code error, int) {
    if (error) return;
    source->stop();
    server->stop();
    context.stop();
  });
  source->start();
  server->start();
  settings.ready(fmt::format("http://127.0.0.1:{}/", server->port()));
  context.run();
}

}  // namespace navcal::web
