// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/gps_receiver.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/rotation.h"

namespace navcal::sim {

GpsReceiver::GpsReceiver(const Options& options, const Motion& motion, std::uint64_t seed)
    : options_(options), motion_(motion), effects_(options.effects != nullptr ? *options.effects : none_),
      noise_(seed) {}

void GpsReceiver::power_on(std::int64_t t_ns) {
  powered_ns_ = t_ns;
  electronics_.power_on(t_ns, motion_);
  fix_due_ns_.reset();
  knows_time_ = knows_position_ = false;
  ephemerides_until_ns_.reset();
  fixes_ = 0;
  last_ = {};
  last_.latitude_deg = options_.origin.latitude_deg;
  last_.longitude_deg = options_.origin.longitude_deg;
  last_.height_m = options_.origin.height_m;
}

void GpsReceiver::learn_time() { learn(knows_time_); }

void GpsReceiver::learn_position() { learn(knows_position_); }

void GpsReceiver::learn(bool& knows) {
  if (options_.gps.search_model != config::SearchModel::receiver_state) return;
  const bool new_to_it = !std::exchange(knows, true);
  if (new_to_it && knows_time_ && knows_position_ && fixes_ == 0) fix_due_ns_.reset();
}

double GpsReceiver::search_s(std::int64_t begin_ns) {
  const devices::GpsModel& gps = options_.gps;
  if (gps.search_model == config::SearchModel::uniform)
    return noise_.uniform(gps.least_search_s, gps.longest_search_s);
  double mean_s = gps.cold_start_s;
  if (ephemerides_until_ns_ && begin_ns <= *ephemerides_until_ns_) {
    mean_s = gps.hot_start_s;
  } else if (knows_time_ && knows_position_) {
    mean_s = gps.warm_start_s;
  }
  constexpr double kSpread = devices::GpsModel::kSearchSpread;
  return mean_s * noise_.uniform(1 - kSpread, 1 + kSpread);
}

bool GpsReceiver::fixes(std::int64_t second_ns) {
  if (motion_.at(second_ns).position_m[2] > options_.gps.antenna_depth_m) {
    fix_due_ns_.reset();
    return false;
  }
  if (!fix_due_ns_) {
    const std::int64_t begin_ns = std::max(second_ns, powered_ns_);
    fix_due_ns_ = begin_ns + std::llround(search_s(begin_ns) * 1e9);
    fixes_ = 0;
  }
  return second_ns >= *fix_due_ns_;
}

GpsReading GpsReceiver::measure(std::int64_t second_ns) {
  last_.utc_ns = second_ns;
  last_.speed_m_s = last_.course_deg = 0;
  last_.fixed = fixes(second_ns);
  last_.cold = !last_.fixed && options_.gps.search_model == config::SearchModel::receiver_state &&
               !(knows_time_ && knows_position_);
  if (!last_.fixed) return last_;
  // Ephemerides are received with each fix. Their life beyond it is drawn once for each stretch with fixes, so
  // that the uniform model draws nothing here.
  if (options_.gps.search_model == config::SearchModel::receiver_state) {
    knows_time_ = knows_position_ = true;
    if (fixes_ == 0) life_s_ = options_.gps.ephemeris_life_s * noise_.uniform(0.5, 1);
    ephemerides_until_ns_ = second_ns + std::llround(life_s_ * 1e9);
  }
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

}  // namespace navcal::sim
