// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "autopilot/allocation.h"
#include "config/mission.h"
#include "sim/layout/layout_vehicle.h"

namespace navcal::sim {

/// Degrees of freedom that a mission needs: for each the first step that does, "step[3] (turn)".
struct MissionNeeds {
  std::optional<std::string> surge;  ///< a speed, or a way to be made
  std::optional<std::string> yaw;    ///< another heading, or a rudder
  std::optional<std::string> pitch;  ///< an elevator
  /// Fins 1 to 3 that steps move by themselves.
  std::array<std::optional<std::string>, 3> fins;
};

/// Every mission holds a depth as well. The shaft speed of the start is a speed for those that can make one.
[[nodiscard]] MissionNeeds needs_of(const config::Mission& mission);

/// "step[3] (turn)": number from 1 and what it does.
[[nodiscard]] std::string step_words(const config::Mission& mission, std::size_t step);

/// What changes the depth of a vehicle.
enum class DepthControl {
  heave,    ///< thrusters up and down
  pitch,    ///< the nose up or down, under way
  ballast,  ///< buoyancy, with moving masses for the pitch of a glide
};

/// How a layout is steered: the degrees of freedom that the autopilot commands, and how fast it may go.
struct ControlPlan {
  /// Surge, sway, heave, roll, pitch, yaw; those that are not commanded are left to the vehicle's own stability.
  std::array<bool, 6> commanded{};
  DepthControl depth = DepthControl::heave;
  double greatest_m_s = 0;  ///< speed ahead that leaves a reserve of thrust and does not upset the vehicle
  double usual_m_s = 0;     ///< 70 % of it, for which the degrees of freedom were found
};

/// Degrees of freedom that are taken in the order surge, yaw, heave or pitch, roll, sway, as long as they can be
/// commanded independently of those before them. The row of a degree of freedom in the allocation matrix, scaled
/// as Allocator::row_scales(), must keep 30 % of its length when the rows before are projected out. greatest_m_s:
/// the highest speed at which 95 % of the thrust balances the drag (50 % of thrusters that turn the vehicle as
/// well), and at which the moment that turns it across its way grows slower than the loops act. Where pitch or
/// roll is not commanded, the vehicle on a level course must turn back from 12 degrees of it to either side.
/// Throws UnfitLayout where the mission needs a degree of freedom that the layout does not command, or where what
/// the autopilot leaves alone is unstable.
[[nodiscard]] ControlPlan plan_control(const LayoutVehicle& vehicle, const autopilot::Allocator& allocator,
                                       const config::Mission& mission);

}  // namespace navcal::sim
