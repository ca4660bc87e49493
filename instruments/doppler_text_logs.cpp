// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/angles.h"
#include "instruments/devices.h"
#include "instruments/doppler_limits.h"
#include "instruments/error_velocity.h"
#include "protocols/pd6.h"
#include "protocols/water_linked.h"

namespace navcal::instruments {

namespace {

namespace pd6 = protocols::pd6;

/// Places in Pd6Log::Ping. A later one is used when those before it are absent.
enum Pd6Axes : std::size_t { pd6_instrument, pd6_earth, pd6_ship };

Pd6Axes axes_of(protocols::FrameId line) {
  if (line == pd6::kBottomInstrument || line == pd6::kWaterInstrument) return pd6_instrument;
  return line == pd6::kBottomEarth || line == pd6::kWaterEarth ? pd6_earth : pd6_ship;
}

bool is_of_bottom(protocols::FrameId line) { return line.view().front() == 'B'; }

/// Teledyne Doppler log, PD6 (ICD section 9). The lines of one ping are collected. Its last one, BD, gives the
/// range to the bottom and closes the sample; a ping whose BD is lost gives none. The instrument's axes are
/// preferred (BI, WI), then the Earth's, then the ship's, which may be level or not.
class Pd6Log final : public Instrument {
 public:
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override {
    if (frame.id == pd6::kAttitude) {
      ping_ = {};  // the first line of a ping
      return read_attitude(frame.bytes, receiver);
    }
    if (frame.id == pd6::kTiming) return read_timing(frame.bytes);
    if (frame.id == pd6::kBottomDistance) return close(frame.bytes, receiver);
    if (frame.id == pd6::kWaterDistance) return Verdict::ignored;
    const auto velocity = pd6::decode_velocity(frame.bytes);
    return velocity ? read_velocity(*velocity) : Verdict::out_of_range;
  }

 private:
  Verdict read_attitude(protocols::Bytes line, Receiver& receiver) {
    const auto attitude = pd6::decode_attitude(line);
    if (!attitude || attitude->heading_deg < 0 || attitude->heading_deg > 360 ||
        std::abs(attitude->pitch_deg) > 90 || std::abs(attitude->roll_deg) > 180) {
      return Verdict::out_of_range;
    }
    CompassSample sample;
    sample.heading_rad = base::as_heading(attitude->heading_deg * base::kRadiansPerDegree);
    sample.pitch_rad = attitude->pitch_deg * base::kRadiansPerDegree;
    sample.roll_rad = attitude->roll_deg * base::kRadiansPerDegree;
    hand_over(sample, receiver, false);
    return Verdict::used;
  }

  Verdict read_timing(protocols::Bytes line) {
    const auto timing = pd6::decode_timing(line);
    if (!timing) return Verdict::out_of_range;
    ping_.temperature_C = timing->temperature_C;
    ping_.sound_speed_m_s = timing->speed_of_sound_m_s;
    return Verdict::used;
  }

  Verdict read_velocity(const pd6::Velocity& velocity) {
    const auto& v = velocity.velocity_m_s;
    if (!velocity.good || !v[0] || !v[1] || !v[2]) return Verdict::used;
    const bool of_bottom = is_of_bottom(velocity.line);
    // All lines state starboard, forward, up, or east, north, up.
    auto& axes = of_bottom ? ping_.bottom_m_s : ping_.water_m_s;
    axes.at(axes_of(velocity.line)) = Vector3{*v[1], *v[0], -*v[2]};
    if (velocity.error_velocity_m_s) (of_bottom ? bottom_error_ : water_error_).take(*velocity.error_velocity_m_s);
    return Verdict::used;
  }

  Verdict close(protocols::Bytes line, Receiver& receiver) {
    const auto distance = pd6::decode_distance(line);
    const Ping ping = std::exchange(ping_, {});
    if (!distance) return Verdict::out_of_range;
    DvlSample sample;
    for (const Pd6Axes axes : {pd6_instrument, pd6_earth, pd6_ship}) {
      if (!ping.bottom_m_s.at(axes) && !ping.water_m_s.at(axes)) continue;
      sample.frame = axes == pd6_earth ? VelocityFrame::earth : VelocityFrame::body;
      sample.bottom_velocity_m_s = ping.bottom_m_s.at(axes);
      sample.water_velocity_m_s = ping.water_m_s.at(axes);
      break;
    }
    if (sample.bottom_velocity_m_s) sample.bottom_velocity_std_m_s = bottom_error_.std_m_s();
    if (sample.water_velocity_m_s) sample.water_velocity_std_m_s = water_error_.std_m_s();
    if (distance->range_m > 0) sample.altitude_m = distance->range_m;
    sample.temperature_C = ping.temperature_C;
    sample.sound_speed_m_s = ping.sound_speed_m_s;
    const bool can_be = clear_of_impossible(sample);
    hand_over(sample, receiver);
    return can_be ? Verdict::used : Verdict::out_of_range;
  }

  /// Velocities of one ping by axes: instrument, Earth, ship.
  struct Ping {
    std::array<std::optional<Vector3>, 3> bottom_m_s, water_m_s;
    std::optional<double> temperature_C, sound_speed_m_s;
  };
  Ping ping_;
  ErrorVelocity bottom_error_, water_error_;
};

}  // namespace

std::unique_ptr<Instrument> make_pd6(const config::PortSettings&) { return std::make_unique<Pd6Log>(); }

namespace {

namespace water_linked = protocols::water_linked;

/// The instrument pings at least once in a second; what is older is a clock that was set in between.
constexpr std::int64_t kMaxAge_us = 2'000'000;

std::optional<std::int64_t> age_ns(const water_linked::Velocity& velocity) {
  if (!velocity.valid_at_us || !velocity.transmitted_at_us) return std::nullopt;
  const std::int64_t age_us = *velocity.transmitted_at_us - *velocity.valid_at_us;
  if (age_us < 0 || age_us > kMaxAge_us) return std::nullopt;
  return 1000 * age_us;
}

/// A tilt serves so many velocities; the instrument sends as many lines of either kind.
constexpr int kTiltServes = 10;

/// Standard error of the axis with the largest variance; else the figure of merit. nullopt when both are zero, as
/// in old lines.
std::optional<double> stated_std_m_s(const water_linked::Velocity& velocity) {
  double variance_m2_s2 = 0;
  if (const auto& covariance = velocity.covariance_m2_s2)
    variance_m2_s2 = std::max({(*covariance)[0], (*covariance)[4], (*covariance)[8]});
  const double std_m_s = variance_m2_s2 > 0 ? std::sqrt(variance_m2_s2) : velocity.figure_of_merit_m_s;
  return std_m_s > 0 ? std::optional(std_m_s) : std::nullopt;
}

/// Water Linked DVL A50 and A125 (ICD section 10): wrz and wrx as velocities over the bottom with their stated
/// errors and the altitude. wrz states when the ping was reflected and when the line was sent, by the instrument's
/// own clock: their difference takes the place of the port's latency. Without bottom lock a sample has neither
/// velocity nor altitude. The altitude is stated along the instrument's axis; the tilt of its dead reckoning, wrp,
/// makes it vertical where wrp comes. Its position, in a frame of its own, is three scalars; the single beams wru
/// are not used. The network port says the same in JSON.
class WaterLinkedLog final : public Instrument {
 public:
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override {
    if (frame.id == water_linked::kVelocity || frame.id == water_linked::kVelocityOld ||
        frame.id == water_linked::kVelocityJson)
      return read_velocity(frame.bytes, receiver);
    if (frame.id != water_linked::kPosition && frame.id != water_linked::kPositionJson) return Verdict::ignored;
    const auto reckoning = water_linked::decode_position(frame.bytes);
    if (!reckoning) return Verdict::out_of_range;
    tilt_cosine_ = std::cos(reckoning->pitch_deg * base::kRadiansPerDegree) *
                   std::cos(reckoning->roll_deg * base::kRadiansPerDegree);
    velocities_since_ = 0;
    constexpr const char* kNames[] = {"local x", "local y", "local z"};
    for (std::size_t i = 0; i < 3; ++i) {
      hand_over(ScalarSample{Text<24>(kNames[i]), Text<16>("m"), reckoning->position_m[i], reckoning->std_m},
                receiver, false);
    }
    return Verdict::used;
  }

 private:
  Verdict read_velocity(protocols::Bytes line, Receiver& receiver) {
    const auto velocity = water_linked::decode_velocity(line);
    if (!velocity) return Verdict::out_of_range;
    DvlSample sample;
    if (velocity->valid) {
      sample.bottom_velocity_m_s = velocity->velocity_m_s;
      sample.bottom_velocity_std_m_s = stated_std_m_s(*velocity);
      sample.altitude_m = velocity->altitude_m * tilt_cosine_;
    }
    if (++velocities_since_ == kTiltServes) tilt_cosine_ = 1;
    const bool can_be = clear_of_impossible(sample);
    receiver.on_measurement({.value = sample, .age_ns = age_ns(*velocity)});
    return can_be ? Verdict::used : Verdict::out_of_range;
  }

  double tilt_cosine_ = 1;    ///< of the newest wrp
  int velocities_since_ = 0;  ///< since then
};

}  // namespace

std::unique_ptr<Instrument> make_water_linked(const config::PortSettings&) {
  return std::make_unique<WaterLinkedLog>();
}

}  // namespace navcal::instruments
