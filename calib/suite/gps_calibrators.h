// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "calib/archive.h"
#include "calib/correction.h"
#include "calib/gps/gps_compass.h"
#include "calib/gps/gps_water_speed.h"
#include "calib/gps/misalignment.h"
#include "calib/suite/suite_options.h"
#include "calib/turn/held_out.h"

namespace navcal::calib {

/// The calibrators that compare the heading with the way over ground: misalignment and GPS-aided compass, fed with
/// what they need of compass, motor and GPS. The misalignment is judged by fixes that had no part in it:
/// course = heading - A + current and slip, on blocks of fixes taken straight ahead.
class GpsCalibrators {
 public:
  explicit GpsCalibrators(const SuiteOptions& options);

  /// `turn_rate_rad_s`: by a calibrated gyro; 0 where there is none.
  [[nodiscard]] WaterTrackReading track_of(const CompassReading& reading, double turn_rate_rad_s) const;
  void update(const CompassReading& reading, const WaterTrackReading& track, const Correction& in_force);
  void update(const MotorReading& motor);
  void update(const GroundReading& ground, const Correction& in_force);
  void start_compass();
  void start_misalignment();
  void set_declination(double declination_rad);

  [[nodiscard]] const Misalignment& misalignment() const { return misalignment_; }
  [[nodiscard]] const GpsCompass& gps_compass() const { return gps_compass_; }
  [[nodiscard]] const Comparison& comparison() const { return comparison_; }
  /// Called when another misalignment becomes active.
  void on_change() {
    comparison_.on_change();
    fixes_ = 0;
  }
  void archive(Archive& archive);

 private:
  static constexpr std::uint32_t kFixes = 20;  ///< of a block

  void judge(const GroundReading& ground, const Correction& in_force);

  SuiteOptions options_;
  WaterSpeed speed_;
  Misalignment misalignment_;
  GpsCompass gps_compass_;
  // Newest heading, true but for A, and how fast it changes.
  std::optional<double> heading_rad_;
  double heading_s_ = 0, turn_rate_rad_s_ = 0;
  // The block of fixes under way.
  double offset_rad_ = 0;  ///< A as it was before the block
  std::uint32_t fixes_ = 0;
  double before_ = 0, in_force_ = 0, estimate_ = 0;
  Comparison comparison_;
};

}  // namespace navcal::calib
