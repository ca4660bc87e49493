#include "gap/inference/set_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace navcal::gap {
namespace {

/// Against the first effect, beside the choice among all of them: what innovations that are not quite Gaussian
/// gain by chance. Against each further one: what the signatures of those before leave, since they are not quite
/// exact.
constexpr double kCaution = 3, kFurtherCaution = 8;
/// An effect that is there may be weak or strong, as likely the one as the other: with one wide prior for all,
/// many parameters of a weak one would cost more than they explain.
constexpr std::array<double, 3> kStrengths{0.2, 0.6, 2};

}  // namespace

Evidence evidence_of(const Linearised& linear, const Priors& priors) {
  return {linear.gram, linear.score + linear.gram * linear.at, priors.spike, priors.slab};
}

SetEvidence::SetEvidence(const Linearised& linear, const Library& library, const Priors& priors)
    : library_(library),
      evidence_(evidence_of(linear, priors)),
      data_(-0.5 * residual_at_zero(linear).squaredNorm()) {}

double SetEvidence::operator()(const CauseSet& set) const {
  if (set.empty()) return data_ + evidence_.base();
  const auto count = static_cast<double>(set.size());
  const double against =
      count * std::log(static_cast<double>(library_.size())) + kCaution + (count - 1) * kFurtherCaution;
  return data_ + evidence_.base() + gain(set) - against;
}

/// Over all combinations of the members' strengths.
double SetEvidence::gain(const CauseSet& set) const {
  const auto members = members_of(library_, set);
  Eigen::VectorXd slabs(static_cast<Eigen::Index>(members.size()));
  std::size_t combinations = 1;
  for (std::size_t i = 0; i < set.size(); ++i) combinations *= kStrengths.size();
  std::vector<double> gains(combinations);
  for (std::size_t n = 0; n < combinations; ++n) {
    Eigen::Index at = 0;
    std::size_t rest = n;
    for (const std::size_t effect : set) {
      for (Eigen::Index k = 0; k < library_.count(effect); ++k) {
        slabs[at] = kStrengths[rest % kStrengths.size()] *
                    library_.unknowns()[static_cast<std::size_t>(library_.first(effect) + k)].typical;
        ++at;
      }
      rest /= kStrengths.size();
    }
    gains[n] = evidence_.gain(members, slabs);
  }
  const double greatest = *std::max_element(gains.begin(), gains.end());
  double sum = 0;
  for (const double one : gains) sum += std::exp(one - greatest);
  return greatest + std::log(sum / static_cast<double>(combinations));
}

}  // namespace navcal::gap
