// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "base/angles.h"
#include "calib/coverage.h"
#include "pipeline/calibration_options.h"
#include "report/calibrate_figures.h"
#include "report/calibrate_report.h"
#include "report/calibrate_words.h"
#include "report/html_page.h"
#include "report/shown_number.h"

namespace navcal::report {
namespace {

std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

std::string title_for(const PageSource& source) {
  std::string title = "Calibration from " + file_name(source.files.front());
  if (source.files.size() > 1) title += fmt::format(" and {} more", source.files.size() - 1);
  return title;
}

std::string joined(const std::vector<ShownQuantity>& quantities) {
  std::string text;
  for (const auto& quantity : quantities) {
    if (!text.empty()) text += ", ";
    text += text_of(quantity, kPlusMinus);
  }
  return text;
}

void append_verdicts(HtmlPage& page, const calib::Report& report) {
  page.fact("plain", "heading", sentence_of(report.heading));
  if (report.calibrators.empty()) {
    page.fact("bad", "refused", "Nothing can be calibrated: the recording has no compass.");
  }
  for (const auto& calibrator : report.calibrators) {
    const bool accepted = calibrator.judgement.accepted;
    std::string sentence(title_of(calibrator.calibrator));
    const bool no_better = calibrator.outcome == calib::Outcome::no_better;
    sentence += ": " + (accepted ? joined(shown(calibrator)) : objection_of(calibrator)) + ".";
    if (const auto held_out = held_out_of(calibrator, kArrow); accepted && !held_out.empty())
      sentence += " On held-out readings " + held_out + ".";
    if (accepted && !no_better && calibrator.verdict == calib::Verdict::in_force)
      sentence += " On the vehicle it would have become active by itself.";
    page.fact(no_better ? "plain" : accepted ? "good" : "bad", verdict_of(calibrator), sentence);
  }
}

void append_heading(HtmlPage& page, const calib::Report& report, const analysis::CalibrateHistory& history) {
  calib::Correction estimates = accepted_estimates(report);
  // The curve is shown before it is accepted, too, if it is good enough; the gyro must be accepted.
  if (!estimates.compass) estimates.compass = report.estimates.compass;
  const auto residuals = analysis::heading_residuals(history.samples(), estimates);
  std::vector<Figure> figures;
  if (auto figure = deviation_figure(report, residuals)) figures.push_back(std::move(*figure));
  if (auto figure = residual_figure(report, residuals)) figures.push_back(std::move(*figure));
  const bool any_heading = calib::visited(report.rose) > 0;
  if (any_heading) figures.push_back(rose_figure(report));
  page.section("Heading");
  if (residuals.empty()) {
    page.paragraph("The heading has no reference: that needs a calibrated gyro, and turns.");
  }
  if (!any_heading) page.paragraph("No headings in the recording.");
  if (!figures.empty()) page.figures(figures);
  if (const auto card = deviation_card(report); !card.empty())
    page.table({"Compass shows, deg", "Deviation", "Two standard errors", "Magnetic, but for A"}, card);
}

void append_estimates(HtmlPage& page, const calib::Report& report) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& calibrator : report.calibrators) {
    std::string title(title_of(calibrator.calibrator));
    const auto& judgement = calibrator.judgement;
    const std::string condition =
        std::isfinite(judgement.condition) ? fmt::format("{:.3g}", judgement.condition) : "singular";
    std::vector<std::string> facts{std::string(verdict_of(calibrator)),
                                   fmt::format("{:.0f} %", judgement.coverage * 100), condition,
                                   std::to_string(judgement.samples)};
    auto quantities = shown(calibrator);
    if (quantities.empty()) quantities.push_back({"no estimate", "", "", ""});
    for (const auto& quantity : quantities) {
      std::vector<std::string> row{title,          quantity.name, quantity.value,
                                   quantity.error, quantity.next, quantity.unit};
      row.insert(row.end(), facts.begin(), facts.end());
      rows.push_back(std::move(row));
      // A cell that is the same in all rows is written in the first row only.
      title.clear();
      for (auto& fact : facts) fact.clear();
    }
  }
  page.section("Estimates");
  page.table({"Calibrator", "Quantity", "Estimate", "Standard error", "At the next use", "Unit", "Verdict",
              "Coverage", "Condition", "Readings"},
             rows);
  if (const std::string next = next_use_of(report); !next.empty()) page.paragraph(next);
}

void append_field_history(HtmlPage& page, const calib::Report& report) {
  const auto lines = field_history_of(report);
  if (lines.empty()) return;
  if (!report.steps.empty())
    page.paragraph(
        "The field of the compass stepped during the recording. The calibration is that of the last segment; the "
        "spread of each segment is about its own hard iron, with common soft iron.");
  for (const std::string& line : lines) page.paragraph(line + ".");
}

void append_left_out(HtmlPage& page, const calib::Report& report, const PageSource& source) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < calib::kStreams; ++i) {
    if (report.gate.taken[i] == 0) continue;
    const auto stream = static_cast<calib::Stream>(i);
    const std::string left_out = left_out_of(report.gate, stream);
    rows.push_back({std::string(calib::name_of(stream)), std::to_string(report.gate.taken[i]),
                    left_out.empty() ? "nothing" : left_out, std::to_string(report.gate.gaps[i])});
  }
  page.section("Readings left out");
  if (rows.empty()) {
    page.paragraph(report.calibrators.empty() ? "Without a compass no readings were examined."
                                              : "No readings came.");
  } else {
    page.table({"Instrument", "Readings", "Left out, by reason", "Gaps"}, rows);
  }
  if (const std::string distortion = distortion_of(report.gate); !distortion.empty())
    page.paragraph(distortion + ". No readings are left out for it.");
  for (const auto& remark : source.remarks) page.paragraph(remark);
}

void append_source(HtmlPage& page, const PageSource& source) {
  const auto& calibration = source.settings.calibration;
  const auto& environment = source.settings.environment;
  const pipeline::ReckonedNoise noise = pipeline::reckoned_noise(source.settings);
  std::vector<std::vector<std::string>> rows;
  for (const auto& file : source.files) rows.push_back({"File", file});
  rows.push_back({"Duration", duration_text(source.duration_s)});
  rows.push_back({"Configuration", source.config.empty() ? "the recording's own" : source.config});
  rows.push_back(
      {"Assumed noise",
       fmt::format("heading {:.2g} deg, gyro {:.2g} deg/s, field {:.2g} uT, gyro bias {:.2g} deg/s in a second",
                   noise.heading_rad * base::kDegreesPerRadian,
                   source.settings.instruments.imu.gyro_noise_rad_s * base::kDegreesPerRadian, noise.field_uT,
                   calibration.bias_walk_rad_s * base::kDegreesPerRadian)});
  rows.push_back({"Local field", environment.field_uT > 0
                                     ? fmt::format("{:.4g} uT, dip {:.4g} deg", environment.field_uT,
                                                   environment.dip_rad * base::kDegreesPerRadian)
                                     : std::string("not configured")});
  rows.push_back(
      {"Declination", fmt::format("{:.2f} deg", environment.declination_rad * base::kDegreesPerRadian)});
  rows.push_back({"Program", "navcal " NAVCAL_VERSION});
  page.section("Made from");
  page.table({"", ""}, rows);
}

}  // namespace

std::string calibrate_page(const calib::Report& report, const analysis::CalibrateHistory& history,
                           const PageSource& source) {
  HtmlPage page(title_for(source));
  append_verdicts(page, report);
  if (!report.calibrators.empty()) {
    append_heading(page, report, history);
    const auto field = field_figures(report, history.samples());
    if (!field.empty()) {
      page.section("Magnetometer");
      append_field_history(page, report);
      page.figures(field);
    }
    if (const auto figures = convergence_figures(history.estimates()); !figures.empty()) {
      page.section("Convergence of the estimates");
      page.figures(figures);
    }
    append_estimates(page, report);
  }
  append_left_out(page, report, source);
  append_source(page, source);
  return std::move(page).finish();
}

}  // namespace navcal::report
