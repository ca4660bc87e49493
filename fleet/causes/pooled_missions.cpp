// SPDX-License-Identifier: Apache-2.0
#include "fleet/causes/pooled_missions.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "fleet/causes/limits.h"

namespace navcal::fleet {
namespace {

bool is_one_of(std::string_view name, auto names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<EffectColumns> columns_of(const std::vector<gap::ParameterName>& parameters) {
  std::vector<EffectColumns> effects;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const std::string& name = parameters[j].effect;
    if (effects.empty() || effects.back().name != name) {
      effects.push_back({name, static_cast<Eigen::Index>(j), 0, is_one_of(name, kOfSurroundings)});
    }
    ++effects.back().count;
  }
  return effects;
}

std::vector<MissionGroup> grouped(const std::vector<FleetMission>& missions, std::string FleetMission::*by) {
  std::map<std::string, std::vector<std::size_t>> groups;
  for (std::size_t m = 0; m < missions.size(); ++m) groups[missions[m].*by].push_back(m);
  std::vector<MissionGroup> found;
  for (auto& [name, members] : groups) found.push_back({name, std::move(members)});
  return found;
}

}  // namespace

PooledMissions::PooledMissions(std::vector<FleetMission> missions) : missions_(std::move(missions)) {
  if (missions_.empty()) throw std::invalid_argument("there is no mission to pool");
  std::sort(missions_.begin(), missions_.end(), [](const FleetMission& a, const FleetMission& b) {
    return std::tie(a.utc_ns, a.recording, a.vehicle) < std::tie(b.utc_ns, b.recording, b.vehicle);
  });
  const auto& parameters = missions_.front().information.parameters;
  for (const FleetMission& mission : missions_) {
    const bool has_errors = !mission.vehicle_error.empty();
    if (mission.information.parameters != parameters ||
        (has_errors && mission.vehicle_error.size() != parameters.size())) {
      throw std::invalid_argument(fmt::format("{} and {} were compared with different libraries of effects",
                                              missions_.front().recording, mission.recording));
    }
    // With an error e ~ N(0, E) of the model, the information I becomes I - I (E^-1 + I)^-1 I, and the score
    // alike.
    const Eigen::VectorXd& error = mission.information.model_error;
    const Eigen::MatrixXd& whole = mission.information.information;
    Eigen::MatrixXd scaled = error.asDiagonal() * whole * error.asDiagonal();
    scaled.diagonal().array() += 1;
    const Eigen::LLT<Eigen::MatrixXd> factor(scaled);
    const Eigen::MatrixXd half = error.asDiagonal() * whole;
    information_.push_back(whole - half.transpose() * factor.solve(half));
    score_.push_back(mission.information.score -
                     half.transpose() * factor.solve(error.cwiseProduct(mission.information.score)));
  }
  effects_ = columns_of(parameters);
  vehicles_ = grouped(missions_, &FleetMission::vehicle);
  designs_ = grouped(missions_, &FleetMission::design);
  days_ = grouped(missions_, &FleetMission::day);
  vehicle_of_.resize(missions_.size());
  for (std::size_t v = 0; v < vehicles_.size(); ++v) {
    Eigen::VectorXd tolerance = Eigen::VectorXd::Constant(size(), kVehicleTolerance);
    const std::vector<double>& errors = missions_[vehicles_[v].missions.front()].vehicle_error;
    for (Eigen::Index j = 0; j < size() && !errors.empty(); ++j)
      tolerance[j] = std::max(tolerance[j], errors[static_cast<std::size_t>(j)]);
    Eigen::MatrixXd sum = tolerance.cwiseAbs2().cwiseInverse().asDiagonal();
    Eigen::VectorXd score = Eigen::VectorXd::Zero(size());
    for (const std::size_t m : vehicles_[v].missions) {
      vehicle_of_[m] = v;
      sum += information_[m];
      score += score_[m];
    }
    tolerance_factor_.emplace_back(sum);
    white_score_.emplace_back(tolerance_factor_.back().matrixL().solve(score));
  }
}

}  // namespace navcal::fleet
