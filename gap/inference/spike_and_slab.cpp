// SPDX-License-Identifier: Apache-2.0
#include "gap/inference/spike_and_slab.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "gap/inference/evidence.h"
#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

/// Start value of expectation-maximisation, typical values.
constexpr double kFirstGuess = 0.03;
constexpr int kIterations = 60;

/// Whether the effect delays the inertial card.
bool delays_card(const Library& library, std::size_t effect) {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(library.unknowns().size()));
  const Eigen::Index j = library.first(effect);
  values[j] = library.unknowns()[static_cast<std::size_t>(j)].typical;
  return library.model(values).effects.delays(0).card_s > 0;
}

/// Whether the effect resembles fin orders at another time: it delays the fins, or the instrument that shows
/// their effect.
bool is_of_orders(const Library& library, std::size_t effect) {
  const bool moves_fins = library[effect].place == sim::EffectPlace::vehicle;
  return library.is_lag(effect) && (moves_fins || delays_card(library, effect));
}

/// Standard deviations that maximise the likelihood of these missions.
Eigen::VectorXd scatter_among(const Library& library, const Eigen::MatrixXd& gram, const Eigen::MatrixXd& scores,
                              const Eigen::VectorXd& slab) {
  Eigen::VectorXd scatter = slab;
  scatter.tail(scatter.size() - Library::kBiases) *= kFirstGuess;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Eigen::MatrixXd covariance = Evidence(gram, scores.col(0), scatter, slab).base_posterior().covariance;
    const Eigen::VectorXd square =
        (covariance * scores).rowwise().squaredNorm() / static_cast<double>(scores.cols()) + covariance.diagonal();
    for (Eigen::Index j = Library::kBiases; j < square.size(); ++j) {
      if (library.holds(library.unknowns()[static_cast<std::size_t>(j)].effect)) scatter[j] = std::sqrt(square[j]);
    }
  }
  return scatter;
}

}  // namespace

Priors fit_spike_widths(const Library& library, const Eigen::MatrixXd& gram, const Eigen::MatrixXd& scores) {
  Priors priors;
  priors.slab.resize(gram.rows());
  for (Eigen::Index j = 0; j < gram.rows(); ++j) {
    const Unknown& unknown = library.unknowns()[static_cast<std::size_t>(j)];
    priors.slab[j] = j < Library::kBiases ? kTurnOnBiasPrior_rad_s : unknown.typical;
    if (j >= Library::kBiases && !library.holds(unknown.effect)) priors.slab[j] *= kExcludedPrior;
  }
  const Eigen::VectorXd scatter =
      scores.cols() > 0 ? scatter_among(library, gram, scores, priors.slab) : kTolerance * priors.slab;
  priors.spike = priors.slab;
  priors.model_error.setZero(priors.slab.size());
  for (Eigen::Index j = Library::kBiases; j < priors.slab.size(); ++j) {
    const std::size_t effect = library.unknowns()[static_cast<std::size_t>(j)].effect;
    if (!library.holds(effect)) continue;
    const double tolerance = kTolerance * priors.slab[j];
    priors.model_error[j] = std::sqrt(std::max(0.0, scatter[j] * scatter[j] - tolerance * tolerance));
    if (is_of_orders(library, effect)) {
      priors.model_error[j] = std::max(priors.model_error[j], kOrdersOff_s);
    }
    priors.spike[j] = std::max({tolerance, scatter[j], priors.model_error[j]});
  }
  return priors;
}

EffectSubset hardly_shown_effects(const Library& library, const Eigen::MatrixXd& gram, const Priors& priors) {
  const Evidence evidence(gram, Eigen::VectorXd::Zero(gram.rows()), priors.spike, priors.slab);
  EffectSubset hidden;
  for (std::size_t effect = 0; effect < library.size(); ++effect) {
    if (!library.holds(effect)) continue;
    double most_nats = 0;
    for (const Eigen::Index j : parameter_indices(library, {effect})) {
      Eigen::VectorXd values = Eigen::VectorXd::Zero(gram.rows());
      values[j] = library.unknowns()[static_cast<std::size_t>(j)].typical;
      most_nats = std::max(most_nats, evidence.separation(std::array{j}, values, {}));
    }
    if (most_nats < kObservable_nats) hidden.push_back(effect);
  }
  return hidden;
}

}  // namespace navcal::gap
