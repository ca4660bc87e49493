// SPDX-License-Identifier: Apache-2.0
#include "identify/fit/fit_problem.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/angles.h"
#include "base/parallel.h"

namespace navcal::identify {
namespace {

StateVector states(double position_m, double depth_m, double angle_rad, double velocity_m_s, double rate_rad_s) {
  StateVector all;
  all << position_m, position_m, depth_m, Eigen::Vector3d::Constant(angle_rad),
      Eigen::Vector3d::Constant(velocity_m_s), Eigen::Vector3d::Constant(rate_rad_s),
      Eigen::Vector2d::Constant(angle_rad);
  return all;
}

/// Standard deviations of what disturbs the vehicle in a second.
StateVector disturbances() { return states(0.015, 0.003, 0.001, 0.003, 0.002); }
StateVector first_state_stds() { return states(100, 5, 0.3, 1, 0.5); }
StateVector state_steps() { return states(1, 1, 1e-4, 1e-4, 1e-4); }

/// Step of a finite difference, as part of the prior's standard deviation.
constexpr double kStepPart = 1e-3;
constexpr double kDelayStep_s = 0.005;
/// Nuisances beside the delay change the prediction only.
constexpr Eigen::Index kDelay = static_cast<Eigen::Index>(Nuisance::actuator_delay);

StateVector tie_stds(const Window& window) { return std::sqrt(window.end_s() - window.begin_s) * disturbances(); }

double delay_of(const Calibration& calibration) { return calibration[kDelay]; }

/// End of a window in the world: the water has carried the vehicle.
StateVector end_of(const ReplayedMotion& motion, const Calibration& calibration) {
  StateVector end = state_of(motion.end());
  const double time_s = ReplayedMotion::kStep_s * static_cast<double>(motion.points.size() - 1);
  end[0] += time_s * get(calibration, Nuisance::current_north);
  end[1] += time_s * get(calibration, Nuisance::current_east);
  return end;
}

}  // namespace

/// The vehicle with each parameter moved a little, and where its actuators were.
struct FitProblem::Vehicles {
  sim::LayoutVehicle nominal;
  std::vector<ActuatorTrajectory> actuators;  ///< of each recording
  std::vector<sim::LayoutVehicle> moved;
  std::vector<std::vector<ActuatorTrajectory>> moved_actuators;  ///< empty: as the nominal ones
  std::vector<double> steps;
};

FitProblem::FitProblem(config::Layout layout, std::vector<Parameter> parameters,
                       const std::vector<RecordedMotion>& recordings, const FitSettings& settings)
    : layout_(std::move(layout)), parameters_(std::move(parameters)), recordings_(recordings),
      settings_(settings) {
  for (const RecordedMotion& recording : recordings_) {
    inputs_.emplace_back(layout_, recording);
    if (!inputs_.back().missing().empty())
      throw std::invalid_argument(recording.name + ": " + inputs_.back().missing().front());
    windows_.push_back(windows_of(recording, settings_.window_s));
    if (windows_.back().empty())
      throw std::invalid_argument(fmt::format("{}: {:.1f} s with readings; at least {:.0f} s are needed",
                                              recording.name, recording.duration_s, settings_.window_s / 2 + 1));
    if (!recording.has(Channel::rate_x) && !recording.has(Channel::rate_z) && !recording.has(Channel::roll) &&
        !recording.has(Channel::heading) && !recording.has(Channel::bottom_x) && !recording.has(Channel::water_x))
      throw std::invalid_argument(recording.name +
                                  ": no rates, no attitude and no Doppler log: nothing measures the motion");
    nuisance_stds_.push_back(nuisance_stds(recording));
  }
}

std::vector<std::string> FitProblem::oddities() const {
  std::vector<std::string> words;
  for (std::size_t r = 0; r < recordings_.size(); ++r) {
    for (const std::string& word : inputs_[r].oddities(layout_))
      words.push_back(recordings_[r].name + ": " + word);
  }
  return words;
}

std::vector<ActuatorTrajectory> FitProblem::trajectories(const config::Layout& layout) const {
  std::vector<ActuatorTrajectory> all;
  for (const ActuatorInputs& inputs : inputs_) all.push_back(inputs.trajectory(layout));
  return all;
}

Unknowns FitProblem::initial() const {
  Unknowns unknowns;
  unknowns.parameters = prior_values(parameters_);
  const sim::LayoutVehicle vehicle(layout_);
  for (std::size_t r = 0; r < recordings_.size(); ++r) {
    unknowns.calibrations.emplace_back(Calibration::Zero());
    const ActuatorTrajectory actuators = inputs_[r].trajectory(layout_);
    unknowns.states.push_back(guessed_states(recordings_[r], windows_[r], vehicle, actuators));
    for (std::size_t k = 0; k < windows_[r].size(); ++k) {
      const Window& window = windows_[r][k];
      StateVector& state = unknowns.states[r][k];
      if (replay(vehicle, actuators, 0, window.begin_s, window.steps, state, recordings_[r].tilt_lag_s)) continue;
      state.segment<6>(6).setZero();
      if (replay(vehicle, actuators, 0, window.begin_s, window.steps, state, recordings_[r].tilt_lag_s)) continue;
      throw UnboundedReplay(
          fmt::format("{}: from {:.1f} s on the vehicle of the layout leaves all bounds within a window of {:.1f} "
                      "s: pitch beyond "
                      "88 degrees or speeds beyond 50 m/s. Shorter windows help where it is unstable; navcal "
                      "vehicle check shows "
                      "what is odd about it",
                      recordings_[r].name, window.begin_s, window.end_s() - window.begin_s));
    }
  }
  return unknowns;
}

std::vector<std::pair<std::size_t, std::size_t>> FitProblem::all_windows() const {
  std::vector<std::pair<std::size_t, std::size_t>> all;
  for (std::size_t r = 0; r < windows_.size(); ++r) {
    for (std::size_t k = 0; k < windows_[r].size(); ++k) all.emplace_back(r, k);
  }
  return all;
}

std::optional<FitProblem::Replayed> FitProblem::replayed(const sim::LayoutVehicle& vehicle,
                                                         const ActuatorTrajectory& actuators,
                                                         const Unknowns& unknowns, std::size_t recording,
                                                         std::size_t window) const {
  const Window& of = windows_[recording][window];
  const Calibration& calibration = unknowns.calibrations[recording];
  const auto motion = replay(vehicle, actuators, delay_of(calibration), of.begin_s, of.steps,
                             unknowns.states[recording][window], recordings_[recording].tilt_lag_s);
  if (!motion) return std::nullopt;
  const PredictedReadings predicted(recordings_[recording]);
  Replayed out;
  out.residuals = residuals(of.readings, predicted(*motion, of.readings, calibration));
  out.tie.setZero();
  if (window + 1 < windows_[recording].size()) {
    out.tie = end_of(*motion, calibration) - unknowns.states[recording][window + 1];
    out.tie[5] = base::wrapped(out.tie[5]);
    out.tie = out.tie.cwiseQuotient(tie_stds(of));
  }
  Eigen::MatrixXd white = out.residuals;
  noise_.whiten(of.readings, white);
  out.cost = white.squaredNorm() + out.tie.squaredNorm();
  return out;
}

double FitProblem::prior_cost(const Unknowns& unknowns) const {
  double cost =
      (unknowns.parameters - prior_values(parameters_)).cwiseQuotient(prior_stds(parameters_)).squaredNorm();
  for (std::size_t r = 0; r < recordings_.size(); ++r)
    cost += unknowns.calibrations[r].cwiseQuotient(nuisance_stds_[r]).squaredNorm();
  return cost;
}

double FitProblem::cost(const Unknowns& unknowns) const {
  const config::Layout layout = with_values(layout_, parameters_, unknowns.parameters);
  const sim::LayoutVehicle vehicle(layout);
  const auto actuators = trajectories(layout);
  const auto windows = all_windows();
  std::vector<double> costs(windows.size());
  base::in_parallel(settings_.threads, windows.size(), [&](std::size_t i) {
    const auto [r, k] = windows[i];
    const auto one = replayed(vehicle, actuators[r], unknowns, r, k);
    costs[i] = one ? one->cost : std::numeric_limits<double>::infinity();
  });
  double cost = prior_cost(unknowns);
  for (const double one : costs) cost += one;
  return cost;
}

std::vector<std::vector<Eigen::VectorXd>> FitProblem::residuals_of(const Unknowns& unknowns) const {
  const config::Layout layout = with_values(layout_, parameters_, unknowns.parameters);
  const sim::LayoutVehicle vehicle(layout);
  const auto actuators = trajectories(layout);
  std::vector<std::vector<Eigen::VectorXd>> all;
  for (const auto& windows : windows_) all.emplace_back(windows.size());
  const auto windows = all_windows();
  base::in_parallel(settings_.threads, windows.size(), [&](std::size_t i) {
    const auto [r, k] = windows[i];
    if (auto one = replayed(vehicle, actuators[r], unknowns, r, k)) all[r][k] = std::move(one->residuals);
  });
  return all;
}

std::vector<std::vector<Eigen::VectorXd>> FitProblem::white_residuals_of(const Unknowns& unknowns) const {
  auto all = residuals_of(unknowns);
  for (std::size_t r = 0; r < all.size(); ++r) {
    for (std::size_t k = 0; k < all[r].size(); ++k) {
      if (all[r][k].size() == 0) continue;
      Eigen::MatrixXd white = all[r][k];
      noise_.whiten(windows_[r][k].readings, white);
      all[r][k] = white.col(0);
    }
  }
  return all;
}

void FitProblem::fit_noise(const Unknowns& unknowns) {
  const auto all = residuals_of(unknowns);
  std::vector<NoiseModel::WindowResiduals> rows;
  double states = 0;
  for (std::size_t r = 0; r < all.size(); ++r) {
    for (std::size_t k = 0; k < all[r].size(); ++k) {
      if (all[r][k].size() > 0) rows.push_back({&windows_[r][k].readings, &all[r][k]});
    }
    states += static_cast<double>(kStates) + static_cast<double>(kNuisances) / 2;
  }
  noise_ = NoiseModel::fitted_to(rows, states + static_cast<double>(parameters_.size()));
}

WindowEquations FitProblem::window_equations(const Vehicles& vehicles, const Unknowns& unknowns,
                                             std::size_t recording, std::size_t window) const {
  const Window& of = windows_[recording][window];
  const Calibration& calibration = unknowns.calibrations[recording];
  const StateVector& begin = unknowns.states[recording][window];
  const PredictedReadings predicted(recordings_[recording]);
  const auto parameters = static_cast<Eigen::Index>(parameters_.size());
  const auto rows = static_cast<Eigen::Index>(of.readings.size());
  const Eigen::Index at_state = parameters + kNuisances, at_next = at_state + kStates;
  const ActuatorTrajectory& actuators = vehicles.actuators[recording];
  const auto run = [&](const sim::LayoutVehicle& vehicle, const ActuatorTrajectory& where, double delay_s,
                       const StateVector& state) {
    auto motion = replay(vehicle, where, delay_s, of.begin_s, of.steps, state, recordings_[recording].tilt_lag_s);
    if (!motion) throw UnboundedReplay("a replay leaves all bounds");
    return std::move(*motion);
  };
  const ReplayedMotion nominal = run(vehicles.nominal, actuators, delay_of(calibration), begin);
  const Eigen::VectorXd at_nominal = predicted(nominal, of.readings, calibration);
  const StateVector end = end_of(nominal, calibration);
  // Readings above, the ties below.
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(rows + kStates, at_next + kStates);
  const auto fill = [&](Eigen::Index column, const ReplayedMotion& motion, const Calibration& with, double step) {
    const Eigen::VectorXd difference =
        residuals(of.readings, at_nominal) - residuals(of.readings, predicted(motion, of.readings, with));
    for (Eigen::Index i = 0; i < rows; ++i) {
      const bool is_angle = describe(of.readings[static_cast<std::size_t>(i)].channel).is_angle;
      jacobian(i, column) = (is_angle ? base::wrapped(difference[i]) : difference[i]) / step;
    }
    jacobian.col(column).tail<kStates>() = (end_of(motion, with) - end) / step;
  };
  for (Eigen::Index i = 0; i < std::ssize(vehicles.moved); ++i) {
    const auto p = static_cast<std::size_t>(i);
    const auto& moved = vehicles.moved_actuators[p];
    const auto motion =
        replay(vehicles.moved[p], moved.empty() ? actuators : moved[recording], delay_of(calibration), of.begin_s,
               of.steps, begin, recordings_[recording].tilt_lag_s);
    // A vehicle that leaves all bounds for a small step is not linear here: this window then says nothing of the
    // number.
    if (motion) fill(i, *motion, calibration, vehicles.steps[p]);
  }
  for (Eigen::Index i = 0; i < kNuisances; ++i) {
    Calibration with = calibration;
    const double step = i == kDelay ? kDelayStep_s : kStepPart * nuisance_stds_[recording][i];
    with[i] += step;
    if (i == kDelay) {
      const auto motion = replay(vehicles.nominal, actuators, delay_of(with), of.begin_s, of.steps, begin,
                                 recordings_[recording].tilt_lag_s);
      if (motion) fill(parameters + i, *motion, with, step);
    } else {
      fill(parameters + i, nominal, with, step);
    }
  }
  const StateVector steps = state_steps();
  for (Eigen::Index i = 0; i < kStates; ++i) {
    // An unstable vehicle may leave all bounds to one side only. To both, this window says nothing of the state.
    for (const double step : {steps[i], -steps[i]}) {
      StateVector state = begin;
      state[i] += step;
      const auto motion = replay(vehicles.nominal, actuators, delay_of(calibration), of.begin_s, of.steps, state,
                                 recordings_[recording].tilt_lag_s);
      if (!motion) continue;
      fill(at_state + i, *motion, calibration, step);
      break;
    }
  }
  Eigen::MatrixXd right(rows + kStates, 1);
  right.topRows(rows) = residuals(of.readings, at_nominal);
  noise_.whiten(of.readings, jacobian.topRows(rows));
  noise_.whiten(of.readings, right.topRows(rows));
  if (window + 1 < windows_[recording].size()) {
    StateVector tie = end - unknowns.states[recording][window + 1];
    tie[5] = base::wrapped(tie[5]);
    const StateVector stds = tie_stds(of);
    jacobian.bottomRows<kStates>() = stds.cwiseInverse().asDiagonal() * jacobian.bottomRows<kStates>();
    jacobian.block<kStates, kStates>(rows, at_next).diagonal() = -stds.cwiseInverse();
    right.bottomRows<kStates>() = -tie.cwiseQuotient(stds);
  } else {
    jacobian.bottomRows<kStates>().setZero();
    right.bottomRows<kStates>().setZero();
  }
  WindowEquations equations;
  equations.gram = jacobian.transpose() * jacobian;
  equations.score = jacobian.transpose() * right.col(0);
  return equations;
}

FitProblem::Linearised FitProblem::linearise(const Unknowns& unknowns, Parameters which) const {
  const config::Layout nominal = with_values(layout_, parameters_, unknowns.parameters);
  Vehicles vehicles{sim::LayoutVehicle(nominal), trajectories(nominal), {}, {}, {}};
  for (std::size_t i = 0; i < parameters_.size() && which == Parameters::free; ++i) {
    Eigen::VectorXd values = unknowns.parameters;
    double step = parameters_[i].step > 0 ? parameters_[i].step : kStepPart * parameters_[i].prior_std;
    if (values[static_cast<Eigen::Index>(i)] + step > parameters_[i].high) step = -step;
    values[static_cast<Eigen::Index>(i)] += step;
    const config::Layout layout = with_values(layout_, parameters_, values);
    vehicles.moved.emplace_back(layout);
    vehicles.moved_actuators.push_back(moves_actuators(parameters_[i]) ? trajectories(layout)
                                                                       : std::vector<ActuatorTrajectory>{});
    vehicles.steps.push_back(step);
  }
  std::vector<std::size_t> counts;
  std::vector<std::vector<WindowEquations>> equations;
  for (const auto& windows : windows_) {
    counts.push_back(windows.size());
    equations.emplace_back(windows.size());
  }
  const auto windows = all_windows();
  base::in_parallel(settings_.threads, windows.size(), [&](std::size_t i) {
    const auto [r, k] = windows[i];
    equations[r][k] = window_equations(vehicles, unknowns, r, k);
  });
  Linearised linearised{ChainSystem(static_cast<Eigen::Index>(parameters_.size()), counts), std::move(equations)};
  for (const auto& [r, k] : windows) linearised.system.add(r, k, linearised.windows[r][k]);
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    // Fixed parameters have no columns; the prior keeps the matrix regular.
    linearised.system.add_border_prior(
        at, parameters_[i].prior_std * parameters_[i].prior_std,
        which == Parameters::fixed ? 0 : unknowns.parameters[at] - parameters_[i].prior);
  }
  for (std::size_t r = 0; r < recordings_.size(); ++r) {
    for (Eigen::Index i = 0; i < kNuisances; ++i)
      linearised.system.add_border_prior(linearised.system.nuisances_at(r) + i,
                                         nuisance_stds_[r][i] * nuisance_stds_[r][i], unknowns.calibrations[r][i]);
    // No part of the cost: keeps the matrix regular where nothing measures a state, such as a position without
    // fixes.
    linearised.system.add_state_prior(r, 0, first_state_stds().cwiseAbs2(), StateVector::Zero());
  }
  return linearised;
}

}  // namespace navcal::identify
