// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "config/options.h"

namespace navcal::config {
namespace {

struct OlderName {
  std::string_view key, name;
};

/// Keys of [calibration] for what is in [instruments] now.
constexpr std::array<OlderName, 4> kOlderNames{{
    {"gyro_noise_deg_s", "instruments.imu_gyro_noise_deg_s"},
    {"tilt_lag_s", "instruments.compass_tilt_lag_s"},
    {"position_noise_m", "instruments.gps_position_noise_m"},
    {"velocity_noise_m_s", "instruments.gps_velocity_noise_m_s"},
}};

}  // namespace

std::vector<Option<Settings>> calibration_options() {
  const auto table = table_of<Settings>("calibration", &Settings::calibration);
  std::vector<Option<Settings>> options{
      table.boolean("enabled", &CalibrationSettings::enabled, "Whether the calibrators run at all."),
      table.boolean("automatic", &CalibrationSettings::automatic,
                    "Whether estimates become active by themselves; otherwise only by calibration.accept."),
      table.number("margin_percent", &CalibrationSettings::margin, kPercent, 0, 90,
                   "Improvement on held-out readings that an estimate needs to become active by itself."),
      table.number("motor_settle_s", &CalibrationSettings::motor_settle_s, kSeconds, 0, 60,
                   "Time after a switching of the motor during which magnetic readings are left out."),
      table.number("heading_noise_deg", &CalibrationSettings::heading_noise_rad, kDegrees, 0, 20,
                   "Noise of the compass's heading that the calibrators reckon with, one standard deviation of a "
                   "reading; 0: it follows from the compass in [instruments] (0.5 deg for the reference one)."),
      table.number("field_noise_uT", &CalibrationSettings::field_noise_uT, kMicrotesla, 0, 20,
                   "Noise of each axis of the magnetic field that the calibrators reckon with; 0: it follows from "
                   "the compass in [instruments] (0.2 uT for the reference one)."),
      table.number(
          "bias_walk_deg_s", &CalibrationSettings::bias_walk_rad_s, kDegreesPerSecond, 0, 10,
          "Random walk of a gyro's bias in one second (grows with the root of time), one standard deviation."),
      table.number("current_m_s", &CalibrationSettings::current_m_s, kMetresPerSecond, 0, 10,
                   "Expected water current, one standard deviation of each axis."),
      table.number("advance_m", &CalibrationSettings::advance_m, kMetres, 0, 10,
                   "Distance through the water for one revolution of the shaft, straight ahead; 0 if unknown "
                   "(then the compass is not calibrated by GPS)."),
  };
  for (const auto& [key, name] : kOlderNames) {
    for (auto& option : instrument_options()) {
      if (option.name() != name) continue;
      option.table = "calibration";
      option.key = key;
      option.moved_to = name;
      options.push_back(std::move(option));
    }
  }
  return options;
}

}  // namespace navcal::config
