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
  void take(const instruments::Sample& sample, const RolePorts& serving);
  /// Of a compass: puts the tilt on it.
  void fill(instruments::Sample& sample);
  /// By the accelerometers; nullopt before their first reading.
  [[nodiscard]] std::optional<nav::TiltReading> newest() const { return tilt_.newest(); }
  void begin_run();

 private:
  nav::AccelerometerTiltOptions options_;
  nav::AccelerometerTilt tilt_;
  std::vector<bool> has_inclinometer_;  ///< of each port
};

/// As the estimators take them. `rate_reading` without depth.
[[nodiscard]] nav::RateReading rate_reading(const instruments::Sample& sample, const instruments::ImuSample& imu);
[[nodiscard]] std::optional<nav::ShaftReading> shaft_reading(const instruments::Sample& sample,
                                                             const instruments::MotorSample& motor);

}  // namespace navcal::pipeline
