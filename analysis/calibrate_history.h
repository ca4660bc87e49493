// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calib/correction.h"
#include "calib/suite/gate.h"
#include "calib/suite/report.h"
#include "calib/turn/turn_integrator.h"
#include "config/settings.h"
#include "pipeline/calibration_options.h"
#include "pipeline/pipeline.h"
#include "pipeline/sources.h"

namespace navcal::analysis {

/// A reading of the compass as the calibrators were given it, with the turn since the one before. Where a
/// recording is long, one stands for several that followed each other.
struct TurnedSample {
  calib::CompassReading reading;
  bool has_turn = false;    ///< nothing is known of the turn where not
  double measured_rad = 0;  ///< of calib::TurnStep
  double bias_time_s = 0;
  double tilt_rad = 0;
};

/// How one number of an estimate came about.
struct EstimatePoint {
  double time_s = 0, value = 0, std = 0;
};

/// Data for the plots of a calibration: readings and estimates over time, in bounded memory for any length of the
/// recording. Listens to the pipeline and forwards everything.
class CalibrateHistory final : public pipeline::Sink {
 public:
  static constexpr std::size_t kMostSamples = 8192, kMostPoints = 160;
  /// "gyro.scale", "compass.B_rad".
  using Estimates = std::map<std::string, std::vector<EstimatePoint>>;

  explicit CalibrateHistory(const config::Settings& settings);

  void on_sample(const instruments::Sample& sample) override;
  /// To be called between the calls of the pipeline: takes down the estimates when it is time to.
  void look(const pipeline::Pipeline& pipeline);
  /// The following readings are from another clock, after a pause of unknown length.
  void begin_recording();
  /// No more samples come: takes down the last estimates, which are those of the report.
  void finish(const pipeline::Pipeline& pipeline);

  /// Time in seconds from the first reading; a pause between recordings counts as the gate's.
  [[nodiscard]] const std::vector<TurnedSample>& samples() const { return samples_; }
  [[nodiscard]] const Estimates& estimates() const { return estimates_; }

 private:
  void put(const calib::Reading& reading);
  void take_cleaned();
  void take_turned(bool to_the_end);
  void keep(const TurnedSample& sample);
  void thin_estimates();
  [[nodiscard]] double seconds(const instruments::Sample& sample);

  pipeline::CalibratedPorts ports_;
  pipeline::Sources sources_;
  calib::Gate gate_;
  calib::TurnIntegrator turns_;
  std::deque<calib::CompassReading> pending_;  ///< their turns are not known yet
  std::optional<calib::TurnStep> turn_;
  std::optional<std::int64_t> origin_ns_;
  double newest_s_ = 0;

  std::vector<TurnedSample> samples_;
  std::size_t readings_per_sample_ = 1, readings_in_last_ = 0;
  Estimates estimates_;
  std::uint64_t readings_ = 0, next_look_ = 0, look_every_ = 10;
};

/// A heading against the integrated gyro. The gyro knows no north, so within a block of turning the mean is taken
/// away, and what all headings have in common does not show.
struct HeadingResidual {
  double heading_rad = 0;    ///< as the compass says it
  double before_rad = 0;     ///< as the compass says it, less the gyro's
  double after_rad = 0;      ///< calibrated, less the gyro's
  double deviation_rad = 0;  ///< `before` set upon the deviation that was found: its mean over the block is that
                             ///< of the curve
};

/// Residuals by the gyro of `estimates`; empty without one, or without turns. Blocks turn by half a radian or
/// more.
[[nodiscard]] std::vector<HeadingResidual> heading_residuals(const std::vector<TurnedSample>& samples,
                                                             const calib::Correction& estimates);

[[nodiscard]] double root_mean_square(const std::vector<HeadingResidual>& residuals,
                                      double HeadingResidual::*which);

}  // namespace navcal::analysis
