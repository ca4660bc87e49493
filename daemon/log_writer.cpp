// SPDX-License-Identifier: Apache-2.0
#include "daemon/log_writer.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/load.h"
#include "daemon/json_text.h"
#include "record/json/json_object.h"

namespace navcal::daemon {
namespace {

constexpr double kNs = 1e9;

std::chrono::nanoseconds nanoseconds(double seconds) {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * kNs));
}

record::LogFolder take_folder(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw std::system_error(error, fmt::format("log folder {}: cannot be made", directory.string()));
  return record::LogFolder(record::real_disk(), directory);
}

}  // namespace

std::string words_for_choice(const std::vector<std::string>& leave_out) {
  return leave_out.empty() ? "nothing" : fmt::format("{}", fmt::join(leave_out, ", "));
}

LogWriter::LogWriter(const config::Settings& settings, std::int64_t now_ns, const pipeline::UtcMapping& mapping)
    : settings_(settings.log), encoder_(settings, config::to_toml(settings)) {
  mapping_ = mapping;
  for (const auto& port : settings.ports) ports_.push_back(port.name);
  leave_out(settings_.leave_out);
  if (!settings_.enabled) return;
  DiskThread::Options options;
  options.sync_interval = nanoseconds(settings_.sync_interval_s);
  options.queue_bytes = settings_.queue_bytes;
  options.free_floor_bytes = settings_.free_floor_bytes;
  disk_ = std::make_unique<DiskThread>([folder = settings_.directory] { return take_folder(folder); }, options);
  begin_file(now_ns);
}

void LogWriter::begin_file(std::int64_t now_ns) {
  file_begun_ns_ = now_ns;
  const std::string calibration = calibration_ ? calibration_(now_ns) : std::string();
  disk_->next_file(mapping_.to_utc(now_ns), [&](std::string& out) {
    encoder_.begin(out, now_ns, mapping_);
    if (!calibration.empty()) encoder_.calib(out, now_ns, calibration);
    if (!settings_.leave_out.empty())
      encoder_.event(out, now_ns, "info", "log.left_out", "", words_for_choice(settings_.leave_out));
  });
}

template <class Encode>
void LogWriter::append(Encode&& encode) {
  if (disk_ && !stopped_) disk_->append(std::forward<Encode>(encode));
}

void LogWriter::raw(std::uint16_t port, record::Direction direction, std::int64_t time_ns,
                    protocols::Bytes bytes) {
  if (raw_left_out_[port]) return;
  append([&](std::string& out) { encoder_.raw(out, port, direction, time_ns, bytes); });
}

void LogWriter::publish(const record::MessageHead& head, const record::AppendJson& append) {
  RecordKey key{head.topic, std::nullopt, head.repeats};
  const auto found = std::find(ports_.begin(), ports_.end(), head.device);
  // The estimate's virtual device follows those of the ports (navigation_device).
  if (found != ports_.end() || head.device == pipeline::kNavigationDevice)
    key.port = static_cast<std::uint16_t>(found - ports_.begin());
  if (server_ == nullptr || !server_->watched(key)) return;
  const std::int64_t utc_ns = head.utc_ns.value_or(mapping_.to_utc(head.validity_ns));
  line_ = R"({"class":"RECORD","topic":")";
  for (const record::Topic& known : record::json_topics()) {
    if (known.id == key.topic) line_ += known.name;
  }
  line_ += R"(","device":)";
  if (head.device.empty()) {
    line_ += "null";
  } else {
    append_quoted(line_, head.device);
  }
  line_ += ",\"time\":";
  utc_ns < pipeline::kFirstUtc_ns ? void(line_ += "null") : record::append_seconds(line_, utc_ns);
  line_ += ",\"message\":";
  record::append_payload(line_, append);
  line_ += "}\r\n";
  server_->publish(key, line_);
}

void LogWriter::put(const record::MessageHead& head, const record::AppendJson& append_json) {
  namespace topic = record::topic;
  publish(head, append_json);
  const bool is_sample = head.repeats && head.topic != topic::kNav && head.topic != topic::kBattery;
  if ((is_sample && !has(config::LogGroup::samples)) ||
      (head.topic == topic::kNav && !has(config::LogGroup::navigation)) ||
      (head.topic == topic::kHealth && !has(config::LogGroup::health)) ||
      (head.topic == topic::kCommand && !has(config::LogGroup::commands)))
    return;
  append([&](std::string& out) { encoder_.put(out, head, append_json); });
}

void LogWriter::calib_report(std::int64_t now_ns, std::string_view json) {
  if (has(config::LogGroup::calibration)) return calib(now_ns, json);
  publish({record::topic::kCalib, now_ns, now_ns}, [&](std::string& out) { out += json; });
}

void LogWriter::leave_out(std::vector<std::string> choice) {
  const auto is_named = [&choice](const std::string& name) {
    return std::find(choice.begin(), choice.end(), name) != choice.end();
  };
  for (std::size_t i = 0; i < left_out_.size(); ++i)
    left_out_.at(i) = is_named(std::string(config::kLogGroups.at(i)));
  raw_left_out_.clear();
  for (const std::string& port : ports_)
    raw_left_out_.push_back(!has(config::LogGroup::raw) || is_named(std::string(config::kRawChoice) + port));
  settings_.leave_out = std::move(choice);
}

void LogWriter::stop(std::int64_t now_ns) {
  if (!disk_ || stopped_) return;
  disk_->end_file([&](std::string& out) { encoder_.finish(out, now_ns); });
  disk_->close_file();
  stopped_ = true;
}

void LogWriter::start(std::int64_t now_ns) {
  if (!disk_ || !stopped_) return;
  stopped_ = false;
  begin_file(now_ns);
}

void LogWriter::rotate(std::int64_t now_ns) {
  if (!disk_ || stopped_) return;
  disk_->end_file([&](std::string& out) { encoder_.finish(out, now_ns); });
  begin_file(now_ns);
}

void LogWriter::tick(std::int64_t now_ns) {
  if (!disk_ || stopped_) return;
  const bool old = static_cast<double>(now_ns - file_begun_ns_) >= settings_.rotate_age_s * kNs;
  if (old || encoder_.file_bytes() >= settings_.rotate_bytes) rotate(now_ns);
  const DiskState disk = disk_->state();
  if (disk.is_gone && disk.file != told_gone_) {
    told_gone_ = disk.file;
    rotate(now_ns);
    event(now_ns, "error", "log.removed", "", disk.file + " was removed while it was written: a new file begins");
  }

  const std::uint64_t dropped = disk.dropped;
  if (dropped == told_dropped_) return;
  const std::string words =
      fmt::format("{} records lost: the disk did not keep up and the queue of {} MB was full",
                  dropped - told_dropped_, settings_.queue_bytes / 1'000'000);
  const bool told =
      disk_->append([&](std::string& out) { encoder_.event(out, now_ns, "error", "log.dropped", "", words); });
  if (told)
    publish({record::topic::kEvent, now_ns, now_ns}, [&](std::string& out) {
      record::append_event_json(out, mapping_, now_ns, "error", "log.dropped", "", words);
    });
  // Without room this event is lost as well, and the next one reports the total.
  if (told) told_dropped_ = dropped;
}

void LogWriter::finish(std::int64_t now_ns) {
  if (!disk_) return;
  if (!stopped_) disk_->end_file([&](std::string& out) { encoder_.finish(out, now_ns); });
  disk_->stop();
}

DiskState LogWriter::state() const {
  if (!disk_) return {};
  DiskState state = disk_->state();
  // A disk that is full or fails still holds up what was logged before the stop: that is what people must know.
  if (stopped_ && state.state == DiskState::State::writing) state.state = DiskState::State::stopped;
  return state;
}

std::vector<std::string> LogWriter::take_notices() {
  return disk_ ? disk_->take_notices() : std::vector<std::string>{};
}

}  // namespace navcal::daemon
