// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/thrusters/outputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace navcal::reference::thrusters {
namespace {

constexpr double kNeutral_us = 1500, kHalfRange_us = 400;

/// Of the command on this side of neutral, in one microsecond.
double units_per_us(const PlannedThruster& thruster, bool above) {
  if (thruster.unit == OrderUnit::microseconds) return 1;
  return (above ? thruster.high - thruster.neutral() : thruster.neutral() - thruster.low) / kHalfRange_us;
}

}  // namespace

std::vector<std::uint8_t> output_line(const std::vector<int>& pulses_us) {
  if (pulses_us.size() > kOutputChannels)
    throw std::invalid_argument("more than eight outputs cannot be reported");
  std::string body = "PNCAO";
  for (std::size_t i = 0; i < kOutputChannels; ++i) {
    body += ',';
    if (i < pulses_us.size()) body += std::to_string(pulses_us[i]);
  }
  unsigned sum = 0;
  for (const char letter : body) sum ^= static_cast<unsigned char>(letter);
  constexpr std::array kHex{'0', '1', '2', '3', '4', '5', '6', '7', '8', '9', 'A', 'B', 'C', 'D', 'E', 'F'};
  const std::string line = '$' + body + '*' + kHex[sum >> 4U] + kHex[sum & 15U] + "\r\n";
  return {line.begin(), line.end()};
}

double pulse_of(const PlannedThruster& thruster, double command) {
  const double away = std::clamp(command, thruster.low, thruster.high) - thruster.neutral();
  const double per_us = units_per_us(thruster, away > 0);
  return kNeutral_us + (per_us > 0 ? away / per_us : 0);
}

double command_of(const PlannedThruster& thruster, double pulse_us) {
  const double away_us = pulse_us - kNeutral_us;
  return thruster.neutral() + away_us * units_per_us(thruster, away_us > 0);
}

}  // namespace navcal::reference::thrusters
