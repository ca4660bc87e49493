// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/doppler_log.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "sim/rotation.h"

namespace navcal::sim {
namespace {

/// Where each beam points, seen from above: port, starboard, forward, aft.
constexpr std::array<Vector3, 4> kBeamSides{{{0, -1, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}}};

Vector3 beam_of(std::size_t beam, double angle_rad) {
  Vector3 direction = kBeamSides.at(beam);
  for (double& one : direction) one *= std::sin(angle_rad);
  direction[2] = std::cos(angle_rad);
  return direction;
}

double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// From the vehicle along a direction of the world to the floor; nullopt where the two do not meet.
std::optional<double> range_along_m(const Vector3& direction, const SeaFloor& floor, const Vector3& position_m) {
  const double height_m = floor.depth_at_m(position_m[0], position_m[1]) - position_m[2];
  const double closing = direction[2] - floor.slope_north * direction[0] - floor.slope_east * direction[1];
  constexpr double kLeastClosingOfBeam = 0.01;
  if (closing < kLeastClosingOfBeam) return std::nullopt;
  return height_m / closing;
}

}  // namespace

bool DopplerPing::has_lock() const {
  return std::all_of(velocity_m_s.begin(), velocity_m_s.end(), [](const auto& one) { return one.has_value(); });
}

DopplerLog::DopplerLog(const Options& options, const Motion& motion)
    : LineDevice(options.baud), options_(options), motion_(motion), noise_(options.seed) {}

void DopplerLog::power_on(std::int64_t t_ns) {
  ticks_ = Ticks(t_ns, 1 / options_.rate_Hz, options_.clock_ppm);
  pings_ = 0;
}

void DopplerLog::act(std::int64_t now_ns, std::vector<Emission>& out) {
  send(now_ns, encode(measure(now_ns - std::llround(options_.latency_s * 1e9)), now_ns), out);
  ticks_.pass();
}

DopplerPing DopplerLog::measure(std::int64_t t_ns) {
  DopplerPing ping{t_ns, motion_.at(t_ns), ++pings_, {}, {}};
  const Vector3 velocity_m_s = velocity_over_bottom_m_s(ping.state);
  const Matrix3 world_from_body = R_world_from_body(ping.state.euler_rad);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3 beam = beam_of(i, options_.beam_angle_rad);
    const auto range_m = range_along_m(world_from_body * beam, options_.floor, ping.state.position_m);
    // All are drawn whether they are needed or not: then an echo does not change the noise of those after it.
    const bool is_lost = noise_.uniform(0, 1) < options_.lost;
    const double range_noise_m = noise_.normal(options_.range_noise_m);
    const double noise_m_s = noise_.normal(options_.beam_noise_m_s);
    if (!range_m || is_lost || *range_m > options_.range_m || *range_m < options_.least_range_m) continue;
    ping.range_m.at(i) = std::max(0.01, *range_m + range_noise_m);
    // The bottom comes nearer along a beam that points where the vehicle goes.
    ping.velocity_m_s.at(i) = (1 + options_.scale_error) * dot(velocity_m_s, beam) + noise_m_s;
  }
  return ping;
}

Vector3 velocity_over_bottom_m_s(const State& state) {
  const Vector3 current =
      transpose(R_world_from_body(state.euler_rad)) * Vector3{state.current_m_s[0], state.current_m_s[1], 0};
  Vector3 velocity = state.velocity_body_m_s;
  for (std::size_t i = 0; i < 3; ++i) velocity[i] += current[i];
  return velocity;
}

DopplerSolution solved(const DopplerPing& ping, double beam_angle_rad) {
  std::array<double, 4> b{};
  for (std::size_t i = 0; i < 4; ++i) b[i] = ping.velocity_m_s[i].value_or(0);
  const double side = 2 * std::sin(beam_angle_rad);
  return {
      {(b[2] - b[3]) / side, (b[1] - b[0]) / side, (b[0] + b[1] + b[2] + b[3]) / (4 * std::cos(beam_angle_rad))},
      (b[0] + b[1] - b[2] - b[3]) / (side * std::numbers::sqrt2)};
}

double magnetic_heading_rad(const State& state) {
  return base::as_heading(state.euler_rad[2] - std::atan2(state.field_world_uT[1], state.field_world_uT[0]));
}

}  // namespace navcal::sim
