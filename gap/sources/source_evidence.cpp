// SPDX-License-Identifier: Apache-2.0
#include "gap/sources/source_evidence.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "gap/thresholds.h"

namespace navcal::gap {

ToleranceSpace::ToleranceSpace(const Linearised& nominal, const Priors& priors)
    : residual_(residual_at_zero(nominal)) {
  const Eigen::MatrixXd inner = priors.spike.asDiagonal() * nominal.gram * priors.spike.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(inner);
  // Directions in which the tolerances show less than a twentieth of the noise explain nothing.
  constexpr double kLeast = 1.0 / 400;
  Eigen::Index first = 0;
  while (first < inner.rows() && eigen.eigenvalues()[first] < kLeast) ++first;
  const Eigen::VectorXd power = eigen.eigenvalues().tail(inner.rows() - first);
  const Eigen::MatrixXd directions = priors.spike.asDiagonal() * eigen.eigenvectors().rightCols(power.size()) *
                                     power.cwiseSqrt().cwiseInverse().asDiagonal();
  basis_ = nominal.design * directions;
  share_ = power.array() / (1 + power.array());
  scaled_score_ = share_.cwiseProduct(basis_.transpose() * residual_);
}

MarginalTraces ToleranceSpace::marginalised(const Eigen::MatrixXd& traces) const {
  const Eigen::MatrixXd shared = basis_.transpose() * traces;
  return {traces.transpose() * traces - shared.transpose() * share_.asDiagonal() * shared,
          traces.transpose() * residual_ - shared.transpose() * scaled_score_};
}

namespace {

/// Step of the finite difference, typical values.
constexpr double kErrorStep = 0.2;

/// The columns of the innovations in which an error stays. Empty: the estimator spreads it over all of them.
struct OwnChannels {
  std::vector<Eigen::Index> grid, fixes;
};
OwnChannels own_channels(ErrorPlace place) {
  const auto from = [place](ErrorPlace first) {
    return static_cast<Eigen::Index>(place) - static_cast<Eigen::Index>(first);
  };
  switch (place) {
    case ErrorPlace::force_x:
    case ErrorPlace::force_y:
    case ErrorPlace::force_z: return {{force_x + from(ErrorPlace::force_x)}, {}};
    case ErrorPlace::depth: return {{Channel::depth}, {}};
    case ErrorPlace::position_north:
    case ErrorPlace::position_east: return {{}, {fix_north + from(ErrorPlace::position_north)}};
    case ErrorPlace::velocity_north:
    case ErrorPlace::velocity_east: return {{}, {velocity_north + from(ErrorPlace::velocity_north)}};
    case ErrorPlace::current_north:
    case ErrorPlace::current_east:
      return {{}, {fix_north + from(ErrorPlace::current_north), velocity_north + from(ErrorPlace::current_north)}};
    default: return {};
  }
}

/// Innovations of the nominal vehicle, with those of another one in some columns.
Innovations with_columns_of(const Innovations& other, const OwnChannels& own, Innovations nominal) {
  for (const Eigen::Index c : own.grid) nominal.grid.col(c) = other.grid.col(c);
  for (const Eigen::Index c : own.fixes) nominal.fixes.col(c) = other.fixes.col(c);
  return nominal;
}

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
      if (std::ranges::find(before.terms, j) != before.terms.end()) continue;
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
    return std::ranges::find(covariate.families, family) != covariate.families.end();
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
    const bool serves = std::ranges::any_of(
        sources, [&](const ErrorSource* source) { return may_follow(*source, covariates[k], set); });
    if (serves) series.push_back({k, std::make_shared<const Eigen::VectorXd>(covariates[k].values)});
  }
  return series;
}

}  // namespace

std::vector<SourcesTogether> by_replays(std::span<const ErrorSource* const> sources, const Mission& mission) {
  std::vector<SourcesTogether> all;
  SourcesTogether followers;
  for (const ErrorSource* source : sources) {
    const ErrorPlace place = source->components.front().place;
    const OwnChannels own = own_channels(place);
    // A current shows in the channels in which the receiver's errors show.
    const bool alone = (own.grid.empty() && own.fixes.empty()) || place == ErrorPlace::current_north;
    if (alone || !mission.silences.empty()) {
      all.push_back({source});
    } else {
      followers.push_back(source);
    }
  }
  if (!followers.empty()) all.push_back(std::move(followers));
  return all;
}

ErrorTraces::ErrorTraces(const ResidualModel& model, const Eigen::VectorXd& at, double begin_s)
    : model_(model), about_(model.library.model(at)), begin_s_(begin_s),
      nominal_(model.replay.run_coarsely(about_)) {}

Innovations ErrorTraces::innovations_with(std::span<const ErrorComponent* const> components,
                                          const std::shared_ptr<const Eigen::VectorXd>& series) const {
  Model model = about_;
  for (const ErrorComponent* component : components) {
    const double amplitude = kErrorStep * component->typical;
    model.effects.add(std::make_unique<TimedError>(component->place, series, begin_s_))
        .set_parameters(std::span(&amplitude, 1));
  }
  return model_.replay.run_coarsely(model);
}

Eigen::MatrixXd ErrorTraces::of(const std::vector<const ErrorComponent*>& components, bool in_one_replay,
                                const std::vector<Series>& series) const {
  const Layout layout = layout_of(model_.replay);
  const Eigen::VectorXd white = model_.whitening(nominal_, layout);
  const auto count = static_cast<Eigen::Index>(series.size());
  Eigen::MatrixXd traces(white.size(), static_cast<Eigen::Index>(components.size()) * count);
  const auto write = [&](const Innovations& with, std::size_t component, std::size_t k) {
    traces.col(static_cast<Eigen::Index>(component) * count + static_cast<Eigen::Index>(k)) =
        (white - model_.whitening(with, layout)) / (kErrorStep * components[component]->typical);
  };
  const std::size_t replays = in_one_replay ? 1 : components.size();
  base::in_parallel(model_.threads, replays * series.size(), [&](std::size_t i) {
    const std::size_t k = i % series.size(), c = i / series.size();
    if (!in_one_replay) {
      write(innovations_with(std::span(&components[c], 1), series[k].values), c, k);
      return;
    }
    const Innovations together = innovations_with(components, series[k].values);
    for (std::size_t each = 0; each < components.size(); ++each) {
      write(with_columns_of(together, own_channels(components[each]->place), nominal_), each, k);
    }
  });
  return traces;
}

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
  std::ranges::stable_sort(fits, std::ranges::greater(), &SourceFit::gain_nats);
  return fits;
}

std::vector<SourceFit> SourceEvidence::descriptions(const ErrorSource& source) const {
  const auto paths = paths_of({&source}, CovariateSet::full);
  return paths.empty() ? std::vector<SourceFit>() : paths.front();
}

}  // namespace navcal::gap
