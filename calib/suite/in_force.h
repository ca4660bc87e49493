// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "calib/archive.h"
#include "calib/correction.h"

namespace navcal::calib {

/// Names a whole Correction: a number that grows with every change, and a sum over its content, so that two
/// different corrections never share a name even when the counting had to begin anew.
struct CorrectionName {
  std::uint32_t number = 0;  ///< 0: nothing is or ever was in force
  std::uint32_t sum = 0;
  bool operator==(const CorrectionName&) const = default;
  /// "7-1a2b3c4d"; "none" for number 0.
  [[nodiscard]] std::string text() const;
};

/// The active calibration and the history of its changes.
class InForce {
 public:
  /// Number of changes that can be taken back.
  static constexpr std::size_t kDepth = 32;

  [[nodiscard]] const Correction& correction() const { return correction_; }
  [[nodiscard]] CorrectionName name() const { return name_; }
  /// Changes that roll_back() can undo.
  [[nodiscard]] std::size_t steps_back(Calibrator calibrator) const;

  /// Takes over the value that `from` has for one calibrator.
  void adopt(Calibrator calibrator, const Correction& from);
  /// Gives one calibrator the value that it had before its last change. False when there is none.
  bool roll_back(Calibrator calibrator);

  /// The hard iron has changed by a step of the field: moves that in force, and those that can be rolled back to.
  void move_hard_iron(const Eigen::Vector3d& by_uT);

  void archive(Archive& archive);

 private:
  struct Change {
    Calibrator calibrator = Calibrator::gyro;
    Correction before;
    void archive(Archive& archive);
  };
  void rename();

  Correction correction_;
  CorrectionName name_;
  std::vector<Change> history_;
};

}  // namespace navcal::calib
