// SPDX-License-Identifier: Apache-2.0
#include "analysis/replay_run.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "record/json/json_members.h"
#include "record/json/message_json.h"

namespace navcal::analysis {
void ReplayRun::open(std::unique_ptr<record::Recording> recording, std::string file) {
  ports_ = std::make_unique<record::PortMatch>(recording->settings(), pipeline_.settings());
  recording_ = std::move(recording);
  file_ = std::move(file);
  newest_ns_ = 0;
  ended_ = false;
  for (std::string& remark : ports_->remarks(file_)) remarks_.push_back(std::move(remark));
}

bool ReplayRun::step(ReplaySink& sink) {
  if (ended_) return false;
  if (const auto entry = recording_->next()) {
    take(*entry, sink);
    return true;
  }
  finish(sink);
  return false;
}

void ReplayRun::take(const record::Entry& entry, ReplaySink& sink) {
  ports_->give(entry, pipeline_, sink);
  if (const auto* raw = std::get_if<record::RawRead>(&entry)) {
    newest_ns_ = std::max(newest_ns_, raw->time_ns);
  } else if (const auto* calibration = std::get_if<pipeline::CalibrationChange>(&entry)) {
    newest_ns_ = std::max(newest_ns_, calibration->time_ns);
    const auto problem = pipeline_.replay_calibration(*calibration, sink);
    if (!problem.empty()) remarks_.push_back(file_ + ": " + problem);
  } else if (const auto* event = std::get_if<record::LoggedEvent>(&entry)) {
    newest_ns_ = std::max(newest_ns_, event->time_ns);
    take_event(*event, sink);
  } else if (const auto* command = std::get_if<record::LoggedCommand>(&entry)) {
    sink.on_command(*command);
  }
}

/// The daemon knows nothing of where the vehicle was in its last run, unlike its calibrations. The battery's
/// charge does not follow from the bytes.
void ReplayRun::take_event(const record::LoggedEvent& event, ReplaySink& sink) {
  const auto json = nlohmann::json::parse(event.json, nullptr, false);
  if (!json.is_object()) return;
  const std::string name = record::text_in(json, "name");
  if (name == "daemon.start") pipeline_.begin_navigation_run();
  if (name != "battery.set") return;
  pipeline_.advance(event.time_ns, sink);
  if (const auto charge = record::battery_event_charge(record::text_in(json, "message")))
    pipeline_.set_battery(*charge);
}

void ReplayRun::finish(ReplaySink& sink) {
  ended_ = true;
  pipeline_.advance(newest_ns_, sink);
  remarks_.insert(remarks_.end(), recording_->remarks().begin(), recording_->remarks().end());
}

}  // namespace navcal::analysis
