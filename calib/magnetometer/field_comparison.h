// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "calib/archive.h"
#include "calib/correction.h"
#include "calib/readings.h"
#include "calib/turn/held_out.h"

namespace navcal::calib {

/// Judges a calibration of the magnetometer by the field alone, without a gyro.
///
/// Model: the size of the Earth's field, and its component along gravity, are the same in every attitude. What is
/// compared are their squared departures from their running means, relative to the mean size: raw, by the
/// calibration in force, and by the estimate. A block of readings is judged by an estimate that was made before
/// the block began (prequential, Dawid 1984). Without tilt the size alone is judged.
class FieldComparison {
 public:
  static constexpr std::uint32_t kReadings = 100;  ///< of one block

  /// `estimates`: those that are accepted, at this reading. True when a block was ended by it.
  bool update(const CompassReading& reading, const Correction& in_force, const Correction& estimates);
  /// Departures as fractions of the field's size.
  [[nodiscard]] const Comparison& comparison() const { return comparison_; }
  /// The active correction has changed.
  void on_change();
  /// Drops everything when the calibrator starts anew.
  void forget() { *this = {}; }
  void archive(Archive& archive);

 private:
  /// Size and vertical component of the field, with their running means over the blocks before.
  class Spread {
   public:
    void add(const Eigen::Vector3d& field_uT, const std::optional<Eigen::Vector3d>& down);
    /// Ends the block: mean squared departure in it, relative to the size.
    double end();
    void archive(Archive& archive) { archive(size_, vertical_); }

   private:
    struct Moments {
      double count = 0, sum = 0, square = 0;  ///< of this block
      double mean = 0, weight = 0;            ///< of the blocks before, with forgetting
      void add(double value);
      /// Mean square about the running mean, which takes in this block.
      double end();
      void archive(Archive& archive) { archive(count, sum, square, mean, weight); }
    };
    Moments size_, vertical_;
  };

  void begin(const Correction& in_force, const Correction& estimates);

  std::optional<FieldCorrection> in_force_, estimate_;  ///< as they were when the block began
  Spread raw_, with_in_force_, with_estimate_;
  std::uint32_t readings_ = 0;
  Comparison comparison_;
};

}  // namespace navcal::calib
