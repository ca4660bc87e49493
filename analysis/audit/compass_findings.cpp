// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "analysis/audit/findings.h"
#include "analysis/audit/heading_errors.h"
#include "base/angles.h"

namespace navcal::analysis {
namespace {

using base::kDegreesPerRadian;
using calib::Calibrator;

constexpr double kLeastHeading_deg = 1;  ///< errors below it are not worth a finding
constexpr double kNanoteslaGauss = 10;   ///< milligauss of a microtesla

std::string vector_text(const Eigen::Vector3d& vector, int decimals) {
  return fmt::format("({:.{}f}, {:.{}f}, {:.{}f})", vector.x(), decimals, vector.y(), decimals, vector.z(),
                     decimals);
}

/// Size of the field against time, as measured and calibrated.
AuditPicture field_picture(const std::vector<TurnedSample>& samples, const calib::FieldCorrection& correction) {
  AuditPicture picture{"Size of the field",
                       "seconds from the beginning",
                       "uT",
                       "The Earth's field is constant: what varies is iron, current and noise.",
                       {{"as measured", {}, false}, {"calibrated", {}, false}}};
  constexpr std::size_t kMost = 2000;
  for (std::size_t i = 0; i < samples.size(); i += samples.size() / kMost + 1) {
    const auto& reading = samples[i].reading;
    if (!reading.field_body_uT) continue;
    picture.traces[0].points.emplace_back(reading.time_s, reading.field_body_uT->norm());
    picture.traces[1].points.emplace_back(reading.time_s, correction(*reading.field_body_uT).norm());
  }
  return picture;
}

AuditPicture heading_picture(std::string title, const HeadingErrors& errors) {
  AuditPicture picture{std::move(title),
                       "heading, deg",
                       "error, deg",
                       "Each point is judged by a calibration from the other half of the log.",
                       {{"error of the heading", {}, false}}};
  for (const HeadingErrors::Point& point : errors.points)
    picture.traces.front().points.emplace_back(point.heading_rad * kDegreesPerRadian,
                                               point.error_rad * kDegreesPerRadian);
  return picture;
}

/// The parameters of ArduPilot that take the hard iron away. Its fields are logged with its own offsets applied.
std::string offsets_for_autopilot(const Eigen::Vector3d& offset_uT) {
  return fmt::format("For ArduPilot with COMPASS_DIA of 1: add {} to COMPASS_OFS_X, Y and Z (milligauss).",
                     vector_text(-kNanoteslaGauss * offset_uT, 0));
}

Finding iron_finding(const AuditedLog& log) {
  Finding finding = finding_of("compass.iron", log.compass);
  const auto* report = log.whole.report.find(Calibrator::magnetometer);
  const auto& correction = log.whole.report.estimates.magnetometer;
  if (report == nullptr || !report->judgement.accepted || !correction) {
    if (report != nullptr) return refused(finding, *report);
    finding.certainty = Certainty::cannot_say;
    finding.sentence = "The compass sends no field.";
    return finding;
  }
  const auto& judgement = report->judgement;
  const IronErrors errors = iron_errors(log, *correction);
  const calib::Quantity* const std = report->quantity("worst_heading_rad");
  const double std_deg = (std != nullptr ? std->std : 0) * kDegreesPerRadian;
  const double half_deg = std::max(1.96 * std_deg, errors.disagreement_rad.value_or(0) * kDegreesPerRadian);
  const double worst_deg = errors.worst_rad * kDegreesPerRadian;
  put_value(finding, {worst_deg, std::max(worst_deg - half_deg, 0.0), worst_deg + half_deg}, "deg");
  const std::string spreads =
      errors.spread_before
          ? fmt::format(
                "The size of the field spreads by {:.2f} % as measured, and by {:.2f} % with a calibration "
                "from the other half of the log.",
                100 * *errors.spread_before, 100 * *errors.spread_after)
      : judgement.held_out_quantity == calib::HeldOutQuantity::field
          ? fmt::format(
                "On readings that had no part in the fit the field spreads by {:.2f} % as measured, "
                "and by {:.2f} % calibrated.",
                100 * judgement.held_out_before, 100 * judgement.held_out_after)
      : judgement.held_out_quantity == calib::HeldOutQuantity::heading
          ? fmt::format(
                "On readings that had no part in the fit the heading is off the gyro's by {:.2f} deg as "
                "measured, and by {:.2f} deg calibrated.",
                judgement.held_out_before * kDegreesPerRadian, judgement.held_out_after * kDegreesPerRadian)
          : std::string();
  const bool halves_confirm = errors.spread_before && *errors.spread_after < *errors.spread_before;
  const bool held_out = judgement.held_out_quantity != calib::HeldOutQuantity::none &&
                        judgement.held_out_after < judgement.held_out_before;
  if (report->outcome == calib::Outcome::no_better || worst_deg - half_deg < kLeastHeading_deg) {
    finding.sentence = fmt::format("Iron turns the heading of the field by {:.1f} +- {:.1f} deg at most. {}",
                                   worst_deg, half_deg, spreads);
    return finding;
  }
  if (errors.spread_before && !halves_confirm) {
    finding.certainty = Certainty::cannot_say;
    finding.sentence = "A calibration from one half of the log does not suit the other. " + spreads;
    finding.todo = "Look for a step of the field, or turn through all headings in both halves.";
    return finding;
  }
  finding.certainty = halves_confirm || held_out ? Certainty::found : Certainty::likely;
  finding.sentence = fmt::format("Iron of {} uT turns the heading of the field by up to {:.1f} +- {:.1f} deg. {}",
                                 vector_text(correction->offset_uT, 1), worst_deg, half_deg, spreads);
  finding.todo = "Calibrate the compass: navcal calibrate. " + offsets_for_autopilot(correction->offset_uT);
  put_heading_cost(finding, log, worst_deg);
  finding.picture = field_picture(log.whole.samples, *correction);
  return finding;
}

void append_steps(std::vector<Finding>& findings, const AuditedLog& log) {
  const auto& report = log.whole.report;
  if (report.find(Calibrator::magnetometer) == nullptr) return;
  if (report.steps.empty()) {
    Finding none = finding_of("compass.step", log.compass);
    none.sentence = "The field did not step.";
    findings.push_back(std::move(none));
  }
  const auto* const magnetometer = report.find(Calibrator::magnetometer);
  const calib::Quantity* const size = magnetometer->quantity("field_uT");
  for (const calib::FieldStep& step : report.steps) {
    Finding finding = finding_of("compass.step", log.compass);
    const double size_uT = step.size_uT.norm(), std_uT = step.std_uT.norm();
    const bool is_known = std::isfinite(std_uT);
    finding.certainty = is_known ? Certainty::found : Certainty::likely;
    if (is_known) put_value(finding, bounded(size_uT, std_uT), "uT");
    finding.sentence = "At this time " + calib::words_of(step) + ".";
    finding.todo =
        "Look for a magnet, a steel tool, a load or a current beside the compass at that time; calibrate each "
        "part "
        "of the log for itself.";
    const double across_uT = step.size_uT.head<2>().norm();
    if (is_known && !step.returned && size != nullptr && size->value > across_uT)
      put_heading_cost(finding, log, std::asin(across_uT / size->value) * kDegreesPerRadian);
    findings.push_back(std::move(finding));
  }
}

void append_motor(std::vector<Finding>& findings, const AuditedLog& log) {
  Finding finding = finding_of("compass.motor", log.compass);
  const auto* const report = log.whole.report.find(Calibrator::motor_current);
  const auto currents = log.all("current");
  if (report == nullptr || currents.empty()) {
    if (log.all("field_x").empty()) return;
    finding.certainty = Certainty::cannot_say;
    finding.sentence = "The log has no current of a motor beside field and rates.";
    finding.todo = log.all("supply_current").empty()
                       ? "Log the current of the motors."
                       : "Name the logged current as motor_current in a map (--map, docs/import.md).";
    findings.push_back(std::move(finding));
    return;
  }
  const auto& slope = log.whole.report.estimates.motor_current;
  if (!report->judgement.accepted || !slope) return findings.push_back(refused(finding, *report));
  const double most_A = quantile(currents.front()->series.values, 0.98);
  double square = 0, variance = 0;
  for (const calib::Quantity& quantity : report->estimate) {
    square += quantity.value * quantity.value;
    variance += quantity.value * quantity.value * quantity.std * quantity.std;
  }
  const double size = std::sqrt(square), std = size > 0 ? std::sqrt(variance) / size : 0;
  put_value(finding, bounded(size, std), "uT/A");
  const double heading_deg = motor_heading_rad(log, *slope, most_A) * kDegreesPerRadian;
  const std::string held_out =
      fmt::format("On readings that had no part in the fit it leaves {:.2f} uT of {:.2f}.",
                  report->judgement.held_out_after, report->judgement.held_out_before);
  finding.sentence = fmt::format("{} uT/A; at {:.1f} A it turns the heading by up to {:.1f} deg. {}",
                                 vector_text(slope->slope_uT_per_A, 3), most_A, heading_deg, held_out);
  const bool is_better = report->outcome == calib::Outcome::accepted &&
                         report->judgement.held_out_quantity == calib::HeldOutQuantity::motor_field &&
                         report->judgement.held_out_after < report->judgement.held_out_before;
  if (is_better && *finding.low > 0 && heading_deg >= kLeastHeading_deg) {
    finding.certainty = Certainty::found;
    put_heading_cost(finding, log, heading_deg);
    finding.todo =
        fmt::format("Move the compass or twist the motor's leads. ArduPilot: COMPASS_MOT_X, Y and Z = {}.",
                    vector_text(-kNanoteslaGauss * slope->slope_uT_per_A, 2));
  }
  findings.push_back(std::move(finding));
}

/// Headings that the devices and the autopilot state, against the field by the calibration of the other half.
void append_headings(std::vector<Finding>& findings, const AuditedLog& log) {
  for (const RecordedChannel* channel : log.all("heading")) {
    Finding finding = finding_of("compass.heading", channel->port);
    const auto errors = heading_errors(log, *channel);
    if (!errors) {
      finding.certainty = Certainty::cannot_say;
      finding.sentence =
          "The compass could not be calibrated in both halves of the log, so that nothing judges this heading.";
      finding.todo = "Turn through all headings twice.";
      findings.push_back(std::move(finding));
      continue;
    }
    std::vector<double> time_s, error_deg;
    for (const HeadingErrors::Point& point : errors->points) {
      time_s.push_back(point.time_s);
      error_deg.push_back(point.error_rad * kDegreesPerRadian);
    }
    const auto value = root_mean_square_bounded(time_s, error_deg);
    if (!value) continue;
    const double own_deg = 1.96 * errors->reference_std_rad * kDegreesPerRadian;
    put_value(finding, {value->value, std::max(value->low - own_deg, 0.0), value->high + own_deg}, "deg");
    finding.sentence = fmt::format(
        "This heading is {:.1f} deg (root mean square, {:.1f} to {:.1f}) off that of the field, calibrated on the "
        "other "
        "half of the log{}.",
        *finding.value, *finding.low, *finding.high,
        errors->is_absolute ? "" : "; a constant part is left out, because it could not be told");
    if (*finding.low > 2 * kLeastHeading_deg) {
      finding.certainty = channel->port == log.compass ? Certainty::found : Certainty::likely;
      finding.todo = channel->port == log.compass
                         ? "Calibrate the compass: navcal calibrate."
                         : "Calibrate the compass that the autopilot uses, then compare again.";
      put_heading_cost(finding, log, *finding.value);
      finding.picture = heading_picture("Heading of " + channel->port, *errors);
    }
    findings.push_back(std::move(finding));
  }
}

void append_pairs(std::vector<Finding>& findings, const AuditedLog& log) {
  const auto fields = log.all("field_x");
  for (std::size_t i = 0; i < fields.size(); ++i) {
    for (std::size_t j = i + 1; j < fields.size(); ++j) {
      const auto angles = angles_between(log, fields[i]->port, fields[j]->port);
      Finding finding = finding_of("compass.pair", fields[i]->port + ", " + fields[j]->port);
      const auto value = angles ? mean_bounded(block_means(angles->time_s, angles->values)) : std::nullopt;
      if (!value) {
        finding.certainty = Certainty::cannot_say;
        finding.sentence = "The two have too few readings at the same times.";
        findings.push_back(std::move(finding));
        continue;
      }
      constexpr double kPair_deg = 5;
      put_value(finding, {value->value, std::max(value->low, 0.0), value->high}, "deg");
      finding.sentence =
          fmt::format("The fields of the two point {:.1f} deg apart in the mean ({:.1f} to {:.1f}).", value->value,
                      *finding.low, value->high);
      if (*finding.low > kPair_deg) {
        finding.certainty = Certainty::found;
        finding.sentence +=
            " At least one has iron, or is mounted otherwise than stated; the log does not tell which.";
        finding.todo = "Check the mounting of both, then calibrate both.";
        put_heading_cost(finding, log, value->value / 2);
        finding.picture = AuditPicture{
            "Angle between the fields", "seconds from the beginning", "deg", "", {{"angle", {}, false}}};
        const std::size_t step = angles->values.size() / 2000 + 1;
        for (std::size_t k = 0; k < angles->values.size(); k += step)
          finding.picture->traces.front().points.emplace_back(angles->time_s[k], angles->values[k]);
      }
      findings.push_back(std::move(finding));
    }
  }
}

}  // namespace

std::vector<Finding> compass_findings(const AuditedLog& log) {
  std::vector<Finding> findings;
  if (!log.compass.empty() && !log.is_partial) {
    findings.push_back(iron_finding(log));
    append_steps(findings, log);
    append_motor(findings, log);
    append_headings(findings, log);
  }
  append_pairs(findings, log);
  return findings;
}

}  // namespace navcal::analysis
