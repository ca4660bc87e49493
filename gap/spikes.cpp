#include "gap/spikes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gap/evidence.h"

namespace navcal::gap {
namespace {

constexpr double kLeast = 0.03;
/// Of what was excluded: as good as nothing.
constexpr double kNever = 1e-9;
/// Reports of the fins ten times a second do not tell finer when something happened.
constexpr double kLeastLag_s = 0.005;
constexpr int kIterations = 40;
constexpr double kBias_rad_s = 3 * std::numbers::pi / 180;

}  // namespace

Priors learnt_priors(const Library& library, const Eigen::MatrixXd& gram, const Eigen::MatrixXd& scores) {
  Priors priors;
  priors.slab.resize(gram.rows());
  for (Eigen::Index j = 0; j < gram.rows(); ++j) {
    priors.slab[j] = j < Library::kBiases ? kBias_rad_s : library.unknowns()[static_cast<std::size_t>(j)].typical;
  }
  Eigen::VectorXd least = priors.slab;
  least.tail(least.size() - Library::kBiases) *= kLeast;
  for (Eigen::Index j = Library::kBiases; j < least.size(); ++j) {
    const std::size_t effect = library.unknowns()[static_cast<std::size_t>(j)].effect;
    if (library.is_curved(effect)) least[j] = std::max(least[j], kLeastLag_s);
    if (!library.holds(effect)) priors.slab[j] = least[j] = kNever * priors.slab[j];
  }
  priors.spike = least;
  if (scores.cols() == 0) return priors;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Eigen::MatrixXd covariance =
        Evidence(gram, scores.col(0), priors.spike, priors.slab).base_posterior().covariance;
    const Eigen::VectorXd square =
        (covariance * scores).rowwise().squaredNorm() / static_cast<double>(scores.cols()) + covariance.diagonal();
    for (Eigen::Index j = Library::kBiases; j < square.size(); ++j) {
      const bool held = library.holds(library.unknowns()[static_cast<std::size_t>(j)].effect);
      if (held) priors.spike[j] = std::max(least[j], std::sqrt(square[j]));
    }
  }
  return priors;
}

}  // namespace navcal::gap
