// SPDX-License-Identifier: Apache-2.0
#include "identify/answer/identification.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "base/angles.h"
#include "identify/answer/prediction.h"
#include "identify/conventions/conventions.h"
#include "identify/filter/noise_fit.h"

namespace navcal::identify {
namespace {

constexpr double kFarFromPrior = 4;       ///< standard deviations of the prior
constexpr double kPoorFit = 3;            ///< residuals over noise
constexpr double kLate = 0.06;            ///< s
constexpr double kApart_sigma = 3;        ///< of two starts
constexpr double kNoBetter = 0.999;       ///< held-out residuals after over before
constexpr double kWorse = 1.01;           ///< likewise: the fit has made it worse
constexpr std::size_t kFewestStarts = 3;  ///< of a root mean square
constexpr double kFarther = 1.5;          ///< errors of held-out predictions after over before
constexpr double kFewPerChannel = 20;

using Parameters = PredictionErrorProblem::Parameters;

double rms_of(const PredictionErrorProblem::Point& point) {
  double sum = 0, n = 0;
  for (const FilterPass& pass : point.passes) {
    sum += pass.power();
    n += pass.count();
  }
  return n > 0 ? std::sqrt(sum / n) : std::numeric_limits<double>::infinity();
}

/// Innovations with these parameters, the nuisances fitted to them.
double rms_with(const PredictionErrorProblem& problem, const Eigen::VectorXd& parameters,
                const FitProgress& progress) {
  constexpr int kSteps = 4;
  Eigen::VectorXd unknowns = problem.start();
  unknowns.head(parameters.size()) = parameters;
  auto point = problem.at(problem.with_delays(std::move(unknowns)));
  if (!point.passes.empty())
    point = problem.minimise(std::move(point), kSteps, Parameters::fixed, progress, "judge");
  return rms_of(point);
}

std::vector<ChannelFit> channels_of_fit(const PredictionErrorProblem& problem, const Estimate& estimate) {
  std::vector<ChannelFit> all;
  for (std::size_t c = 0; c < kChannels; ++c) {
    const auto channel = static_cast<Channel>(c);
    ChannelFit fit{channel, 0, problem.noises().factor[c], 0};
    FilteredReplay::Neighbours neighbours;
    for (std::size_t r = 0; r < problem.filters().size(); ++r) {
      const auto own = problem.filters()[r].neighbours(estimate.point.passes[r].readings, c);
      neighbours.count += own.count;
      neighbours.squares += own.squares;
      neighbours.products += own.products;
    }
    if (neighbours.count == 0) continue;
    fit.readings = static_cast<std::size_t>(neighbours.count);
    fit.correlation = neighbours.correlation();
    all.push_back(fit);
  }
  return all;
}

std::vector<NuisanceFit> nuisances_of_fit(const PredictionErrorProblem& problem, const Estimate& estimate) {
  std::vector<NuisanceFit> all;
  for (std::size_t r = 0; r < problem.filters().size(); ++r) {
    const Calibration priors = estimated_nuisance_stds(problem.filters()[r]);
    for (Eigen::Index i = 0; i < kNuisances; ++i) {
      const Eigen::Index at = problem.nuisances_at(r) + i;
      const double std = std::sqrt(estimate.border_covariance(at, at));
      if (std > kTold * priors[i]) continue;
      const NuisanceDescription& of = nuisances()[static_cast<std::size_t>(i)];
      all.push_back({problem.filters()[r].recording().name, std::string(of.name), std::string(of.unit),
                     estimate.unknowns[at], std});
    }
  }
  return all;
}

std::vector<DisturbanceFit> disturbances_of_fit(const PredictionErrorProblem& problem, const Estimate& estimate) {
  constexpr std::array<std::string_view, 6> kAxisNames{"surge", "sway", "heave", "roll", "pitch", "yaw"};
  sim::Vector6 power = sim::Vector6::Zero();
  for (std::size_t r = 0; r < problem.filters().size(); ++r)
    power += problem.filters()[r].actuator_power(estimate.point.passes[r]);
  power /= static_cast<double>(problem.filters().size());
  std::vector<DisturbanceFit> all;
  for (std::size_t i = 0; i < kAxisNames.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    DisturbanceFit fit{
        kAxisNames[i], i < 3 ? "m/s2" : "rad/s2", problem.noises().coloured[at], problem.noises().white[at], {}};
    // Below a thousandth of it the actuators do not move the vehicle this way.
    if (std::sqrt(power[at]) > 1e-3 * fit.coloured) fit.share = fit.coloured / std::sqrt(power[at]);
    all.push_back(fit);
  }
  return all;
}

double delay_of(const PredictionErrorProblem& problem, const Estimate& estimate, std::size_t recording) {
  return estimate.unknowns[problem.nuisances_at(recording) + static_cast<Eigen::Index>(Nuisance::actuator_delay)];
}

void warn_of_fit(const PredictionErrorProblem& problem, const Estimate& estimate, Identification& answer) {
  for (std::size_t r = 0; r < problem.filters().size(); ++r) {
    const double delay_s = delay_of(problem, estimate, r);
    if (std::abs(delay_s) > kLate)
      answer.warnings.push_back(fmt::format(
          "{}: the vehicle follows its commands {:.2f} s {} than the layout and the recording's times say",
          problem.filters()[r].recording().name, std::abs(delay_s), delay_s > 0 ? "later" : "earlier"));
  }
  if (answer.interval_s > 0) answer.warnings.push_back(thinned_warning(answer.interval_s));
  std::string poor, far, bounds;
  for (const ChannelFit& fit : answer.channels) {
    if (static_cast<double>(fit.readings) < kFewPerChannel || fit.noise_scale < kPoorFit) continue;
    poor += fmt::format("{}{} {:.1f}", poor.empty() ? "" : ", ", describe(fit.channel).name, fit.noise_scale);
  }
  for (const IdentifiedParameter& one : answer.parameters) {
    const double away = std::abs(one.value - one.parameter.prior) / one.parameter.prior_std;
    if (away > kFarFromPrior) far += fmt::format("{}{} {:.1f}", far.empty() ? "" : ", ", one.parameter.name, away);
    if (one.value <= one.parameter.low || one.value >= one.parameter.high)
      bounds += (bounds.empty() ? "" : ", ") + one.parameter.name;
  }
  if (answer.left_out > 0)
    answer.warnings.push_back(
        fmt::format("{} stretches of a few seconds are left out: the vehicle of the file leaves all bounds there",
                    answer.left_out));
  if (!bounds.empty()) answer.warnings.push_back("numbers at a bound: " + bounds);
  if (estimate.start_spread > kApart_sigma)
    answer.warnings.push_back(
        fmt::format("two starts of the fit end up to {:.1f} stated errors apart; the likelier one is shown, and "
                    "the standard errors contain the difference",
                    estimate.start_spread));
  if (!poor.empty())
    answer.warnings.push_back(
        "the fitted vehicle does not explain the recordings: noise over the instruments' own: " + poor);
  if (!far.empty())
    answer.warnings.push_back("numbers far from the file's, in its standard errors: " + far +
                              ". Is this a recording of another vehicle?");
  if (!answer.converged)
    answer.warnings.push_back(fmt::format("the fit has not settled within {} steps", answer.iterations));
}

/// Where a regression predicts the held-out recordings better, or the file's own numbers do.
void judge_predictions(const IdentifyRequest& request, Identification& answer) {
  try {
    const Prediction of = predict({answer.layout, request.held_out, request.recordings}, [](double) {});
    const Prediction before = predict({request.prior, request.held_out, request.recordings}, [](double) {});
    if (of.by_velocity == before.by_velocity && of.layout_error > kFarther * before.layout_error)
      answer.worse = fmt::format("its predictions are off by {:.3g}, by {:.3g} with the numbers of the file ({})",
                                 of.layout_error, before.layout_error,
                                 of.by_velocity ? "velocity after 1 s, m/s" : "position after 10 s, m");
    const auto add = [&](std::string_view quantity, std::string_view unit,
                         PredictionErrors::Row PredictionErrors::*row, std::size_t horizon, double scale = 1) {
      const PredictionErrors& errors = of.errors.at(horizon);
      const auto in = [&](const PredictionErrors& all, Predictor by) {
        const std::optional<double>& error = (all.*row).at(static_cast<std::size_t>(by));
        return error ? std::optional(scale * *error) : std::nullopt;
      };
      const auto fitted = in(errors, Predictor::layout), file = in(before.errors.at(horizon), Predictor::layout);
      if (!fitted || !file || errors.starts < kFewestStarts) return;
      answer.predictions.push_back(
          {quantity, unit, errors.after_s, errors.starts, *file, *fitted, in(errors, Predictor::linear)});
      if (*fitted > kFarther * *file)
        answer.warnings.push_back(fmt::format(
            "held out, the {} after {:.0f} s is off by {:.3g} {}, by {:.3g} with the numbers of the file",
            quantity, errors.after_s, *fitted, unit, *file));
    };
    add("velocity", "m/s", &PredictionErrors::velocity_m_s, 0);
    for (const std::size_t horizon : {1U, 2U}) {
      if (of.is_steered) break;  // they judge its controller
      add("position", "m", &PredictionErrors::position_m, horizon);
      add("heading", "deg", &PredictionErrors::heading_rad, horizon, base::kDegreesPerRadian);
    }
    for (const auto& [is_worse, what] : {std::pair{of.worse_than_linear, "a linear regression"},
                                         std::pair{of.worse_than_hold, "holding the velocity"}})
      if (is_worse)
        answer.warnings.push_back(fmt::format("held out, the fitted vehicle predicts worse than {}", what));
  } catch (const std::invalid_argument&) {
    // The recordings do not measure what predictions begin with.
  }
}

/// A problem with the recordings that it holds, and what fits them.
struct Thinned {
  double interval_s = 0;
  std::vector<RecordedMotion> recordings;
  std::unique_ptr<PredictionErrorProblem> problem;
  std::size_t left_out = 0;
  Estimate found;
};

/// Readings that hardly depend on each other, and what they tell.
Thinned fitted(const IdentifyRequest& request, const std::vector<Parameter>& parameters,
               const FitProgress& progress) {
  std::optional<Thinned> before;
  for (const double interval_s : kIntervals_s) {
    Thinned all;
    all.interval_s = interval_s;
    for (const RecordedMotion& recording : request.recordings)
      all.recordings.push_back(thinned(recording, interval_s));
    all.problem =
        std::make_unique<PredictionErrorProblem>(request.prior, parameters, all.recordings, request.settings);
    all.left_out = all.problem->leave_out_diverging(all.problem->start());
    if (before) {
      all.found = estimate_from(*all.problem, before->found.unknowns.head(std::ssize(parameters)), progress);
      all.found.iterations += before->found.iterations;
    } else {
      all.found = estimate(*all.problem, progress);
    }
    const double correlation = least_correlation(all.problem->followed(all.found.point), all.problem->noises());
    before = std::move(all);
    if (correlation < kDependent) break;
  }
  return std::move(*before);
}

}  // namespace

Identification identify(const IdentifyRequest& request, const FitProgress& progress) {
  const std::vector<Parameter> parameters = uncertain_parameters(request.prior);
  if (parameters.empty())
    throw std::invalid_argument(
        "the layout states no uncertain number: beside each number that the recordings shall tell, KEY_std states "
        "its standard error, or KEY_range its range");
  Thinned used = fitted(request, parameters, progress);
  Identification answer;
  answer.interval_s = used.interval_s;
  Estimate& found = used.found;
  const auto count = std::ssize(parameters);
  PredictionErrorProblem& problem = *used.problem;
  for (std::string& odd : problem.oddities()) answer.warnings.push_back(std::move(odd));
  for (const Convention& wrong : check_conventions(request.prior, request.recordings, [](double) {}).found)
    answer.warnings.push_back(fmt::format("{} of {}? {}", wrong.name, wrong.what, wrong.sentence));
  answer.left_out = used.left_out;
  const Eigen::VectorXd values = found.unknowns.head(count), priors = prior_values(parameters);
  answer.model_error = found.model_error;
  answer.iterations = found.iterations;
  answer.converged = found.converged;
  for (const RecordedMotion& recording : request.recordings) answer.seconds += recording.duration_s;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    answer.parameters.push_back(
        {parameters[i], values[at], found.stds[at], found.stds[at] <= kTold * parameters[i].prior_std});
  }
  answer.directions = untold_directions(parameters, values, found.covariance);
  answer.channels = channels_of_fit(problem, found);
  answer.nuisances = nuisances_of_fit(problem, found);
  answer.disturbances = disturbances_of_fit(problem, found);
  answer.disturbance_tau_s = problem.noises().tau_s;
  answer.layout = with_estimates(request.prior, parameters, values, found.stds);
  warn_of_fit(problem, found, answer);
  answer.fitted = {rms_with(problem, priors, progress), rms_of(found.point)};
  if (!request.held_out.empty()) {
    std::vector<RecordedMotion> recordings;
    for (const RecordedMotion& recording : request.held_out)
      recordings.push_back(thinned(recording, answer.interval_s));
    PredictionErrorProblem held_out(request.prior, parameters, recordings, request.settings);
    held_out.set_noises(problem.noises());
    held_out.leave_out_diverging(held_out.start());
    const BeforeAfter rms{rms_with(held_out, priors, progress), rms_with(held_out, values, progress)};
    answer.held_out = rms;
    if (!(rms.after < kNoBetter * rms.before))
      answer.warnings.push_back(
          fmt::format("the fit does not improve the held-out recordings: residuals {:.3f} before, {:.3f} after",
                      rms.before, rms.after));
    judge_predictions(request, answer);
    if (rms.after > kWorse * rms.before)
      answer.worse = "its residuals are larger than with the numbers of the file";
  }
  if (request.advise && !answer.directions.empty())
    answer.manoeuvres = advised_manoeuvres(problem, found, request.settings, progress);
  return answer;
}

}  // namespace navcal::identify
