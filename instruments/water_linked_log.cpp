// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/angles.h"
#include "instruments/devices.h"
#include "instruments/doppler_limits.h"
#include "protocols/water_linked.h"

namespace navcal::instruments {
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
