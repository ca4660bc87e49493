// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/gps_receiver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "sim/rotation.h"

namespace navcal::sim {

using std::chrono::nanoseconds;
using UtcTime = std::chrono::sys_time<nanoseconds>;

GpsReceiver::GpsReceiver(const Options& options, const Motion& motion, std::uint64_t seed)
    : options_(options),
      motion_(motion),
      effects_(options.effects != nullptr ? *options.effects : none_),
      noise_(seed) {}

void GpsReceiver::power_on(std::int64_t t_ns) {
  powered_ns_ = t_ns;
  electronics_.power_on(t_ns, motion_);
  fix_due_ns_.reset();
  last_ = {};
  last_.latitude_deg = options_.origin.latitude_deg;
  last_.longitude_deg = options_.origin.longitude_deg;
  last_.height_m = options_.origin.height_m;
}

bool GpsReceiver::fixes(std::int64_t second_ns) {
  if (motion_.at(second_ns).position_m[2] > options_.gps.antenna_depth_m) {
    fix_due_ns_.reset();
    return false;
  }
  if (!fix_due_ns_) {
    const double search_s = noise_.uniform(options_.gps.least_search_s, options_.gps.longest_search_s);
    fix_due_ns_ = std::max(second_ns, powered_ns_) + std::llround(search_s * 1e9);
    fixes_ = 0;
  }
  return second_ns >= *fix_due_ns_;
}

GpsReading GpsReceiver::measure(std::int64_t second_ns) {
  last_.utc_ns = second_ns;
  last_.speed_m_s = last_.course_deg = 0;
  last_.fixed = fixes(second_ns);
  if (!last_.fixed) return last_;
  last_.degraded = options_.gps.noise_factor(fixes_++);

  const double late_s = effects_.delays(effects_.time_s(second_ns)).gps_s;
  const std::int64_t t_ns = second_ns - std::llround(late_s * 1e9);
  const State state = motion_.at(t_ns);
  const Instant now = effects_.instant(t_ns, state, electronics_.temperature_C(t_ns, motion_));
  AntennaMotion antenna{state.position_m, R_world_from_body(state.euler_rad) * state.velocity_body_m_s};
  for (std::size_t i = 0; i < 2; ++i) antenna.velocity_m_s[i] += state.current_m_s[i];
  if (is_away_from_origin(options_.gps.mounting)) {
    const Matrix3 world_from_body = R_world_from_body(state.euler_rad);
    const Vector3 arm_m = world_from_body * options_.gps.mounting.position_m;
    const Vector3 turning_m_s = world_from_body * cross(state.rate_rad_s, options_.gps.mounting.position_m);
    for (std::size_t i = 0; i < 3; ++i) {
      antenna.position_m[i] += arm_m[i];
      antenna.velocity_m_s[i] += turning_m_s[i];
    }
  }
  effects_.antenna(now, antenna);

  const double louder = last_.degraded * effects_.noise(Instrument::gps, now.time_s);
  for (double& coordinate : antenna.position_m)
    coordinate += noise_.normal(options_.gps.position_noise_m * louder);
  const Vector3 geographic = geodetic(options_.origin, antenna.position_m);
  last_.latitude_deg = geographic[0];
  last_.longitude_deg = geographic[1];
  last_.height_m = geographic[2];
  const double north = antenna.velocity_m_s[0] + noise_.normal(options_.gps.velocity_noise_m_s * louder);
  const double east = antenna.velocity_m_s[1] + noise_.normal(options_.gps.velocity_noise_m_s * louder);
  last_.speed_m_s = std::hypot(north, east);
  last_.course_deg = std::atan2(east, north) * 180 / std::numbers::pi;
  if (last_.course_deg < 0) last_.course_deg += 360;
  return last_;
}

protocols::Date date_of(std::int64_t utc_ns) {
  const std::chrono::year_month_day day(std::chrono::floor<std::chrono::days>(UtcTime(nanoseconds(utc_ns))));
  return {static_cast<std::uint16_t>(static_cast<int>(day.year())),
          static_cast<std::uint8_t>(static_cast<unsigned>(day.month())),
          static_cast<std::uint8_t>(static_cast<unsigned>(day.day()))};
}

protocols::TimeOfDay time_of(std::int64_t utc_ns) {
  const UtcTime instant{nanoseconds(utc_ns)};
  const std::chrono::hh_mm_ss time(instant - std::chrono::floor<std::chrono::days>(instant));
  return {static_cast<std::uint8_t>(time.hours().count()), static_cast<std::uint8_t>(time.minutes().count()),
          static_cast<std::uint8_t>(time.seconds().count()),
          static_cast<std::uint32_t>(time.subseconds().count())};
}

}  // namespace navcal::sim
