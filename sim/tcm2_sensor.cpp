#include "sim/tcm2_sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/rotation.h"

namespace navcal::sim {
namespace {

constexpr std::int64_t kStep_ns = 10'000'000;
constexpr double kRadians = std::numbers::pi / 180;

}  // namespace

Tcm2Sensor::Tcm2Sensor(const Options& options, const Motion& motion, std::uint64_t seed)
    : options_(options), motion_(motion), noise_(seed) {}

void Tcm2Sensor::power_on(std::int64_t t_ns) {
  const State state = motion_.at(t_ns);
  settled_ns_ = t_ns;
  roll_rad_ = state.euler_rad[0];
  pitch_rad_ = state.euler_rad[1];
  temperature_C_ = state.water_temperature_C;
}

/// First-order lags of the fluid and of the temperature, in steps of 10 ms.
void Tcm2Sensor::settle(std::int64_t t_ns) {
  while (settled_ns_ < t_ns) {
    const std::int64_t step_ns = std::min(kStep_ns, t_ns - settled_ns_);
    const double step_s = static_cast<double>(step_ns) * 1e-9;
    settled_ns_ += step_ns;
    const State state = motion_.at(settled_ns_);
    const double fluid = -std::expm1(-step_s / options_.fluid_lag_s);
    roll_rad_ += fluid * (state.euler_rad[0] - roll_rad_);
    pitch_rad_ += fluid * (state.euler_rad[1] - pitch_rad_);
    const double warm = -std::expm1(-step_s / options_.warming_time_s);
    temperature_C_ += warm * (state.water_temperature_C + options_.warming_C - temperature_C_);
  }
}

Tcm2Reading Tcm2Sensor::measure(std::int64_t t_ns) {
  settle(t_ns);
  const State state = motion_.at(t_ns);
  Tcm2Reading reading;
  reading.field_uT = transpose(R_world_from_body(state.euler_rad)) * state.field_world_uT;
  for (double& component : reading.field_uT) component += noise_.normal(options_.field_noise_uT);
  reading.pitch_rad = pitch_rad_ + noise_.normal(options_.tilt_noise_deg * kRadians);
  reading.roll_rad = roll_rad_ + noise_.normal(options_.tilt_noise_deg * kRadians);
  reading.tilt_out_of_range =
      std::max(std::abs(reading.pitch_rad), std::abs(reading.roll_rad)) > options_.tilt_range_deg * kRadians;
  // Levelling: thesis eq. 2.2.
  const auto [x, y, z] = reading.field_uT;
  const double sf = std::sin(reading.roll_rad), cf = std::cos(reading.roll_rad);
  const double st = std::sin(reading.pitch_rad), ct = std::cos(reading.pitch_rad);
  const double xh = x * ct + y * sf * st + z * cf * st;
  const double yh = y * cf - z * sf;
  reading.heading_rad = std::atan2(-yh, xh);
  if (reading.heading_rad < 0) reading.heading_rad += 2 * std::numbers::pi;
  reading.temperature_C = temperature_C_ + noise_.normal(options_.temperature_noise_C);
  return reading;
}

}  // namespace navcal::sim
