// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/reference_instruments.h"

namespace navcal::config {

/// Accuracy of the compass as the file states it. Noise is white, one standard deviation of a reading.
struct CompassAccuracy {
  double field_noise_uT = base::reference::kFieldNoise_uT;  ///< each axis
  double tilt_noise_rad = base::reference::kTiltNoise_rad;  ///< roll and pitch
  double tilt_lag_s = base::reference::kTiltLag_s;          ///< first-order lag of the inclinometer
  double temperature_noise_C = base::reference::kTemperatureNoise_C;

  bool operator==(const CompassAccuracy&) const = default;
};

struct ImuAccuracy {
  double gyro_noise_rad_s = base::reference::kGyroNoise_rad_s;
  double turn_on_bias_rad_s = base::reference::kTurnOnBias_rad_s;  ///< new for each gyro at each power-on
  double force_noise_m_s2 = base::reference::kForceNoise_m_s2;
  double depth_noise_m = base::reference::kDepthNoise_m;

  bool operator==(const ImuAccuracy&) const = default;
};

/// How long a receiver searches before its first fix (docs/surfacing.md). 64 bits, so that no gap lies between the
/// members of GpsAccuracy: the key of a bank of nulls is made from their bytes.
enum class SearchModel : std::uint64_t {
  uniform,         ///< between two bounds, whatever came before
  receiver_state,  ///< by what the receiver still knows: ephemerides, time, position
};

struct GpsAccuracy {
  double position_noise_m = base::reference::kPositionNoise_m;      ///< each axis, of a settled fix
  double velocity_noise_m_s = base::reference::kVelocityNoise_m_s;  ///< likewise
  double antenna_depth_m = base::reference::kAntennaDepth_m;        ///< no fixes where the origin is deeper
  double least_search_s = base::reference::kLeastSearch_s;          ///< from sight of the sky to the first fix
  double longest_search_s = base::reference::kLongestSearch_s;
  SearchModel search_model = SearchModel::uniform;
  // The model receiver_state: mean search by what the receiver knows, those of the Motorola M12
  // (docs/surfacing.md).
  double hot_start_s = 15;
  double warm_start_s = 45;
  double cold_start_s = 70;
  double ephemeris_life_s = 4 * 3600;

  bool operator==(const GpsAccuracy&) const = default;
};

struct MotorAccuracy {
  double fin_noise_rad = base::reference::kFinNoise_rad;
  double current_noise_A = base::reference::kCurrentNoise_A;

  bool operator==(const MotorAccuracy&) const = default;
};

/// The table [instruments]: what is known of the instruments beside their ports. Simulator, diagnosis, navigation
/// and calibrators share it (devices/instrument_model.h).
struct InstrumentSettings {
  CompassAccuracy compass;
  ImuAccuracy imu;
  GpsAccuracy gps;
  MotorAccuracy motor;

  bool operator==(const InstrumentSettings&) const = default;
};

}  // namespace navcal::config
