// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "fleet/causes/pooled_missions.h"

namespace navcal::fleet::test {

/// A fleet whose missions are drawn from the hierarchical model itself: tolerances of each vehicle, causes, model
/// errors, and information of random directions.
class SimulatedFleet {
 public:
  struct Size {
    std::size_t vehicles = 6, missions = 8;
  };
  /// A cause as the test makes it: what it adds in a mission of vehicle `v`, the vehicle's `k`-th, at its day.
  using Causes = std::function<void(std::size_t v, std::size_t k, Eigen::VectorXd& values)>;

  SimulatedFleet(unsigned seed, Size size, const Causes& causes) : random_(seed) {
    const auto names = parameters();
    const auto n = static_cast<Eigen::Index>(names.size());
    for (std::size_t v = 0; v < size.vehicles; ++v) {
      const Eigen::VectorXd tolerance = 0.02 * normal(n);
      for (std::size_t k = 0; k < size.missions; ++k) {
        FleetMission mission;
        mission.recording = "v" + std::to_string(v) + "-" + std::to_string(k);
        mission.vehicle = "v" + std::to_string(v);
        mission.design = "design";
        mission.day = "day " + std::to_string(k);
        mission.utc_ns = static_cast<std::int64_t>(k) * 86'400'000'000'000 + static_cast<std::int64_t>(v);
        mission.information =
            information(names, tolerance, [&](Eigen::VectorXd& values) { causes(v, k, values); });
        missions_.push_back(std::move(mission));
      }
    }
  }
  [[nodiscard]] std::vector<FleetMission> missions() const { return missions_; }

  /// a: 1 parameter, b: a vector of 2, c: a lag, and two effects of the surroundings.
  static std::vector<gap::ParameterName> parameters() {
    constexpr double kFree = 1e9;
    return {{"fin_gain", "scale", 1, -kFree, kFree},        {"hard_iron", "x_uT", 1, -kFree, kFree},
            {"hard_iron", "y_uT", 1, -kFree, kFree},        {"fin_lag", "tau_s", 1, 0, kFree},
            {"buoyancy", "force_N", 1, -kFree, kFree},      {"water_current", "north_m_s", 1, -kFree, kFree},
            {"water_current", "east_m_s", 1, -kFree, kFree}};
  }

 private:
  Eigen::VectorXd normal(Eigen::Index n) {
    Eigen::VectorXd values(n);
    for (Eigen::Index i = 0; i < n; ++i) values[i] = normal_(random_);
    return values;
  }
  gap::RecordingInformation information(const std::vector<gap::ParameterName>& names,
                                        const Eigen::VectorXd& tolerance,
                                        const std::function<void(Eigen::VectorXd&)>& add) {
    const Eigen::Index n = tolerance.size();
    gap::RecordingInformation made;
    made.parameters = names;
    made.model_error = Eigen::VectorXd::Constant(n, 0.01);
    Eigen::VectorXd values = tolerance + made.model_error.cwiseProduct(normal(n));
    add(values);
    // Rows of a design with some correlation between neighbours: a standard error of about 0.03 for each
    // parameter.
    constexpr Eigen::Index kRows = 1200;
    Eigen::MatrixXd design(kRows, n);
    for (Eigen::Index j = 0; j < n; ++j) {
      design.col(j) =
          normal(kRows) + (j > 0 ? Eigen::VectorXd(0.5 * design.col(j - 1)) : Eigen::VectorXd::Zero(kRows));
    }
    const Eigen::VectorXd residual = design * values + normal(kRows);
    made.information = design.transpose() * design;
    made.score = design.transpose() * residual;
    made.power = residual.squaredNorm();
    made.measurements = kRows;
    made.null_power = 1 + static_cast<double>(n) * 0.02 * 0.02;
    made.null_power_std = 0.04;
    return made;
  }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::vector<FleetMission> missions_;
};

}  // namespace navcal::fleet::test
