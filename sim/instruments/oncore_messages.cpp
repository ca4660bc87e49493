// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/oncore_messages.h"

#include <algorithm>
#include <string>

#include "protocols/nmea_vehicle.h"
#include "protocols/oncore_encode.h"
#include "sim/instruments/constellation.h"

namespace navcal::sim {
namespace {

namespace oncore = protocols::oncore;

constexpr std::uint8_t kUsedForPosition = 8;

/// The first fixes are of three satellites, which is too few for the height.
bool is_flat(const GpsReading& reading) { return reading.fixed && reading.degraded > 1.4; }

bool in_use(const GpsReading& reading, std::size_t satellite) {
  return reading.fixed && kSky[satellite].used && satellite < (is_flat(reading) ? kSkyUsedFlat : kSkyUsed);
}

protocols::Fix fix_of(const GpsReading& reading) {
  return is_flat(reading) ? protocols::Fix::fix_2d : protocols::Fix::fix_3d;
}

oncore::Position position_of(const GpsReading& reading, const ReceiverTime& time) {
  oncore::Position position;
  position.date = protocols::date_of(time.reported_ns);
  position.time = protocols::time_of_day(time.reported_ns);
  position.filtered = {reading.latitude_deg, reading.longitude_deg, reading.height_m, std::nullopt};
  position.unfiltered = position.filtered;
  position.speed_m_s = reading.speed_m_s;
  position.speed_3d_m_s = reading.speed_m_s;
  position.heading_deg = reading.course_deg;
  const bool flat = is_flat(reading);
  position.dop = reading.fixed ? (flat ? kSkyHdop : kSkyPdop) * reading.degraded : 0;
  position.visible = static_cast<std::uint8_t>(kSky.size());
  position.tracked = reading.fixed ? (flat ? kSkyUsedFlat : kSkyUsed) : std::uint8_t{0};
  position.fix = reading.fixed ? fix_of(reading) : protocols::Fix::acquiring;
  position.no_almanac = reading.cold;
  position.antenna = oncore::Antenna::ok;
  position.channel_count = kSky.size();
  for (std::size_t i = 0; i < kSky.size(); ++i) {
    position.channels[i].satellite = kSky[i].prn;
    if (!reading.fixed) continue;
    position.channels[i].mode = in_use(reading, i) ? kUsedForPosition : std::uint8_t{0};
    position.channels[i].cn0 = kSky[i].cn0_dBHz;
  }
  position.temperature_C = 25;
  position.utc = oncore::UtcState{true, time.leap_seconds_known,
                                  static_cast<std::int8_t>(time.leap_seconds_known ? time.leap_seconds : 0)};
  return position;
}

}  // namespace

std::vector<std::uint8_t> ha_message(const GpsReading& reading, const ReceiverTime& time) {
  return oncore::encode_ha(position_of(reading, time));
}

std::vector<std::uint8_t> ea_message(const GpsReading& reading, const ReceiverTime& time) {
  return oncore::encode_ea(position_of(reading, time));
}

std::vector<std::uint8_t> bb_message() {
  oncore::VisibleSatellites satellites;
  satellites.visible = static_cast<std::uint8_t>(kSky.size());
  satellites.count = kSky.size();
  std::ranges::transform(kSky, satellites.satellites.begin(), [](const SkySatellite& satellite) {
    return oncore::VisibleSatellites::Satellite{satellite.prn, 0, satellite.elevation_deg, satellite.azimuth_deg,
                                                0};
  });
  return oncore::encode_bb(satellites);
}

std::vector<std::uint8_t> bo_message(const ReceiverTime& time) {
  if (!time.leap_seconds_known) return oncore::encode_bo({});
  return oncore::encode_bo({static_cast<std::int8_t>(time.leap_seconds)});
}

std::vector<std::uint8_t> cj_message() {
  return oncore::encode_cj(
      "COPYRIGHT: NONE        \r\nSFTW P/N # EMULATED    \r\nSOFTWARE VER # 1       \r\n"
      "SOFTWARE REV # 0       \r\nMODEL #    NAVCAL      \r\nSERIAL #   00000001    \r\n");
}

std::vector<std::uint8_t> nmea_sentences(const GpsReading& reading, const ReceiverTime& time) {
  namespace nmea = protocols::nmea;
  nmea::StatedPosition position;
  position.date = protocols::date_of(time.reported_ns);
  position.time = protocols::time_of_day(time.reported_ns);
  if (reading.fixed) {
    position.fix = fix_of(reading);
    position.latitude_deg = reading.latitude_deg;
    position.longitude_deg = reading.longitude_deg;
    position.altitude_m = reading.height_m;
    position.geoid_separation_m = 0;
    position.speed_m_s = reading.speed_m_s;
    position.course_deg = reading.course_deg;
    position.pdop = kSkyPdop * reading.degraded;
    position.hdop = kSkyHdop * reading.degraded;
    position.vdop = kSkyVdop * reading.degraded;
  }
  std::vector<nmea::StatedSatellite> satellites;
  std::vector<std::uint16_t> used;
  for (std::size_t i = 0; i < kSky.size(); ++i) {
    const SkySatellite& satellite = kSky[i];
    satellites.push_back({satellite.prn, satellite.elevation_deg, satellite.azimuth_deg, satellite.cn0_dBHz});
    if (in_use(reading, i)) used.push_back(satellite.prn);
  }
  position.satellites = static_cast<unsigned>(used.size());
  std::string sentences;
  append_gga(sentences, position);
  append_rmc(sentences, position);
  append_gsa(sentences, position, used);
  append_gsv(sentences, position.talker, satellites);
  return {sentences.begin(), sentences.end()};
}

}  // namespace navcal::sim
