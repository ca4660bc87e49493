// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "calib/archive.h"
#include "calib/judgement.h"
#include "calib/readings.h"

namespace navcal::calib {

/// A magnetic heading at its time.
struct TimedHeading {
  double time_s = 0;
  double time_std_s = 0;
  double heading_rad = 0;
  void archive(Archive& archive) { archive(time_s, time_std_s, heading_rad); }
};

/// A heading and a reference of the same instant.
struct HeadingPair {
  double time_s = 0;
  double heading_rad = 0;    ///< magnetic, between two readings, not wrapped
  double rate_rad_s = 0;     ///< at which the heading changes
  double reference_rad = 0;  ///< true
  double variance_rad2 = 0;  ///< of the reference
  double time_std_s = 0;     ///< of the time by which the two differ
};

/// Pairs each reference with the heading at its time, linear between the two readings around it. References wait
/// for the headings, which come later. O(1) for each reading; memory is taken with
/// the first reference.
class ReferenceTrack {
 public:
  /// References closer together than this are left out: they say nothing new.
  static constexpr double kLeastInterval_s = 0.09;
  /// Readings further apart do not tell the heading between them.
  static constexpr double kLongestGap_s = 0.5;

  void update(const ReferenceReading& reference) {
    const bool is_good = std::isfinite(reference.time_s) && std::isfinite(reference.heading_rad) &&
                         reference.std_rad > 0 && std::isfinite(reference.std_rad);
    if (!is_good || (newest_s_ && reference.time_s < *newest_s_ + kLeastInterval_s)) return;
    newest_s_ = reference.time_s;
    if (waiting_.empty()) waiting_.resize(kMostWaiting);
    if (count_ == waiting_.size()) pop();
    waiting_[(first_ + count_++) % waiting_.size()] = reference;
  }

  /// The next heading, in order of time. `use` takes a HeadingPair.
  template <class Use>
  void update(const TimedHeading& heading, Use use) {
    for (; count_ > 0 && waiting_[first_].time_s <= heading.time_s; pop()) {
      const ReferenceReading& reference = waiting_[first_];
      const double gap_s = before_ ? heading.time_s - before_->time_s : 0;
      if (!(gap_s > 0) || gap_s > kLongestGap_s || reference.time_s < before_->time_s) continue;
      const double turn_rad = std::remainder(heading.heading_rad - before_->heading_rad, 2 * kPi);
      const double share = (reference.time_s - before_->time_s) / gap_s;
      const double time_std_s =
          std::hypot(reference.time_std_s, std::max(heading.time_std_s, before_->time_std_s));
      use(HeadingPair{reference.time_s, before_->heading_rad + share * turn_rad, turn_rad / gap_s,
                      reference.heading_rad, reference.std_rad * reference.std_rad, time_std_s});
    }
    before_ = heading;
  }
  void archive(Archive& archive) {
    archive(waiting_, first_, count_, newest_s_, before_);
    if (waiting_.size() > kMostWaiting || count_ > waiting_.size() || (count_ > 0 && first_ >= waiting_.size()))
      archive.fail();
    if (!archive.ok()) {
      waiting_.clear();
      first_ = count_ = 0;
    }
  }

 private:
  static constexpr double kPi = 3.14159265358979323846;

  void pop() {
    first_ = (first_ + 1) % waiting_.size();
    --count_;
  }

  static constexpr std::size_t kMostWaiting = 256;
  std::vector<ReferenceReading> waiting_;  ///< a ring; empty before the first reference
  std::size_t first_ = 0, count_ = 0;
  std::optional<double> newest_s_;
  std::optional<TimedHeading> before_;
};

/// Model: psi_i + d - psi_ref,i = E(psi_i) + r_i tau + e_i (rad), with E = A + B sin + C cos + D sin 2 + E cos 2
/// (thesis 2.7) of the magnetic heading psi, declination d, and a true heading psi_ref of an external reference: a
/// receiver with two antennas, a gyro compass, a surveyed line. Linear least squares with weights 1 / var(e),
/// var(e) = sigma_ref^2 + sigma_psi^2. tau (s) is the error of the compass's latency against the reference's, r
/// the turn rate: a constant of the recording, which looks like A where all turns go one way. B..E and tau have
/// Gaussian priors, that of tau with the stated standard errors of the times. A constant error of the reference,
/// of its mounting and of d is in A.
///
/// Errors of a reference are not white: those of satellites last for minutes. The covariance is therefore that of
/// the scores of blocks of time (a sandwich: White, Econometrica 48, 1980). Each component of the scores is
/// prewhitened by an autoregression of first order and recoloured (Andrews and Monahan, Econometrica 60, 1992).
/// Its coefficient is corrected for the bias of few blocks (Marriott and Pope, Biometrika 41, 1954). The scatter
/// counts m / (m - 6) for m blocks, and the priors add their own. The model's own covariance is added in the share
/// 10 / m, since few blocks tell little of the scatter. Less than 20 blocks are refused.
///
/// There are at most 64 blocks: pairs of them are joined when more come, so that memory is bounded. O(1) for each
/// reading.
class HeadingReference {
 public:
  static constexpr int kUnknowns = 6;  ///< A..E (rad), tau (s)
  using Vector = Eigen::Matrix<double, kUnknowns, 1>;
  using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;
  struct Parameters {
    double heading_noise_rad = 0.0087;  ///< of a heading
    double deviation_std_rad = 0.35;    ///< prior of each of B..E
    double accepted_std_rad = 0.01745;  ///< of the corrected heading, worst over the circle
    std::uint32_t least_pairs = 30;
  };
  struct Estimate {
    Vector coefficients = Vector::Zero();  ///< A..E, tau
    Matrix covariance = Matrix::Zero();
    double residual_rad = 0;  ///< root-mean-square, weighted
    double worst_std_rad = 0, worst_heading_rad = 0;
  };

  HeadingReference() : HeadingReference(Parameters{}) {}
  explicit HeadingReference(const Parameters& parameters) : parameters_(parameters) {}

  void update(const HeadingPair& pair);
  /// nullopt before the first parameters.least_pairs pairs.
  [[nodiscard]] std::optional<Estimate> estimate(double declination_rad) const;
  [[nodiscard]] Judgement judgement(double declination_rad) const;
  [[nodiscard]] std::uint64_t pairs() const { return pairs_; }
  void archive(Archive& archive);

 private:
  static constexpr std::size_t kMostBlocks = 64;
  static constexpr double kFirstBlock_s = 5;
  static constexpr std::size_t kLeastBlocks = 20;

  /// Weighted normal equations of a block of time.
  struct Block {
    Matrix information = Matrix::Zero();
    Vector right = Vector::Zero();
    double square = 0;
    double begin_s = 0;
    void add(const Block& other);
    void archive(Archive& archive) { archive(information, right, square, begin_s); }
  };

  Block& block_at(double time_s);
  [[nodiscard]] Matrix score_covariance(const Vector& x) const;

  Parameters parameters_;
  std::vector<Block> blocks_;  ///< empty without a reference, so that nobody else pays for it
  double block_s_ = kFirstBlock_s;
  double about_rad_ = 0;  ///< difference from which the others are counted, so that no seam matters
  std::uint64_t pairs_ = 0;
  double time_variance_s2_ = 0;  ///< stated, sum over the pairs
  HeadingHistogram rose_{};
};

}  // namespace navcal::calib
