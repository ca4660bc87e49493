// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "calib/suite/suite.h"
#include "config/settings.h"
#include "instruments/samples.h"
#include "pipeline/calibration.h"
#include "pipeline/calibration_options.h"
#include "pipeline/pipeline.h"

namespace navcal::pipeline {

/// Between samples and calibrators: picks the instruments that are calibrated, puts what is in force on their
/// samples, feeds them to the suite, and tells of changes.
class CalibrationStage {
 public:
  /// Null when the configuration has nothing to calibrate, or says not to.
  static std::unique_ptr<CalibrationStage> make(const config::Settings& settings);
  CalibrationStage(const config::Settings& settings, const CalibratedPorts& ports);

  /// Puts what is in force on a sample. The heading that an autopilot estimates by the same compass serves no more
  /// then: it is taken off its sample, and returned as SENSOR autopilot_heading.
  std::optional<instruments::Sample> correct(instruments::Sample& sample) const;
  /// Feeds it, as it was before. Tells the sink of what came into force by it.
  void learn(const instruments::Sample& original, Sink& sink);
  /// The operator's word; what cannot be done is said in words, and nothing is told to the sink then.
  std::string order(CalibrationOrder order, calib::Calibrator calibrator, std::int64_t now_ns, Sink& sink);
  void finish(Sink& sink);

  [[nodiscard]] calib::Report report() const { return suite_.report(); }
  [[nodiscard]] const calib::InForce& in_force() const { return suite_.in_force(); }
  /// A change of the kind with which a log begins.
  [[nodiscard]] CalibrationChange beginning(std::int64_t now_ns);
  /// Everything, to the last bit, from a state of beginning(). False when it is none; nothing has changed then.
  bool restore(std::string_view state);
  /// The restored state is of an earlier run, with another monotonic clock.
  void begin_run();
  /// The ports that are learnt from, once it is known which deliver.
  void use(const CalibratedPorts& ports) { ports_ = ports; }
  [[nodiscard]] const CalibratedPorts& ports() const { return ports_; }
  /// The Earth's field here became known, or is another one: the vehicle has moved.
  void use(const EarthFieldWatch& field);
  /// The place whose field by the model the calibrators know; it is restored with the rest.
  [[nodiscard]] const std::optional<FieldPlace>& field_place() const { return field_place_; }

 private:
  void learn_from(const instruments::Sample& sample, const instruments::CompassSample& compass);
  void learn_from(const instruments::Sample& sample, const instruments::ImuSample& imu);
  void learn_from(const instruments::Sample& sample, const instruments::GpsSample& gps);
  void learn_from(const instruments::Sample& sample, const instruments::MotorSample& motor);
  template <class Other>
  void learn_from(const instruments::Sample&, const Other&) {}
  [[nodiscard]] double seconds(std::int64_t validity_ns);
  void tell(std::int64_t now_ns, CalibrationChange::Cause cause, calib::Calibrator calibrator, Sink& sink) const;
  void tell_adopted(Sink& sink);
  void archive(calib::Archive& archive);

  calib::Suite suite_;
  CalibratedPorts ports_;
  std::int64_t compass_delay_ns_;               ///< known beforehand
  std::vector<protocols::Protocol> protocols_;  ///< of each port of the configuration
  std::optional<FieldPlace> field_place_;
  std::int64_t newest_ns_ = 0;             ///< arrival of the newest sample
  std::optional<std::int64_t> origin_ns_;  ///< of the seconds that the suite is told
  std::optional<double> motor_current_A_;  ///< newest reading
  std::int64_t motor_current_ns_ = 0;      ///< its time of validity
  std::optional<double> origin_latitude_rad_, origin_longitude_rad_;
};

}  // namespace navcal::pipeline
