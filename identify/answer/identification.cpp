// SPDX-License-Identifier: Apache-2.0
#include "identify/answer/identification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace navcal::identify {
namespace {

constexpr double kFarFromPrior = 4;  ///< standard deviations of the prior
constexpr double kPoorFit = 3;       ///< residuals over noise
constexpr double kLate = 0.06;       ///< s: three standard deviations of the delay's prior
constexpr double kNoBetter = 0.999;  ///< held-out residuals after over before
constexpr double kFewPerChannel = 20;

double rms_of(const std::vector<std::vector<Eigen::VectorXd>>& residuals) {
  double sum = 0, n = 0;
  for (const auto& windows : residuals) {
    for (const auto& window : windows) {
      sum += window.squaredNorm();
      n += static_cast<double>(window.size());
    }
  }
  return n > 0 ? std::sqrt(sum / n) : 0;
}

/// Residuals with these parameters, the nuisances and states fitted to them.
double rms_with(FitProblem& problem, const NoiseModel& noise, const Eigen::VectorXd& parameters,
                const FitProgress& progress) {
  problem.set_noise(noise);
  Unknowns unknowns = problem.initial();
  unknowns.parameters = parameters;
  return rms_of(problem.white_residuals_of(fit_nuisances(problem, std::move(unknowns), progress)));
}

std::vector<ChannelFit> channels_of_fit(const FitProblem& problem) {
  std::vector<ChannelFit> all;
  for (std::size_t c = 0; c < kChannels; ++c) {
    const auto channel = static_cast<Channel>(c);
    ChannelFit fit{channel, 0, problem.noise().scale(channel), problem.noise().correlation(channel)};
    for (const RecordedMotion& recording : problem.recordings()) fit.readings += recording[channel].size();
    if (fit.readings > 0) all.push_back(fit);
  }
  return all;
}

std::vector<NuisanceFit> nuisances_of_fit(const FitProblem& problem, const Estimate& estimate) {
  std::vector<NuisanceFit> all;
  const auto parameters = static_cast<Eigen::Index>(problem.parameters().size());
  for (std::size_t r = 0; r < problem.recordings().size(); ++r) {
    const Calibration priors = nuisance_stds(problem.recordings()[r]);
    for (Eigen::Index i = 0; i < kNuisances; ++i) {
      const Eigen::Index at = parameters + static_cast<Eigen::Index>(r) * kNuisances + i;
      const double std = std::sqrt(estimate.border_covariance(at, at));
      if (std > kTold * priors[i]) continue;
      const NuisanceDescription& of = nuisances()[static_cast<std::size_t>(i)];
      all.push_back({problem.recordings()[r].name, std::string(of.name), std::string(of.unit),
                     estimate.unknowns.calibrations[r][i], std});
    }
  }
  return all;
}

void warn_of_fit(const FitProblem& problem, const Estimate& estimate, Identification& answer) {
  for (std::size_t r = 0; r < problem.recordings().size(); ++r) {
    const double delay_s = get(estimate.unknowns.calibrations[r], Nuisance::actuator_delay);
    if (std::abs(delay_s) > kLate)
      answer.warnings.push_back(fmt::format(
          "{}: the vehicle follows its commands {:.2f} s {} than the layout and the recording's times say",
          problem.recordings()[r].name, std::abs(delay_s), delay_s > 0 ? "later" : "earlier"));
  }
  std::string poor, far;
  for (const ChannelFit& fit : answer.channels) {
    if (static_cast<double>(fit.readings) < kFewPerChannel || fit.noise_scale < kPoorFit) continue;
    poor += fmt::format("{}{} {:.1f}", poor.empty() ? "" : ", ", describe(fit.channel).name, fit.noise_scale);
  }
  for (const IdentifiedParameter& one : answer.parameters) {
    const double away = std::abs(one.value - one.parameter.prior) / one.parameter.prior_std;
    if (away > kFarFromPrior) far += fmt::format("{}{} {:.1f}", far.empty() ? "" : ", ", one.parameter.name, away);
  }
  if (!poor.empty())
    answer.warnings.push_back(
        "the fitted vehicle does not explain the recordings: residuals over the instruments' noise: " + poor);
  if (!far.empty())
    answer.warnings.push_back("numbers far from the file's, in its standard errors: " + far +
                              ". Is this a recording of another vehicle?");
  if (!answer.converged)
    answer.warnings.push_back(fmt::format("the fit has not settled within {} steps", answer.iterations));
}

}  // namespace

namespace {

/// One fit with the windows of the request.
Identification identified(const IdentifyRequest& request, const FitProgress& progress) {
  const std::vector<Parameter> parameters = uncertain_parameters(request.prior);
  if (parameters.empty())
    throw std::invalid_argument(
        "the layout states no uncertain number: beside each number that the recordings shall tell, KEY_std states "
        "its standard error, or KEY_range its range");
  FitProblem problem(request.prior, parameters, request.recordings, request.settings);
  Identification answer;
  answer.warnings = problem.oddities();
  const Estimate found = estimate(problem, progress);
  answer.model_error = found.model_error;
  answer.iterations = found.iterations;
  answer.converged = found.converged;
  for (const RecordedMotion& recording : request.recordings) answer.seconds += recording.duration_s;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    answer.parameters.push_back({parameters[i], found.unknowns.parameters[at], found.stds[at],
                                 found.stds[at] <= kTold * parameters[i].prior_std});
  }
  answer.directions = untold_directions(parameters, found.unknowns.parameters, found.covariance);
  answer.channels = channels_of_fit(problem);
  answer.nuisances = nuisances_of_fit(problem, found);
  answer.layout = with_estimates(request.prior, parameters, found.unknowns.parameters, found.stds);
  warn_of_fit(problem, found, answer);
  answer.fitted.after = rms_of(problem.white_residuals_of(found.unknowns));
  const Eigen::VectorXd priors = prior_values(parameters);
  answer.fitted.before = rms_with(problem, problem.noise(), priors, progress);
  if (!request.held_out.empty()) {
    FitProblem held_out(request.prior, parameters, request.held_out, request.settings);
    BeforeAfter rms;
    rms.before = rms_with(held_out, problem.noise(), priors, progress);
    rms.after = rms_with(held_out, problem.noise(), found.unknowns.parameters, progress);
    answer.held_out = rms;
    if (!(rms.after < kNoBetter * rms.before))
      answer.warnings.push_back(
          fmt::format("the fit does not improve the held-out recordings: residuals {:.3f} before, {:.3f} after",
                      rms.before, rms.after));
  }
  if (request.advise && !answer.directions.empty())
    answer.manoeuvres = advised_manoeuvres(problem, found, progress);
  return answer;
}

}  // namespace

Identification identify(const IdentifyRequest& request, const FitProgress& progress) {
  IdentifyRequest shorter = request;
  while (true) {
    try {
      Identification answer = identified(shorter, progress);
      if (shorter.settings.window_s < request.settings.window_s) {
        answer.warnings.push_back(fmt::format(
            "windows of {} s were used instead of {} s: within longer ones the vehicle leaves all bounds",
            shorter.settings.window_s, request.settings.window_s));
      }
      return answer;
    } catch (const UnboundedReplay& error) {
      shorter.settings.window_s /= 2;
      if (shorter.settings.window_s < kLeastWindow_s) throw std::invalid_argument(error.what());
    }
  }
}

}  // namespace navcal::identify
