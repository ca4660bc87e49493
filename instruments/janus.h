// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "instruments/samples.h"

/// Geometry of Doppler logs with four beams at one angle to the instrument's axis ("Janus"). Beam 3 points
/// forward, 4 aft; seen from above, 1 points to port and 2 to starboard in a convex head that looks down.
/// Reference: Teledyne RDI, "ADCP coordinate transformation", not at hand; checked on captures (ICD section 8).
namespace navcal::instruments {

struct JanusHead {
  double beam_angle_rad = 0;  ///< between a beam and the axis
  bool is_convex = true;
  bool looks_up = false;
  double alignment_rad = 0;  ///< azimuth of beam 3 from the bow, positive to starboard
};

using BeamValues = std::array<std::optional<double>, 4>;

/// A velocity relative to the instrument in its own axes: x from beam 1 to beam 2, y from beam 4 to beam 3, z
/// towards the head from what it looks at.
struct JanusVelocity {
  Vector3 velocity_m_s{};
  std::optional<double> error_m_s;  ///< absent for a solution of three beams
};

/// `beam_m_s`: along the beams, positive towards the head. A missing beam is replaced by the one that makes the
/// error velocity zero. nullopt with more than one missing.
[[nodiscard]] std::optional<JanusVelocity> velocity_of_beams(const BeamValues& beam_m_s, const JanusHead& head);

/// A vector in the instrument's axes, in those of the vehicle: forward, starboard, down.
[[nodiscard]] Vector3 body_of_instrument(const Vector3& vector, const JanusHead& head);

/// Height of the instrument over a plane bottom that is level, in the mean of the beams that found it. `range_m`
/// are ranges as the instrument states them: along the beam, times the cosine of the beam angle. Attitude of the
/// vehicle. nullopt without ranges, for a head that looks up, and where a beam is above the horizontal.
[[nodiscard]] std::optional<double> altitude_of_beams(const BeamValues& range_m, const JanusHead& head,
                                                      double pitch_rad, double roll_rad);

/// A velocity in level axes (forward, starboard, down), in the body's axes of a vehicle with this attitude.
[[nodiscard]] Vector3 body_of_level(const Vector3& vector, double pitch_rad, double roll_rad);

/// Teledyne's pitch is the angle of the forward axis to the horizontal in the plane of a pendulum that hangs from
/// the rolled instrument. This gives Euler's pitch.
[[nodiscard]] double euler_pitch_rad(double pendulum_pitch_rad, double roll_rad);

}  // namespace navcal::instruments
