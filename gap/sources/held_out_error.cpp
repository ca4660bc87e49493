// SPDX-License-Identifier: Apache-2.0
#include "gap/sources/held_out_error.h"

#include <Eigen/Cholesky>
#include <memory>
#include <utility>

#include "gap/inference/blocks.h"

namespace navcal::gap {
namespace {

/// The covariate of another course with the mean and scale of that of the fit.
Eigen::VectorXd values_in(const Covariate& other, const Covariate& fitted, bool with_own_mean) {
  const double mean = with_own_mean ? other.mean : fitted.mean;
  return (other.scale * other.values.array() + other.mean - mean) / fitted.scale;
}

bool is_gyro(ErrorPlace place) { return place >= ErrorPlace::gyro_ax && place <= ErrorPlace::gyro_bz; }

Eigen::VectorXd whitened(const ResidualModel& of, const Model& model) {
  return of.whitening(of.replay.run(model), layout_of(of.replay));
}

void add_error(const ErrorTerm& term, Eigen::VectorXd series, double begin_s, Model& model) {
  model.effects
      .add(std::make_unique<TimedError>(term.component->place,
                                        std::make_shared<const Eigen::VectorXd>(std::move(series)), begin_s))
      .set_parameters(std::span(&term.coefficient, 1));
}

}  // namespace

std::vector<HeldOutError> predict_other(std::span<const SourceFit> fits, const SourceProblem& problem,
                                        const ResidualModel& other, const Eigen::VectorXd& at,
                                        const Trajectory10Hz& course) {
  const std::vector<Covariate> covariates = covariates_of(course);
  const Model nominal = other.library.model(at);
  const Eigen::VectorXd residual = whitened(other, nominal);
  const double before = residual.squaredNorm();
  std::vector<HeldOutError> errors;
  for (const SourceFit& fit : fits) {
    Model model = nominal;
    for (const ErrorTerm& term : fit.terms) {
      add_error(term,
                values_in(covariates[term.covariate], problem.covariates[term.covariate],
                          is_gyro(term.component->place)),
                course.time_s.front(), model);
    }
    const double after = whitened(other, model).squaredNorm();
    errors.push_back({0.5 * (before - after), before, after, static_cast<double>(Whitening::count(residual))});
  }
  return errors;
}

HeldOutError predict_blocks(const SourceFit& fit, const SourceProblem& problem) {
  const ResidualModel& of = problem.model;
  const Model nominal = of.library.model(problem.nominal.at);
  const Eigen::VectorXd residual = whitened(of, nominal);
  const auto count = static_cast<Eigen::Index>(fit.terms.size());
  // Traces of each term at its estimated size: coefficients about 1.
  Eigen::MatrixXd traces(residual.size(), count);
  Eigen::VectorXd information(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const ErrorTerm& term = fit.terms[static_cast<std::size_t>(i)];
    Model model = nominal;
    add_error(term, problem.covariates[term.covariate].values, problem.begin_s, model);
    traces.col(i) = residual - whitened(of, model);
    constexpr double kWide = 3;  // standard deviation of the prior, in estimates
    information[i] = 1 / (kWide * kWide);
  }
  const Layout layout = layout_of(of.replay);
  Eigen::VectorXd even(residual.size());
  for (Eigen::Index i = 0; i < even.size(); ++i) even[i] = is_in_even_minute(i, layout, even.size()) ? 1 : 0;
  HeldOutError result{0, residual.squaredNorm(), 0, static_cast<double>(Whitening::count(residual))};
  for (const bool learn_from_even : {true, false}) {
    const Eigen::VectorXd learn = learn_from_even ? even : Eigen::VectorXd(1 - even.array());
    const Eigen::MatrixXd learnt = learn.asDiagonal() * traces;
    Eigen::MatrixXd gram = learnt.transpose() * traces;
    gram.diagonal() += information;
    const Eigen::VectorXd coefficients = gram.llt().solve(learnt.transpose() * residual);
    result.after += (1 - learn.array()).matrix().cwiseProduct(residual - traces * coefficients).squaredNorm();
  }
  result.gain_nats = 0.5 * (result.before - result.after);
  return result;
}

}  // namespace navcal::gap
