// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <stdexcept>
#include <vector>

#include "config/layout.h"
#include "identify/data/recorded_motion.h"
#include "identify/fit/chain_system.h"
#include "identify/fit/noise_model.h"
#include "identify/fit/windows.h"
#include "identify/parameters.h"

namespace navcal::identify {

/// All that is fitted: parameters of the layout in their units, and for each recording its nuisances and the
/// states at the begins of its windows.
struct Unknowns {
  Eigen::VectorXd parameters;
  std::vector<Calibration> calibrations;
  std::vector<std::vector<StateVector>> states;
};

/// A replay leaves all bounds within a window.
struct UnboundedReplay : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Shortest windows that are tried for a vehicle that leaves all bounds within longer ones, s.
inline constexpr double kLeastWindow_s = 0.5;

struct FitSettings {
  double window_s = 2;
  unsigned threads = 2;
};

/// Whitened residuals of recordings as a function of all unknowns (multiple shooting: Bock 1981; Betts, Practical
/// Methods for Optimal Control, 2010, section 3.4). The recordings are cut into windows, and each is replayed from
/// a state of its own. The states of neighbouring windows are tied: the state at a window's end is that at the
/// begin of the next up to normal deviates of small ones, which stand for what disturbs the vehicle during a
/// window. So a replay cannot diverge over more than a window, and the windows still know of one another.
///
/// Minimised: |whitened residuals|^2 + |ties|^2 + |parameters and nuisances about their priors|^2.
class FitProblem {
 public:
  /// `recordings` must outlive it. Throws std::invalid_argument in words when one lacks commands or readings.
  FitProblem(config::Layout layout, std::vector<Parameter> parameters,
             const std::vector<RecordedMotion>& recordings, const FitSettings& settings);

  /// Parameters at their priors, nuisances zero, states as guessed.
  [[nodiscard]] Unknowns initial() const;

  /// Twice the negative log posterior but for constants; infinite where a replay leaves all bounds.
  [[nodiscard]] double cost(const Unknowns& unknowns) const;

  struct Linearised {
    ChainSystem system;
    std::vector<std::vector<WindowEquations>> windows;
  };
  /// Fixed parameters have no columns: the solution then moves nuisances and states only.
  enum class Parameters { free, fixed };
  [[nodiscard]] Linearised linearise(const Unknowns& unknowns, Parameters parameters = Parameters::free) const;

  /// Residuals in SI units, not whitened: for each recording and window, in the order of its readings. Empty where
  /// a replay leaves all bounds.
  [[nodiscard]] std::vector<std::vector<Eigen::VectorXd>> residuals_of(const Unknowns& unknowns) const;
  /// The same, whitened.
  [[nodiscard]] std::vector<std::vector<Eigen::VectorXd>> white_residuals_of(const Unknowns& unknowns) const;

  void set_noise(const NoiseModel& noise) { noise_ = noise; }
  /// Standard deviations of the priors of a recording's nuisances, instead of nuisance_stds().
  void set_nuisance_stds(std::size_t recording, const Calibration& stds) { nuisance_stds_[recording] = stds; }
  /// Fits the noise to the residuals.
  void fit_noise(const Unknowns& unknowns);
  [[nodiscard]] const NoiseModel& noise() const { return noise_; }
  [[nodiscard]] const std::vector<std::vector<Window>>& windows() const { return windows_; }
  [[nodiscard]] const FitSettings& settings() const { return settings_; }
  [[nodiscard]] const std::vector<Parameter>& parameters() const { return parameters_; }
  [[nodiscard]] const config::Layout& layout() const { return layout_; }
  [[nodiscard]] const std::vector<RecordedMotion>& recordings() const { return recordings_; }
  [[nodiscard]] std::vector<std::string> oddities() const;

 private:
  struct Vehicles;
  struct Replayed {
    Eigen::VectorXd residuals;  ///< not whitened
    StateVector tie;            ///< end less the next begin, over its standard deviation
    double cost = 0;            ///< of residuals and tie
  };
  [[nodiscard]] std::vector<ActuatorTrajectory> trajectories(const config::Layout& layout) const;
  [[nodiscard]] std::optional<Replayed> replayed(const sim::LayoutVehicle& vehicle,
                                                 const ActuatorTrajectory& actuators, const Unknowns& unknowns,
                                                 std::size_t recording, std::size_t window) const;
  [[nodiscard]] WindowEquations window_equations(const Vehicles& vehicles, const Unknowns& unknowns,
                                                 std::size_t recording, std::size_t window) const;
  [[nodiscard]] double prior_cost(const Unknowns& unknowns) const;
  [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> all_windows() const;

  config::Layout layout_;
  std::vector<Parameter> parameters_;
  const std::vector<RecordedMotion>& recordings_;
  FitSettings settings_;
  std::vector<ActuatorInputs> inputs_;
  std::vector<std::vector<Window>> windows_;
  std::vector<Calibration> nuisance_stds_;
  NoiseModel noise_;
};

}  // namespace navcal::identify
