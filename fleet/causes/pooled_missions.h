// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "gap/verdict/information.h"

// What all missions of a fleet say together, in the order of their times.
namespace navcal::fleet {

/// One mission with the groups that it belongs to.
struct FleetMission {
  std::string recording;  ///< its name for people
  std::string vehicle;    ///< the vehicle that sailed it
  std::string design;     ///< nominal vehicle that it is compared with: vehicles of one design share it
  std::string day;        ///< date and place: missions of one day are in the same water
  std::int64_t utc_ns = 0;
  gap::RecordingInformation information;
  /// Standard deviation of what vehicles of the design differ in, typical values, the same in all missions of one
  /// vehicle. Empty: kVehicleTolerance.
  std::vector<double> vehicle_error{};
};

/// Missions that belong together: indices into PooledMissions::missions(), ascending.
struct MissionGroup {
  std::string name;
  std::vector<std::size_t> missions;
};

/// An effect of the library: its parameters are consecutive.
struct EffectColumns {
  std::string name;
  Eigen::Index first = 0, count = 0;
  /// Whether it can belong to a day: to the water or the field of the place and not to a vehicle.
  bool is_of_surroundings = false;
};

/// Likelihoods of all missions, ready to be pooled. The error of the model in each mission is integrated out, so a
/// mission says no more of a parameter than the model allows.
class PooledMissions {
 public:
  /// Sorts the missions by time, then by name. Throws std::invalid_argument when their lists of parameters differ,
  /// or when there is none.
  explicit PooledMissions(std::vector<FleetMission> missions);

  [[nodiscard]] const std::vector<FleetMission>& missions() const { return missions_; }
  [[nodiscard]] const std::vector<EffectColumns>& effects() const { return effects_; }
  [[nodiscard]] const std::vector<MissionGroup>& vehicles() const { return vehicles_; }
  [[nodiscard]] const std::vector<MissionGroup>& designs() const { return designs_; }
  [[nodiscard]] const std::vector<MissionGroup>& days() const { return days_; }
  [[nodiscard]] std::size_t vehicle_of(std::size_t mission) const { return vehicle_of_[mission]; }
  /// Number of parameters.
  [[nodiscard]] Eigen::Index size() const { return missions_.front().information.score.size(); }

  /// Information and score of a mission without its model error.
  [[nodiscard]] const Eigen::MatrixXd& information(std::size_t mission) const { return information_[mission]; }
  [[nodiscard]] const Eigen::VectorXd& score(std::size_t mission) const { return score_[mission]; }
  /// Factor of the information about a vehicle's own tolerances: the sum of its missions, and the prior.
  [[nodiscard]] const Eigen::LLT<Eigen::MatrixXd>& tolerance_factor(std::size_t vehicle) const {
    return tolerance_factor_[vehicle];
  }
  /// Sum of the scores of a vehicle's missions, whitened by that factor.
  [[nodiscard]] const Eigen::VectorXd& white_score(std::size_t vehicle) const { return white_score_[vehicle]; }

 private:
  std::vector<FleetMission> missions_;
  std::vector<EffectColumns> effects_;
  std::vector<MissionGroup> vehicles_, designs_, days_;
  std::vector<std::size_t> vehicle_of_;
  std::vector<Eigen::MatrixXd> information_;
  std::vector<Eigen::VectorXd> score_;
  std::vector<Eigen::LLT<Eigen::MatrixXd>> tolerance_factor_;
  std::vector<Eigen::VectorXd> white_score_;
};

}  // namespace navcal::fleet
