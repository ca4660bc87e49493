// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <stdexcept>
#include <vector>

#include "diagnosis/causes.h"
#include "identify/filter/noise_fit.h"

namespace navcal::diagnosis {

/// A log likelihood that is quadratic in some unknowns x:
///   log p = value + score . x - x . information x / 2.
struct Likelihood {
  Eigen::MatrixXd information;
  Eigen::VectorXd score;
  double value = 0;

  /// The same as a function of x - at.
  [[nodiscard]] Likelihood about(const Eigen::VectorXd& at) const;
  /// Of the same x when a deviate root z, z ~ N(0, 1), is added to it and integrated out.
  [[nodiscard]] Likelihood blurred(const Eigen::MatrixXd& root) const;
  /// Of some of the unknowns, the others zero.
  [[nodiscard]] Likelihood of(const std::vector<Eigen::Index>& columns) const;
  Likelihood& operator+=(const Likelihood& other);
};

/// Covariance of normal unknowns with these standard deviations, behind readings with this information.
[[nodiscard]] Eigen::MatrixXd covariance_of(const Eigen::MatrixXd& information, const Eigen::VectorXd& stds);

/// x ~ N(mean, root root^T).
struct JointPrior {
  Eigen::VectorXd mean;
  Eigen::MatrixXd root;

  /// Likelihood of changes a of x, x itself integrated out.
  [[nodiscard]] Likelihood of_changes(const Likelihood& likelihood) const {
    return likelihood.about(mean).blurred(root);
  }
  [[nodiscard]] Eigen::VectorXd posterior_mean(const Likelihood& likelihood) const;
};

/// Called with 0 to 1; it may throw to end the work.
using Progress = std::function<void(double)>;

/// A recording linearised about some departures from the nominal vehicle and perfect instruments.
struct RecordingFit {
  Likelihood linear;   ///< of departures from the nominal vehicle (CauseLibrary::columns())
  Eigen::VectorXd at;  ///< where it was linearised
};

/// The error of a recording that no vehicle of the layout could have made, in words that name it.
[[nodiscard]] std::invalid_argument cannot_follow(const identify::RecordedMotion& recording);

/// White innovations of a recording.
struct RecordingPower {
  double mean_square = 1;
  /// Of each channel; negative where it has no reading.
  std::array<double, identify::kChannels> of_channel{};
  std::array<double, identify::kChannels> readings_of_channel{};
  std::vector<double> of_block;  ///< sums of squares of blocks of time
  std::vector<double> readings;  ///< behind them
};

/// A recording with the filter that follows it. The recording and the library must outlive it.
class FittedRecording {
 public:
  /// Throws std::invalid_argument in words when commands or readings are missing, and where the layout cannot
  /// follow the recording.
  FittedRecording(const config::Layout& layout, const CauseLibrary& library,
                  const identify::RecordedMotion& recording, const identify::FilterNoises& noises,
                  unsigned threads);

  /// From here on fits have the gains and variances of the filter with these departures. Only then do they
  /// compare: a filter that expects other errors is more or less probable for that alone, whatever caused the
  /// readings. Throws std::invalid_argument where the layout cannot follow the recording so.
  void hold_gains(const Eigen::VectorXd& at);
  /// nullopt: a vehicle with these departures could not have moved so. Departures beyond a bound are at the bound.
  [[nodiscard]] std::optional<RecordingFit> fit(const Eigen::VectorXd& at) const;
  [[nodiscard]] std::optional<RecordingPower> power(const Eigen::VectorXd& at) const;
  [[nodiscard]] std::optional<identify::FilterPass> follow(const Eigen::VectorXd& at) const;
  [[nodiscard]] identify::FilteredReplay& filter() { return filter_; }
  [[nodiscard]] const identify::FilteredReplay& filter() const { return filter_; }

 private:
  [[nodiscard]] Eigen::VectorXd values_at(const Eigen::VectorXd& at) const;

  const CauseLibrary& library_;
  identify::FilteredReplay filter_;
  std::vector<identify::FilterColumn> columns_;
  std::optional<identify::FilterPass> held_;
};

}  // namespace navcal::diagnosis
