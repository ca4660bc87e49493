// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string_view>

#include "identify/data/actuator_inputs.h"
#include "identify/data/recorded_motion.h"
#include "sim/layout/layout_vehicle.h"

namespace navcal::identify {

/// Relations that hold between channels of one motion, and between commands and motion by the layout. Each
/// compares changes over 2 s, so that a constant offset of a channel does not count.
enum class Relation : std::size_t {
  roll,  ///< change of the angle against the rates
  pitch,
  heading,
  second_gyro,
  force_x,  ///< specific force against gravity, tilt and the change of the velocity
  force_y,
  force_z,
  depth,  ///< change of the depth against the vertical velocity
  gauge_depth,
  north,  ///< change of the position against heading and velocity of the body
  east,
  fix_north,  ///< the same against the velocity that the receiver states
  fix_east,
  surge,  ///< change of the velocity against what the commands make of the layout's vehicle within a second
  sway,
  heave,
  roll_response,
  pitch_response,
  yaw_response,
};
inline constexpr std::size_t kRelations = 19;
struct RelationDescription {
  std::string_view words, unit;
  double floor;      ///< residual of good instruments, one sigma
  double allowance;  ///< mean residual that is no news: biases, current, a poor model
};
extern const std::array<RelationDescription, kRelations> kRelationDescriptions;

/// How well one recording agrees with a relation.
struct Residual {
  double mean_square = 0;  ///< with the floor
  double count = 0;        ///< windows that carry it: (sum e^2)^2 / sum e^4. 0: not measured
  std::size_t windows = 0;
};

struct Agreement {
  std::array<Residual, kRelations> of;
  /// Turn from heading and body's velocity to the track, positive east, and its standard error.
  std::optional<double> track_turn_rad;
  double track_turn_std_rad = 0;
};

/// What becomes of the actuators' positions before they move the vehicle.
using ActuatorChange = std::function<void(sim::ActuatorValues&)>;

/// `actuators`: nullptr without commands.
[[nodiscard]] Agreement agreement_of(const sim::LayoutVehicle& vehicle, const RecordedMotion& motion,
                                     const ActuatorTrajectory* actuators, const ActuatorChange& change);

}  // namespace navcal::identify
