// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "diagnosis/causes.h"
#include "diagnosis/limits.h"
#include "gap/verdict/diagnosis.h"
#include "identify/filter/noise_fit.h"

namespace navcal::diagnosis {

/// A log likelihood that is quadratic in some unknowns x:
///   log p = value + score . x - x . information x / 2.
struct Likelihood {
  Eigen::MatrixXd information;
  Eigen::VectorXd score;
  double value = 0;
  double norm = 0;  ///< `value` where nothing departs; up to a constant of the recording
  /// Of Student's t in place of the normal distribution, where the variances are themselves estimates.
  double freedom = std::numeric_limits<double>::infinity();

  /// Log evidence of x = 0: `value`, or by Student's t
  ///   norm - (freedom + 1) / 2 log(1 + 2 (norm - value) / freedom).
  [[nodiscard]] double evidence() const;

  /// The same as a function of x - at.
  [[nodiscard]] Likelihood about(const Eigen::VectorXd& at) const;
  /// Of the same x when a deviate root z, z ~ N(0, 1), is added to it and integrated out.
  [[nodiscard]] Likelihood blurred(const Eigen::MatrixXd& root) const;
  /// The same with noise whose variance is larger by a factor.
  [[nodiscard]] Likelihood tempered(double factor) const;
  /// Of some of the unknowns, the others zero.
  [[nodiscard]] Likelihood of(const std::vector<Eigen::Index>& columns) const;
  Likelihood& operator+=(const Likelihood& other);
};

/// Likelihood of the unknowns of several independent recordings, one behind the other in one vector.
[[nodiscard]] Likelihood side_by_side(std::span<const Likelihood> recordings);

/// Covariance of normal unknowns with these standard deviations, behind readings with this information.
[[nodiscard]] Eigen::MatrixXd covariance_of(const Eigen::MatrixXd& information, const Eigen::VectorXd& stds);

/// x ~ N(mean, root root^T), departures in one recording, or in each of several side by side.
struct JointPrior {
  Eigen::VectorXd mean;
  Eigen::MatrixXd root;
  Eigen::Index recordings = 1;

  /// The same change in each recording.
  [[nodiscard]] Eigen::VectorXd in_each(const Eigen::VectorXd& change) const {
    return change.replicate(recordings, 1);
  }
  /// Likelihood of changes a of all recordings alike, x itself integrated out.
  [[nodiscard]] Likelihood of_changes(const Likelihood& likelihood) const;
  [[nodiscard]] Eigen::VectorXd posterior_mean(const Likelihood& likelihood) const;
};

/// Called with 0 to 1; it may throw to end the work.
using Progress = std::function<void(double)>;

/// A recording linearised about some departures from the nominal vehicle and perfect instruments.
struct RecordingFit {
  /// Of departures from the nominal vehicle, CauseLibrary::columns() for each recording.
  Likelihood linear;
  Eigen::VectorXd at;      ///< where it was linearised
  double mean_square = 1;  ///< of the white innovations there
  /// The nominal vehicle's change in all recordings, as settled() found it.
  Eigen::VectorXd change = {};
  /// Log probability that the likelihood promises elsewhere, nats: more where it was given up before it settled,
  /// or where the promise was not kept because the recording is not linear. It is no evidence.
  double promised_nats = 0;

  /// Innovations that are far above their noise are not linear over the way to where they would be explained. With
  /// noise that is larger by this factor, departures stay within their tolerances, and what explains most comes
  /// first (as in Levenberg 1944 and Marquardt 1963, with the prior as their metric).
  [[nodiscard]] double damping() const;
  /// The filter that the recording was linearised about expects far smaller innovations: its gains serve no other.
  [[nodiscard]] bool is_astray() const;
  /// The likelihood that says where to go from the nominal vehicle.
  [[nodiscard]] Likelihood guide() const;
};

/// The error of a recording that no vehicle of the layout could have made, in words that name it.
[[nodiscard]] std::invalid_argument cannot_follow(const identify::RecordedMotion& recording);

/// White innovations of a recording.
struct RecordingPower {
  double mean_square = 1;
  /// Of each channel; negative where it has no reading.
  std::array<double, identify::kChannels> of_channel{};
  std::array<double, identify::kChannels> readings_of_channel{};
  std::vector<double> of_block;        ///< sums of squares of blocks of time
  std::vector<double> readings;        ///< behind them
  std::vector<gap::WhereEntry> apart;  ///< what departs without being a channel
};

/// What a verdict needs.
struct Leads {
  /// Leads over the other sets of causes beyond what nominal recordings have by chance, nats; the one that tells a
  /// cause from another in its place; and the one over no cause that is said where it makes no gap.
  double gap_nats = 0, named_nats = 0, class_nats = 0, faint_nats = 0;
  /// Power above which a recording is not like the nominal ones; absent: by the scatter of theirs.
  std::optional<double> most_power;
  bool has_scatter = false;  ///< the likelihoods have the scatter between recordings in them
};

class NotCopied {
 public:
  NotCopied() = default;
  NotCopied(const NotCopied&) = delete;
  NotCopied& operator=(const NotCopied&) = delete;
  virtual ~NotCopied() = default;
};

/// A recording as evidence about the vehicle and its instruments.
class RecordingModel : public NotCopied {
 public:
  /// The same departures, those beyond a bound at the bound.
  [[nodiscard]] virtual Eigen::VectorXd within(const Eigen::VectorXd& at) const { return at; }
  /// nullopt: a vehicle with these departures could not have moved so. Departures beyond a bound are at the bound.
  [[nodiscard]] virtual std::optional<RecordingFit> fit(const Eigen::VectorXd& at) const = 0;
  /// Log likelihood of these departures, which are within the bounds, as fit() has it there.
  [[nodiscard]] virtual std::optional<double> log_likelihood(const Eigen::VectorXd& at) const;
  [[nodiscard]] virtual std::optional<RecordingPower> power(const Eigen::VectorXd& at) const = 0;
  /// Departures of the vehicle in this recording, about which its power counts.
  [[nodiscard]] virtual Eigen::VectorXd own_departures(const JointPrior& prior, const Likelihood& here) const = 0;
  [[nodiscard]] virtual const identify::RecordedMotion& recording() const = 0;
  /// What is odd about its commands, in words.
  [[nodiscard]] virtual std::vector<std::string> oddities() const = 0;
  /// From here on, fits have the gains and variances of the filter of a vehicle with these departures. Only then
  /// do they compare: a filter that expects other errors is more or less probable for that alone, whatever caused
  /// the readings. False: nothing has changed, because that vehicle cannot follow or there is no such filter.
  virtual bool hold(const Eigen::VectorXd& /*at*/) { return false; }
};

/// Recordings with the same causes, each with departures of its own besides. They must outlive it.
class JoinedRecordings final : public RecordingModel {
 public:
  explicit JoinedRecordings(std::span<RecordingModel* const> parts) : parts_(parts.begin(), parts.end()) {}

  [[nodiscard]] Eigen::VectorXd within(const Eigen::VectorXd& at) const override;
  [[nodiscard]] std::optional<RecordingFit> fit(const Eigen::VectorXd& at) const override;
  [[nodiscard]] std::optional<double> log_likelihood(const Eigen::VectorXd& at) const override;
  /// Over all of them.
  [[nodiscard]] std::optional<RecordingPower> power(const Eigen::VectorXd& at) const override;
  [[nodiscard]] Eigen::VectorXd own_departures(const JointPrior& prior, const Likelihood& here) const override {
    return prior.posterior_mean(here);
  }
  [[nodiscard]] const identify::RecordedMotion& recording() const override { return parts_.front()->recording(); }
  [[nodiscard]] std::vector<std::string> oddities() const override { return {}; }
  bool hold(const Eigen::VectorXd& at) override;

 private:
  [[nodiscard]] Eigen::VectorXd of_part(const Eigen::VectorXd& at, std::size_t part) const;

  std::vector<RecordingModel*> parts_;
};

/// Makes the models of a diagnosis.
class ModelSource : public NotCopied {
 public:
  /// A nominal recording. Throws std::invalid_argument where the recording cannot be judged.
  [[nodiscard]] virtual std::unique_ptr<RecordingModel> nominal(const identify::RecordedMotion& recording) = 0;
  /// Fits what the recordings share beside the vehicle (noises) to its nominal models, each at its departures,
  /// before they are linearised for the `round`-th time from 0 on.
  virtual void refine(std::size_t round, std::span<const Eigen::VectorXd> at) = 0;
  /// Takes fewer readings where those of the refined models depend on each other: filtered, averaged or
  /// interpolated ones say the same several times, and a diagnosis would be too sure. Returns the time between the
  /// readings of a channel that are used from now on, s, by nominal models that are to be made anew; nullopt: as
  /// before.
  virtual std::optional<double> thin() { return std::nullopt; }
  /// Powers of the nominal recordings, each at its departures, with what they share fitted to the others: what
  /// fits a recording best says too little of the next one.
  [[nodiscard]] virtual std::vector<RecordingPower> nominal_powers(std::span<const Eigen::VectorXd> at) const = 0;
  /// A recording that is compared with a nominal vehicle of these departures.
  [[nodiscard]] virtual std::unique_ptr<RecordingModel> compared(const identify::RecordedMotion& recording,
                                                                 const Eigen::VectorXd& nominal) const = 0;
  /// Several of those as one model: with departures of each recording (JoinedRecordings), or where the likelihoods
  /// have the scatter in them, of all. They must outlive it.
  [[nodiscard]] virtual std::unique_ptr<RecordingModel> joined(
      std::span<RecordingModel* const> compared) const = 0;
  /// Whether there is a scatter, at any time; the rest once the nominal models are refined.
  [[nodiscard]] virtual Leads leads() const = 0;
};

/// Values of the fit at some departures from `start`, within the bounds of the library's parameters.
[[nodiscard]] Eigen::VectorXd values_within(const CauseLibrary& library, const Eigen::VectorXd& start,
                                            const Eigen::VectorXd& at);

/// A recording with the filter that follows it. The library must outlive it.
class FittedRecording final : public RecordingModel {
 public:
  /// Throws std::invalid_argument in words when commands or readings are missing, and where the layout cannot
  /// follow the recording.
  FittedRecording(const config::Layout& layout, const CauseLibrary& library, identify::RecordedMotion recording,
                  const identify::FilterNoises& noises, unsigned threads);

  bool hold(const Eigen::VectorXd& at) override;
  [[nodiscard]] Eigen::VectorXd within(const Eigen::VectorXd& at) const override {
    return values_at(at) - filter_.start();
  }
  [[nodiscard]] std::optional<RecordingFit> fit(const Eigen::VectorXd& at) const override;
  [[nodiscard]] std::optional<double> log_likelihood(const Eigen::VectorXd& at) const override;
  [[nodiscard]] std::optional<RecordingPower> power(const Eigen::VectorXd& at) const override;
  [[nodiscard]] Eigen::VectorXd own_departures(const JointPrior& prior, const Likelihood& here) const override {
    return prior.posterior_mean(here);
  }
  [[nodiscard]] const identify::RecordedMotion& recording() const override { return filter_.recording(); }
  [[nodiscard]] std::vector<std::string> oddities() const override { return filter_.oddities(); }
  [[nodiscard]] std::optional<identify::FilterPass> follow(const Eigen::VectorXd& at) const;
  [[nodiscard]] RecordingPower power_of(const identify::FilterPass& pass) const;
  /// The derivatives by all columns. nullopt: a vehicle with these departures could not have moved so.
  [[nodiscard]] std::optional<identify::FilterLinearised> linearised(const Eigen::VectorXd& at) const {
    return linearised(at, columns_);
  }
  [[nodiscard]] identify::FilteredReplay& filter() { return filter_; }
  [[nodiscard]] const identify::FilteredReplay& filter() const { return filter_; }

 private:
  [[nodiscard]] std::optional<identify::FilterLinearised> linearised(const Eigen::VectorXd& at,
                                                                     std::span<const Eigen::Index> columns) const;
  [[nodiscard]] Eigen::VectorXd values_at(const Eigen::VectorXd& at) const {
    return values_within(library_, filter_.start(), at);
  }

  const CauseLibrary& library_;
  identify::RecordedMotion recorded_;
  identify::FilteredReplay filter_;
  std::vector<Eigen::Index> columns_;
  std::optional<identify::FilterPass> held_;
};

/// Recordings followed by a filter, with noises that are fitted to the nominal ones. Layout and library must
/// outlive it and its models.
class FilteredSource final : public ModelSource {
 public:
  FilteredSource(const config::Layout& layout, const CauseLibrary& library, unsigned threads)
      : layout_(layout), library_(library), threads_(threads) {}

  [[nodiscard]] std::unique_ptr<RecordingModel> nominal(const identify::RecordedMotion& recording) override;
  void refine(std::size_t round, std::span<const Eigen::VectorXd> at) override;
  std::optional<double> thin() override;
  [[nodiscard]] std::vector<RecordingPower> nominal_powers(std::span<const Eigen::VectorXd> at) const override;
  /// A recording followed with the present noises, its gains not held.
  [[nodiscard]] std::unique_ptr<FittedRecording> fitted(const identify::RecordedMotion& recording) const {
    return std::make_unique<FittedRecording>(
        layout_, library_, identify::thinned(recording, identify::kIntervals_s[interval_]), noises_, threads_);
  }
  [[nodiscard]] std::unique_ptr<RecordingModel> compared(const identify::RecordedMotion& recording,
                                                         const Eigen::VectorXd& nominal) const override;
  [[nodiscard]] std::unique_ptr<RecordingModel> joined(std::span<RecordingModel* const> compared) const override {
    return std::make_unique<JoinedRecordings>(compared);
  }
  [[nodiscard]] Leads leads() const override;

 private:
  const config::Layout& layout_;
  const CauseLibrary& library_;
  unsigned threads_;
  std::size_t interval_ = kFirstInterval;  ///< place among the intervals that are tried
  identify::FilterNoises noises_;
  double correlation_ = 0;                  ///< of neighbouring readings, where noises_ were fitted
  std::vector<FittedRecording*> nominals_;  ///< those that nominal() made
};

}  // namespace navcal::diagnosis
