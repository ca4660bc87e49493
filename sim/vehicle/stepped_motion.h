// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "sim/state.h"
#include "sim/vehicle/body.h"
#include "sim/vehicle/influences.h"

namespace navcal::sim {

/// Step of the simulated vehicles.
inline constexpr std::int64_t kMotionStep_ns = 10'000'000;
inline constexpr double kMotionStep_s = 1e-9 * kMotionStep_ns;

/// Options of a simulated motion besides the vehicle and its helm.
struct MotionOptions {
  std::int64_t start_ns = 0;                ///< when the run begins
  VehicleInfluencer* influencer = nullptr;  ///< must outlive the motion
  /// Time for which states are kept, seconds. A request for an older state returns the oldest one. A state
  /// takes 0.2 kB, so a run that lasts for days needs a bound.
  double history_s = std::numeric_limits<double>::infinity();
  /// The hull of one propeller and three fins floats; that of a layout always does.
  bool floats = false;
};

/// A vehicle under way: taken ahead in steps of 0.01 s as far as it is asked for, states between steps in a
/// straight line. After its helm's orders have ended it goes on as the helm does. Not for several threads at once.
class SteppedMotion : public Motion {
 public:
  /// State at t_ns; before the run, that of its beginning. Throws UnstableVehicle, UnfitLayout.
  [[nodiscard]] State at(std::int64_t t_ns) const final;
  /// Duration of the orders, seconds from the start. The call simulates up to that time, so states older than
  /// `history_s` before it are dropped. Throws UnstableVehicle, UnfitLayout.
  [[nodiscard]] double duration_s() const;

 protected:
  /// Throws UnstableVehicle.
  SteppedMotion(const MotionOptions& options, const Body& start);

  /// Takes the vehicle from body() at time_s() over one step, and calls end_step().
  virtual void take_step() const = 0;
  void end_step(const State& begin, const Body& end, bool orders_finished) const;

  [[nodiscard]] const Body& body() const { return body_; }
  /// From the start to the beginning of the step.
  [[nodiscard]] std::int64_t elapsed_ns() const { return steps_ * kMotionStep_ns; }
  [[nodiscard]] double time_s() const { return static_cast<double>(steps_) * kMotionStep_s; }
  [[nodiscard]] Influences influences() const;
  /// The state of body(), without actuators.
  [[nodiscard]] State state_of(const Vector6& acceleration, const Influences& influences) const;
  /// Share of a floating hull that is out of the water: clamp(1/2 - z/H, 0, 1), with depth z of the origin.
  [[nodiscard]] double emerged(double height_m) const {
    return std::clamp(0.5 - body_.position_m.z() / height_m, 0.0, 1.0);
  }

  // Orders to the vehicle are kept until they are taken, for `history_s` at most.
  template <class Told>
  void tell(std::deque<Told>& waiting, Told told) const {
    waiting.push_back(std::move(told));
    while (1e-9 * static_cast<double>(waiting.back().time_ns - waiting.front().time_ns) > options_.history_s)
      waiting.pop_front();
  }
  template <class Told>
  void take(std::deque<Told>& waiting, std::int64_t t_ns, std::vector<Told>& out) const {
    (void)at(t_ns);
    for (; !waiting.empty() && waiting.front().time_ns <= t_ns; waiting.pop_front())
      out.push_back(std::move(waiting.front()));
  }

  const MotionOptions options_;

 private:
  // The motion is what it is from the beginning on; only as much of it as was asked for has been worked out.
  mutable Body body_;
  mutable std::int64_t steps_ = 0;
  mutable std::deque<State> states_;  ///< at the beginnings of the newest steps
  mutable std::optional<double> ended_s_;
};

/// Writes position, attitude, velocities and specific force of a body.
void set_motion(State& state, const Body& body, const Vector6& acceleration);

[[nodiscard]] inline Vector3 array_of(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace navcal::sim
