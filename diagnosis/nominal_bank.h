// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "diagnosis/cause_search.h"

namespace navcal::diagnosis {

/// Mean and standard deviation of a figure in nominal recordings.
struct Floor {
  double mean = 1, std = 0;

  /// Above it, a recording is not like the nominal ones.
  [[nodiscard]] double limit() const;
};
/// 1 +- 0 where there is no recording; a tenth of the mean as the deviation where there is one only.
[[nodiscard]] Floor floor_of(std::span<const double> of_recordings);

/// What nominal recordings show: the floor of a diagnosis.
struct NominalBank {
  /// Estimates of every single cause's columns as if it were the cause, one vector for each recording.
  std::vector<Eigen::VectorXd> estimates;
  std::vector<std::array<double, identify::kChannels>> channel_powers;
  std::vector<double> powers;  ///< mean square of all whitened residuals
  /// -2/n of the log evidence of no cause, with n readings: 1 where tolerances and noise explain the recording.
  std::vector<double> misfits;

  [[nodiscard]] std::size_t size() const { return powers.size(); }
  void add(const RecordingFit& fit, const CauseLibrary& library, const ColumnPriors& priors);
};

/// -2/n of a log evidence in nats, with n readings of the fit.
[[nodiscard]] double misfit_of(const RecordingFit& fit, double log_evidence);

/// Simulates the recording `count` times with the layout within its tolerances: the recorded positions of the
/// actuators, the recorded times of the readings, and noise as stated. Every number that is uncertain, every
/// effect and every error of an instrument departs by a normal deviate of its tolerance. A motion that leaves all
/// bounds is left out.
[[nodiscard]] std::vector<identify::RecordedMotion> simulate_nominal(
    const config::Layout& layout, const CauseLibrary& library, const identify::RecordedMotion& recording,
    const RecordingFit& fit, const ColumnPriors& priors, int count, std::uint64_t seed);

/// Priors of a library as a fit has them: those of its parameters, and these of the nuisances
/// (FittedRecording::nuisance_stds()).
[[nodiscard]] ColumnPriors tolerances_of(const CauseLibrary& library, const identify::Calibration& nuisance_stds);
/// The same, as wide as the bank's recordings scatter.
[[nodiscard]] ColumnPriors widened(ColumnPriors priors, const CauseLibrary& library, const NominalBank& bank);

}  // namespace navcal::diagnosis
