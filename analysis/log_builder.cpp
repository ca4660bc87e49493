// SPDX-License-Identifier: Apache-2.0
#include "analysis/log_builder.h"

#include "config/load.h"
#include "record/json/calibration_json.h"
#include "record/json/flat_json.h"

namespace navcal::analysis {
namespace {

constexpr std::size_t kFlushBytes = 64 << 10;

/// A capture says what its ports are called and speak, not where they were; a configuration must.
config::Settings with_places(config::Settings settings, const std::filesystem::path& capture) {
  for (auto& port : settings.ports) {
    if (port.path.empty()) port.path = std::filesystem::absolute(capture).string() + ":" + port.name;
  }
  return settings;
}

}  // namespace

LogBuilder::LogBuilder(const config::Settings& settings, const std::filesystem::path& log)
    : ports_(settings.ports), encoder_(settings, config::to_toml(settings)), pipeline_(settings), file_(log) {}

void LogBuilder::begin(const record::MappingChange& first) {
  newest_ns_ = first.time_ns;
  encoder_.begin(text_, newest_ns_, first.mapping);
  pipeline_.set_mapping(first.mapping, *this);
  begun_ = true;
  pipeline_.advance(newest_ns_, *this);
  if (!pipeline_.calibrates()) return;
  std::string json;
  record::append_json(json, pipeline_.mapping(), pipeline_.calibration_beginning(newest_ns_));
  encoder_.calib(text_, newest_ns_, json);
}

void LogBuilder::take(const record::RawRead& read) {
  newest_ns_ = read.time_ns;
  encoder_.raw(text_, read.port, read.direction, read.time_ns, read.bytes);
  if (read.direction == record::Direction::received) {
    pipeline_.bytes(read.port, read.time_ns, read.bytes, *this);
  }
  if (text_.size() >= kFlushBytes) flush();
}

void LogBuilder::take(const record::LoggedEvent& event) {
  const auto json = record::FlatJson::parse(event.json);
  if (json)
    encoder_.event(text_, event.time_ns, json->get("severity"), json->get("name"), json->get("port"),
                   json->get("message"));
}

void LogBuilder::tell(std::string_view severity, std::string_view name, std::string_view message) {
  encoder_.event(text_, newest_ns_, severity, name, "", message);
}

void LogBuilder::commit() {
  pipeline_.advance(newest_ns_, *this);
  if (pipeline_.calibrates()) {
    const auto lines = record::calib_lines(pipeline_.calibration_report(), pipeline_.mapping().to_utc(newest_ns_));
    for (const std::string& line : lines) encoder_.calib(text_, newest_ns_, line);
  }
  encoder_.finish(text_, newest_ns_);
  flush();
  file_.commit();
}

void LogBuilder::on_sample(const instruments::Sample& sample) { encoder_.sample(text_, sample); }

void LogBuilder::on_mapping(const pipeline::UtcMapping& mapping) {
  if (begun_) encoder_.mapping(text_, newest_ns_, mapping);
}

void LogBuilder::on_navigation(const pipeline::NavigationSample& sample) {
  encoder_.navigation(text_, sample);
  for (const auto& told : pipeline::events_of(sample))
    encoder_.event(text_, sample.stamp.arrival_ns, told.severity, told.name, "", told.message);
}

void LogBuilder::on_battery(const pipeline::BatterySample& sample) { encoder_.battery(text_, sample); }

void LogBuilder::on_alarm(const pipeline::AlarmChange& change) {
  const bool is_battery = change.alarm == pipeline::EstimateAlarm::battery_low;
  encoder_.event(text_, change.time_ns, change.raised ? "alarm" : "info",
                 change.raised ? "alarm.raised" : "alarm.cleared", ports_[change.port].name,
                 (is_battery ? "battery_low: " : "floor_near: ") + change.words);
}

void LogBuilder::on_stream_event(const pipeline::StreamEvent& event) {
  encoder_.event(text_, event.time_ns, event.severity, event.name, ports_[event.port].name, event.message);
}

void LogBuilder::on_calibration(const pipeline::CalibrationChange& change) {
  std::string json;
  record::append_json(json, pipeline_.mapping(), change);
  encoder_.calib(text_, change.time_ns, json);
}

void LogBuilder::flush() {
  file_.write(text_);
  text_.clear();
}

std::vector<std::string> import_capture(const std::filesystem::path& capture, const std::filesystem::path& log,
                                        const record::Progress& progress) {
  if (record::is_log(capture)) throw record::BadRecording(capture.string() + ": it is a log already");
  const auto recording = record::Recording::open(capture);
  LogBuilder builder(with_places(recording->settings(), capture), log);
  while (const auto entry = recording->next()) {
    if (const auto* first = std::get_if<record::MappingChange>(&*entry)) builder.begin(*first);
    if (const auto* read = std::get_if<record::RawRead>(&*entry)) builder.take(*read);
    if (const auto* event = std::get_if<record::LoggedEvent>(&*entry)) builder.take(*event);
    progress(recording->progress());
  }
  builder.commit();
  return recording->remarks();
}

}  // namespace navcal::analysis
