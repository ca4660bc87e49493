// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calib/archive.h"
#include "calib/magnetometer/field_comparison.h"
#include "calib/suite/estimators.h"
#include "calib/suite/gate.h"
#include "calib/suite/in_force.h"
#include "calib/suite/report.h"
#include "calib/suite/suite_options.h"
#include "calib/turn/held_out.h"

namespace navcal::calib {

/// The whole of the calibration: readings in; the active calibration and the reports on it out. Readings go
/// through the Gate to all estimators. Their estimates run in shadow and are judged on held-out readings
/// (HeldOut). They become active when they are accepted and better by the margin, or by the operator's order.
/// When the field steps, the active calibration is moved by the step or leaves force, and what was learnt before
/// judges nothing after it.
/// The same calls in the same order give the same results to the last bit.
class Suite {
 public:
  /// `instruments`: a calibrator that lacks one of its own is not reported.
  Suite(const SuiteOptions& options, Instruments instruments);

  void put(const Reading& reading);
  /// A true heading by an external reference; it does not wait in the gate.
  void put(const ReferenceReading& reading);
  /// Called when no more readings come: all that wait are used, and iterative fits run to their end.
  void finish();
  /// Readings go on after a pause of unknown length, on another clock.
  void restart() { gate_.restart(); }

  [[nodiscard]] const InForce& in_force() const { return in_force_; }
  /// A calibrator whose value in force changed by itself since the last call; to be called until there is none.
  std::optional<Calibrator> take_adopted();

  /// A step of the field that was found since the last call.
  std::optional<FieldStep> take_field_step();

  /// The Earth's field here became known, or is another one: the vehicle has moved.
  void set_local_field(const LocalField& field);

  // The operator's word. Each returns why it cannot be done; empty: it is done.
  /// `force`: also an estimate that is refused.
  std::string accept(Calibrator calibrator, bool force = false);
  std::string roll_back(Calibrator calibrator);
  std::string start(Calibrator calibrator);

  [[nodiscard]] Report report() const;
  void archive(Archive& archive);

 private:
  struct Flags {
    bool held = false;     ///< rolled back: only the operator brings it back
    bool adopted = false;  ///< not told yet
    bool left = false;     ///< out of force since the last step of the field
  };

  void process(const Reading& reading);
  void take_turned();
  /// Moves the hard iron in force by what has become known of the steps of the field since the last call.
  void follow_field();
  /// Deviations of another field leave force or come back, and what was learnt before judges nothing after. Null:
  /// the last step was withdrawn.
  void change_field(const FieldStep* step);
  /// Takes a calibrator's value out of force at a step, or back when the step has gone.
  void leave(Calibrator calibrator, const Correction& rest);
  void come_back(Calibrator calibrator);
  /// The magnetometer's calibrator begins anew, and the history of its field.
  void forget_field();
  void judge(const TurnedReading& turned);
  [[nodiscard]] bool has_instruments(Calibrator calibrator) const;
  /// The reading that is missing of the first configured instrument of a calibrator that has said nothing. Empty:
  /// none is.
  [[nodiscard]] std::string silent_instrument(Calibrator calibrator) const;
  [[nodiscard]] const Comparison& comparison(Calibrator calibrator) const;
  /// Looks anew whether a calibrator's estimate is accepted.
  void refresh_accepted(Calibrator calibrator);
  /// True when the estimate is better on held-out readings than the active correction, and no other instrument
  /// contradicts it.
  [[nodiscard]] bool is_better(Calibrator calibrator) const;
  /// True when what is active is worse on held-out readings than nothing.
  [[nodiscard]] bool is_worse(Calibrator calibrator) const;
  void adopt_what_is_better();
  /// Verdict, outcome and held-out figures of one calibrator.
  void judge(CalibratorReport& report, const Correction& in_force) const;
  void adopt(Calibrator calibrator, const Correction& estimates);
  void on_change(Calibrator calibrator);
  void archive_added(Archive& archive);

  SuiteOptions options_;
  Instruments instruments_;
  Gate gate_;
  Estimators estimators_;
  HeldOut held_out_;
  FieldComparison field_;  ///< of the magnetometer, by the field alone
  InForce in_force_;
  Correction accepted_;  ///< as of not long ago: one calibrator is judged after the other, for it takes time
  std::uint64_t readings_ = 0;
  std::vector<Flags> flags_;  ///< by calibrator
  /// Calibrators that are judged in turn: all that are named, and of the others those that have their instruments.
  std::vector<Calibrator> judged_;
  HeadingHistogram rose_{};
  std::uint32_t told_steps_ = 0;
  std::uint32_t followed_steps_ = 0, followed_withdrawn_ = 0;
  std::uint32_t learnt_steps_ = 0;  ///< steps told before the hard iron in force was learnt
  std::uint32_t followed_moves_ = 0;
  std::optional<FieldStep> told_move_;  ///< to be told
  IronShift moved_;                     ///< by which it was moved since
};

}  // namespace navcal::calib
