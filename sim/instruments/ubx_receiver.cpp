// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/ubx_receiver.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/angles.h"
#include "base/durations.h"
#include "protocols/ubx_navigation.h"
#include "protocols/ubx_receiver.h"
#include "sim/instruments/constellation.h"
#include "sim/instruments/oncore_messages.h"

namespace navcal::sim {
namespace {

/// The epoch of a u-blox receiver by its own knowledge.
struct UbxEpoch {
  std::int64_t utc_ns = 0;          ///< to which the receiver rounds it
  std::int64_t clock_error_ns = 0;  ///< by which it was measured later
  int leap_seconds = 18;
  bool knows_time = false;
};

namespace ubx = protocols::ubx;

constexpr std::int64_t kGpsEpoch_s = 315'964'800;  // 1980-01-06 as a Unix time
constexpr std::int64_t kUbxWeek_ms = 7LL * 86400 * 1000;
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

/// `takes_valset`: of generation 9.
std::vector<std::uint8_t> version_message(bool takes_valset) {
  if (takes_valset)
    return ubx::encode_mon_ver({"EXT CORE 1.00 (navcal)", "00190000", {"FWVER=EMU 1.00", "PROTVER=27.11"}});
  return ubx::encode_mon_ver({"EXT CORE 3.01 (navcal)", "00080000", {"FWVER=EMU 3.01", "PROTVER=18.00"}});
}

constexpr std::int64_t kUbxReply_ns = 20 * base::kMillisecond_ns;  // from a command to its answer

/// The messages that it can send, in the order in which it sends them.
constexpr ubx::MessageCode kUbxMessages[] = {ubx::kNavDop, ubx::kNavPvt, ubx::kNavTimeGps, ubx::kNavSat};

bool is_sentence(ubx::MessageCode code) { return code >> 8 == 0xF0; }

}  // namespace

UbxReceiver::UbxReceiver(const Options& options, const Motion& motion)
    : CommandedDevice(options.baud), options_(options), receiver_(options.receiver, motion, options.seed) {}

std::int64_t UbxReceiver::latency_ns() const { return std::llround(options_.receiver.gps.timing.latency_s * 1e9); }

void UbxReceiver::power_on(std::int64_t t_ns) {
  receiver_.power_on(t_ns);
  forget();
  configuration_ = {};
  epoch_ns_ = (t_ns / base::kSecond_ns + 1) * base::kSecond_ns;
  epochs_ = 0;
  ever_fixed_ = false;
}

void UbxReceiver::obey(std::int64_t t_ns, const protocols::Frame& command) {
  const auto code = ubx::code_of(command).value_or(0);
  const std::int64_t due_ns = t_ns + kUbxReply_ns;
  if (code == ubx::kMonVer) answer(due_ns, version_message(options_.generation == Generation::nine));
  if (code >> 8 != 0x06) return;
  bool accepted = false;
  if (const auto values = ubx::decode_cfg_valset(command.bytes)) {
    accepted = options_.generation == Generation::nine && set(*values);
  } else if (const auto rate = ubx::decode_cfg_msg(command.bytes)) {
    accepted = set(*rate);
  } else if (const auto epochs = ubx::decode_cfg_rate(command.bytes)) {
    accepted = epochs->interval_ms >= 25;
    if (accepted) configuration_.interval_ns = epochs->interval_ms * base::kMillisecond_ns;
  }
  answer(due_ns, ubx::encode_acknowledgement({code, accepted}));
}

bool UbxReceiver::set(const ubx::ValueSet& values) {
  Configuration wanted = configuration_;
  for (const auto& [key, value] : values.items) {
    bool known = key == ubx::kRateMeasurement_ms || key == ubx::kRateNavigation;
    if (key == ubx::kRateMeasurement_ms)
      wanted.interval_ns = static_cast<std::int64_t>(value) * base::kMillisecond_ns;
    for (const auto port : {ubx::ReceiverPort::uart1, ubx::ReceiverPort::uart2, ubx::ReceiverPort::usb}) {
      const bool here = port == options_.port;
      if (key == ubx::key_of_ubx_output(port)) {
        known = true;
        if (here) wanted.ubx = value != 0;
      }
      if (key == ubx::key_of_nmea_output(port)) {
        known = true;
        if (here) wanted.nmea = value != 0;
      }
      for (const ubx::MessageCode code : kUbxMessages) {
        if (key != ubx::key_of_message(code, port)) continue;
        known = true;
        if (here) wanted.epochs[code] = static_cast<std::uint8_t>(value);
      }
    }
    if (!known) return false;  // one unknown key, and nothing is set
  }
  configuration_ = wanted;
  return true;
}

bool UbxReceiver::set(const ubx::MessageRate& rate) {
  if (is_sentence(rate.code)) {
    // Enough for a start-up that turns all of them off.
    if (rate.epochs == 0) configuration_.nmea = false;
    return true;
  }
  const bool has =
      options_.generation != Generation::six || (rate.code != ubx::kNavPvt && rate.code != ubx::kNavSat);
  const bool known = std::ranges::find(kUbxMessages, rate.code) != std::end(kUbxMessages);
  if (!has || !known) return false;
  configuration_.epochs[rate.code] = rate.epochs;
  return true;
}

std::vector<std::uint8_t> UbxReceiver::message(MessageCode code, const GpsReading& reading) const {
  const UbxEpoch epoch{epoch_ns_, options_.clock_error_ns, options_.leap_seconds, ever_fixed_};
  if (code == ubx::kNavDop) return dop_message(reading, epoch);
  if (code == ubx::kNavPvt) return pvt_message(reading, epoch, options_.receiver.gps);
  if (code == ubx::kNavTimeGps) return timegps_message(epoch);
  return sat_message(reading, epoch);
}

void UbxReceiver::act(std::int64_t now_ns, std::vector<Emission>& out) {
  GpsReading reading = receiver_.measure(epoch_ns_ + options_.clock_error_ns);
  reading.utc_ns = epoch_ns_;
  ever_fixed_ = ever_fixed_ || reading.fixed;
  if (configuration_.nmea) {
    send(now_ns, nmea_sentences(reading, {epoch_ns_, options_.leap_seconds, true}), out);
  }
  for (const MessageCode code : kUbxMessages) {
    const auto wanted = configuration_.epochs.find(code);
    if (!configuration_.ubx || wanted == configuration_.epochs.end() || wanted->second == 0) continue;
    if (epochs_ % wanted->second == 0) send(now_ns, message(code, reading), out);
  }
  ++epochs_;
  epoch_ns_ += configuration_.interval_ns;
}

}  // namespace navcal::sim
