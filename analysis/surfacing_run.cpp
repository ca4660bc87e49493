// SPDX-License-Identifier: Apache-2.0
#include "analysis/surfacing_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "analysis/port_matching.h"
#include "base/progress.h"
#include "record/recording.h"

namespace navcal::analysis {
namespace {

/// A file that begins so soon after the end of the last is the next of its series.
constexpr std::int64_t kNextOfSeries_ns = 60'000'000'000;

config::Settings with_navigation(config::Settings settings) {
  settings.navigation.enabled = true;
  return settings;
}

std::int64_t entry_time_ns(const record::Entry& entry) {
  return std::visit([](const auto& e) { return e.time_ns; }, entry);
}

}  // namespace

SurfacingRun::SurfacingRun(const config::Settings& settings)
    : settings_(with_navigation(settings)), pipeline_(std::make_unique<pipeline::Pipeline>(settings_)) {}

void SurfacingRun::begin_file(std::int64_t time_ns) {
  if (newest_ns_ == 0 || (time_ns >= newest_ns_ && time_ns - newest_ns_ <= kNextOfSeries_ns)) return;
  pipeline_ = std::make_unique<pipeline::Pipeline>(settings_);
  newest_ns_ = 0;
}

bool SurfacingRun::play(const std::string& file) {
  if (!seen_.is_new(file, remarks_)) return false;
  file_ = file;
  const auto recording = record::Recording::open(file);
  const auto ports = match_ports(recording->settings(), settings_, file);
  base::Progress progress("surfacings");
  bool begins = true;
  while (const auto entry = recording->next()) {
    const std::int64_t time_ns = entry_time_ns(*entry);
    if (begins) begin_file(time_ns);
    begins = false;
    newest_ns_ = std::max(newest_ns_, time_ns);
    ports.give(*entry, *pipeline_, *this);
    if (const auto* calibration = std::get_if<pipeline::CalibrationChange>(&*entry)) {
      if (const auto problem = pipeline_->replay_calibration(*calibration, *this); !problem.empty())
        remarks_.push_back(fmt::format("{}: {}", file, problem));
    }
    progress.show(recording->progress());
  }
  pipeline_->advance(newest_ns_, *this);
  remarks_.insert(remarks_.end(), recording->remarks().begin(), recording->remarks().end());
  return true;
}

void SurfacingRun::on_navigation(const pipeline::NavigationSample& sample) {
  if (!sample.surfacing) return;
  RecordedSurfacing& found = surfacings_.emplace_back();
  found.file = file_;
  found.surfacing = *sample.surfacing;
  found.first_fix_utc_ns = pipeline_->mapping().to_utc(sample.surfacing->first_fix_ns);
  if (!sample.outage) return;
  found.distance_m = sample.outage->distance_m;
  found.error_m = sample.outage->error_m;
  found.std_m = sample.outage->std_m;
  found.error_uncalibrated_m = sample.outage_error_uncalibrated_m;
}

}  // namespace navcal::analysis
