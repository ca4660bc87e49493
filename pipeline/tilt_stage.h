// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "config/settings.h"
#include "instruments/samples.h"
#include "nav/accelerometer_tilt.h"
#include "pipeline/sources.h"

namespace navcal::pipeline {

/// Gives roll and pitch by the accelerometers to samples of a compass that has no inclinometer
/// (docs/navigation.md), for levelling, calibration and attitude. A compass that has shown a tilt of its own is
/// left alone.
class TiltStage {
 public:
  /// Null when no port delivers accelerations.
  static std::unique_ptr<TiltStage> make(const config::Settings& settings);
  explicit TiltStage(const config::Settings& settings);

  /// Learns from a sample of a port that serves.
  void take(const instruments::Sample& sample);
  /// The sample of a compass with the tilt by the accelerometers; nullopt where the sample stays as it is.
  [[nodiscard]] std::optional<instruments::Sample> with_tilt(const instruments::Sample& sample);
  /// The tilt by the accelerometers; nullopt before their first reading.
  [[nodiscard]] std::optional<nav::TiltReading> newest() const { return tilt_.newest(); }
  /// Other ports serve from here on.
  void use(const RolePorts& ports) { ports_ = ports; }
  void begin_run();

 private:
  RolePorts ports_;
  nav::AccelerometerTiltOptions options_;
  nav::AccelerometerTilt tilt_;
  std::vector<Eigen::Vector3d> positions_m_;  ///< of each port's sensor
  std::vector<bool> has_inclinometer_;        ///< of each port
};

}  // namespace navcal::pipeline
