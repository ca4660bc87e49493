#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "gap/library.h"
#include "gap/linearised.h"
#include "gap/spikes.h"

namespace navcal::gap {

/// A set of effects and how probable it is beside the others that were looked at.
struct Candidate {
  std::vector<std::size_t> effects;  ///< in order; empty: no effect
  double log_odds = 0;               ///< against no effect, nats; of sets equally far, by their evidence
  double probability = 0;
};

/// A candidate whose replay was taken anew where it says the vehicle is.
struct Explanation {
  std::vector<std::size_t> effects;
  double log_odds = 0;
  Linearised linear;  ///< about the posterior mean of members and biases
  /// Posterior of all unknowns; the standard deviations hold what the model is known to be wrong by, and grow with
  /// noise that is more than nominal.
  Eigen::VectorXd mean, std;
};

struct SearchResult {
  std::vector<Candidate> candidates;  ///< most probable first
  Explanation best;                   ///< of the first of them
  /// Posterior of all unknowns where the best set's are zero and the others within tolerance. Were its own within
  /// tolerance, too, strong data would make them what they are in spite of it.
  Eigen::VectorXd mean_without_effects;
  /// Of each of the best set's effects: what this mission would tell of it, nats, if it had the direction that was
  /// found and its typical strength.
  std::vector<double> shown_nats;
};

/// Of an effect with these values, in typical strengths: the norm of a vector's components, the largest of others.
[[nodiscard]] double strength_of(const Library& library, std::size_t effect, const Eigen::VectorXd& values);

[[nodiscard]] std::vector<Eigen::Index> members_of(const Library& library,
                                                   const std::vector<std::size_t>& effects);

/// Priors by which none of these effects is there at all.
[[nodiscard]] Priors without_members(Priors priors, const Library& library,
                                     const std::vector<std::size_t>& effects);

/// Singles, pairs and triples of effects by their evidence. Leading sets are simulated and linearised again at
/// their own estimate: what is left of second order would otherwise recruit innocent effects.
[[nodiscard]] SearchResult search(const Replay& replay, const Library& library, const Whitening& whitening,
                                  const Linearised& nominal, const Priors& priors, unsigned threads,
                                  const std::function<void(double)>& progress);

}  // namespace navcal::gap
