// SPDX-License-Identifier: Apache-2.0
#include "gap/verdict/information.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "gap/inference/model_fit.h"
#include "gap/inference/problem.h"
#include "gap/inference/subset_evidence.h"
#include "gap/verdict/prepare.h"

// The likelihood of a recording is Gaussian in the parameters near a point of linearisation. The nominal vehicle
// serves while the effects are weak. Where one or two effects clearly win, the point is their own estimate,
// because lags and strong effects are not linear from zero. Score and information are referred to zero in either
// case, and the biases are integrated out by a Schur complement (Golub and Van Loan 2013, section 3.2.6).
namespace navcal::gap {
namespace {

/// Log evidence from which the model is linearised about a subset's estimate, nats. Set: below it the estimate is
/// within the linear range of the nominal vehicle.
constexpr double kWorthLinearising_nats = 10;

/// The single or pair of effects with the most evidence in the nominal linearisation; empty: none has enough.
EffectSubset leading_subset(const Library& library, const LinearGaussianModel& model) {
  const SubsetEvidence evidence(model);
  const double none = evidence({});
  EffectSubset best;
  double best_nats = none + kWorthLinearising_nats;
  for (std::size_t a = 0; a < library.size(); ++a) {
    if (!library.holds(a)) continue;
    for (std::size_t b = a; b < library.size(); ++b) {
      if (!library.holds(b)) continue;
      const EffectSubset set = a == b ? EffectSubset{a} : EffectSubset{a, b};
      if (const double nats = evidence(set); nats > best_nats) {
        best_nats = nats;
        best = set;
      }
    }
  }
  return best;
}

std::vector<ParameterName> parameter_names(const Library& library) {
  std::vector<ParameterName> names;
  for (const Unknown& unknown : library.unknowns().subspan(Library::kBiases)) {
    names.push_back({std::string(library[unknown.effect].name), std::string(unknown.name), unknown.typical,
                     unknown.least / unknown.typical, unknown.greatest / unknown.typical});
  }
  return names;
}

void set_floor(const std::vector<double>& powers, RecordingInformation& into) {
  const auto n = static_cast<double>(powers.size());
  for (const double power : powers) into.null_power += power / n;
  double square = 0;
  for (const double power : powers) square += (power - into.null_power) * (power - into.null_power);
  into.null_power_std = powers.size() > 1 ? std::sqrt(square / (n - 1)) : 0;
}

/// Integrates the biases out and changes to typical values.
void set_likelihood(const Linearised& linear, const Priors& priors, RecordingInformation& into) {
  constexpr Eigen::Index b = Library::kBiases;
  const Eigen::Index n = linear.gram.rows() - b;
  const Eigen::VectorXd score = linear.score + linear.gram * linear.at;
  Eigen::MatrixXd biases = linear.gram.topLeftCorner(b, b);
  biases.diagonal() += priors.slab.head(b).cwiseAbs2().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> factor(biases);
  const Eigen::MatrixXd cross = linear.gram.topRightCorner(b, n);
  const Eigen::VectorXd solved = factor.solve(score.head(b));
  Eigen::VectorXd typical(n);
  for (Eigen::Index j = 0; j < n; ++j) typical[j] = into.parameters[static_cast<std::size_t>(j)].typical;
  const Eigen::MatrixXd information =
      linear.gram.bottomRightCorner(n, n) - cross.transpose() * factor.solve(cross);
  into.information = typical.asDiagonal() * (0.5 * (information + information.transpose())) * typical.asDiagonal();
  into.score = typical.cwiseProduct(score.tail(n) - cross.transpose() * solved);
  into.model_error = priors.model_error.tail(n).cwiseQuotient(typical);
  const Eigen::VectorXd at_zero = residual_at_zero(linear);
  into.power = at_zero.squaredNorm() - score.head(b).dot(solved);
  into.measurements = static_cast<double>(Whitening::count(at_zero));
}

}  // namespace

InformationResult information_of(const Request& request, const Progress& progress) {
  const Library library(request.excluded);
  const unsigned threads = base::threads_or_cores(request.threads);
  Preparation preparation(request, library, progress, threads);
  Diagnosis said;
  InformationResult result;
  const auto prepared = preparation.prepare(request.missions.at(0), said);
  result.remarks = said.remarks;
  if (!prepared) {
    result.shortcoming = said.remarks.empty() ? "the recording is empty" : said.remarks.back();
    return result;
  }
  progress("linearising", 0);
  const ResidualModel model = prepared->model(library, threads);
  Linearised linear = linearise(model, prepared->at);
  const Priors priors = fit_spike_widths(library, prepared->bank.gram, prepared->bank.scores);
  RecordingInformation information;
  const EffectSubset leading = leading_subset(library, {linear, library, priors});
  if (!leading.empty()) {
    for (const std::size_t effect : leading) information.about.emplace_back(library[effect].name);
    linear = fit_model(leading, {model, linear, priors}).linear;
  }
  information.parameters = parameter_names(library);
  set_likelihood(linear, priors, information);
  set_floor(prepared->bank.powers, information);
  information.place = prepared->mission.field.place;
  information.utc_ns = prepared->mission.field.utc_ns;
  information.duration_s = prepared->mission.duration_s;
  result.information = std::move(information);
  return result;
}

}  // namespace navcal::gap
