// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/tcm2_sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "sim/rotation.h"

namespace navcal::sim {
namespace {

constexpr std::int64_t kStep_ns = 10'000'000;

double norm(const Vector3& v) { return std::hypot(v[0], v[1], v[2]); }

}  // namespace

Tcm2Sensor::Tcm2Sensor(const Options& options, const Motion& motion, std::uint64_t seed)
    : options_(options), motion_(motion), effects_(options.effects != nullptr ? *options.effects : none_),
      noise_(seed) {}

void Tcm2Sensor::power_on(std::int64_t t_ns) {
  electronics_.power_on(t_ns, motion_);
  fluid_ = {};
  powered_ns_ = t_ns;
  feel(t_ns);
}

void Tcm2Sensor::feel(std::int64_t t_ns) {
  const State state = motion_.at(t_ns);
  const Instant now = effects_.instant(t_ns, state, electronics_.temperature_C(t_ns, motion_));
  Tilt seen{state.euler_rad[0], state.euler_rad[1]};
  effects_.tilt_seen(now, seen);
  const double since_power_s = static_cast<double>(t_ns - powered_ns_) * 1e-9;
  const Vector3 settled =
      fluid_.at(since_power_s, {seen.roll_rad, seen.pitch_rad, 0}, options_.compass.tilt_lag_s);
  tilt_ = {settled[0], settled[1]};
  Vector3 field_world_uT = state.field_world_uT;
  effects_.earth_field(now, field_world_uT);
  field_body_uT_ = transpose(R_world_from_body(state.euler_rad)) * field_world_uT;
  effects_.body_field(now, field_body_uT_);
  felt_ns_ = t_ns;
}

Tcm2Reading Tcm2Sensor::measure(std::int64_t t_ns) {
  while (felt_ns_ < t_ns) feel(std::min(felt_ns_ + kStep_ns, t_ns));
  const State state = motion_.at(t_ns);
  const Instant now = effects_.instant(t_ns, state, electronics_.temperature_C(t_ns, motion_));
  Tilt said = tilt_;
  effects_.tilt_said(now, said);
  Vector3 field_uT = field_body_uT_;
  if (is_turned(options_.compass.mounting)) {
    const Matrix3 device_from_body = transpose(R_body_from_device(options_.compass.mounting));
    const Matrix3 body_from_world = transpose(R_world_from_body({said.roll_rad, said.pitch_rad, 0}));
    const Vector3 down = device_from_body * (body_from_world * Vector3{0, 0, 1});
    said = {std::atan2(down[1], down[2]), -std::asin(std::clamp(down[0], -1.0, 1.0))};
    field_uT = device_from_body * field_uT;
  }
  const double louder = effects_.noise(Instrument::compass, now.time_s);
  Tcm2Reading reading;
  reading.field_uT = field_uT;
  for (double& component : reading.field_uT) component += noise_.normal(options_.compass.field_noise_uT * louder);
  reading.pitch_rad = said.pitch_rad + noise_.normal(options_.compass.tilt_noise_rad * louder);
  reading.roll_rad = said.roll_rad + noise_.normal(options_.compass.tilt_noise_rad * louder);
  reading.tilt_out_of_range = std::max(std::abs(reading.pitch_rad), std::abs(reading.roll_rad)) >
                              options_.tilt_range_deg * base::kRadiansPerDegree;
  const double earth_uT = norm(state.field_world_uT);
  reading.distorted = std::abs(norm(reading.field_uT) - earth_uT) > options_.distortion_share * earth_uT;
  // Levelling: Mach's thesis (2003), eq. 2.2.
  const auto [x, y, z] = reading.field_uT;
  const double sf = std::sin(reading.roll_rad), cf = std::cos(reading.roll_rad);
  const double st = std::sin(reading.pitch_rad), ct = std::cos(reading.pitch_rad);
  const double xh = x * ct + y * sf * st + z * cf * st;
  const double yh = y * cf - z * sf;
  reading.heading_rad = std::atan2(-yh, xh);
  if (reading.heading_rad < 0) reading.heading_rad += 2 * std::numbers::pi;
  reading.temperature_C = now.electronics_C + noise_.normal(options_.compass.temperature_noise_C * louder);
  return reading;
}

}  // namespace navcal::sim
