// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/audit/audit.h"
#include "analysis/audit/heading_errors.h"
#include "base/angles.h"
#include "base/rounding.h"

namespace navcal::analysis {
namespace {

using base::kDegreesPerRadian;
using calib::Calibrator;

constexpr double kLeastHeading_deg = 1;   ///< errors below it are not worth a finding
constexpr double kStatedHeading_deg = 2;  ///< the same of a heading that passed through a filter
constexpr double kPair_deg = 5;           ///< between two compasses that are mounted by hand
constexpr double kMilligauss = 10;        ///< of a microtesla
constexpr std::size_t kMostPoints = 2000;

std::string vector_text(Eigen::Vector3d vector, int decimals) {
  // No "-0".
  for (double& axis : vector) axis = base::rounded(axis, std::pow(10.0, -decimals)) + 0.0;
  return fmt::format("({:.{}f}, {:.{}f}, {:.{}f})", vector.x(), decimals, vector.y(), decimals, vector.z(),
                     decimals);
}

AuditPicture field_picture(const std::vector<TurnedSample>& samples, const calib::FieldCorrection& correction) {
  AuditPicture::Points measured, calibrated;
  for (std::size_t i = 0; i < samples.size(); i += samples.size() / kMostPoints + 1) {
    const auto& reading = samples[i].reading;
    if (!reading.field_body_uT) continue;
    measured.emplace_back(reading.time_s, reading.field_body_uT->norm());
    calibrated.emplace_back(reading.time_s, correction(*reading.field_body_uT).norm());
  }
  return {"Strength of the field: without iron it is the same on all headings",
          "seconds from the beginning",
          "strength of the field, uT",
          {{"as measured", measured}, {"calibrated", calibrated}}};
}

/// What readings that had no part in a fit say of it.
struct HeldOutWords {
  bool is_better = false, is_worse = false;
  std::string words;
};
HeldOutWords held_out_words(const calib::CalibratorReport& report, const IronErrors& errors) {
  const auto& judgement = report.judgement;
  const double before = judgement.held_out_before, after = judgement.held_out_after;
  const auto spread = [](double from, double to, const char* by) {
    return HeldOutWords{to < from, from < to,
                        fmt::format("The size of the field spreads by {:.2f} % as measured, and by {:.2f} % {}.",
                                    100 * from, 100 * to, by)};
  };
  if (errors.spread_before)
    return spread(*errors.spread_before, *errors.spread_after,
                  "with a calibration from the other half of the log");
  if (judgement.held_out_quantity == calib::HeldOutQuantity::field)
    return spread(before, after, "calibrated, both on held-out readings");
  if (judgement.held_out_quantity != calib::HeldOutQuantity::heading) return {};
  return {
      after < before, before < after,
      fmt::format(
          "On held-out readings the heading is {:.2f} deg off the gyro's as measured and {:.2f} deg calibrated.",
          before * kDegreesPerRadian, after * kDegreesPerRadian)};
}

Finding iron_finding(const AuditedLog& log) {
  Finding finding{"compass.iron", "Iron at the compass", log.compass};
  const auto* report = log.whole.report.find(Calibrator::magnetometer);
  const auto* const correction = determined_field(log.whole.report);
  if (report == nullptr) return finding.cannot("The compass sends no field.");
  const calib::Quantity* const std = report->quantity("worst_heading_rad");
  const bool is_accepted = report->judgement.accepted;
  Finding open = refused(finding, *report);
  if (correction == nullptr) return open;
  const IronErrors errors = iron_errors(log, *correction);
  const HeldOutWords held_out = held_out_words(*report, errors);
  const double half_deg =
      kDegreesPerRadian * std::max(std != nullptr ? 1.96 * std->std : 0, errors.disagreement_rad.value_or(0));
  const double worst_deg = errors.worst_rad * kDegreesPerRadian, low_deg = std::max(worst_deg - half_deg, 0.0);
  finding.put({worst_deg, low_deg, worst_deg + half_deg}, "deg");
  finding.sentence = fmt::format(
      "Iron of {} uT, or a steady current or a mounting askew that look like it, turns the heading of the field "
      "by up to {:.1f} deg. {}",
      vector_text(correction->offset_uT, 1), worst_deg, held_out.words);
  const bool is_beyond = finding.is_beyond(0, kLeastHeading_deg);
  // A calibrator refuses what is too uncertain to correct by; less tells that there is iron.
  if (!is_accepted && !(is_beyond && held_out.is_better)) return open;
  if (!is_beyond) return finding;
  finding.certainty = held_out.is_worse || report->outcome == calib::Outcome::no_better ? Certainty::cannot_say
                      : held_out.is_better && is_accepted                               ? Certainty::found
                                                                                        : Certainty::likely;
  finding.todo = "Look for a step of the field, or turn through all headings twice.";
  if (finding.certainty == Certainty::cannot_say) return finding;
  finding.todo = !is_accepted ? open.todo
                              : fmt::format(
                                    "Calibrate the compass: navcal calibrate. ArduPilot, with COMPASS_DIA of 1: "
                                    "add {} to COMPASS_OFS_X, Y and Z.",
                                    vector_text(-kMilligauss * correction->offset_uT, 0));
  if (!is_accepted) finding.sentence += " It is not determined well enough to correct by it: " + open.sentence;
  finding.put_heading(worst_deg, log.speed_m_s());
  finding.picture = field_picture(log.whole.samples, *correction);
  return finding;
}

/// A steady current looks like iron. Where the log has a current whose field it does not tell, both are possible.
void weigh_against_motor(Finding& iron, const Finding& motor, const AuditedLog& log) {
  if (iron.certainty != Certainty::found || motor.certainty != Certainty::cannot_say || log.all("current").empty())
    return;
  iron.certainty = Certainty::likely;
  iron.sentence += " The log does not tell the field of the motor's current, which may be a part of it.";
}

void append_steps(std::vector<Finding>& findings, const AuditedLog& log) {
  const auto* const magnetometer = log.whole.report.find(Calibrator::magnetometer);
  const bool has_field = std::any_of(log.whole.samples.begin(), log.whole.samples.end(),
                                     [](const auto& sample) { return sample.reading.field_body_uT.has_value(); });
  if (magnetometer == nullptr || !has_field) return;
  const Finding step{"compass.step", "Step of the field", log.compass};
  if (log.whole.report.steps.empty()) {
    findings.push_back(step);
    findings.back().sentence = "The field did not step.";
  }
  const calib::Quantity* const size = magnetometer->quantity("field_uT");
  for (const calib::FieldStep& found : log.whole.report.steps) {
    Finding& finding = findings.emplace_back(step);
    const double size_uT = found.size_uT.norm(), std_uT = found.std_uT.norm();
    const auto* const motor = log.whole.report.find(Calibrator::motor_current);
    const bool is_motor = motor != nullptr && motor->outcome == calib::Outcome::accepted;
    const bool is_known = std::isfinite(std_uT) && bounded(size_uT, std_uT).low > 0;
    finding.certainty = !is_known ? Certainty::cannot_say : is_motor ? Certainty::likely : Certainty::found;
    finding.sentence = "In this log " + calib::words_of(found) + (is_motor ? "; it may be the motor's." : ".");
    finding.todo = "Look for a magnet, steel, a load or a current beside the compass at that time.";
    if (!is_known) continue;
    finding.put(bounded(size_uT, std_uT), "uT");
    const double across_uT = found.size_uT.head<2>().norm();
    const bool is_told = across_uT > 2 * found.std_uT.head<2>().norm();
    if (is_told && !found.returned && size != nullptr && size->value > across_uT)
      finding.put_heading(std::asin(across_uT / size->value) * kDegreesPerRadian, log.speed_m_s());
  }
}

Finding motor_finding(const AuditedLog& log) {
  Finding finding{"compass.motor", "Field of the motor", log.compass};
  const auto* const report = log.whole.report.find(Calibrator::motor_current);
  const auto currents = log.all("current");
  if (report == nullptr || currents.empty()) {
    return finding.cannot(
        "The log has no current of a motor beside field and rates.",
        "Log the current of the motors; a map names it as motor_current (--map, docs/import.md).");
  }
  const auto& slope = log.whole.report.estimates.motor_current;
  if (!slope) return refused(finding, *report);
  const double most_A = quantile(currents.front()->series.values, 0.98), size = slope->slope_uT_per_A.norm();
  double variance = 0;
  for (const calib::Quantity& quantity : report->estimate) variance += std::pow(quantity.value * quantity.std, 2);
  finding.put(bounded(size, size > 0 ? std::sqrt(variance) / size : 0), "uT/A");
  finding.low = std::max(*finding.low, 0.0);
  const auto& judgement = report->judgement;
  if (!judgement.accepted) {
    // The largest field that the interval allows, ahead and abeam.
    const double ahead_rad = motor_heading_rad(log, {{*finding.high, 0, 0}}, most_A);
    const double abeam_rad = motor_heading_rad(log, {{0, *finding.high, 0}}, most_A);
    finding.low = 0;  // the size of a noisy vector is never zero
    if (!(std::max(ahead_rad, abeam_rad) * kDegreesPerRadian < kLeastHeading_deg))
      return refused(finding, *report);
    finding.sentence = fmt::format("At {:.1f} A it is below {:.2f} uT.", most_A, *finding.high * most_A);
    return finding;
  }
  const double heading_deg = motor_heading_rad(log, *slope, most_A) * kDegreesPerRadian;
  finding.sentence = fmt::format(
      "{} uT/A; at {:.1f} A it turns the heading by up to {:.1f} deg. On held-out readings {:.2f} uT of {:.2f} "
      "are left.",
      vector_text(slope->slope_uT_per_A, 3), most_A, heading_deg, judgement.held_out_after,
      judgement.held_out_before);
  if (report->outcome != calib::Outcome::accepted || judgement.held_out_after >= judgement.held_out_before ||
      *finding.low <= 0 || heading_deg < kLeastHeading_deg)
    return finding;
  finding.certainty = Certainty::found;
  finding.put_heading(heading_deg, log.speed_m_s());
  finding.todo =
      fmt::format("Move the compass or twist the motor's leads. ArduPilot: COMPASS_MOT_X, Y and Z = {}.",
                  vector_text(-kMilligauss * slope->slope_uT_per_A, 2));
  return finding;
}

/// A heading that a device or the autopilot states.
Finding heading_finding(const AuditedLog& log, const RecordedChannel& channel) {
  Finding finding{"compass.heading", "Stated heading", channel.port};
  const auto errors = heading_errors(log, channel);
  const auto value = errors ? root_mean_square_bounded(errors->time_s, errors->error_deg) : std::nullopt;
  const auto own = log.heading_std_deg.find(channel.port);
  const bool is_stated =
      own != log.heading_std_deg.end() && quantile(own->second.values, 0) < quantile(own->second.values, 1);
  if (is_stated) finding.stated = quantile(own->second.values, 0.5);
  Finding uncalibrated = finding.cannot(
      "The compass could not be calibrated, or the field stepped, so that nothing judges this heading" +
          (finding.stated ? fmt::format(", nor the error of {:.1f} deg that it states.", *finding.stated)
                          : std::string(".")),
      "Turn through all headings twice.");
  if (!value) return uncalibrated;
  if (is_stated && errors->stated_deg) finding.stated = errors->stated_deg;
  const double own_deg = 1.96 * errors->reference_std_rad * kDegreesPerRadian;
  finding.put({value->value, std::max(value->low - own_deg, 0.0), value->high + own_deg}, "deg");
  finding.sentence = fmt::format(
      "This heading is {:.1f} deg (root mean square) off that of the field, calibrated on the {} log{}{}.",
      value->value, errors->is_of_other_half ? "other half of the" : "whole",
      errors->is_accepted ? "" : ", as far as that determines it",
      errors->is_absolute ? "" : "; a constant part cannot be told and is left out");
  finding.sentence += !finding.stated
                          ? " It states no error of its own."
                          : fmt::format(" It states an error of {:.1f} deg, which {}.", *finding.stated,
                                        *finding.low > *finding.stated ? "does not hold"
                                        : errors->is_absolute          ? "holds"
                                                                       : "holds but for that part");
  if (!finding.is_beyond(0, kStatedHeading_deg)) return errors->is_accepted ? finding : uncalibrated;
  finding.certainty = channel.port == log.compass && errors->is_accepted ? Certainty::found : Certainty::likely;
  finding.todo = "Calibrate the compass that this heading comes from, then compare again.";
  finding.put_heading(value->value, log.speed_m_s());
  AuditPicture::Points points;
  for (std::size_t i = 0; i < errors->error_deg.size(); i += errors->error_deg.size() / kMostPoints + 1)
    points.emplace_back(errors->heading_deg[i], errors->error_deg[i]);
  finding.picture = {"Error of the heading of " + channel.port, "heading, deg", "error, deg", {{"error", points}}};
  return finding;
}

/// A field that no place on Earth has.
Finding size_finding(const AuditedLog& log, const std::string& port) {
  constexpr double kLeast_uT = 20, kMost_uT = 70;  // 22 to 67 uT by the World Magnetic Model, with a scale error
  constexpr double kScaleError = 0.01;             // of a good compass
  Finding finding{"compass.size", "Size of the field", port};
  const FieldComparison field = compare_fields(log, port, port);
  const auto size = mean_bounded(block_means(field.time_s, field.size_uT));
  if (!size) return finding.cannot("There are too few readings.");
  const double own_uT = kScaleError * size->value;
  finding.put({size->value, size->low - own_uT, size->high + own_uT}, "uT");
  finding.sentence = fmt::format("The field has {:.1f} uT; on Earth it has 22 to 67 uT.", size->value);
  if (size->low <= kMost_uT && size->high >= kLeast_uT) return finding;
  finding.certainty = Certainty::found;
  finding.sentence += " The difference is iron beside the compass, a false unit, or a false scale.";
  finding.todo = "Calibrate the compass, away from steel; check the unit of its field.";
  return finding;
}

Finding axes_finding(const AuditedLog& log, const std::string& port) {
  constexpr double kWorse = 3, kFollows = 0.25;
  Finding finding{"compass.axes", "Axes of the field", port};
  const auto axes = field_axes(log, port);
  if (!axes) return finding.cannot("The log has no rates, or the vehicle hardly turned.");
  finding.sentence = fmt::format("The changes of the field follow the rates within {:.2f} uT.", axes->sent_uT);
  if (axes->best_uT > kFollows * axes->changed_uT)
    return finding.cannot(fmt::format(
        "Whatever its axes, the field does not follow the rates: of changes of {:.1f} uT {:.1f} are left.",
        axes->changed_uT, axes->best_uT));
  if (axes->sent_uT <= kWorse * axes->best_uT) return finding;
  finding.certainty = Certainty::likely;
  finding.sentence += fmt::format(
      " With axes {}, or all of these reversed, within {:.2f} uT: axes are exchanged or reversed, of the field or "
      "of the rates.",
      axes->best, axes->best_uT);
  finding.todo = "Set the mounting of the compass (ArduPilot: COMPASS_ORIENT), then calibrate it.";
  return finding;
}

Finding pair_finding(const AuditedLog& log, const std::string& first, const std::string& second) {
  Finding finding{"compass.pair", "Two compasses", first + ", " + second};
  const FieldComparison field = compare_fields(log, first, second);
  const auto value = mean_bounded(block_means(field.time_s, field.apart_deg));
  if (!value) return finding.cannot("The two have too few readings at the same times.");
  finding.put({value->value, std::max(value->low, 0.0), value->high}, "deg");
  finding.sentence = fmt::format("The headings of the two fields are {:.1f} deg apart in the mean{}.",
                                 value->value, field.is_levelled ? "" : ", the vehicle taken as level");
  if (!finding.is_beyond(0, kPair_deg)) return finding;
  finding.certainty = Certainty::found;
  finding.sentence += " At least one has iron, or is mounted otherwise than stated; the log does not tell which.";
  finding.todo = "Check the mounting of both, then calibrate both.";
  finding.put_heading(value->value / 2, log.speed_m_s());  // the worse of the two is off by half of it at least
  return finding;
}

}  // namespace

std::vector<Finding> compass_findings(const AuditedLog& log) {
  std::vector<Finding> findings;
  if (!log.compass.empty() && !log.is_partial) {
    findings.push_back(iron_finding(log));
    append_steps(findings, log);
    if (!log.all("field_x").empty()) {
      Finding motor = motor_finding(log);
      weigh_against_motor(findings.front(), motor, log);
      findings.push_back(std::move(motor));
    }
    for (const RecordedChannel* channel : log.all("heading")) findings.push_back(heading_finding(log, *channel));
  }
  const auto fields = log.all("field_x");
  for (std::size_t i = 0; i < fields.size(); ++i) {
    findings.push_back(size_finding(log, fields[i]->port));
    findings.push_back(axes_finding(log, fields[i]->port));
    for (std::size_t j = i + 1; j < fields.size(); ++j)
      findings.push_back(pair_finding(log, fields[i]->port, fields[j]->port));
  }
  return findings;
}

}  // namespace navcal::analysis
