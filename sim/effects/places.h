// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "sim/state.h"

// The quantities on which effects act.
namespace navcal::sim {

/// Tilt that the inclinometer senses or reports.
struct Tilt {
  double roll_rad = 0, pitch_rad = 0;
};

/// Gyro rates of the inertial card, in the order of its channels: A-x, A-z, B-y, B-z.
using GyroRates = std::array<double, 4>;
/// Body axis that each of these gyros senses.
inline constexpr std::array<std::size_t, 4> kGyroAxes{0, 2, 1, 2};

/// All channels of the inertial card as its converter sees them.
using CardVoltages_mV = std::array<double, 8>;

/// Motion of the GPS antenna, in world axes.
struct AntennaMotion {
  Vector3 position_m{};
  Vector3 velocity_m_s{};
};

/// Extra age of an instrument's data relative to their time, beyond its nominal latency.
struct Delays {
  double card_s = 0;
  double gps_s = 0;
};

enum class Instrument : std::uint8_t { compass, imu, gps, motor };
inline constexpr std::size_t kInstruments = 4;

/// Transmission of a frame over its line.
struct Transmission {
  int copies = 1;           ///< 0: it is lost
  double late_s = 0;        ///< the host takes it so much later
  double held_until_s = 0;  ///< the host takes nothing before this time of the mission
};

}  // namespace navcal::sim
