// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/tcm2_score.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace navcal::sim {
namespace {

constexpr double kMagnitude = 0.05;
constexpr double kTiltForAPoint_rad = 5 * std::numbers::pi / 180;

}  // namespace

void Tcm2Score::add(const Tcm2Reading& reading) {
  const double sector = reading.heading_rad / (2 * std::numbers::pi) * kSectors;
  headings_.set(std::min(static_cast<std::size_t>(std::max(sector, 0.0)), kSectors - 1));
  least_pitch_rad_ = std::min(least_pitch_rad_, reading.pitch_rad);
  greatest_pitch_rad_ = std::max(greatest_pitch_rad_, reading.pitch_rad);
  least_roll_rad_ = std::min(least_roll_rad_, reading.roll_rad);
  greatest_roll_rad_ = std::max(greatest_roll_rad_, reading.roll_rad);
}

protocols::tcm2::CalibrationScore Tcm2Score::score() const {
  if (headings_.none()) return {};
  const double tilt = greatest_pitch_rad_ - least_pitch_rad_ + greatest_roll_rad_ - least_roll_rad_;
  const auto points = [](double value) {
    return static_cast<std::uint8_t>(std::clamp(std::floor(value), 0.0, 9.0));
  };
  return {points(9.0 * static_cast<double>(headings_.count()) / kSectors), points(tilt / kTiltForAPoint_rad),
          kMagnitude};
}

}  // namespace navcal::sim
