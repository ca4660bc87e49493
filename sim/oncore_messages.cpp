#include "sim/oncore_messages.h"

#include <algorithm>

#include "protocols/nmea_encode.h"
#include "protocols/oncore_encode.h"
#include "sim/constellation.h"

namespace navcal::sim {
namespace {

namespace wire = protocols::oncore;

constexpr std::uint8_t kUsedForPosition = 8;

wire::Position position_of(const GpsReading& reading, const ReceiverTime& time) {
  wire::Position position;
  position.date = date_of(time.reported_ns);
  position.time = time_of(time.reported_ns);
  position.filtered = {reading.latitude_deg, reading.longitude_deg, reading.height_m, std::nullopt};
  position.unfiltered = position.filtered;
  position.speed_m_s = reading.speed_m_s;
  position.speed_3d_m_s = reading.speed_m_s;
  position.heading_deg = reading.course_deg;
  position.dop = reading.fixed ? kSkyPdop : 0;
  position.visible = static_cast<std::uint8_t>(kSky.size());
  position.tracked = reading.fixed ? kSkyUsed : std::uint8_t{0};
  position.fix = reading.fixed ? protocols::Fix::fix_3d : protocols::Fix::acquiring;
  position.antenna = wire::Antenna::ok;
  position.channel_count = kSky.size();
  for (std::size_t i = 0; i < kSky.size(); ++i) {
    position.channels[i].satellite = kSky[i].prn;
    if (!reading.fixed) continue;
    position.channels[i].mode = kSky[i].used ? kUsedForPosition : std::uint8_t{0};
    position.channels[i].cn0 = kSky[i].cn0_dBHz;
  }
  position.temperature_C = 25;
  position.utc = wire::UtcState{true, time.leap_seconds_known,
                                static_cast<std::int8_t>(time.leap_seconds_known ? time.leap_seconds : 0)};
  return position;
}

}  // namespace

std::vector<std::uint8_t> ha_message(const GpsReading& reading, const ReceiverTime& time) {
  return wire::encode_ha(position_of(reading, time));
}

std::vector<std::uint8_t> ea_message(const GpsReading& reading, const ReceiverTime& time) {
  return wire::encode_ea(position_of(reading, time));
}

std::vector<std::uint8_t> bb_message() {
  wire::VisibleSatellites satellites;
  satellites.visible = static_cast<std::uint8_t>(kSky.size());
  satellites.count = kSky.size();
  std::transform(kSky.begin(), kSky.end(), satellites.satellites.begin(), [](const SkySatellite& satellite) {
    return wire::VisibleSatellites::Satellite{satellite.prn, 0, satellite.elevation_deg, satellite.azimuth_deg, 0};
  });
  return wire::encode_bb(satellites);
}

std::vector<std::uint8_t> bo_message(const ReceiverTime& time) {
  if (!time.leap_seconds_known) return wire::encode_bo({});
  return wire::encode_bo({static_cast<std::int8_t>(time.leap_seconds)});
}

std::vector<std::uint8_t> cj_message() {
  return wire::encode_cj(
      "COPYRIGHT: NONE        \r\nSFTW P/N # EMULATED    \r\nSOFTWARE VER # 1       \r\n"
      "SOFTWARE REV # 0       \r\nMODEL #    NAVCAL      \r\nSERIAL #   00000001    \r\n");
}

std::vector<std::uint8_t> nmea_sentences(const GpsReading& reading, const ReceiverTime& time) {
  namespace nmea = protocols::nmea;
  nmea::Navigation navigation;
  navigation.date = date_of(time.reported_ns);
  navigation.time = time_of(time.reported_ns);
  navigation.fix = reading.fixed ? protocols::Fix::fix_3d : protocols::Fix::none;
  navigation.latitude_deg = reading.latitude_deg;
  navigation.longitude_deg = reading.longitude_deg;
  navigation.altitude_m = reading.height_m;
  navigation.speed_m_s = reading.speed_m_s;
  navigation.course_deg = reading.course_deg;
  navigation.pdop = kSkyPdop;
  navigation.hdop = kSkyHdop;
  navigation.vdop = kSkyVdop;
  nmea::Satellites satellites;
  for (const SkySatellite& satellite : kSky) {
    satellites.push_back({satellite.prn, satellite.elevation_deg, satellite.azimuth_deg, satellite.cn0_dBHz,
                          reading.fixed && satellite.used});
  }
  std::vector<std::uint8_t> sentences;
  for (const auto& sentence : {nmea::encode_gga(navigation, satellites), nmea::encode_rmc(navigation),
                               nmea::encode_gsa(navigation, satellites), nmea::encode_gsv(satellites)}) {
    sentences.insert(sentences.end(), sentence.begin(), sentence.end());
  }
  return sentences;
}

}  // namespace navcal::sim
