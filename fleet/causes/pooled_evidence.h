// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fleet/causes/pooled_missions.h"

namespace navcal::fleet {

/// What a cause belongs to.
enum class CauseLevel : std::uint8_t {
  vehicle,  ///< one vehicle, in all its missions or from one of them on
  design,   ///< all vehicles of one design
  day,      ///< all missions of one day and place: the water, or the Earth's field
};
/// "vehicle", "design", "day".
[[nodiscard]] std::string_view name_of(CauseLevel level);

/// An effect in some of the missions: what could be a cause.
struct PossibleCause {
  std::size_t effect = 0;  ///< index into PooledMissions::effects()
  CauseLevel level = CauseLevel::vehicle;
  std::string of;                     ///< vehicle, design or day
  std::vector<std::size_t> missions;  ///< those that it acts in, ascending
  /// Index of the first and of the last of them among the vehicle's missions; empty: it acts from the first one
  /// on, or up to the last one.
  std::optional<std::size_t> since, until;
  double log_prior = 0;  ///< nats, against no cause

  /// Whether it is the same effect of the same vehicle, design or day, whenever it began.
  [[nodiscard]] bool is_same_but_for_time(const PossibleCause& other) const {
    return effect == other.effect && level == other.level && of == other.of;
  }
};

/// The causes that are possible in these missions, each with its prior.
[[nodiscard]] std::vector<PossibleCause> possible_causes(const PooledMissions& missions);

/// Cause with the standard deviation of its strength's prior.
struct ActingCause {
  PossibleCause cause;
  double strength = 1;  ///< one of kCauseStrengths
};

/// The hierarchical model: the parameters of mission m are
///   v_m = tolerance of its design + tolerance of its vehicle + of its day + the causes that act in it + error_m,
/// all Gaussian with mean zero. With the likelihoods of the missions (gap::RecordingInformation) the evidence of a
/// set of causes is a closed form (Gelman et al. 2013, Bayesian Data Analysis, chapters 5 and 15). The tolerances
/// of the vehicles are integrated out first, since no cause needs them.
class PooledEvidence {
 public:
  /// Keeps a reference to `missions`.
  PooledEvidence(const PooledMissions& missions, const std::vector<ActingCause>& acting);

  struct Gain {
    double log_odds = 0;   ///< evidence gained over the model without it, prior included, nats
    double strength = 1;   ///< of kCauseStrengths, the one that fits best
    Eigen::VectorXd mean;  ///< of its parameters, typical values
    Eigen::MatrixXd covariance;
    bool is_within_bounds = true;
  };
  /// Gain by one more cause.
  [[nodiscard]] Gain gain(const PossibleCause& cause) const;
  /// Posterior of the parameters of the acting cause number `i`, typical values.
  [[nodiscard]] Eigen::VectorXd mean_of(std::size_t i) const;
  [[nodiscard]] Eigen::VectorXd std_of(std::size_t i) const;

 private:
  /// Columns of one effect in some missions; `white` has, for each vehicle among them, the columns of the sum
  /// of its information, whitened by the factor of its tolerances.
  struct Column {
    Eigen::Index first = 0, count = 0;
    std::vector<std::size_t> missions;
    std::vector<std::pair<std::size_t, Eigen::MatrixXd>> white;
    double prior = 1;
    Eigen::Index at = 0;  ///< place among the common unknowns
  };
  [[nodiscard]] Column column(Eigen::Index first, Eigen::Index count, std::vector<std::size_t> missions,
                              double prior) const;
  [[nodiscard]] Eigen::MatrixXd gram(const Column& a, const Column& b) const;
  [[nodiscard]] Eigen::VectorXd score(const Column& a) const;
  void add(Column column);

  const PooledMissions& missions_;
  std::vector<Column> columns_;
  std::size_t first_acting_ = 0;
  Eigen::Index size_ = 0;
  Eigen::VectorXd mean_;
  Eigen::MatrixXd covariance_;
};

}  // namespace navcal::fleet
