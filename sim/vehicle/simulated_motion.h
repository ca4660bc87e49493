// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "config/vehicle.h"
#include "sim/layout/layout_vehicle.h"
#include "sim/state.h"
#include "sim/vehicle/helm.h"
#include "sim/vehicle/influences.h"

namespace navcal::sim {

/// Options of a simulated motion besides the vehicle and its helm.
struct MotionOptions {
  std::int64_t start_ns = 0;                ///< when the run begins
  VehicleInfluencer* influencer = nullptr;  ///< must outlive the motion
  /// Time for which states are kept, seconds. A request for an older state returns the oldest one. A state
  /// takes 0.2 kB, so a run that lasts for days needs a bound.
  double history_s = std::numeric_limits<double>::infinity();
  /// The hull of one propeller and three fins floats; that of a layout always does.
  bool floats = false;
  Vector3 field_world_uT = State{}.field_world_uT;
  /// UTC. With it the vehicle obeys orders in real time: it is never taken further ahead than this, since what it
  /// does next depends on orders that have not come, and states of a time to come are those of now.
  std::function<std::int64_t()> now_ns{};
};

/// A vehicle under way: taken ahead in steps of 0.01 s as far as it is asked for, states between steps in a
/// straight line. After its helm's orders have ended it goes on as the helm does. Of a hull that floats, what is
/// above the water has no buoyancy (body.size_m tells its height, else the cube root of what it displaces). Not
/// for several threads at once.
class SimulatedMotion final : public Motion {
 public:
  /// Interval at which outputs are told.
  static constexpr std::int64_t kOutputs_ns = 100'000'000;

  /// The vehicle of a layout. Shaft, fins and motor current of its states are zero: it has outputs instead.
  /// `options.influencer` may change the layout; the helm takes pulses for the nominal one. Throws
  /// UnstableVehicle.
  SimulatedMotion(config::Layout layout, std::unique_ptr<Helm> helm, const MotionOptions& options);
  /// The vehicle of one propeller and three fins, with a motor card. Throws UnstableVehicle.
  SimulatedMotion(const config::VehicleSettings& vehicle, std::unique_ptr<Helm> helm,
                  const MotionOptions& options);

  /// State at t_ns; before the run, that of its beginning. Throws UnstableVehicle, UnfitLayout.
  [[nodiscard]] State at(std::int64_t t_ns) const override;
  /// Duration of the orders, seconds from the start. The call simulates up to that time, so states older than
  /// `history_s` before it are dropped. Throws UnstableVehicle, UnfitLayout.
  [[nodiscard]] double duration_s() const;
  /// Appends the orders up to t_ns. Orders older than `history_s` are dropped as well.
  void take_orders(std::int64_t t_ns, std::vector<Order>& out) const override { take(orders_, t_ns, out); }
  void take_outputs(std::int64_t t_ns, std::vector<OutputOrder>& out) const override { take(outputs_, t_ns, out); }
  /// Positions of the actuators after the newest step.
  [[nodiscard]] const ActuatorValues& positions() const { return actuators_.positions; }

 private:
  void change_layout(double time_s) const;
  void take_step() const;
  /// Actuators that the model holds over a step which begins with them at `from`.
  [[nodiscard]] ActuatorValues held_over_step(ActuatorValues from, double end_s) const;
  /// The state at the beginning of a step, when actuators were like this.
  [[nodiscard]] State state_of(const Vector6& acceleration, const Influences& influences,
                               const Actuators& actuators) const;

  /// t_ns, but not later than now.
  [[nodiscard]] std::int64_t by_now(std::int64_t t_ns) const {
    return options_.now_ns ? std::min(t_ns, options_.now_ns()) : t_ns;
  }

  // Orders to the vehicle are kept until they are taken, for `history_s` at most.
  template <class Told>
  void tell(std::deque<Told>& waiting, Told told) const;
  template <class Told>
  void take(std::deque<Told>& waiting, std::int64_t t_ns, std::vector<Told>& out) const {
    t_ns = by_now(t_ns);
    (void)at(t_ns);
    for (; !waiting.empty() && waiting.front().time_ns <= t_ns; waiting.pop_front())
      out.push_back(std::move(waiting.front()));
  }

  const MotionOptions options_;
  config::Layout nominal_;
  std::optional<config::PropellerSettings> card_;  ///< of a vehicle with a motor card
  double height_m_;                                ///< of the hull
  // The motion is what it is from the beginning on; only as much of it as was asked for has been worked out.
  mutable LayoutVehicle vehicle_;
  mutable double next_change_s_ = 0;
  mutable std::unique_ptr<Helm> helm_;
  mutable Body body_;
  mutable Actuators actuators_;
  mutable std::optional<ActuatorNumbers> linked_rad_;  ///< the fins themselves, behind their linkage
  mutable std::int64_t steps_ = 0;
  mutable std::deque<State> states_;  ///< at the beginnings of the newest steps
  mutable std::optional<double> ended_s_;
  mutable std::deque<Order> orders_;         ///< not yet taken
  mutable std::deque<OutputOrder> outputs_;  ///< likewise
};

/// Writes position, attitude, velocities and specific force of a body.
void set_motion(State& state, const Body& body, const Vector6& acceleration);

[[nodiscard]] inline Vector3 array_of(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace navcal::sim
