// SPDX-License-Identifier: Apache-2.0
#include "report/calibrate_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/angles.h"
#include "report/shown_number.h"

namespace navcal::report {
namespace {

/// How a quantity is shown: ending of its name, factor, unit, and the error above which it counts as unknown.
struct Unit {
  std::string_view ending;
  double factor;
  std::string_view text;
  double unknown;
};
constexpr double kScaleUnknown = 1;
constexpr std::array kUnits{Unit{"_rad_s", base::kDegreesPerRadian, "deg/s", 100},
                            Unit{"_rad", base::kDegreesPerRadian, "deg", 180},
                            Unit{"_uT", 1, "uT", 1000},
                            Unit{"_uT_per_A", 1, "uT/A", 1000},
                            Unit{"_m_s", 1, "m/s", 100},
                            Unit{"delay_s", 1000, "ms", 10000},
                            Unit{"_s", 1, "s", 100}};

/// Short name: "bias_rad_s" becomes "bias"; "delay_s" keeps its noun.
std::string name_without(std::string_view name, std::string_view ending) {
  name.remove_suffix(ending.starts_with('_') ? ending.size() : 2);
  return std::string(name);
}

/// Text instead of a number if nothing is known, because a number would mislead; empty otherwise.
std::string_view instead_of_value(const calib::Quantity& quantity, double error, double unknown) {
  if (std::isnan(quantity.value)) return "not determined";
  if (std::isfinite(error)) return error > unknown ? "not determined" : "";
  // An ellipse in the horizontal plane does not determine the vertical.
  return quantity.name.starts_with("offset_") ? "not determined" : "";
}

/// Some reasons exclude only a part of the words of a compass.
std::string reason_in_words(calib::Rejection rejection) {
  if (rejection == calib::Rejection::tilt_out_of_range) return "heading and tilt by E002";
  if (rejection == calib::Rejection::field_out_of_range) return "heading and field by E004";
  if (rejection == calib::Rejection::field_too_large) return "field over 500 uT";
  std::string reason(calib::name_of(rejection));
  std::replace(reason.begin(), reason.end(), '_', ' ');
  return reason;
}

}  // namespace

std::string_view title_of(calib::Calibrator calibrator) { return calib::row_of(calibrator).title; }

std::vector<ShownQuantity> shown(const calib::CalibratorReport& report) {
  std::vector<ShownQuantity> all;
  for (const calib::Quantity& quantity : report.estimate) {
    if (quantity.name.starts_with("matrix_"))
      continue;  // the matrix is for programs: users need the heading's error
    const auto unit =
        std::ranges::find_if(kUnits, [&](const Unit& u) { return quantity.name.ends_with(u.ending); });
    const bool found = unit != kUnits.end();
    const double factor = found ? unit->factor : 1;
    const double value = quantity.value * factor, error = quantity.std * factor;
    const int decimals = decimals_for(value, error);
    ShownQuantity one;
    one.name = found ? name_without(quantity.name, unit->ending) : std::string(quantity.name);
    std::replace(one.name.begin(), one.name.end(), '_', ' ');
    one.unit = found ? unit->text : "";
    if (const auto word = instead_of_value(quantity, error, found ? unit->unknown : kScaleUnknown);
        !word.empty()) {
      one.value = word;
      one.unit.clear();
      all.push_back(std::move(one));
      continue;
    }
    // A quantity with an error and no value: the worst corrected heading.
    if (quantity.name != "worst_heading_rad") one.value = fmt::format("{:.{}f}", value, decimals);
    if (std::isfinite(error)) one.error = fmt::format("{:.{}f}", error, decimals);
    if (std::isfinite(quantity.next_std)) one.next = fmt::format("{:.{}f}", quantity.next_std * factor, decimals);
    all.push_back(std::move(one));
  }
  return all;
}

std::string text_of(const ShownQuantity& quantity, std::string_view plus_minus) {
  std::string text = quantity.name;
  if (!quantity.value.empty()) text += " " + quantity.value;
  if (!quantity.error.empty()) text.append(" ").append(plus_minus).append(" ").append(quantity.error);
  if (!quantity.unit.empty()) text += " " + quantity.unit;
  if (!quantity.next.empty()) text += fmt::format(" (next use {} {})", plus_minus, quantity.next);
  return text;
}

std::string_view verdict_of(const calib::CalibratorReport& report) { return calib::name_of(report.outcome); }

std::string held_out_of(const calib::CalibratorReport& report, std::string_view arrow) {
  const double before = report.judgement.held_out_before, after = report.judgement.held_out_after;
  switch (report.judgement.held_out_quantity) {
    case calib::HeldOutQuantity::heading:
      return fmt::format("{:.2f} {} {:.2f} deg of heading", before * base::kDegreesPerRadian, arrow,
                         after * base::kDegreesPerRadian);
    case calib::HeldOutQuantity::field:
      return fmt::format("{:.2f} {} {:.2f} % of the field's size", before * 100, arrow, after * 100);
    case calib::HeldOutQuantity::motor_field: return fmt::format("{:.3f} {} {:.3f} uT", before, arrow, after);
    case calib::HeldOutQuantity::none: break;
  }
  return {};
}

std::string sentence_of(const calib::HeadingCheck& heading) {
  if (heading.blocks == 0) {
    return "The heading could not be judged: that needs a calibrated gyro (inertial card), and turns after that.";
  }
  return fmt::format(
      "Heading against the calibrated gyro, on held-out readings: {:.2f} deg as measured, {:.2f} deg calibrated "
      "(root-mean-square over {} blocks of turns).",
      heading.before_rad * base::kDegreesPerRadian, heading.after_rad * base::kDegreesPerRadian, heading.blocks);
}

std::string next_use_of(const calib::Report& report) {
  if (report.parts == 0) return {};
  const auto is_known = [](const calib::Quantity& quantity) { return std::isfinite(quantity.next_std); };
  const bool any = std::ranges::any_of(report.calibrators, [&](const calib::CalibratorReport& calibrator) {
    return std::ranges::any_of(calibrator.estimate, is_known);
  });
  const std::string parts =
      fmt::format("{} {}", report.parts, report.parts_are_files ? "files" : "quarters of the recording");
  if (any) return fmt::format("Next use: by what {}, each calibrated alone, find beside each other.", parts);
  return fmt::format(
      "Errors are those within the recording. Of the next use nothing is known: of {}, fewer than two give an "
      "accepted estimate alone. A second recording tells.",
      parts);
}

std::vector<std::string> field_history_of(const calib::Report& report) {
  std::vector<std::string> lines;
  if (report.moves > 0)
    lines.push_back(fmt::format("another place {}, with the field of that place: no step",
                                report.moves == 1 ? "once" : fmt::format("{} times", report.moves)));
  if (report.steps.empty()) return lines;
  const auto percent = [](const std::optional<double>& spread) {
    return spread ? fmt::format("{:.2f} %", 100 * *spread) : std::string("unknown");
  };
  for (std::size_t i = 0; i < report.segments.size(); ++i) {
    const calib::FieldSegment& segment = report.segments[i];
    if (i > 0 && i - 1 < report.steps.size()) lines.push_back(words_of(report.steps[i - 1]));
    lines.push_back(fmt::format("{} to {}: {} readings, spread of the field's size {} as measured, {} calibrated",
                                calib::utc_text(segment.begin_utc_ns), calib::utc_text(segment.end_utc_ns),
                                segment.readings, percent(segment.spread_raw()),
                                percent(segment.spread_calibrated)));
  }
  return lines;
}

std::string distortion_of(const calib::GateCounts& gate) {
  if (gate.distorted == 0) return {};
  return fmt::format("{} {} with E001: the compass reports magnetic distortion", gate.distorted,
                     gate.distorted == 1 ? "word" : "words");
}

std::string left_out_of(const calib::GateCounts& gate, calib::Stream stream) {
  std::string text;
  const auto& counts = gate.left_out.at(static_cast<std::size_t>(stream));
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    std::string reason = reason_in_words(static_cast<calib::Rejection>(i));
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[i], reason);
  }
  return text;
}

calib::Correction accepted_estimates(const calib::Report& report) {
  calib::Correction accepted;
  for (const auto& calibrator : report.calibrators) {
    if (calibrator.judgement.accepted) copy_value(accepted, report.estimates, calibrator.calibrator);
  }
  return accepted;
}

}  // namespace navcal::report
