#include "sim/gps_receiver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "sim/rotation.h"

namespace navcal::sim {

using std::chrono::nanoseconds;
using Instant = std::chrono::sys_time<nanoseconds>;

GpsReceiver::GpsReceiver(const Options& options, const Motion& motion, std::uint64_t seed)
    : options_(options), motion_(motion), noise_(seed) {}

void GpsReceiver::power_on(std::int64_t t_ns) {
  powered_ns_ = t_ns;
  fix_due_ns_.reset();
  last_ = {};
  last_.latitude_deg = options_.origin.latitude_deg;
  last_.longitude_deg = options_.origin.longitude_deg;
  last_.height_m = options_.origin.height_m;
}

GpsReading GpsReceiver::measure(std::int64_t second_ns) {
  const State state = motion_.at(second_ns);
  last_.utc_ns = second_ns;
  last_.fixed = false;
  last_.speed_m_s = last_.course_deg = 0;
  if (state.position_m[2] > options_.antenna_depth_m) {
    fix_due_ns_.reset();
    return last_;
  }
  if (!fix_due_ns_) {
    const double search_s = noise_.uniform(options_.least_search_s, options_.longest_search_s);
    fix_due_ns_ = std::max(second_ns, powered_ns_) + std::llround(search_s * 1e9);
  }
  if (second_ns < *fix_due_ns_) return last_;
  last_.fixed = true;
  Vector3 place = state.position_m;
  for (double& coordinate : place) coordinate += noise_.normal(options_.position_noise_m);
  const Vector3 geographic = geodetic(options_.origin, place);
  last_.latitude_deg = geographic[0];
  last_.longitude_deg = geographic[1];
  last_.height_m = geographic[2];
  const Vector3 velocity = R_world_from_body(state.euler_rad) * state.velocity_body_m_s;
  const double north = velocity[0] + noise_.normal(options_.velocity_noise_m_s);
  const double east = velocity[1] + noise_.normal(options_.velocity_noise_m_s);
  last_.speed_m_s = std::hypot(north, east);
  last_.course_deg = std::atan2(east, north) * 180 / std::numbers::pi;
  if (last_.course_deg < 0) last_.course_deg += 360;
  return last_;
}

protocols::Date date_of(std::int64_t utc_ns) {
  const std::chrono::year_month_day day(std::chrono::floor<std::chrono::days>(Instant(nanoseconds(utc_ns))));
  return {static_cast<std::uint16_t>(static_cast<int>(day.year())),
          static_cast<std::uint8_t>(static_cast<unsigned>(day.month())),
          static_cast<std::uint8_t>(static_cast<unsigned>(day.day()))};
}

protocols::TimeOfDay time_of(std::int64_t utc_ns) {
  const Instant instant{nanoseconds(utc_ns)};
  const std::chrono::hh_mm_ss time(instant - std::chrono::floor<std::chrono::days>(instant));
  return {static_cast<std::uint8_t>(time.hours().count()), static_cast<std::uint8_t>(time.minutes().count()),
          static_cast<std::uint8_t>(time.seconds().count()),
          static_cast<std::uint32_t>(time.subseconds().count())};
}

}  // namespace navcal::sim
