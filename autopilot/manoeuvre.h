// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "autopilot/autopilot.h"
#include "autopilot/vehicle_state.h"
#include "config/mission.h"

namespace navcal::autopilot {

/// Input of a manoeuvre: its times, the way made and the state of the vehicle.
struct Situation {
  double since_s = 0;   ///< it began
  double period_s = 0;  ///< since it was asked last
  double way_m = 0;     ///< through the water, since it began
  VehicleState state;
  Orders last;  ///< the orders given last
};

/// One step of a mission under way; it changes the demand.
class Manoeuvre {
 public:
  explicit Manoeuvre(const config::MissionStep& step) : step_(step) {}
  virtual ~Manoeuvre() = default;
  /// Called once, before the first go_on().
  virtual void begin(const Situation& now, Demand& demand) = 0;
  /// Called at each period; false: the manoeuvre is done, and `demand` keeps its values.
  [[nodiscard]] virtual bool go_on(const Situation& now, Demand& demand) = 0;

 protected:
  const config::MissionStep step_;
};

/// The heading next to `near_rad` that is `heading_rad` but for whole turns.
[[nodiscard]] double nearest_heading(double heading_rad, double near_rad);

[[nodiscard]] std::unique_ptr<Manoeuvre> make_manoeuvre(const config::MissionStep& step);

}  // namespace navcal::autopilot
