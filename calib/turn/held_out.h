// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "calib/archive.h"
#include "calib/correction.h"
#include "calib/turn/turn_step.h"

namespace navcal::calib {

/// Root-mean-squares of one quantity over blocks, the newest with the largest weight: as measured, with the
/// active correction, and with the estimate.
class Comparison {
 public:
  void add(double before_square, double in_force_square, double estimate_square);
  /// The active correction has changed.
  void on_change() { since_change_ = {}, all_.gain_square = 0; }
  /// True when the estimate is better than the active correction by this relative margin, and its gain is
  /// significant over the blocks: three standard errors of the mean gain.
  [[nodiscard]] bool better_by(double margin) const;
  /// The same of no correction in the estimate's place: what is active makes it worse.
  [[nodiscard]] bool worse_by(double margin) const;

  /// True when enough blocks have judged the estimate and it was no better than the active correction.
  [[nodiscard]] bool contradicts() const;

  [[nodiscard]] double before_rms() const { return all_.rms(all_.before); }
  [[nodiscard]] double in_force_rms() const { return since_change_.rms(since_change_.in_force); }
  [[nodiscard]] double estimate_rms() const { return all_.rms(all_.estimate); }
  [[nodiscard]] std::uint64_t blocks() const { return all_.blocks; }
  /// Enough blocks were judged for a verdict.
  [[nodiscard]] bool is_judged() const { return all_.blocks >= kLeastBlocks; }
  void archive(Archive& archive) { archive(all_, since_change_); }

 private:
  static constexpr std::uint64_t kLeastBlocks = 3;
  static constexpr double kLeastStandardErrors = 3;
  struct Sums {
    double before = 0, in_force = 0, estimate = 0;
    double gain_square = 0;  ///< since the change: of in_force less estimate; in all_: of before less in_force
    double weight = 0, weight_square = 0;
    std::uint64_t blocks = 0;
    void add(double before_square, double in_force_square, double estimate_square, double gain);
    [[nodiscard]] double rms(double sum) const;
    /// Mean gain over its standard error, by the sums of gains and of their squares; 0 before the second block.
    [[nodiscard]] double significance(double gain, double squares) const;
    void archive(Archive& archive) {
      archive(before, in_force, estimate, gain_square, weight, weight_square, blocks);
    }
  };
  [[nodiscard]] bool gains(double from, double to, double squares, double margin) const;
  Sums all_, since_change_;
};

/// Model: heading_i = psi0 + turn_i + residual_i (rad) within a block of consecutive readings, psi0 free, the turn
/// by TurnStep. Prequential (Dawid, J. Royal Statistical Society A 147, 1984): a block is judged by corrections
/// made before it began, so no reading has a part in what it judges. Blocks are counted in readings. Compasses are
/// judged against the calibrated gyro, and only by blocks that turn; gyros against the corrected heading.
class HeldOut {
 public:
  static constexpr std::uint32_t kReadings = 100;

  HeldOut();
  /// `estimates`: those that are accepted, at this reading. True when a block was ended by it.
  bool update(const CompassReading& reading, const TurnStep& step, const Correction& in_force,
              const Correction& estimates);

  /// Comparison of a gyro, or of a calibrator that corrects the heading; empty for others.
  [[nodiscard]] const Comparison& of(Calibrator calibrator) const;
  /// Comparison of the heading with all estimates together.
  [[nodiscard]] const Comparison& heading() const { return heading_; }
  /// The active correction has changed.
  void on_change();
  /// Drops the comparison of a calibrator that starts anew.
  void forget(Calibrator calibrator);
  /// Archives all but the calibrators from the eleventh on.
  void archive(Archive& archive);
  /// Like forget(), but the present block continues.
  void forget_added(Calibrator calibrator);
  /// Archives one of the calibrators that archive() leaves out.
  void archive_added(Archive& archive, Calibrator calibrator);

 private:
  /// Mean and scatter of residuals, by Welford.
  struct Scatter {
    double count = 0, mean = 0, sum = 0;
    void add(double residual_rad);
    [[nodiscard]] double square() const { return count > 0 ? sum / count : 0; }
    void archive(Archive& archive) { archive(count, mean, sum); }
  };
  static constexpr std::array kGyros{Calibrator::gyro, Calibrator::gyro_b};
  struct GyroScatter {
    Scatter before, in_force, estimate;
    void archive(Archive& archive) { archive(before, in_force, estimate); }
  };
  struct Block {
    Correction in_force, estimates;  ///< as they were before it
    std::uint32_t readings = 0;
    double measured_rad = 0, measured_b_rad = 0, bias_s = 0,
           tilt_rad = 0;  ///< TurnStep, summed from its beginning
    double least_turn_rad = 0, most_turn_rad = 0;
    Scatter before, with_in_force, with_all;
    std::vector<Scatter> with;  ///< residuals with each correction of with_
    std::array<GyroScatter, kGyros.size()> gyros;
    void archive(Archive& archive);
  };

  void begin(const Correction& in_force, const Correction& estimates);
  /// Puts the corrections together by which the block is judged.
  void combine();
  void judge_headings(const CompassReading& reading);
  void judge_gyros(const CompassReading& reading);
  void end();
  [[nodiscard]] double turn(const std::optional<RateCorrection>& gyro, bool b) const;
  [[nodiscard]] const std::optional<RateCorrection>& reference_gyro() const;

  std::vector<Calibrator> headings_;  ///< those that correct the heading
  Block block_;
  std::vector<Correction> with_;  ///< active correction with the estimate of one of headings_
  Correction with_all_;           ///< active correction with all estimates
  bool in_block_ = false;
  std::vector<Comparison> comparisons_;
  Comparison heading_;
};

}  // namespace navcal::calib
