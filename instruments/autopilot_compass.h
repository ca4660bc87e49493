// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "instruments/samples.h"

namespace navcal::instruments {

/// Standard error of an autopilot's heading where it states none: 10 degrees. A compass that it has calibrated by
/// itself, beside motors, with the declination of its own table (docs/icd.md, section 17).
inline constexpr double kAutopilotHeadingStd_rad = 0.17453292519943295;

/// The compass calibrations that an ArduPilot autopilot applies before it sends a field, by its parameters
/// (AP_Compass_Backend::correct_field):
///   field = D (measured + OFS) SCALE + MOT current
/// D has DIA on its diagonal and ODI beside it. Offsets in mGauss, MOT in mGauss/A; body axes.
class AutopilotCompass {
 public:
  static constexpr int kUnits = 3;

  /// A parameter; those of other names, and numbers that are not finite, are ignored.
  void take(std::string_view name, double value);
  /// OFS of `unit` beside a field, cut to whole mGauss: it counts where it is not that of the parameters.
  void take_offset(int unit, const Vector3& offset_uT);
  /// Field as it was measured. Nullopt while a parameter of `unit` (0: the first) is missing, where D has no
  /// inverse, and where the calibration depends on what is not sent (on the throttle; on a current that is
  /// absent).
  [[nodiscard]] std::optional<Vector3> measured_uT(int unit, const Vector3& sent_uT,
                                                   std::optional<double> current_A) const;
  /// Parameters of `unit` in the order in which they are to be asked for: the calibration is complete with the
  /// last. Of COMPASS_SCALE and those of the motor some versions know nothing, which means that they do nothing.
  [[nodiscard]] static std::vector<std::string> names(int unit);

 private:
  struct Unit {
    std::array<std::optional<double>, 3> offset_mG, diagonal, off_diagonal;
    Vector3 motor_mG_per_A{};
    double scale = 1;
  };
  std::array<Unit, kUnits> units_;
  int motor_source_ = 0;  ///< COMPASS_MOTCT: 1 throttle, 2 current
};

}  // namespace navcal::instruments
