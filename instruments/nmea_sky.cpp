// SPDX-License-Identifier: Apache-2.0
#include "instruments/nmea_sky.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace navcal::instruments {

void NmeaSky::add_used(const protocols::nmea::Gsa& gsa) {
  if (std::exchange(used_is_whole_, false) || used_.size() >= SkySample::kMaxSatellites) used_.clear();
  used_.insert(used_.end(), gsa.satellites.begin(), gsa.satellites.begin() + static_cast<long>(gsa.count));
}

bool NmeaSky::is_used(std::uint16_t number) const {
  return std::find(used_.begin(), used_.end(), number) != used_.end();
}

std::optional<SkySample> NmeaSky::add(std::string_view talker, const protocols::nmea::Gsv& gsv) {
  used_is_whole_ = true;
  const auto who = static_cast<std::uint16_t>(talker.size() < 2 ? 0 : talker[0] << 8 | talker[1]);
  if (gsv.sentence == 1) {  // a new group of this talker: its former satellites are dropped
    std::size_t kept = 0;
    for (std::size_t i = 0; i < sky_.count; ++i) {
      if (talkers_[i] == who) continue;
      talkers_[kept] = talkers_[i];
      sky_.satellites[kept++] = sky_.satellites[i];
    }
    sky_.count = kept;
  }
  for (std::size_t i = 0; i < gsv.count && sky_.count < SkySample::kMaxSatellites; ++i) {
    const auto& seen = gsv.satellites[i];
    SkySample::Satellite satellite;
    satellite.prn = seen.number;
    if (seen.elevation_deg) satellite.elevation_deg = *seen.elevation_deg;
    if (seen.azimuth_deg) satellite.azimuth_deg = *seen.azimuth_deg;
    if (seen.cn0_dBHz) satellite.cn0_dBHz = *seen.cn0_dBHz;
    satellite.used = is_used(seen.number);
    talkers_[sky_.count] = who;
    sky_.satellites[sky_.count++] = satellite;
  }
  if (gsv.sentence < gsv.sentences) return std::nullopt;
  return sky_;
}

}  // namespace navcal::instruments
