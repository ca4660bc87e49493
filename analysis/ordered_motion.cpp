// SPDX-License-Identifier: Apache-2.0
#include "analysis/ordered_motion.h"

#include <algorithm>
#include <memory>

#include "base/angles.h"

namespace navcal::analysis {

OrderedMotion::Floating::Floating(const config::VehicleSettings& vehicle, const sim::OrderedHelm& helm,
                                  sim::VehicleInfluencer* others)
    : weight_N_(vehicle.hull.mass_kg * sim::kGravity_m_s2), diameter_m_(vehicle.hull.diameter_m), helm_(helm),
      others_(others) {}

void OrderedMotion::Floating::influence(double time_s, sim::Influences& on) {
  if (others_ != nullptr) others_->influence(time_s, on);
  const double emerged = std::clamp(0.5 - helm_.depth_m() / diameter_m_, 0.0, 1.0);
  on.buoyancy_N -= emerged * weight_N_;
}

void OrderedMotion::Floating::link_fins(double time_s, double step_s, sim::Vector3& fins_rad) {
  if (others_ != nullptr) others_->link_fins(time_s, step_s, fins_rad);
}

// The helm belongs to the motion from its construction on; the members before it only keep its address.
OrderedMotion::OrderedMotion(const config::VehicleSettings& vehicle, const Options& options)
    : now_ns_(options.now_ns), start_ns_(options.start_ns), helm_(new sim::OrderedHelm(vehicle)),
      floating_(vehicle, *helm_, options.influencer),
      motion_(vehicle, std::unique_ptr<sim::Helm>(helm_),
              {.start_ns = options.start_ns, .influencer = &floating_, .history_s = options.history_s}) {}

sim::State OrderedMotion::at(std::int64_t t_ns) const { return motion_.at(std::min(t_ns, now_ns_())); }

void OrderedMotion::order(std::int64_t t_ns, const protocols::motor_card::Command& command) {
  Eigen::Vector3d fins_rad;
  for (std::size_t i = 0; i < 3; ++i)
    fins_rad[static_cast<Eigen::Index>(i)] = command.fins_deg[i] * base::kRadiansPerDegree;
  helm_->order(static_cast<double>(t_ns - start_ns_) * 1e-9, fins_rad, command.rpm / 60.0);
}

}  // namespace navcal::analysis
