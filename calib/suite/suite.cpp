// SPDX-License-Identifier: Apache-2.0
#include "calib/suite/suite.h"

#include <algorithm>
#include <utility>

#include "calib/coverage.h"

namespace navcal::calib {
namespace {

/// Readings of the compass from one judgement to the next: each of ten calibrators is judged every 30.
constexpr std::uint64_t kJudgeEvery = 3;
/// Readings of the compass after which those to come will be no better: without a field, or frozen.
constexpr std::uint64_t kReadingsEnough = 50;

}  // namespace

Suite::Suite(const SuiteOptions& options, Instruments instruments)
    : options_(options), instruments_(instruments), gate_(options.gate), estimators_(options),
      flags_(calibrators().size()) {
  for (const Calibrator calibrator : calibrators()) {
    const bool is_there = index_of(calibrator) < kNamedCalibrators || has_instruments(calibrator);
    if (is_there && !row_of(calibrator).only_shown) judged_.push_back(calibrator);
  }
}

void Suite::set_local_field(const LocalField& field) {
  options_.local_field = field;
  estimators_.set_local_field(field);
}

void Suite::put(const Reading& reading) {
  gate_.put(reading);
  while (const auto clean = gate_.take()) process(*clean);
}

void Suite::put(const ReferenceReading& reading) {
  const auto time_s = gate_.on_own_scale(reading.time_s);
  if (!time_s) return;
  ReferenceReading timed = reading;
  timed.time_s = *time_s;
  estimators_.update(timed);
  adopt_what_is_better();
}

void Suite::finish() {
  gate_.flush();
  while (const auto clean = gate_.take()) process(*clean);
  estimators_.finish();
  take_turned();
  estimators_.settle();
}

void Suite::process(const Reading& reading) {
  if (const auto* compass = std::get_if<CompassReading>(&reading)) {
    if (compass->heading_rad) ++rose_[sector_of(*compass->heading_rad)];
    estimators_.update(*compass, in_force_.correction());
  } else if (const auto* rate = std::get_if<RateReading>(&reading)) {
    estimators_.update(*rate);
  } else if (const auto* ground = std::get_if<GroundReading>(&reading)) {
    estimators_.update(*ground, in_force_.correction());
    adopt_what_is_better();
  } else if (const auto* motor = std::get_if<MotorReading>(&reading)) {
    estimators_.update(*motor, in_force_.correction());
  }
  take_turned();
}

void Suite::take_turned() {
  while (const auto turned = estimators_.next(in_force_.correction())) judge(*turned);
}

void Suite::judge(const TurnedReading& turned) {
  if (readings_ % kJudgeEvery == 0) refresh_accepted(judged_[readings_ / kJudgeEvery % judged_.size()]);
  ++readings_;
  follow_field();
  if (field_.update(turned.reading, in_force_.correction(), accepted_)) adopt_what_is_better();
  if (!turned.turn) return;
  if (held_out_.update(turned.reading, *turned.turn, in_force_.correction(), accepted_)) adopt_what_is_better();
}

void Suite::refresh_accepted(Calibrator calibrator) {
  const CalibratorUnit& unit = estimators_.unit(calibrator);
  if (unit.judgement().accepted) {
    unit.put_estimate(accepted_);
  } else {
    copy_value(accepted_, Correction{}, calibrator);
  }
}

const Comparison& Suite::comparison(Calibrator calibrator) const {
  const Comparison* const own = estimators_.unit(calibrator).comparison().comparison;
  return own != nullptr ? *own : held_out_.of(calibrator);
}

bool Suite::is_better(Calibrator calibrator) const {
  const Comparison& found = comparison(calibrator);
  if (found.better_by(options_.margin)) return true;
  // The field's own comparison decides where no gyro serves as reference.
  return row_of(calibrator).field_alone && field_.comparison().better_by(options_.margin) && !found.contradicts();
}

bool Suite::is_worse(Calibrator calibrator) const {
  const Correction& in_force = in_force_.correction();
  if (!has(in_force, calibrator)) return false;
  // The corrected heading is that of one of these: of the magnetometer, else of the compass, else by GPS.
  const bool by_gps = calibrator == Calibrator::gps_compass, by_turns = calibrator == Calibrator::compass;
  if (((by_gps || by_turns) && in_force.magnetometer) || (by_gps && in_force.compass)) return false;
  const bool by_field = row_of(calibrator).field_alone && !comparison(calibrator).is_judged();
  return (by_field ? field_.comparison() : comparison(calibrator)).worse_by(options_.margin);
}

void Suite::adopt_what_is_better() {
  if (!options_.automatic) return;
  for (const Calibrator calibrator : calibrators()) {
    Flags& flags = flags_[index_of(calibrator)];
    if (!row_of(calibrator).automatic || flags.held) continue;
    const bool adopts = has(accepted_, calibrator) && is_better(calibrator);
    if (!adopts && !is_worse(calibrator)) continue;
    adopt(calibrator, adopts ? accepted_ : Correction{});
    flags.adopted = true;
  }
}

void Suite::adopt(Calibrator calibrator, const Correction& estimates) {
  in_force_.adopt(calibrator, estimates);
  flags_[index_of(calibrator)].left = false;
  if (calibrator == Calibrator::magnetometer) {
    learnt_steps_ = estimators_.magnetometer().field_steps();
    moved_ = {};
  }
  on_change(calibrator);
}

void Suite::on_change(Calibrator calibrator) {
  held_out_.on_change();
  field_.on_change();
  estimators_.on_in_force(calibrator, in_force_.correction());
  if (row_of(calibrator).corrects == Corrects::field) forget_field();
  for (const Calibrator other : calibrators()) {
    // The other calibrator may have started anew.
    if (row_of(other).corrects == Corrects::offset) refresh_accepted(other);
  }
}

std::optional<Calibrator> Suite::take_adopted() {
  for (const Calibrator calibrator : calibrators()) {
    if (std::exchange(flags_[index_of(calibrator)].adopted, false)) return calibrator;
  }
  return std::nullopt;
}

std::optional<FieldStep> Suite::take_field_step() {
  if (told_move_) return std::exchange(told_move_, std::nullopt);
  const Magnetometer& magnetometer = estimators_.magnetometer();
  const std::uint32_t told = magnetometer.field_steps() + magnetometer.withdrawn_steps();
  const bool is_new = told > told_steps_;
  told_steps_ = told;  // steps are minutes apart: never two at once
  return is_new ? magnetometer.last_step() : std::nullopt;
}

std::string Suite::accept(Calibrator calibrator, bool force) {
  if (!has_instruments(calibrator)) return "the configuration has no instruments for it";
  Correction estimates;
  estimators_.unit(calibrator).put_estimate(estimates);
  const Judgement judgement = estimators_.unit(calibrator).judgement();
  if (!judgement.accepted && !force) {
    const std::string hint = has(estimates, calibrator) ? ". \"force\":true puts it in force all the same" : "";
    return "refused: " + judgement.reason + (judgement.manoeuvre.empty() ? "" : "; " + judgement.manoeuvre) + hint;
  }
  if (!has(estimates, calibrator)) {
    return "there is no estimate yet" + (judgement.reason.empty() ? "" : ": " + judgement.reason);
  }
  flags_[index_of(calibrator)].held = false;
  adopt(calibrator, estimates);
  return {};
}

std::string Suite::roll_back(Calibrator calibrator) {
  if (!in_force_.roll_back(calibrator)) return "nothing to go back to";
  flags_[index_of(calibrator)].held = true;
  flags_[index_of(calibrator)].left = false;
  on_change(calibrator);
  return {};
}

std::string Suite::start(Calibrator calibrator) {
  if (!has_instruments(calibrator)) return "the configuration has no instruments for it";
  estimators_.unit(calibrator).start();
  held_out_.forget(calibrator);
  if (row_of(calibrator).field_alone) field_.forget();
  if (calibrator == Calibrator::magnetometer) forget_field();
  flags_[index_of(calibrator)].held = false;
  if (row_of(calibrator).clears_rose) rose_ = {};
  refresh_accepted(calibrator);
  return {};
}

bool Suite::has_instruments(Calibrator calibrator) const {
  const CalibratorRow& row = row_of(calibrator);
  const Instruments& needed = row.needs;
  const auto& [compass, rate, ground, motor, reference] = instruments_;
  if (row.needs_advance && !(options_.advance_m > 0)) return false;
  return (compass || !needed.compass) && (rate || !needed.rate) && (ground || !needed.ground) &&
         (motor || !needed.motor) && (reference || !needed.reference);
}

std::string Suite::silent_instrument(Calibrator calibrator) const {
  const auto silent = [&](bool needed, Stream stream) {
    return needed && gate_.counts().taken[static_cast<std::size_t>(stream)] == 0;
  };
  const Instruments& needed = row_of(calibrator).needs;
  if (silent(needed.compass, Stream::compass)) return "reading of the compass";
  if (silent(needed.rate, Stream::rate)) return "reading of the inertial card";
  if (silent(needed.ground, Stream::ground)) return "fix with a speed over ground";
  if (silent(needed.motor, Stream::motor)) return "reading of the motor card";
  return {};
}

void Suite::judge(CalibratorReport& report, const Correction& in_force) const {
  Judgement& judgement = report.judgement;
  const std::uint64_t compass = gate_.counts().taken[static_cast<std::size_t>(Stream::compass)];
  const auto& left_out = gate_.counts().left_out[static_cast<std::size_t>(Stream::compass)];
  if (const std::string silent = silent_instrument(report.calibrator); !silent.empty()) {
    judgement.reason = "no " + silent + " so far";
    judgement.manoeuvre.clear();
  } else if (!judgement.accepted && row_of(report.calibrator).needs.compass &&
             2 * left_out[static_cast<std::size_t>(Rejection::frozen)] > std::max(compass, kReadingsEnough)) {
    judgement.reason =
        "the readings of the compass stay the same to the last digit: it hangs, or the vehicle lies still";
    judgement.manoeuvre.clear();
  } else if (row_of(report.calibrator).field_alone && judgement.samples == 0 && compass >= kReadingsEnough) {
    const bool too_large = left_out[static_cast<std::size_t>(Rejection::field_too_large)] > 0;
    judgement.reason = too_large ? "the measured field is larger than the 500 uT that the Earth and a vehicle make"
                                 : "the compass gives headings without the field that it measures";
    judgement.manoeuvre = too_large ? "take magnets away from the compass, and check the unit of its field" : "";
  }
  const bool by_field = row_of(report.calibrator).field_alone && !comparison(report.calibrator).is_judged();
  const Comparison& held_out = by_field ? field_.comparison() : comparison(report.calibrator);
  judgement.held_out_before = held_out.before_rms();
  judgement.held_out_after = held_out.estimate_rms();
  judgement.held_out_quantity = held_out.blocks() == 0 ? HeldOutQuantity::none
                                : by_field             ? HeldOutQuantity::field
                                                       : estimators_.unit(report.calibrator).comparison().quantity;
  const bool is_worse = held_out.is_judged() && judgement.held_out_after >= judgement.held_out_before;
  report.outcome = !judgement.accepted ? Outcome::refused : is_worse ? Outcome::no_better : Outcome::accepted;
  report.verdict = has(in_force, report.calibrator) ? Verdict::in_force
                   : judgement.accepted             ? Verdict::shadow
                                                    : Verdict::refused;
}

Report Suite::report() const {
  Report report;
  report.name = in_force_.name();
  report.in_force = in_force_.correction();
  report.estimates = estimators_.estimates();
  for (const Calibrator calibrator : calibrators()) {
    if (!has_instruments(calibrator)) continue;
    const CalibratorUnit& unit = estimators_.unit(calibrator);
    CalibratorReport& one = report.calibrators.emplace_back();
    one.calibrator = calibrator;
    one.judgement = unit.judgement();
    judge(one, report.in_force);
    one.estimate = unit.quantities();
    one.covariance = unit.covariance();
    if (calibrator == Calibrator::magnetometer && one.verdict == Verdict::in_force)
      one.step_std_uT = moved_.variance_uT2.cwiseSqrt();
    one.held = flags_[index_of(calibrator)].held;
    one.steps_back = in_force_.steps_back(calibrator);
  }
  const Comparison& heading = held_out_.heading();
  report.heading = {heading.blocks(), heading.before_rms(), heading.estimate_rms(), heading.in_force_rms()};
  report.rose = rose_;
  report.steps = estimators_.magnetometer().history().steps();
  report.moves = estimators_.magnetometer().moves();
  report.segments = estimators_.magnetometer().history().segments();
  report.gate = gate_.counts();
  return report;
}

void Suite::archive(Archive& archive) {
  const auto all = calibrators();
  const bool with_added = archive.tag_either("suite 5", "suite 6", all.size() > kNamedCalibrators);
  archive(gate_, estimators_, held_out_, field_, in_force_, accepted_, readings_);
  for (std::size_t i = 0; i < kNamedCalibrators; ++i) archive(flags_[i].held);
  for (std::size_t i = 0; i < kNamedCalibrators; ++i) archive(flags_[i].adopted);
  for (std::size_t i = 0; i < kNamedCalibrators; ++i) archive(flags_[i].left);
  archive(rose_, told_steps_, followed_steps_, followed_withdrawn_, learnt_steps_, moved_);
  if (!archive.saving()) {
    followed_moves_ = estimators_.magnetometer().moves();
    // A state that is older than a calibrator does not contain it, so that calibrator starts anew.
    for (const Calibrator calibrator : all.subspan(kNamedCalibrators)) {
      estimators_.unit(calibrator).start();
      held_out_.forget_added(calibrator);
      flags_[index_of(calibrator)] = {};
    }
  }
  if (with_added) archive_added(archive);
}

void Suite::archive_added(Archive& archive) {
  const auto added = calibrators().subspan(kNamedCalibrators);
  std::uint64_t count = added.size();
  archive(count);
  for (std::uint64_t i = 0; i < count && archive.ok(); ++i) {
    Calibrator calibrator = archive.saving() ? added[i] : Calibrator::gyro;
    calib::archive(archive, calibrator);
    if (!archive.ok()) return;
    if (index_of(calibrator) < kNamedCalibrators) return archive.fail();
    Flags& flags = flags_[index_of(calibrator)];
    archive(flags.held, flags.adopted, flags.left);
    held_out_.archive_added(archive, calibrator);
    estimators_.unit(calibrator).archive(archive);
  }
}

}  // namespace navcal::calib
