// SPDX-License-Identifier: Apache-2.0
#include "sim/layout/layout_motion.h"

#include <cmath>
#include <utility>

#include "base/gravity.h"
#include "sim/layout/pulses.h"

namespace navcal::sim {
namespace {

double height_of(const config::Layout& layout) {
  if (layout.body.size_m[2] > 0) return layout.body.size_m[2];
  return std::cbrt(layout.body.buoyancy_N / (layout.water_density_kg_m3 * base::kGravity_m_s2));
}

}  // namespace

LayoutMotion::LayoutMotion(config::Layout layout, std::unique_ptr<LayoutHelm> helm, const MotionOptions& options)
    : SteppedMotion(options, helm->start()), nominal_(std::move(layout)), height_m_(height_of(nominal_)),
      vehicle_(nominal_), helm_(std::move(helm)), positions_(ActuatorValues::neutral(nominal_)) {}

void LayoutMotion::change_layout(double time_s) const {
  if (options_.influencer == nullptr || time_s < next_change_s_) return;
  config::Layout layout = nominal_;
  options_.influencer->change_layout(time_s, layout);
  if (layout != vehicle_.layout()) vehicle_ = LayoutVehicle(std::move(layout));
  next_change_s_ = options_.influencer->next_layout_change_s(time_s);
}

void LayoutMotion::take_step() const {
  change_layout(time_s());
  const Influences on = influences();
  const std::vector<double>& pulses_us = helm_->next(time_s(), kMotionStep_s, body());
  if (elapsed_ns() % kOutputs_ns == 0) tell(outputs_, OutputOrder{options_.start_ns + elapsed_ns(), pulses_us});
  const ActuatorValues next =
      follow(vehicle_.layout(), positions_, commands_of(nominal_, pulses_us), kMotionStep_s);
  LayoutVehicle::Held held = vehicle_.hold(mean_of(positions_, next), on);
  held.restoring.net_weight_N += emerged(height_m_) * vehicle_.layout().body.buoyancy_N;
  const LayoutVehicle::Step step = vehicle_.held_step(body(), held, kMotionStep_s);
  positions_ = next;
  end_step(state_of(step.acceleration, on), step.body, helm_->finished());
}

}  // namespace navcal::sim
