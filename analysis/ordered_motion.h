// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include "config/vehicle.h"
#include "protocols/motor_card.h"
#include "sim/state.h"
#include "sim/vehicle/ordered_helm.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::analysis {

/// A simulated vehicle that obeys the emulated motor card in real time. It is never taken further ahead than the
/// time that it is: what it does next depends on orders that have not come. It floats: the part of the hull that
/// is above the water has no buoyancy (docs/simulator.md).
class OrderedMotion final : public sim::Motion {
 public:
  struct Options {
    std::int64_t start_ns = 0;                     ///< UTC
    double history_s = 600;                        ///< how far back states are kept
    sim::VehicleInfluencer* influencer = nullptr;  ///< must outlive the motion
    std::function<std::int64_t()> now_ns;          ///< UTC
  };
  OrderedMotion(const config::VehicleSettings& vehicle, const Options& options);

  /// The state at t_ns; for a time to come, the state now. Throws UnstableVehicle.
  [[nodiscard]] sim::State at(std::int64_t t_ns) const override;
  /// What the card was told at t_ns. It takes effect at once.
  void order(std::int64_t t_ns, const protocols::motor_card::Command& command);

 private:
  /// Adds the weight of what is above the water to what others do to the vehicle.
  class Floating final : public sim::VehicleInfluencer {
   public:
    Floating(const config::VehicleSettings& vehicle, const sim::OrderedHelm& helm, sim::VehicleInfluencer* others);
    void influence(double time_s, sim::Influences& on) override;
    void link_fins(double time_s, double step_s, sim::Vector3& fins_rad) override;

   private:
    double weight_N_, diameter_m_;
    const sim::OrderedHelm& helm_;
    sim::VehicleInfluencer* others_;
  };

  std::function<std::int64_t()> now_ns_;
  std::int64_t start_ns_;
  sim::OrderedHelm* helm_;  ///< owned by motion_
  Floating floating_;
  sim::SimulatedMotion motion_;
};

}  // namespace navcal::analysis
