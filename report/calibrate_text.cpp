// SPDX-License-Identifier: Apache-2.0
#include <string_view>
#include <vector>

#include "base/append_format.h"
#include "calib/coverage.h"
#include "report/calibrate_report.h"
#include "report/calibrate_words.h"
#include "report/shown_number.h"
#include "report/svg_rose.h"
#include "report/wrapped_text.h"

namespace navcal::report {
namespace {

constexpr std::size_t kTitle = 21, kVerdict = 10;

void append_calibrator(std::string& out, const calib::CalibratorReport& report) {
  std::vector<std::string> pieces;
  for (const ShownQuantity& quantity : shown(report)) pieces.push_back(text_of(quantity, "+-"));
  base::append_format(out, "{:<{}}{:<{}}", title_of(report.calibrator), kTitle, verdict_of(report), kVerdict);
  const bool estimated = !pieces.empty();
  if (estimated) append_wrapped(out, kTitle + kVerdict, pieces, ",  ");
  const auto append_line = [&](const std::string& text) {
    if (text.empty()) return;
    if (estimated) out.append(kTitle + kVerdict, ' ');
    append_wrapped(out, kTitle + kVerdict, words_of(text), " ");
  };
  const std::string objection = objection_of(report), held_out = held_out_of(report, "->");
  append_line(objection);
  const bool adopted = report.verdict == calib::Verdict::in_force && report.outcome != calib::Outcome::no_better;
  if (!held_out.empty()) {
    append_line("on readings held out " + held_out + (adopted ? "; a vehicle would use it by itself" : ""));
  }
  if (!estimated && objection.empty() && held_out.empty()) out += '\n';
}

void append_field_history(std::string& out, const calib::Report& report) {
  std::string_view title = "steps of the field";
  for (const std::string& line : field_history_of(report)) {
    base::append_format(out, "{:<{}}{}\n", title, kTitle, line);
    title = "";
  }
}

void append_rose(std::string& out, const calib::HeadingHistogram& rose) {
  if (calib::visited(rose) == 0) return;
  base::append_format(out, "{1:<{2}}N{0:8}E{0:8}S{0:8}W{0:8}N\n", "", "headings seen", kTitle);
  base::append_format(out, "{:<{}}{}   ({} of {} sectors; . never, : seldom)\n", "", kTitle, text_rose(rose),
                      calib::visited(rose), rose.size());
}

void append_readings(std::string& out, const calib::GateCounts& gate, double duration_s) {
  base::append_format(out, "{:<{}}{}", "readings", kTitle, duration_text(duration_s));
  for (std::size_t i = 0; i < calib::kStreams; ++i) {
    if (gate.taken[i] == 0) continue;
    const auto stream = static_cast<calib::Stream>(i);
    const std::string left_out = left_out_of(gate, stream);
    base::append_format(out, ", {} {}{}", gate.taken[i], calib::name_of(stream),
                        left_out.empty() ? "" : " (left out: " + left_out + ")");
  }
  out += '\n';
  if (const std::string distortion = distortion_of(gate); !distortion.empty())
    base::append_format(out, "{:<{}}{}\n", "", kTitle, distortion);
}

}  // namespace

std::string calibrate_text(const calib::Report& report, double duration_s) {
  std::string out;
  append_readings(out, report.gate, duration_s);
  if (report.calibrators.empty()) {
    return out + "Nothing can be calibrated: the recording has no compass (a port of protocol tcm2 or nmea).\n";
  }
  for (const auto& calibrator : report.calibrators) append_calibrator(out, calibrator);
  append_field_history(out, report);
  append_rose(out, report.rose);
  out += sentence_of(report.heading) + "\n";
  if (const std::string next = next_use_of(report); !next.empty()) out += next + "\n";
  const auto lacks = [&](calib::Calibrator calibrator) { return report.find(calibrator) == nullptr; };
  if (lacks(calib::Calibrator::gyro))
    out += "No gyro in the recording (a port of protocol imu-card): no calibrations that need it.\n";
  if (lacks(calib::Calibrator::misalignment))
    out += "No GPS in the recording: A, which no turn reveals, stays unknown.\n";
  return out;
}

}  // namespace navcal::report
