// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/set_evidence.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/statistics.h"
#include "diagnosis/limits.h"

namespace navcal::diagnosis {
namespace {

/// Columns of a set with the prior of their sizes at some strength, in order, and the bounds of the vehicle's.
struct Members {
  std::vector<Eigen::Index> columns;
  Eigen::VectorXd mean, std, low, high;
};

Members members_of(const CauseSet& set, const CauseLibrary& library, double strength) {
  Members members;
  std::vector<double> mean, std, low, high;
  constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  for (const std::size_t cause : set) {
    for (const CauseParameter& parameter : library.causes[cause].parameters) {
      const double typical = parameter.typical * parameter.per_unit;
      const bool is_switch = parameter.is_switch();
      members.columns.push_back(parameter.column);
      mean.push_back(is_switch ? typical : 0);
      std.push_back((is_switch ? kSwitchScatter : strength) * typical);
      low.push_back(library.causes[cause].is_instrument ? -kUnbounded : parameter.low * parameter.per_unit);
      high.push_back(library.causes[cause].is_instrument ? kUnbounded : parameter.high * parameter.per_unit);
    }
  }
  for (const auto& [from, to] :
       {std::pair{&mean, &members.mean}, {&std, &members.std}, {&low, &members.low}, {&high, &members.high}})
    *to = Eigen::Map<const Eigen::VectorXd>(from->data(), std::ssize(*from));
  return members;
}

/// log Phi(z)
double log_share_below(double z) {
  if (z > -8) return std::log(std::erfc(-z / std::numbers::sqrt2) / 2);
  // Mills' ratio, where erfc loses its digits.
  return -0.5 * z * z - std::log(-z * std::sqrt(2 * std::numbers::pi));
}

/// Logarithm of the probability that a normal deviate lies within bounds of which at most one is near.
double log_share_within(double low, double high, double mean, double std) {
  return log_share_below((high - mean) / std) + log_share_below((mean - low) / std);
}

/// `is_robust`: Student's t has the tails for which the first effect pays elsewhere.
double log_prior(std::size_t size, std::size_t causes, bool is_robust) {
  double log_prior = size > 0 && !is_robust ? -kComplexityPenalty_nats : 0;
  for (std::size_t i = 0; i < size; ++i) {
    if (i > 0) log_prior -= kComplexityPenaltyPerFurtherEffect_nats;
    log_prior -= std::log(static_cast<double>(causes - i) / static_cast<double>(i + 1));
  }
  return log_prior;
}

/// Posterior with a prior that has no bounds. `here`: the likelihood about the prior's mean.
SetEvidence::Posterior unbounded_posterior(const Members& members, const Likelihood& here) {
  const Eigen::MatrixXd covariance = covariance_of(here.information, members.std);
  return {members.columns, members.mean + covariance * here.score, covariance};
}

}  // namespace

bool are_one(const Cause& a, const Cause& b) {
  if (a.of != b.of) return false;
  const auto kind = [](const Cause& cause) {
    if (cause.name == "gravity_shift" || cause.name == "buoyancy_shift") return 1;
    return cause.name == "thrust_scale" || cause.name == "actuator_dead" || cause.name == "actuator_reversed" ? 2
                                                                                                              : 0;
  };
  return kind(a) != 0 && kind(a) == kind(b);
}

SetEvidence::Posterior SetEvidence::posterior(const CauseSet& set, const Anchor& anchor) const {
  Members members = members_of(set, library_, kMemberStrengths.back());
  if (anchor.share > 0) members.mean += anchor.share * (anchor.change(members.columns) - members.mean);
  Posterior all = unbounded_posterior(members, changes_.of(members.columns).about(members.mean));
  for (Eigen::Index i = 0; i < all.mean.size(); ++i) {
    // The most probable one on the bound, the others given that.
    const double inside = std::clamp(all.mean[i], members.low[i], members.high[i]);
    if (inside != all.mean[i]) all.mean += (inside - all.mean[i]) / all.covariance(i, i) * all.covariance.col(i);
  }
  all.mean = all.mean.cwiseMax(members.low).cwiseMin(members.high);
  return all;
}

Eigen::VectorXd SetEvidence::Posterior::among(Eigen::Index count) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(count);
  all(columns) = mean;
  return all;
}

double SetEvidence::gain(const CauseSet& set, double strength) const {
  const Members members = members_of(set, library_, strength);
  const Likelihood here = changes_.of(members.columns).about(members.mean);
  double gain = here.blurred(members.std.asDiagonal()).evidence() - changes_.evidence();
  const Posterior wide = unbounded_posterior(members, here);
  for (Eigen::Index i = 0; i < wide.mean.size(); ++i) {
    // A prior that ends at the bounds has its whole weight between them.
    const double low = members.low[i], high = members.high[i];
    gain += log_share_within(low, high, wide.mean[i], std::max(wide.std(i), 1e-150)) -
            log_share_within(low, high, members.mean[i], members.std[i]);
  }
  return gain;
}

double SetEvidence::gain(const CauseSet& set) const {
  if (set.empty()) return 0;
  std::vector<double> gains;
  for (const double strength : kMemberStrengths) gains.push_back(gain(set, strength));
  return base::log_mean_exp(gains) +
         log_prior(set.size(), library_.causes.size(), std::isfinite(changes_.freedom));
}

double log_prior_of(const Eigen::VectorXd& change, const CauseSet& set, const CauseLibrary& library) {
  const Members members = members_of(set, library, kMemberStrengths.back());
  return -(change(members.columns) - members.mean).cwiseQuotient(members.std).squaredNorm() / 2;
}

}  // namespace navcal::diagnosis
