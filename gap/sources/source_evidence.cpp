// SPDX-License-Identifier: Apache-2.0
#include "gap/sources/source_evidence.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "gap/thresholds.h"

namespace navcal::gap {
namespace {

/// Standard deviations of the prior of a coefficient, in typical values of its component.
constexpr std::array<double, 3> kCoefficients{0.1, 0.5, 2.5};

/// All terms of one source, and their traces.
struct Terms {
  std::vector<ErrorTerm> all;
  MarginalTraces traces;
};

/// Terms that were chosen, and the standard deviations of their priors.
struct Choice {
  std::vector<Eigen::Index> terms;
  std::vector<double> widths;
  double evidence = 0;
};

struct ChoicePosterior {
  Eigen::VectorXd mean, std;
};

/// Matrix T G T + 1 and vector T s of chosen terms with prior standard deviations T.
std::pair<Eigen::MatrixXd, Eigen::VectorXd> scaled(const Terms& terms, const Choice& choice) {
  const auto n = static_cast<Eigen::Index>(choice.terms.size());
  Eigen::MatrixXd gram(n, n);
  Eigen::VectorXd score(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto a = static_cast<std::size_t>(i);
    score[i] = choice.widths[a] * terms.traces.score[choice.terms[a]];
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto b = static_cast<std::size_t>(j);
      gram(i, j) = choice.widths[a] * choice.widths[b] * terms.traces.gram(choice.terms[a], choice.terms[b]);
    }
    gram(i, i) += 1;
  }
  return {gram, score};
}

double choice_evidence(const Terms& terms, const Choice& choice) {
  const auto [gram, score] = scaled(terms, choice);
  const Eigen::LLT<Eigen::MatrixXd> factor(gram);
  return 0.5 * score.dot(factor.solve(score)) - factor.matrixLLT().diagonal().array().log().sum();
}

ChoicePosterior posterior_of(const Terms& terms, const Choice& choice) {
  const auto [gram, score] = scaled(terms, choice);
  const Eigen::MatrixXd inverse = gram.llt().solve(Eigen::MatrixXd::Identity(gram.rows(), gram.cols()));
  const Eigen::Map<const Eigen::VectorXd> width(choice.widths.data(), gram.rows());
  return {width.cwiseProduct(inverse * score), width.cwiseProduct(inverse.diagonal().cwiseSqrt())};
}

/// Chooses one term after the other, as long as the evidence grows by more than the choice costs. Returns the
/// choices of one term, of two and so on; the last one has the largest evidence.
std::vector<Choice> chosen(const Terms& terms) {
  std::vector<Choice> path;
  const auto count = static_cast<double>(terms.all.size() * kCoefficients.size());
  const double cost = std::log(std::max(1.0, count));
  while (path.size() < kMostErrorTerms) {
    const Choice before = path.empty() ? Choice() : path.back();
    Choice leader;
    leader.evidence = before.evidence;
    for (Eigen::Index j = 0; j < terms.traces.score.size(); ++j) {
      if (std::find(before.terms.begin(), before.terms.end(), j) != before.terms.end()) continue;
      for (const double coefficient : kCoefficients) {
        Choice next = before;
        next.terms.push_back(j);
        next.widths.push_back(coefficient * terms.all[static_cast<std::size_t>(j)].component->typical);
        next.evidence = choice_evidence(terms, next) - cost * static_cast<double>(next.terms.size());
        if (next.evidence > leader.evidence) leader = std::move(next);
      }
    }
    if (leader.terms.empty()) break;
    path.push_back(std::move(leader));
  }
  return path;
}

/// The description by a choice of terms.
SourceFit fit_of(const ErrorSource& source, const Terms& terms, const Choice& choice) {
  const ChoicePosterior posterior = posterior_of(terms, choice);
  SourceFit fit{&source, choice.evidence, {}};
  for (std::size_t i = 0; i < choice.terms.size(); ++i) {
    ErrorTerm term = terms.all[static_cast<std::size_t>(choice.terms[i])];
    term.coefficient = posterior.mean[static_cast<Eigen::Index>(i)];
    term.std_error = posterior.std[static_cast<Eigen::Index>(i)];
    fit.terms.push_back(term);
  }
  return fit;
}

/// Whether an error of a source may follow a covariate.
bool may_follow(const ErrorSource& source, const Covariate& covariate, CovariateSet set) {
  const auto has = [&](std::string_view family) {
    return std::find(covariate.families.begin(), covariate.families.end(), family) != covariate.families.end();
  };
  if (!covariate.varies || (set == CovariateSet::basic && !covariate.is_basic)) return false;
  if (has("constant") && source.is_biased) return false;
  return (!has("heading") || source.follows_heading) && (!has("command") || source.follows_orders);
}

/// The covariates that an error of any of these sources may follow.
std::vector<Series> series_for(const SourcesTogether& sources, std::span<const Covariate> covariates,
                               CovariateSet set) {
  std::vector<Series> series;
  for (std::size_t k = 0; k < covariates.size(); ++k) {
    const bool serves = std::any_of(sources.begin(), sources.end(), [&](const ErrorSource* source) {
      return may_follow(*source, covariates[k], set);
    });
    if (serves) series.push_back({k, std::make_shared<const Eigen::VectorXd>(covariates[k].values)});
  }
  return series;
}

}  // namespace

SourceEvidence::SourceEvidence(const SourceProblem& problem)
    : problem_(problem), tolerances_(problem.nominal, problem.priors),
      replayed_(problem.model, problem.nominal.at, problem.begin_s) {}

std::vector<std::vector<SourceFit>> SourceEvidence::paths_of(const SourcesTogether& sources,
                                                             CovariateSet set) const {
  const std::vector<Series> series = series_for(sources, problem_.covariates, set);
  std::vector<const ErrorComponent*> components;
  for (const ErrorSource* source : sources) {
    for (const ErrorComponent& component : source->components) components.push_back(&component);
  }
  const Eigen::MatrixXd traces = replayed_.of(components, sources.size() > 1, series);
  std::vector<std::vector<SourceFit>> paths;
  Eigen::Index column = 0;
  for (const ErrorSource* source : sources) {
    Terms terms;
    std::vector<Eigen::Index> columns;
    for (const ErrorComponent& component : source->components) {
      for (const Series& each : series) {
        if (may_follow(*source, problem_.covariates[each.covariate], set)) {
          terms.all.push_back({&component, each.covariate, 0, 0});
          columns.push_back(column);
        }
        ++column;
      }
    }
    terms.traces = tolerances_.marginalised(traces(Eigen::all, columns));
    std::vector<SourceFit> path;
    for (const Choice& choice : chosen(terms)) path.push_back(fit_of(*source, terms, choice));
    if (!path.empty()) paths.push_back(std::move(path));
  }
  return paths;
}

std::vector<SourceFit> SourceEvidence::ranked(std::span<const ErrorSource* const> candidates,
                                              const std::function<void(double)>& progress) const {
  std::vector<SourceFit> fits;
  const std::vector<SourcesTogether> groups = by_replays(candidates, problem_.model.replay.mission());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    progress(static_cast<double>(i) / static_cast<double>(groups.size()));
    for (auto& path : paths_of(groups[i], CovariateSet::basic)) fits.push_back(std::move(path.back()));
  }
  std::stable_sort(fits.begin(), fits.end(),
                   [](const SourceFit& a, const SourceFit& b) { return a.gain_nats > b.gain_nats; });
  return fits;
}

std::vector<SourceFit> SourceEvidence::descriptions(const ErrorSource& source) const {
  const auto paths = paths_of({&source}, CovariateSet::full);
  return paths.empty() ? std::vector<SourceFit>() : paths.front();
}

}  // namespace navcal::gap
