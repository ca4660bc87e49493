// SPDX-License-Identifier: Apache-2.0
#include "calib/suite/suite.h"

#include "calib/coverage.h"

namespace navcal::calib {
namespace {

/// Readings of the compass from one judgement to the next: each calibrator is judged every 27.
constexpr std::uint64_t kJudgeEvery = 3;

/// Those that improve the heading or the rate; delays and the swing come into force by the operator's word alone.
constexpr std::array kAutomatic{Calibrator::gyro,         Calibrator::gyro_b,      Calibrator::compass,
                                Calibrator::magnetometer, Calibrator::gps_compass, Calibrator::misalignment,
                                Calibrator::motor_current};

/// Those without which a calibrator cannot begin.
Instruments instruments_of(Calibrator calibrator) {
  switch (calibrator) {
    case Calibrator::magnetometer:
      return {.compass = true};
    case Calibrator::gps_compass:
      return {.compass = true, .ground = true, .motor = true};
    case Calibrator::misalignment:
    case Calibrator::course_delay:
      return {.compass = true, .ground = true};
    case Calibrator::motor_current:
      return {.compass = true, .rate = true, .motor = true};
    case Calibrator::gyro:
    case Calibrator::gyro_b:
    case Calibrator::compass:
    case Calibrator::swing:
    case Calibrator::compass_delay:
      break;
  }
  return {.compass = true, .rate = true};
}

std::size_t index(Calibrator calibrator) { return static_cast<std::size_t>(calibrator); }

}  // namespace

Suite::Suite(const SuiteOptions& options, Instruments instruments)
    : options_(options), instruments_(instruments), gate_(options.gate), estimators_(options) {}

void Suite::set_local_field(const LocalField& field) {
  options_.local_field = field;
  estimators_.set_local_field(field);
}

void Suite::put(const Reading& reading) {
  gate_.put(reading);
  while (const auto clean = gate_.take()) process(*clean);
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
  if (readings_ % kJudgeEvery == 0) refresh_accepted(kCalibrators[readings_ / kJudgeEvery % kCalibrators.size()]);
  ++readings_;
  if (field_.update(turned.reading, in_force_.correction(), accepted_)) adopt_what_is_better();
  if (!turned.turn) return;
  if (held_out_.update(turned.reading, *turned.turn, in_force_.correction(), accepted_)) adopt_what_is_better();
}

void Suite::refresh_accepted(Calibrator calibrator) {
  if (estimators_.judgement(calibrator).accepted) {
    estimators_.put_estimate(calibrator, accepted_);
  } else {
    copy_value(accepted_, Correction{}, calibrator);
  }
}

const Comparison& Suite::comparison(Calibrator calibrator) const {
  if (calibrator == Calibrator::motor_current) return estimators_.motor_comparison();
  return calibrator == Calibrator::misalignment ? estimators_.misalignment_comparison() : held_out_.of(calibrator);
}

bool Suite::is_better(Calibrator calibrator) const {
  const Comparison& found = comparison(calibrator);
  if (found.better_by(options_.margin)) return true;
  // Where no gyro serves as reference, the field itself does.
  return calibrator == Calibrator::magnetometer && field_.comparison().better_by(options_.margin) &&
         !found.contradicts();
}

void Suite::adopt_what_is_better() {
  if (!options_.automatic) return;
  for (const Calibrator calibrator : kAutomatic) {
    if (held_[index(calibrator)] || !has(accepted_, calibrator) || !is_better(calibrator)) continue;
    adopt(calibrator, accepted_);
    adopted_[index(calibrator)] = true;
  }
}

void Suite::adopt(Calibrator calibrator, const Correction& estimates) {
  in_force_.adopt(calibrator, estimates);
  on_change(calibrator);
}

void Suite::on_change(Calibrator calibrator) {
  held_out_.on_change();
  field_.on_change();
  estimators_.on_in_force(calibrator, in_force_.correction());
  refresh_accepted(Calibrator::misalignment);  // it may have begun anew
}

std::optional<Calibrator> Suite::take_adopted() {
  for (const Calibrator calibrator : kCalibrators) {
    if (!adopted_[index(calibrator)]) continue;
    adopted_[index(calibrator)] = false;
    return calibrator;
  }
  return std::nullopt;
}

std::optional<FieldStep> Suite::take_field_step() {
  const Magnetometer& magnetometer = estimators_.magnetometer();
  const bool is_new = magnetometer.field_steps() > told_steps_;
  told_steps_ = magnetometer.field_steps();  // steps are minutes apart: never two at once
  return is_new ? magnetometer.last_step() : std::nullopt;
}

std::string Suite::accept(Calibrator calibrator, bool force) {
  if (!has_instruments(calibrator)) return "the configuration has no instruments for it";
  Correction estimates;
  estimators_.put_estimate(calibrator, estimates);
  const Judgement judgement = estimators_.judgement(calibrator);
  if (!judgement.accepted && !force) {
    const std::string hint = has(estimates, calibrator) ? ". \"force\":true puts it in force all the same" : "";
    return "refused: " + judgement.reason + (judgement.manoeuvre.empty() ? "" : "; " + judgement.manoeuvre) + hint;
  }
  if (!has(estimates, calibrator)) {
    return "there is no estimate yet" + (judgement.reason.empty() ? "" : ": " + judgement.reason);
  }
  held_[index(calibrator)] = false;
  adopt(calibrator, estimates);
  return {};
}

std::string Suite::roll_back(Calibrator calibrator) {
  if (!in_force_.roll_back(calibrator)) return "nothing to go back to";
  held_[index(calibrator)] = true;
  on_change(calibrator);
  return {};
}

std::string Suite::start(Calibrator calibrator) {
  if (!has_instruments(calibrator)) return "the configuration has no instruments for it";
  estimators_.start(calibrator);
  held_out_.forget(calibrator);
  if (calibrator == Calibrator::magnetometer) field_.forget();
  held_[index(calibrator)] = false;
  if (calibrator == Calibrator::compass || calibrator == Calibrator::magnetometer) rose_ = {};
  refresh_accepted(calibrator);
  return {};
}

bool Suite::has_instruments(Calibrator calibrator) const {
  const Instruments needed = instruments_of(calibrator);
  const auto& [compass, rate, ground, motor] = instruments_;
  if (calibrator == Calibrator::gps_compass && !(options_.advance_m > 0)) return false;
  return (compass || !needed.compass) && (rate || !needed.rate) && (ground || !needed.ground) &&
         (motor || !needed.motor);
}

std::string Suite::silent_instrument(Calibrator calibrator) const {
  const auto silent = [&](bool needed, Stream stream) {
    return needed && gate_.counts().taken[static_cast<std::size_t>(stream)] == 0;
  };
  const Instruments needed = instruments_of(calibrator);
  if (silent(needed.compass, Stream::compass)) return "the compass";
  if (silent(needed.rate, Stream::rate)) return "the inertial card";
  if (silent(needed.ground, Stream::ground)) return "the GPS receiver";
  if (silent(needed.motor, Stream::motor)) return "the motor card";
  return {};
}

bool Suite::gives_no_field() const {
  constexpr std::uint64_t kEnough = 50;  // readings
  return gate_.counts().taken[static_cast<std::size_t>(Stream::compass)] >= kEnough;
}

void Suite::judge(CalibratorReport& report, const Correction& in_force) const {
  Judgement& judgement = report.judgement;
  if (const std::string silent = silent_instrument(report.calibrator); !silent.empty()) {
    judgement.reason = "no reading of " + silent + " so far";
    judgement.manoeuvre.clear();
  } else if (report.calibrator == Calibrator::magnetometer && judgement.samples == 0 && gives_no_field()) {
    judgement.reason = "the compass gives headings without the field that it measures";
    judgement.manoeuvre.clear();
  }
  const bool by_field =
      report.calibrator == Calibrator::magnetometer && !comparison(report.calibrator).is_judged();
  const Comparison& held_out = by_field ? field_.comparison() : comparison(report.calibrator);
  judgement.held_out_before = held_out.before_rms();
  judgement.held_out_after = held_out.estimate_rms();
  judgement.held_out_quantity = held_out.blocks() == 0                           ? HeldOutQuantity::none
                                : by_field                                       ? HeldOutQuantity::field
                                : report.calibrator == Calibrator::motor_current ? HeldOutQuantity::motor_field
                                                                                 : HeldOutQuantity::heading;
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
  for (const Calibrator calibrator : kCalibrators) {
    if (!has_instruments(calibrator)) continue;
    CalibratorReport& one = report.calibrators.emplace_back();
    one.calibrator = calibrator;
    one.judgement = estimators_.judgement(calibrator);
    judge(one, report.in_force);
    one.estimate = estimators_.quantities(calibrator);
    one.covariance = estimators_.covariance(calibrator);
    one.held = held_[index(calibrator)];
    one.steps_back = in_force_.steps_back(calibrator);
  }
  const Comparison& heading = held_out_.heading();
  report.heading = {heading.blocks(), heading.before_rms(), heading.estimate_rms(), heading.in_force_rms()};
  report.rose = rose_;
  report.steps = estimators_.magnetometer().history().steps();
  report.segments = estimators_.magnetometer().history().segments();
  report.gate = gate_.counts();
  return report;
}

void Suite::archive(Archive& archive) {
  archive.tag("suite 3");
  archive(gate_, estimators_, held_out_, field_, in_force_, accepted_, readings_, held_, adopted_, rose_,
          told_steps_);
}

}  // namespace navcal::calib
