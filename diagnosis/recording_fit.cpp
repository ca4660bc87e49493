// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/recording_fit.h"

#include <algorithm>

#include "diagnosis/limits.h"
#include "identify/fit/estimate.h"

namespace navcal::diagnosis {
namespace {

using identify::FitProblem;
using identify::kNuisances;
using identify::Unknowns;

/// Greatest number of steps of a fit: of states and nuisances alone, and of all.
constexpr int kStepsOfStates = 10, kSteps = 12;

/// All parameters with these priors, and which of them are fitted: the numbers of the layout, and those with a
/// prior.
struct Fitted {
  std::vector<identify::Parameter> all, active;
  std::vector<Eigen::Index> columns;  ///< of `active` among all
};

Fitted fitted_with(const CauseLibrary& library, const std::vector<ParameterPrior>& priors) {
  Fitted fitted{library.parameters, {}, {}};
  for (const ParameterPrior& prior : priors) {
    if (prior.column >= static_cast<Eigen::Index>(fitted.all.size())) continue;
    identify::Parameter& parameter = fitted.all[static_cast<std::size_t>(prior.column)];
    parameter.prior = prior.mean;
    parameter.prior_std = prior.std;
  }
  for (std::size_t i = 0; i < fitted.all.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const bool has_prior = std::any_of(priors.begin(), priors.end(),
                                       [&](const ParameterPrior& prior) { return prior.column == column; });
    if (i >= library.layout_numbers && !has_prior) continue;
    fitted.active.push_back(fitted.all[i]);
    fitted.columns.push_back(column);
  }
  return fitted;
}

void add_powers(const FitProblem& problem, const Unknowns& unknowns, RecordingFit& fit) {
  std::array<double, identify::kChannels> squares{}, counts{};
  const auto white = problem.white_residuals_of(unknowns);
  for (std::size_t k = 0; k < white.front().size(); ++k) {
    const auto& readings = problem.windows().front()[k].readings;
    const Eigen::VectorXd& of = white.front()[k];
    for (Eigen::Index i = 0; i < of.size(); ++i) {
      const auto channel = static_cast<std::size_t>(readings[static_cast<std::size_t>(i)].channel);
      squares[channel] += of[i] * of[i];
      counts[channel] += 1;
    }
    fit.window_power.push_back(of.squaredNorm());
    fit.window_readings.push_back(static_cast<double>(of.size()));
    fit.readings += static_cast<double>(of.size());
  }
  for (std::size_t c = 0; c < identify::kChannels; ++c)
    fit.channel_power[c] = counts[c] > 0 ? squares[c] / counts[c] : -1;
}

}  // namespace

LinearRecording LinearRecording::about(const Eigen::VectorXd& at) const {
  return {gram, score - gram * at, power - 2 * score.dot(at) + at.dot(gram * at)};
}

FittedRecording::FittedRecording(const config::Layout& layout, const CauseLibrary& library,
                                 const std::vector<identify::RecordedMotion>& one_recording,
                                 const identify::NoiseModel& noise, const identify::FitSettings& settings)
    : layout_(layout), library_(library), recordings_(one_recording), noise_(noise), settings_(settings),
      nuisance_stds_(identify::nuisance_stds(one_recording.front())) {
  for (const Cause& cause : library.causes) {
    if (!cause.is_instrument) continue;
    for (const CauseParameter& parameter : cause.parameters)
      nuisance_stds_[parameter.column - static_cast<Eigen::Index>(library.parameters.size())] =
          kTolerance * parameter.typical * parameter.per_unit;
  }
  static_cast<void>(problem_with({}, nuisance_stds_));
}

FitProblem FittedRecording::problem_with(std::vector<identify::Parameter> parameters,
                                         const identify::Calibration& nuisance_stds) const {
  FitProblem problem(layout_, std::move(parameters), recordings_, settings_);
  problem.set_noise(noise_);
  problem.set_nuisance_stds(0, nuisance_stds);
  return problem;
}

Unknowns FittedRecording::unknowns_of(const RecordingFit& fit) const {
  Unknowns unknowns;
  const auto parameters = static_cast<Eigen::Index>(library_.parameters.size());
  unknowns.parameters = fit.at.head(parameters);
  for (std::size_t i = 0; i < library_.layout_numbers; ++i)
    unknowns.parameters[static_cast<Eigen::Index>(i)] += library_.parameters[i].prior;
  unknowns.calibrations.emplace_back(fit.at.tail<kNuisances>());
  unknowns.states = fit.states;
  return unknowns;
}

RecordingFit FittedRecording::fit(const std::vector<ParameterPrior>& priors, const RecordingFit* from,
                                  const Progress& progress) const {
  const Fitted fitted = fitted_with(library_, priors);
  const auto first_nuisance = static_cast<Eigen::Index>(library_.parameters.size());
  identify::Calibration stds = nuisance_stds_;
  for (const ParameterPrior& prior : priors) {
    if (prior.column >= first_nuisance) stds[prior.column - first_nuisance] = prior.std;
  }
  const FitProblem active = problem_with(fitted.active, stds);
  // The states are guessed anew: those of another vehicle lead to other minima.
  Unknowns start = active.initial();
  if (from != nullptr) start.parameters = unknowns_of(*from).parameters(fitted.columns).eval();
  for (std::size_t i = library_.layout_numbers; i < fitted.active.size(); ++i)
    start.parameters[static_cast<Eigen::Index>(i)] = fitted.active[i].prior;
  const auto tell = [&](double done) {
    return [&progress, done](std::string_view, double part) { progress(done + 0.5 * part); };
  };
  // States and nuisances first: numbers of the layout would be moved to mend a poor guess of them.
  start = identify::minimise(active, std::move(start), kStepsOfStates, FitProblem::Parameters::fixed, tell(0))
              .unknowns;
  Unknowns found =
      identify::minimise(active, std::move(start), kSteps, FitProblem::Parameters::free, tell(0.5)).unknowns;
  const Eigen::VectorXd values = found.parameters;
  found.parameters = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(fitted.all.size()));
  found.parameters(fitted.columns) = values;
  const FitProblem problem = problem_with(fitted.all, stds);
  const FitProblem::Linearised linearised = problem.linearise(found);

  RecordingFit fit;
  const auto parameters = static_cast<Eigen::Index>(library_.parameters.size());
  fit.at.resize(library_.columns());
  fit.at.head(parameters) = found.parameters;
  for (std::size_t i = 0; i < library_.layout_numbers; ++i)
    fit.at[static_cast<Eigen::Index>(i)] -= library_.parameters[i].prior;
  fit.at.tail<kNuisances>() = found.calibrations.front();
  fit.states = found.states;

  // The system contains the priors, the model of the residuals does not.
  Eigen::VectorXd precision(library_.columns()), deviation = fit.at;
  for (Eigen::Index i = 0; i < parameters; ++i) {
    const identify::Parameter& parameter = problem.parameters()[static_cast<std::size_t>(i)];
    precision[i] = 1 / (parameter.prior_std * parameter.prior_std);
    deviation[i] = found.parameters[i] - parameter.prior;
  }
  precision.tail<kNuisances>() = stds.cwiseAbs2().cwiseInverse();
  LinearRecording here;
  here.gram = linearised.system.information();
  here.gram.diagonal() -= precision;
  here.score = linearised.system.effective_scores(0, linearised.windows.front()).rowwise().sum();
  here.power = problem.cost(found) - precision.dot(deviation.cwiseAbs2());
  fit.linear = here.about(-fit.at);
  add_powers(problem, found, fit);
  return fit;
}

std::vector<std::string> FittedRecording::oddities() const { return problem_with({}, nuisance_stds_).oddities(); }

identify::NoiseModel FittedRecording::noise_of(const RecordingFit& fit) const {
  FitProblem problem = problem_with(library_.parameters, nuisance_stds_);
  problem.fit_noise(unknowns_of(fit));
  return problem.noise();
}

}  // namespace navcal::diagnosis
