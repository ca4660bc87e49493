// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages.h"

#include <fmt/format.h>

#include <string>
#include <variant>

namespace navcal::pipeline {
namespace {

using Cause = Sources::Change::Cause;

std::string words_for(const Sources::Change& change, const std::vector<std::string>& port_names) {
  std::string words = fmt::format("serves the {}", config::name_of(change.role));
  if (!change.before) return words;
  const std::string& before = port_names.at(*change.before);
  switch (change.cause) {
    case Cause::silence: return words + fmt::format(", because {} is silent", before);
    case Cause::error: return words + fmt::format(" instead of {}, because it states the smaller error", before);
    case Cause::delivers: break;
  }
  return words + fmt::format(" instead of {}", before);
}

}  // namespace

Stages::Stages(const config::Settings& settings)
    : sources_(settings), field_(settings.environment), tilt_(TiltStage::make(settings)),
      calibration_(CalibrationStage::make(settings)), navigation_(NavigationStage::make(settings)),
      battery_(BatteryStage::make(settings)) {
  for (const auto& port : settings.ports) port_names_.push_back(port.name);
}

void Stages::take(const instruments::Sample& sample, const UtcMapping& mapping, Sink& sink) {
  std::optional<instruments::Sample> filled;
  if (tilt_) {
    tilt_->take(sample);
    filled = tilt_->with_tilt(sample);
  }
  const instruments::Sample& original = filled ? *filled : sample;
  instruments::Sample corrected = original;
  const auto replaced = calibration_ ? calibration_->correct(corrected) : std::nullopt;
  take_sources(corrected, sink);  // a field alone is no heading before it is calibrated
  take_field(corrected, sink);
  sink.on_sample(corrected);
  if (replaced) sink.on_sample(*replaced);
  const auto placed = navigation_ ? navigation_->at_origin(corrected) : std::nullopt;
  if (navigation_) {
    navigation_->take(original, placed ? *placed : corrected, tilt_ ? tilt_->newest() : std::nullopt, mapping,
                      sink);
  }
  if (battery_) {
    // An estimate costs some time: the speed is taken as often as the shaft's.
    const bool is_motor = std::holds_alternative<instruments::MotorSample>(corrected.value);
    battery_->take(corrected, is_motor ? navigation(mapping) : std::nullopt, mapping, sink);
  }
  if (calibration_) calibration_->learn(placed ? *placed : original, sink);
}

void Stages::take_sources(const instruments::Sample& sample, Sink& sink) {
  const auto changes = sources_.take(sample);
  if (calibration_) calibration_->use(sources_.learnt());
  if (changes.empty()) return;
  use_sources();
  for (const auto& change : changes) {
    const std::string name = fmt::format("source.{}", config::name_of(change.role));
    sink.on_stream_event({change.port, sample.stamp.arrival_ns,
                          change.cause == Cause::silence ? "warning" : "info", name,
                          words_for(change, port_names_)});
  }
}

void Stages::take_field(const instruments::Sample& sample, Sink& sink) {
  const auto* gps = std::get_if<instruments::GpsSample>(&sample.value);
  if (gps == nullptr || sample.port != sources_.serving()[Role::position]) return;
  const bool was_known = field_.place().has_value();
  if (!field_.take(*gps)) return;
  use_field();
  sink.on_earth_field(field_.field());
  if (was_known) return;  // a moving vehicle's field changes step by step
  sink.on_stream_event(
      {sample.port, sample.stamp.arrival_ns, "info", "earth_field", pipeline::words_for(field_.field())});
}

void Stages::use_field() {
  if (calibration_) calibration_->use(field_);
  if (navigation_) navigation_->set_declination(field_.field().declination_rad);
}

bool Stages::restore_calibration(std::string_view state) {
  if (!calibration_ || !calibration_->restore(state)) return false;
  sources_.go_on_with(calibration_->ports());
  if (const auto& place = calibration_->field_place()) (void)field_.go_on_at(*place);
  use_field();
  return true;
}

void Stages::begin_navigation_run() {
  sources_.begin_run();
  if (tilt_) tilt_->begin_run();
  if (navigation_) navigation_->begin_run();
  use_sources();
}

void Stages::use_sources() {
  if (tilt_) tilt_->use(sources_.serving());
  if (navigation_) navigation_->use(sources_.serving());
}

}  // namespace navcal::pipeline
