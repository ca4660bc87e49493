// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/ubx_messages.h"

#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "base/durations.h"
#include "protocols/ubx_navigation.h"
#include "protocols/ubx_receiver.h"
#include "sim/instruments/constellation.h"

namespace navcal::sim {
namespace {

namespace ubx = protocols::ubx;

constexpr std::int64_t kGpsEpoch_s = 315'964'800;  // 1980-01-06 as a Unix time
constexpr std::int64_t kUbxWeek_ms = 7 * 86400 * 1000LL;
constexpr double kSettledTime_s = 30e-9;
constexpr double kUnknownError_m = 4294967.295;  // the largest that the message holds
constexpr double kNoDop = 99.99;

std::int64_t gps_ms(const UbxEpoch& epoch) {
  return epoch.utc_ns / base::kMillisecond_ns - (kGpsEpoch_s - epoch.leap_seconds) * 1000;
}

std::uint32_t time_of_week_ms(const UbxEpoch& epoch) {
  return static_cast<std::uint32_t>(gps_ms(epoch) % kUbxWeek_ms);
}

/// The first fixes are of three satellites, which is too few for the height.
bool is_flat_fix(const GpsReading& reading) { return reading.degraded > 1.4; }

std::uint8_t satellites_used(const GpsReading& reading) {
  if (!reading.fixed) return 0;
  return is_flat_fix(reading) ? kSkyUsedFlat : kSkyUsed;
}

}  // namespace

std::vector<std::uint8_t> pvt_message(const GpsReading& reading, const UbxEpoch& epoch,
                                      const devices::GpsModel& gps) {
  ubx::NavPvt pvt;
  pvt.time_of_week_ms = time_of_week_ms(epoch);
  pvt.date = protocols::date_of(epoch.utc_ns);
  const protocols::TimeOfDay time = protocols::time_of_day(epoch.utc_ns);
  pvt.hour = time.hour;
  pvt.minute = time.minute;
  pvt.second = time.second;
  // The fraction of the second is in the correction, with the error of the clock.
  pvt.nanosecond = static_cast<std::int32_t>(time.nanosecond + epoch.clock_error_ns);
  pvt.date_valid = pvt.time_valid = pvt.fully_resolved = epoch.knows_time;
  pvt.time_accuracy_s = epoch.knows_time ? kSettledTime_s : 4;
  pvt.satellites = satellites_used(reading);
  pvt.longitude_deg = reading.longitude_deg;
  pvt.latitude_deg = reading.latitude_deg;
  pvt.height_m = pvt.height_msl_m = reading.height_m;  // it has no geoid
  pvt.fix_ok = reading.fixed;
  if (!reading.fixed) {
    pvt.horizontal_accuracy_m = pvt.vertical_accuracy_m = pvt.speed_accuracy_m_s = kUnknownError_m;
    pvt.pdop = kNoDop;
    pvt.position_invalid = true;
    return ubx::encode_nav_pvt(pvt);
  }
  pvt.fix_type = is_flat_fix(reading) ? 2 : 3;
  pvt.horizontal_accuracy_m = std::numbers::sqrt2 * gps.position_noise_m * reading.degraded;
  pvt.vertical_accuracy_m = gps.position_noise_m * reading.degraded;
  const double course_rad = reading.course_deg * base::kRadiansPerDegree;
  pvt.velocity_ned_m_s = {reading.speed_m_s * std::cos(course_rad), reading.speed_m_s * std::sin(course_rad), 0};
  pvt.ground_speed_m_s = reading.speed_m_s;
  pvt.heading_of_motion_deg = reading.course_deg;
  pvt.speed_accuracy_m_s = gps.velocity_noise_m_s * reading.degraded;
  pvt.heading_accuracy_deg =
      std::min(180.0, base::kDegreesPerRadian * pvt.speed_accuracy_m_s / std::max(reading.speed_m_s, 1e-3));
  pvt.pdop = kSkyPdop * reading.degraded;
  return ubx::encode_nav_pvt(pvt);
}

std::vector<std::uint8_t> dop_message(const GpsReading& reading, const UbxEpoch& epoch) {
  ubx::NavDop dop;
  dop.time_of_week_ms = time_of_week_ms(epoch);
  const auto of = [&](double value) { return reading.fixed ? value * reading.degraded : kNoDop; };
  dop.position = of(kSkyPdop);
  dop.horizontal = of(kSkyHdop);
  dop.vertical = of(kSkyVdop);
  dop.time = of(kSkyHdop);
  dop.geometric = of(std::hypot(kSkyPdop, kSkyHdop));
  dop.northing = dop.easting = of(kSkyHdop / std::numbers::sqrt2);
  return ubx::encode_nav_dop(dop);
}

std::vector<std::uint8_t> timegps_message(const UbxEpoch& epoch) {
  ubx::NavTimeGps time;
  time.time_of_week_ms = time_of_week_ms(epoch);
  time.fraction_ns = static_cast<std::int32_t>(epoch.clock_error_ns);
  time.week = static_cast<std::int16_t>(gps_ms(epoch) / kUbxWeek_ms);
  time.leap_s = static_cast<std::int8_t>(epoch.leap_seconds);
  time.time_of_week_valid = time.week_valid = time.leap_valid = epoch.knows_time;
  time.time_accuracy_s = epoch.knows_time ? kSettledTime_s : 4;
  return ubx::encode_nav_timegps(time);
}

std::vector<std::uint8_t> sat_message(const GpsReading& reading, const UbxEpoch& epoch) {
  ubx::NavSat sat;
  sat.time_of_week_ms = time_of_week_ms(epoch);
  sat.count = kSky.size();
  for (std::size_t i = 0; i < kSky.size(); ++i) {
    ubx::NavSat::Satellite& satellite = sat.satellites[i];
    satellite.number = kSky[i].prn;
    satellite.elevation_deg = static_cast<std::int8_t>(kSky[i].elevation_deg);
    satellite.azimuth_deg = static_cast<std::int16_t>(kSky[i].azimuth_deg);
    satellite.health = 1;
    if (!reading.fixed) continue;
    satellite.cn0_dBHz = kSky[i].cn0_dBHz;
    satellite.quality = 7;
    satellite.used = kSky[i].used && i < satellites_used(reading);
  }
  return ubx::encode_nav_sat(sat);
}

std::vector<std::uint8_t> version_message(bool takes_valset) {
  if (takes_valset)
    return ubx::encode_mon_ver({"EXT CORE 1.00 (navcal)", "00190000", {"FWVER=EMU 1.00", "PROTVER=27.11"}});
  return ubx::encode_mon_ver({"EXT CORE 3.01 (navcal)", "00080000", {"FWVER=EMU 3.01", "PROTVER=18.00"}});
}

}  // namespace navcal::sim
