// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "diagnosis/recording_fit.h"

namespace navcal::diagnosis {

/// Mean and standard deviation of a figure in nominal recordings.
struct Floor {
  double mean = 1, std = 0;
  std::size_t count = 0;  ///< of recordings

  /// Above it, a recording is not like the nominal ones. `factor`: for tolerances that they do not show.
  [[nodiscard]] double limit(double factor) const;
};
/// 1 +- 0 where there is no recording; a tenth of the mean as the deviation where there is one only.
[[nodiscard]] Floor floor_of(std::span<const double> of_recordings);

/// Standard deviations of all columns: between vehicles of the layout, and between recordings of one vehicle.
struct ColumnScatter {
  Eigen::VectorXd vehicle, session;
};
/// By the library: usual tolerances for all that can be a cause, the layout's standard errors, and the priors of
/// the other nuisances, which are of a session.
[[nodiscard]] ColumnScatter scatter_of(const CauseLibrary& library, const identify::Calibration& nuisance_stds);
/// With a tolerance for the causes of each name, for the vehicle and for its sessions, that makes the recordings
/// of one vehicle likely; `scatter`: begin of the search.
[[nodiscard]] ColumnScatter scatter_among(const CauseLibrary& library, std::span<const Likelihood> recordings,
                                          ColumnScatter scatter);

/// Prior of another recording of a vehicle that has these ones, or of `count` others side by side: the vehicle is
/// the same in all, and of the variance between recordings the part kSessionShare.
[[nodiscard]] JointPrior prior_from(std::span<const Likelihood> recordings, const ColumnScatter& scatter,
                                    Eigen::Index count = 1);

/// Nominal recordings of a vehicle: the floor of a diagnosis.
struct NominalBank {
  JointPrior prior;                    ///< of another recording
  std::vector<RecordingPower> powers;  ///< of each one
  /// For each cause, the largest log evidence that a nominal recording has for it when the others are its prior,
  /// nats. For several recordings that are judged together: that so many like it have.
  std::vector<double> chance_nats;
  Leads leads;
  std::vector<Likelihood> recordings{};
  ColumnScatter scatter{};
  std::optional<double> interval_s{};  ///< ModelSource::thin()

  [[nodiscard]] Floor floor() const;  ///< of the noise power of all channels together
  /// Prior of `count` other recordings that are judged together.
  [[nodiscard]] JointPrior prior_of(std::size_t count) const;
  /// The same of so many recordings like the `i`-th one, by the others.
  [[nodiscard]] JointPrior prior_by_others(std::size_t i, std::size_t count = 1) const;
  /// Makes `chance_nats` that of so many. Causes that one recording does not tell apart, because its model has
  /// errors, many like it do not either, so `leads.class_nats` grows with their number up to the lead that names.
  void expect(std::size_t count, const CauseLibrary& library);

 private:
  /// A joint model whose likelihood has the scatter in it is as one recording.
  [[nodiscard]] std::size_t modelled(std::size_t count) const { return leads.has_scatter ? 1 : count; }
};

/// For one recording. Throws std::invalid_argument in words. `recordings` may be empty: then the noises are those
/// of `alone`, the prior has the tolerances, and there is no floor.
[[nodiscard]] NominalBank bank_of(ModelSource& source, const CauseLibrary& library,
                                  std::span<const identify::RecordedMotion> recordings,
                                  const identify::RecordedMotion& alone, const Progress& progress);

}  // namespace navcal::diagnosis
