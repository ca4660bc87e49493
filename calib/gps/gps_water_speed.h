// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "base/reference_instruments.h"
#include "calib/archive.h"
#include "calib/readings.h"

namespace navcal::calib {

/// Model: d(v)/dt = (g n - v) |v + g n| / (2 l), v speed through water (m/s), n shaft speed (rev/s): quadratic
/// drag against a thrust that balances it at v = g n. g is the advance per revolution (m), l the way (m) over
/// which the hull gathers speed. A vehicle without a log has no better; GpsCompass finds the scale of it.
class WaterSpeed {
 public:
  struct Parameters {
    double advance_m = base::reference::kAdvance_m;  ///< per revolution, straight ahead
    double way_m = 3.0;
    double longest_step_s = 0.25;  ///< of integration
  };

  WaterSpeed() : WaterSpeed(Parameters{}) {}
  explicit WaterSpeed(const Parameters& parameters) : parameters_(parameters) {}

  void update(const MotorReading& motor);
  /// Speed at or after the newest reading of the motor; nullopt before any.
  [[nodiscard]] std::optional<double> at(double time_s) const;
  void archive(Archive& archive);

 private:
  [[nodiscard]] double advanced(double duration_s) const;

  Parameters parameters_;
  bool started_ = false;
  double time_s_ = 0, speed_m_s_ = 0, revolutions_per_s_ = 0;
};

}  // namespace navcal::calib
