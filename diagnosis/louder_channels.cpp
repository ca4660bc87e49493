// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/louder_channels.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "diagnosis/limits.h"

namespace navcal::diagnosis {
namespace {

constexpr std::string_view kUnit = "noise power";

Floor floor_of_channel(std::span<const RecordingPower> nominal, std::size_t channel) {
  std::vector<double> powers;
  for (const RecordingPower& one : nominal) {
    if (one.of_channel[channel] >= 0) powers.push_back(one.of_channel[channel]);
  }
  return floor_of(powers);
}

}  // namespace

std::vector<gap::WhereEntry> louder_channels(const RecordingPower& of, std::span<const RecordingPower> nominal) {
  std::vector<gap::WhereEntry> louder;
  for (std::size_t c = 0; c < identify::kChannels; ++c) {
    const double power = of.of_channel[c];
    if (power < 0) continue;
    Floor floor = floor_of_channel(nominal, c);
    // A mean square of few readings scatters by itself.
    if (of.readings_of_channel[c] > 0)
      floor.std = std::hypot(floor.std, floor.mean * std::sqrt(2 / of.readings_of_channel[c]));
    // One of several tells nothing of the scatter among them.
    if ((floor.count == 1 && nominal.size() > 1) || power <= floor.limit(kNominalFactor)) continue;
    const double z = (power - floor.mean) / std::max(floor.std, 0.02 * floor.mean);
    louder.push_back({std::string(identify::kChannelDescriptions[c].name), "whole recording", power, floor.mean,
                      std::string(kUnit), std::erfc(std::min(z, 30.0) / std::numbers::sqrt2)});
  }
  std::sort(louder.begin(), louder.end(),
            [](const auto& a, const auto& b) { return a.gap / a.floor > b.gap / b.floor; });
  return louder;
}

}  // namespace navcal::diagnosis
