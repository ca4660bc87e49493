// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "instruments/devices.h"
#include "instruments/doppler_limits.h"
#include "instruments/error_velocity.h"
#include "instruments/janus.h"
#include "protocols/pd0.h"

namespace navcal::instruments {
namespace {

namespace pd0 = protocols::pd0;

constexpr double kAtmosphere_Pa = 101325;  ///< pressures of the leader begin here

/// What the leaders say of the instrument and its attitude.
struct Pd0Posture {
  pd0::Axes axes{};
  JanusHead head;
  bool has_beam_angle = false;
  bool is_level = false;  ///< velocities in the ship's axes were turned into level ones
  double pitch_rad = 0, roll_rad = 0;
};

Pd0Posture posture_of(const pd0::FixedLeader& fixed, const pd0::VariableLeader& variable) {
  Pd0Posture posture;
  posture.axes = fixed.axes;
  const auto beam_angle_deg = fixed.beam_angle_deg();
  posture.has_beam_angle = beam_angle_deg.has_value();
  posture.head = {beam_angle_deg.value_or(0) * base::kRadiansPerDegree, fixed.is_convex(), fixed.looks_up(),
                  fixed.heading_alignment_deg * base::kRadiansPerDegree};
  // Tilts that the host has set are those of another time, or zero: velocities of such instruments are not level.
  posture.is_level =
      fixed.uses_tilts && is_measured(fixed, pd0::pitch_sensor) && is_measured(fixed, pd0::roll_sensor);
  posture.roll_rad = variable.roll_deg * base::kRadiansPerDegree;
  posture.pitch_rad = euler_pitch_rad(variable.pitch_deg * base::kRadiansPerDegree, posture.roll_rad);
  return posture;
}

/// A velocity of the vehicle, with the error velocity.
struct Pd0Velocity {
  Vector3 velocity_m_s{};
  std::optional<double> error_m_s;
};

Vector3 negative(const Vector3& v) { return {-v[0], -v[1], -v[2]}; }

/// `sent` is the velocity of the bottom, or of the water, relative to the instrument. The vehicle's is the
/// opposite.
std::optional<Pd0Velocity> vehicle_velocity(const BeamValues& sent, const Pd0Posture& posture) {
  if (posture.axes == pd0::Axes::beam) {
    const auto solved = posture.has_beam_angle ? velocity_of_beams(sent, posture.head) : std::nullopt;
    if (!solved) return std::nullopt;
    return Pd0Velocity{negative(body_of_instrument(solved->velocity_m_s, posture.head)), solved->error_m_s};
  }
  if (!sent[0] || !sent[1] || !sent[2]) return std::nullopt;
  const Vector3 v{*sent[0], *sent[1], *sent[2]};
  switch (posture.axes) {
    case pd0::Axes::instrument: return Pd0Velocity{negative(body_of_instrument(v, posture.head)), sent[3]};
    case pd0::Axes::ship: {
      const Vector3 body{-v[1], -v[0], v[2]};
      return Pd0Velocity{posture.is_level ? body_of_level(body, posture.pitch_rad, posture.roll_rad) : body,
                         sent[3]};
    }
    default: return Pd0Velocity{{-v[1], -v[0], v[2]}, sent[3]};
  }
}

/// False when an angle cannot be.
bool read_attitude(const pd0::Ensemble& ensemble, Receiver& receiver) {
  const pd0::FixedLeader& fixed = *ensemble.fixed;
  const pd0::VariableLeader& variable = *ensemble.variable;
  const bool has_tilt = is_measured(fixed, pd0::pitch_sensor) && is_measured(fixed, pd0::roll_sensor);
  const bool has_heading = is_measured(fixed, pd0::heading_sensor);
  if (!has_tilt && !has_heading) return true;
  if (variable.heading_deg > 360 || std::abs(variable.pitch_deg) > 90 || std::abs(variable.roll_deg) > 180)
    return false;
  CompassSample sample;
  if (has_heading) {
    sample.heading_rad = base::as_heading(variable.heading_deg * base::kRadiansPerDegree);
    sample.heading_is_true = fixed.heading_bias_deg != 0;
  }
  if (has_tilt) {
    sample.roll_rad = variable.roll_deg * base::kRadiansPerDegree;
    sample.pitch_rad = euler_pitch_rad(variable.pitch_deg * base::kRadiansPerDegree, *sample.roll_rad);
  }
  hand_over(sample, receiver, false);
  return true;
}

void read_pressure(const pd0::Ensemble& ensemble, Receiver& receiver) {
  if (!is_measured(*ensemble.fixed, pd0::depth_sensor)) return;
  DepthSample sample;
  if (ensemble.variable->pressure_Pa) {
    sample.pressure_Pa = *ensemble.variable->pressure_Pa + kAtmosphere_Pa;
  } else {
    sample.depth_m = ensemble.variable->depth_m;
  }
  hand_over(sample, receiver, false);
}

/// Teledyne Doppler log, PD0 (ICD section 8): bottom track in any of its four axes, altitude, and what its own
/// sensors measure of attitude and pressure. Axes of the vehicle are those of the mounted instrument, with its own
/// heading alignment; [port.NAME.mounting] turns further.
class Pd0Log final : public Instrument {
 public:
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override {
    const pd0::Ensemble ensemble = pd0::decode(frame.bytes);
    if (!ensemble.fixed || !ensemble.variable) return Verdict::ignored;
    bool can_be = read_attitude(ensemble, receiver);
    read_pressure(ensemble, receiver);
    if (!ensemble.bottom) return can_be ? Verdict::used : Verdict::out_of_range;

    const Pd0Posture posture = posture_of(*ensemble.fixed, *ensemble.variable);
    DvlSample sample;
    if (posture.axes == pd0::Axes::earth) sample.frame = VelocityFrame::earth;
    if (const auto bottom = vehicle_velocity(ensemble.bottom->velocity_m_s, posture)) {
      sample.bottom_velocity_m_s = bottom->velocity_m_s;
      sample.bottom_velocity_std_m_s = error_m_s(bottom->error_m_s, bottom_error_);
    }
    const auto& good = ensemble.bottom->water_percent_good;
    const bool has_water = std::any_of(good.begin(), good.end(), [](std::uint8_t percent) { return percent > 0; });
    if (const auto water = vehicle_velocity(ensemble.bottom->water_velocity_m_s, posture); water && has_water) {
      sample.water_velocity_m_s = water->velocity_m_s;
      sample.water_velocity_std_m_s = error_m_s(water->error_m_s, water_error_);
    }
    if (posture.has_beam_angle) {
      sample.altitude_m =
          altitude_of_beams(ensemble.bottom->range_m, posture.head, posture.pitch_rad, posture.roll_rad);
    }
    sample.temperature_C = ensemble.variable->temperature_C;
    sample.sound_speed_m_s = ensemble.variable->speed_of_sound_m_s;
    can_be = clear_of_impossible(sample) && can_be;

    hand_over(sample, receiver);
    return can_be ? Verdict::used : Verdict::out_of_range;
  }

 private:
  [[nodiscard]] std::optional<double> error_m_s(const std::optional<double>& error_velocity_m_s,
                                                ErrorVelocity& history) const {
    if (error_velocity_m_s) history.take(*error_velocity_m_s);
    const auto std_m_s = history.std_m_s();
    if (!std_m_s || error_velocity_m_s) return std_m_s;
    // Three beams: the horizontal component along the missing beam has three times the variance.
    return std::numbers::sqrt3 * *std_m_s;
  }

  ErrorVelocity bottom_error_, water_error_;
};

}  // namespace

std::unique_ptr<Instrument> make_pd0(const config::PortSettings&) { return std::make_unique<Pd0Log>(); }

}  // namespace navcal::instruments
