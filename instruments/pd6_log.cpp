// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <utility>

#include "base/angles.h"
#include "instruments/devices.h"
#include "instruments/doppler_limits.h"
#include "instruments/error_velocity.h"
#include "protocols/pd6.h"

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

}  // namespace navcal::instruments
