// SPDX-License-Identifier: Apache-2.0
#include "sim/instruments/doppler_devices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "protocols/pd6.h"
#include "protocols/utc.h"
#include "protocols/water_linked.h"
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

namespace pd0 = protocols::pd0;
namespace pd6 = protocols::pd6;
namespace water_linked = protocols::water_linked;

constexpr double kSoundSpeed_m_s = 1500;
constexpr double kSeaWater_kg_m3 = 1025;

/// In the Earth's axes, north being the magnetic one of the log's own compass.
Vector3 north_east_down(const Vector3& body, const State& state) {
  return R_world_from_body({state.euler_rad[0], state.euler_rad[1], magnetic_heading_rad(state)}) * body;
}

Vector3 level(const Vector3& body, const State& state) {
  return R_world_from_body({state.euler_rad[0], state.euler_rad[1], 0}) * body;
}

/// What a pendulum shows that hangs in the rolled instrument.
double pendulum_pitch_rad(const State& state) {
  return std::atan(std::tan(state.euler_rad[1]) / std::cos(state.euler_rad[0]));
}

double degrees(double angle_rad) { return angle_rad * base::kDegreesPerRadian; }

void append(std::vector<std::uint8_t>& bytes, const std::vector<std::uint8_t>& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

pd0::FixedLeader fixed_leader(const Pd0Doppler::Options& options) {
  pd0::FixedLeader fixed;
  fixed.firmware_version = 51;
  fixed.firmware_revision = 41;
  fixed.system = static_cast<std::uint16_t>(0x4343 | (options.convex ? 0x08 : 0));  // 600 kHz, looks down
  fixed.beams = 4;
  fixed.axes = options.axes;
  fixed.uses_tilts = options.uses_tilts;
  fixed.used_sensors = fixed.fitted_sensors =
      pd0::temperature_sensor | pd0::roll_sensor | pd0::pitch_sensor | pd0::heading_sensor | pd0::depth_sensor;
  fixed.stated_beam_angle_deg = static_cast<std::uint8_t>(std::lround(degrees(options.beam_angle_rad)));
  return fixed;
}

pd0::VariableLeader variable_leader(const DopplerPing& ping) {
  pd0::VariableLeader variable;
  variable.ensemble = ping.number;
  variable.date = protocols::date_of(ping.measured_ns);
  variable.time = protocols::time_of_day(ping.measured_ns);
  variable.speed_of_sound_m_s = kSoundSpeed_m_s;
  variable.depth_m = std::max(0.0, ping.state.position_m[2]);
  // 359.996 degrees would be sent as 360.00.
  variable.heading_deg = std::fmod(std::round(100 * degrees(magnetic_heading_rad(ping.state))) / 100, 360.0);
  variable.pitch_deg = degrees(pendulum_pitch_rad(ping.state));
  variable.roll_deg = degrees(ping.state.euler_rad[0]);
  variable.salinity_ppt = 35;
  variable.temperature_C = ping.state.water_temperature_C;
  variable.pressure_Pa = kSeaWater_kg_m3 * kGravity_m_s2 * ping.state.position_m[2];
  return variable;
}

}  // namespace

bool DopplerPing::has_lock() const {
  return std::ranges::all_of(velocity_m_s, [](const auto& one) { return one.has_value(); });
}

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

std::array<std::optional<double>, 4> Pd0Doppler::velocities_m_s(const DopplerPing& ping) const {
  if (sent_as_.axes == pd0::Axes::beam) {
    auto beams = ping.velocity_m_s;
    // A concave head has its beams crossed.
    if (!sent_as_.convex) {
      std::swap(beams[0], beams[1]);
      std::swap(beams[2], beams[3]);
    }
    return beams;
  }
  if (!ping.has_lock()) return {};
  const DopplerSolution solution = solved(ping, options_.beam_angle_rad);
  Vector3 own = solution.body_m_s;
  if (sent_as_.axes == pd0::Axes::ship && sent_as_.uses_tilts) own = level(own, ping.state);
  if (sent_as_.axes == pd0::Axes::earth) own = north_east_down(own, ping.state);
  // Sent is the bottom's velocity: starboard, forward, up, or east, north, up.
  return {-own[1], -own[0], own[2], solution.error_m_s};
}

std::vector<std::uint8_t> Pd0Doppler::encode(const DopplerPing& ping, std::int64_t) const {
  pd0::BottomTrack bottom;
  bottom.velocity_m_s = velocities_m_s(ping);
  for (std::size_t i = 0; i < 4; ++i) {
    if (ping.range_m[i]) bottom.range_m[i] = *ping.range_m[i] * std::cos(options_.beam_angle_rad);
    bottom.percent_good[i] = bottom.velocity_m_s[i] ? 100 : 0;
  }
  if (!sent_as_.convex) {
    std::swap(bottom.range_m[0], bottom.range_m[1]);
    std::swap(bottom.range_m[2], bottom.range_m[3]);
  }
  pd0::Ensemble ensemble;
  ensemble.fixed = fixed_leader(sent_as_);
  ensemble.variable = variable_leader(ping);
  ensemble.bottom = bottom;
  return pd0::encode(ensemble);
}

std::vector<std::uint8_t> Pd6Doppler::encode(const DopplerPing& ping, std::int64_t) const {
  const auto date = protocols::date_of(ping.measured_ns);
  const auto time = protocols::time_of_day(ping.measured_ns);
  pd6::Timing timing;
  const std::string clock =
      fmt::format("{:02}{:02}{:02}{:02}{:02}{:02}{:02}", date.year % 100, date.month, date.day, time.hour,
                  time.minute, time.second, time.nanosecond / 10'000'000);
  std::copy_n(clock.begin(), timing.clock.size(), timing.clock.begin());
  timing.salinity_ppt = 35;
  timing.temperature_C = ping.state.water_temperature_C;
  timing.depth_m = std::max(0.0, ping.state.position_m[2]);
  timing.speed_of_sound_m_s = kSoundSpeed_m_s;

  const double heading_deg = std::fmod(std::round(100 * degrees(magnetic_heading_rad(ping.state))) / 100, 360.0);
  std::vector<std::uint8_t> bytes =
      pd6::encode(pd6::Attitude{degrees(ping.state.euler_rad[1]), degrees(ping.state.euler_rad[0]), heading_deg});
  append(bytes, pd6::encode(timing));
  pd6::Velocity instrument{pd6::kBottomInstrument, {}, {}, false}, ship{pd6::kBottomShip, {}, {}, false},
      earth{pd6::kBottomEarth, {}, {}, false};
  pd6::Distance distance{pd6::kBottomDistance, {}, 0, 0};
  if (ping.has_lock()) {
    const DopplerSolution solution = solved(ping, options_.beam_angle_rad);
    const auto sent = [](const Vector3& v) { return std::array<std::optional<double>, 3>{v[1], v[0], -v[2]}; };
    instrument.velocity_m_s = sent(solution.body_m_s);
    instrument.error_velocity_m_s = solution.error_m_s;
    ship.velocity_m_s = sent(level(solution.body_m_s, ping.state));
    earth.velocity_m_s = sent(north_east_down(solution.body_m_s, ping.state));
    instrument.good = ship.good = earth.good = true;
    for (const auto& range_m : ping.range_m) distance.range_m += *range_m * std::cos(options_.beam_angle_rad) / 4;
  }
  for (const auto* velocity : {&instrument, &ship, &earth}) append(bytes, pd6::encode(*velocity));
  append(bytes, pd6::encode(distance));
  return bytes;
}

std::vector<std::uint8_t> WaterLinkedDoppler::encode(const DopplerPing& ping, std::int64_t sent_ns) const {
  water_linked::Velocity velocity;
  velocity.valid = ping.has_lock();
  velocity.altitude_m = -1;
  const double beam_variance_m2_s2 = options_.beam_noise_m_s * options_.beam_noise_m_s;
  const double sine = std::sin(options_.beam_angle_rad), cosine = std::cos(options_.beam_angle_rad);
  const double across_m2_s2 = beam_variance_m2_s2 / (2 * sine * sine);
  const double down_m2_s2 = beam_variance_m2_s2 / (4 * cosine * cosine);
  velocity.covariance_m2_s2 = std::array<double, 9>{across_m2_s2, 0, 0, 0, across_m2_s2, 0, 0, 0, down_m2_s2};
  velocity.figure_of_merit_m_s = std::sqrt(across_m2_s2);
  if (velocity.valid) {
    velocity.velocity_m_s = solved(ping, options_.beam_angle_rad).body_m_s;
    // Along the instrument's axis: over a plane bottom the inverse ranges of opposite beams have this mean.
    double inverse_per_m = 0;
    for (const auto& range_m : ping.range_m) inverse_per_m += 1 / *range_m / 4;
    velocity.altitude_m = cosine / inverse_per_m;
  }
  velocity.valid_at_us = ping.measured_ns / 1000;
  velocity.transmitted_at_us = sent_ns / 1000;
  velocity.since_last_ms = 1000 / options_.rate_Hz;
  std::vector<std::uint8_t> bytes = water_linked::encode(velocity);
  for (std::size_t i = 0; i < 4; ++i) {
    append(bytes, water_linked::encode(water_linked::Transducer{static_cast<std::uint8_t>(i),
                                                                ping.velocity_m_s[i].value_or(0),
                                                                ping.range_m[i].value_or(-1), -40, -95}));
  }
  return bytes;
}

}  // namespace navcal::sim
