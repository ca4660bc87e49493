// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/louder_channels.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace navcal::diagnosis {
namespace {

constexpr std::string_view kUnit = "noise power";

Floor floor_of_channel(const NominalBank& bank, std::size_t channel) {
  std::vector<double> powers;
  for (const auto& one : bank.channel_powers) {
    if (one[channel] >= 0) powers.push_back(one[channel]);
  }
  return floor_of(powers);
}

}  // namespace

std::vector<gap::WhereEntry> louder_channels(const RecordingFit& fit, const NominalBank& bank) {
  std::vector<gap::WhereEntry> louder;
  for (std::size_t c = 0; c < identify::kChannels; ++c) {
    const double power = fit.channel_power[c];
    if (power < 0) continue;
    const Floor floor = floor_of_channel(bank, c);
    if (power <= floor.limit()) continue;
    const double z = (power - floor.mean) / std::max(floor.std, 0.02 * floor.mean);
    louder.push_back({std::string(identify::kChannelDescriptions[c].name), "whole recording", power, floor.mean,
                      std::string(kUnit), std::erfc(std::min(z, 30.0) / std::numbers::sqrt2)});
  }
  std::sort(louder.begin(), louder.end(),
            [](const auto& a, const auto& b) { return a.gap / a.floor > b.gap / b.floor; });
  return louder;
}

}  // namespace navcal::diagnosis
