// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string_view>

#include "config/settings.h"
#include "instruments/samples.h"
#include "pipeline/battery_stage.h"
#include "pipeline/calibration_stage.h"
#include "pipeline/earth_field.h"
#include "pipeline/navigation_stage.h"
#include "pipeline/pipeline.h"
#include "pipeline/sources.h"
#include "pipeline/tilt_stage.h"

namespace navcal::pipeline {

/// Stages of a stamped sample: selection of the port, the Earth's field at the fixes, tilt by the accelerometers,
/// the active calibration; then the position estimator and the calibrators. Any stage may be absent.
class Stages {
 public:
  explicit Stages(const config::Settings& settings);

  [[nodiscard]] bool are_none() const { return !calibration_ && !navigation_ && !battery_; }
  void take(const instruments::Sample& sample, const UtcMapping& mapping, Sink& sink);

  /// Null when there is nothing to calibrate.
  [[nodiscard]] CalibrationStage* calibration() const { return calibration_.get(); }
  /// Restores like CalibrationStage::restore(), with instruments and place of the state.
  bool restore_calibration(std::string_view state);
  void begin_navigation_run();
  /// As Pipeline::navigation().
  [[nodiscard]] std::optional<NavigationSample> navigation(const UtcMapping& mapping) const {
    return navigation_ ? navigation_->newest(mapping) : std::nullopt;
  }
  /// Null where the battery is not counted.
  [[nodiscard]] BatteryStage* battery() const { return battery_.get(); }
  [[nodiscard]] const Sources& sources() const { return sources_; }
  [[nodiscard]] const EarthField& earth_field() const { return field_.field(); }

 private:
  void take_sources(const instruments::Sample& sample, Sink& sink);
  void take_field(const instruments::Sample& sample, Sink& sink);
  void use_sources();
  void use_field();

  std::vector<std::string> port_names_;
  Sources sources_;
  EarthFieldWatch field_;
  std::unique_ptr<TiltStage> tilt_;
  std::unique_ptr<CalibrationStage> calibration_;
  std::unique_ptr<NavigationStage> navigation_;
  std::unique_ptr<BatteryStage> battery_;
};

/// Sends samples through the stages, and everything else past them.
class StagesSink final : public Sink {
 public:
  StagesSink(Stages& stages, const UtcMapping& mapping, Sink& next)
      : stages_(stages), mapping_(mapping), next_(next) {}
  void on_sample(const instruments::Sample& sample) override { stages_.take(sample, mapping_, next_); }
  void on_frame(std::uint16_t port, const protocols::Frame& frame, std::int64_t arrival_ns) override {
    next_.on_frame(port, frame, arrival_ns);
  }
  void on_stream_event(const StreamEvent& event) override { next_.on_stream_event(event); }
  void on_mapping(const UtcMapping& mapping) override { next_.on_mapping(mapping); }

 private:
  Stages& stages_;
  const UtcMapping& mapping_;
  Sink& next_;
};

}  // namespace navcal::pipeline
