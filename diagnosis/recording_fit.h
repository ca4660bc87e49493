// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "diagnosis/causes.h"
#include "identify/fit/fit_problem.h"

namespace navcal::diagnosis {

/// Whitened residuals of one recording as a linear function of the columns of a library (CauseLibrary::columns()):
///   |r(x)|^2 = power - 2 score . x + x . gram x   for departures x from the nominal vehicle and perfect
///   instruments.
/// States of the vehicle are eliminated. The priors are not in it.
struct LinearRecording {
  Eigen::MatrixXd gram;
  Eigen::VectorXd score;
  double power = 0;

  /// The same about other departures: r(x + at).
  [[nodiscard]] LinearRecording about(const Eigen::VectorXd& at) const;
};

/// One recording fitted by the replay of a layout.
struct RecordingFit {
  LinearRecording linear;
  Eigen::VectorXd at;  ///< departures that were fitted
  std::vector<std::vector<identify::StateVector>> states;
  double readings = 0;
  /// Mean square of the whitened residuals of each channel; negative where it has no reading.
  std::array<double, identify::kChannels> channel_power{};
  std::vector<double> window_power;     ///< sums of squares
  std::vector<double> window_readings;  ///< readings behind them
};

/// Prior of a column during a fit, instead of that of the library. The mean of a nuisance's prior is zero.
struct ParameterPrior {
  Eigen::Index column;
  double mean, std;
};

/// Called with 0 to 1; it may throw to end the work.
using Progress = std::function<void(double)>;

/// A recording with the layout that replays it. The recording and the library must outlive it.
class FittedRecording {
 public:
  /// Throws std::invalid_argument in words when commands or readings are missing.
  FittedRecording(const config::Layout& layout, const CauseLibrary& library,
                  const std::vector<identify::RecordedMotion>& one_recording, const identify::NoiseModel& noise,
                  const identify::FitSettings& settings);

  /// Fits the uncertain numbers of the layout, the parameters of `priors`, nuisances and states, beginning at
  /// `from` where it is given, and linearises there about all columns. The other effects are zero. Throws
  /// identify::UnboundedReplay.
  [[nodiscard]] RecordingFit fit(const std::vector<ParameterPrior>& priors, const RecordingFit* from,
                                 const Progress& progress) const;
  /// Standard deviations of the nuisances' priors. Errors of instruments that can be a cause are within tolerance:
  /// if a fit could take any of them, it would mend a wrong layout with them and end far from the vehicle.
  [[nodiscard]] const identify::Calibration& nuisance_stds() const { return nuisance_stds_; }
  [[nodiscard]] const identify::RecordedMotion& recording() const { return recordings_.front(); }
  [[nodiscard]] std::vector<std::string> oddities() const;
  /// Noise of the residuals of a fit.
  [[nodiscard]] identify::NoiseModel noise_of(const RecordingFit& fit) const;

 private:
  [[nodiscard]] identify::FitProblem problem_with(std::vector<identify::Parameter> parameters,
                                                  const identify::Calibration& nuisance_stds) const;
  [[nodiscard]] identify::Unknowns unknowns_of(const RecordingFit& fit) const;

  const config::Layout& layout_;
  const CauseLibrary& library_;
  const std::vector<identify::RecordedMotion>& recordings_;
  identify::NoiseModel noise_;
  identify::FitSettings settings_;
  identify::Calibration nuisance_stds_;
};

}  // namespace navcal::diagnosis
