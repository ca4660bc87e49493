// SPDX-License-Identifier: Apache-2.0
#include "analysis/calibrate_run.h"

#include <fmt/format.h>

#include <variant>

#include "analysis/import/import_report.h"

namespace navcal::analysis {
namespace {

/// A file that begins so soon after the end of the last is the next of its series.
constexpr std::int64_t kSeriesGap_ns = 60'000'000'000;

/// Whoever calibrates from a recording wants all that it supports, whatever the vehicle was told to do by itself.
config::Settings with_calibration(config::Settings settings) {
  settings.calibration.enabled = true;
  settings.calibration.automatic = true;
  settings.navigation.enabled = false;  // nobody asks here where it was
  return settings;
}

pipeline::Sink& nobody() {
  static pipeline::Sink sink;
  return sink;
}

/// Monotonic, or UTC in a capture.
std::int64_t time_of(const record::Entry& entry) {
  return std::visit([](const auto& e) { return e.time_ns; }, entry);
}

}  // namespace

CalibrateRun::CalibrateRun(const config::Settings& settings, CalibrateHistory* history)
    : settings_(with_calibration(settings)), history_(history),
      sink_(history != nullptr ? static_cast<pipeline::Sink&>(*history) : nobody()),
      pipeline_(std::make_unique<pipeline::Pipeline>(settings_)) {}

void CalibrateRun::play(const std::string& file, const record::Progress& progress,
                        const record::TimeWindow& window) {
  if (!seen_.is_new(file, remarks_)) return;
  files_.push_back(file);
  const auto recording = record::Recording::open(file, window);
  const record::PortMatch ports(recording->settings(), settings_);
  for (std::string& remark : ports.remarks(file)) remarks_.push_back(std::move(remark));
  file_begins_ = true;
  while (const auto entry = recording->next()) {
    at(file, time_of(*entry));
    take(file, *entry, ports);
    if (history_ != nullptr) history_->look(*pipeline_);
    progress(recording->progress());
  }
  pipeline_->advance(newest_ns_, sink_);
  for (std::size_t port = 0; port < settings_.ports.size(); ++port) {
    if (pipeline_->statistics(static_cast<std::uint16_t>(port)).has_corrected_fields) tell_corrected_fields(file);
  }
  remarks_.insert(remarks_.end(), recording->remarks().begin(), recording->remarks().end());
}

void CalibrateRun::at(const std::string& file, std::int64_t time_ns) {
  if (file_begins_) {
    const bool first = newest_ns_ == 0;
    if (first || time_ns < newest_ns_ || time_ns > newest_ns_ + kSeriesGap_ns) {
      if (!first) begin_recording(file, time_ns);
      newest_ns_ = time_ns;
    }
    if (first) begin_ordered();
    file_begins_ = false;
  }
  if (time_ns <= newest_ns_) return;
  duration_ns_ += time_ns - newest_ns_;
  newest_ns_ = time_ns;
}

void CalibrateRun::begin_recording(const std::string& file, std::int64_t time_ns) {
  const std::string state = pipeline_->calibration_beginning(newest_ns_).state;
  pipeline_ = std::make_unique<pipeline::Pipeline>(settings_);
  if (pipeline_->calibrates() && pipeline_->restore_calibration(state)) {
    pipeline_->begin_calibration_run();
  } else if (pipeline_->calibrates()) {
    remarks_.push_back(file + ": the estimates from the files before it were lost");
  }
  if (history_ != nullptr) history_->begin_recording();
  newest_ns_ = time_ns;
}

/// A recording needs no order: a swing shows by its rests.
void CalibrateRun::begin_ordered() {
  for (const auto calibrator : calib::calibrators()) {
    if (calib::row_of(calibrator).by_order)
      pipeline_->order_calibration(pipeline::CalibrationOrder::start, calibrator, newest_ns_, sink_);
  }
}

void CalibrateRun::take(const std::string& file, const record::Entry& entry, const record::PortMatch& ports) {
  ports.give(entry, *pipeline_, sink_, newest_ns_);
  if (const auto* order = std::get_if<pipeline::CalibrationChange>(&entry)) {
    const bool starts = order->cause == pipeline::CalibrationChange::Cause::start && order->calibrator;
    if (starts && calib::row_of(*order->calibrator).by_order)
      pipeline_->order_calibration(pipeline::CalibrationOrder::start, *order->calibrator, newest_ns_, sink_);
  } else if (const auto* event = std::get_if<record::LoggedEvent>(&entry)) {
    is_of_px4_ = is_of_px4_ || event->json.find("(ulog)") != std::string::npos;
    if (event->json.find(kCorrectedFields) != std::string::npos) tell_corrected_fields(file);
  }
}

void CalibrateRun::tell_corrected_fields(const std::string& file) {
  if (!has_corrected_fields_) remarks_.push_back(fmt::format("{}: {}", file, kCorrectedFields));
  has_corrected_fields_ = true;
}

std::string CalibrateRun::field_port() const {
  const auto port = pipeline_->sources()[config::Role::field];
  return port ? settings_.ports[*port].name : std::string();
}

calib::Report CalibrateRun::finish() {
  pipeline_->finish_calibration(sink_);
  if (history_ != nullptr) {
    history_->finish(*pipeline_);
  }
  return pipeline_->calibration_report();
}

std::string CalibrateRun::state_with(calib::Calibrator calibrator) {
  using Order = pipeline::CalibrationOrder;
  if (!pipeline_->order_calibration(Order::accept, calibrator, newest_ns_, sink_).empty()) return {};
  for (const auto other : calib::calibrators())
    pipeline_->order_calibration(Order::start, other, newest_ns_, sink_);
  return pipeline_->calibration_beginning(newest_ns_).state;
}

void CalibrateRun::begin_with(const std::string& state) {
  if (pipeline_->restore_calibration(state)) pipeline_->begin_calibration_run();
}

}  // namespace navcal::analysis
