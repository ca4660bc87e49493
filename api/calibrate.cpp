// SPDX-License-Identifier: Apache-2.0
#include <navcal/calibrate.h>

#include <algorithm>
#include <cstddef>

#include "analysis/next_use.h"
#include "api/guard.h"
#include "config/load.h"
#include "record/json/calibration_json.h"

namespace navcal::api {
namespace {

std::optional<HeldOut> held_out_of(const calib::Judgement& judgement) {
  HeldOut held_out{{}, judgement.held_out_before, judgement.held_out_after};
  switch (judgement.held_out_quantity) {
    case calib::HeldOutQuantity::none: return std::nullopt;
    case calib::HeldOutQuantity::heading: held_out.unit = "rad"; break;
    case calib::HeldOutQuantity::field: held_out.unit = "1"; break;
    case calib::HeldOutQuantity::motor_field: held_out.unit = "uT"; break;
  }
  return held_out;
}

CalibratorResult result_of(const calib::CalibratorReport& report) {
  CalibratorResult result;
  result.name = calib::name_of(report.calibrator);
  result.verdict = calib::name_of(report.verdict);
  result.judgement = calib::name_of(report.outcome);
  result.accepted = report.judgement.accepted;
  result.reason = report.judgement.reason;
  result.manoeuvre = report.judgement.manoeuvre;
  result.coverage = report.judgement.coverage;
  result.condition = report.judgement.condition;
  result.samples = report.judgement.samples;
  for (const auto& quantity : report.estimate) {
    result.estimate.push_back({std::string(quantity.name), quantity.value, quantity.std});
  }
  result.held_out = held_out_of(report.judgement);
  return result;
}

FieldCorrection correction_of(const calib::FieldCorrection& field) {
  FieldCorrection correction;
  for (std::size_t row = 0; row < 3; ++row) {
    const auto i = static_cast<Eigen::Index>(row);
    correction.offset_uT[row] = field.offset_uT[i];
    for (std::size_t column = 0; column < 3; ++column) {
      correction.matrix[row][column] = field.matrix(i, static_cast<Eigen::Index>(column));
    }
  }
  return correction;
}

Calibration calibration_of(const calib::Report& report, const analysis::CalibrateRun& run) {
  Calibration answer;
  for (const auto& calibrator : report.calibrators) answer.calibrators.push_back(result_of(calibrator));
  if (report.estimates.magnetometer) answer.magnetometer = correction_of(*report.estimates.magnetometer);
  answer.heading = {report.heading.blocks, report.heading.before_rad, report.heading.after_rad};
  answer.duration_s = run.duration_s();
  answer.remarks = run.remarks();
  record::append_calibrate_json(answer.json, report);
  return answer;
}

}  // namespace

const Quantity* CalibratorResult::quantity(std::string_view quantity_name) const noexcept {
  const auto found = std::ranges::find(estimate, quantity_name, &Quantity::name);
  return found == estimate.end() ? nullptr : &*found;
}

const CalibratorResult* Calibration::find(std::string_view name) const noexcept {
  const auto found = std::ranges::find(calibrators, name, &CalibratorResult::name);
  return found == calibrators.end() ? nullptr : &*found;
}

Calibration calibrate(const std::vector<std::filesystem::path>& files, const CalibrateOptions& options) {
  return guarded_with_progress(options.progress, [&](ProgressRelay& relay) {
    if (files.empty()) throw Error(ErrorKind::bad_argument, "files: at least one recording is needed");
    const auto settings =
        options.config.empty() ? record::Recording::open(files.front())->settings() : config::load(options.config);
    analysis::CalibrateRun run(settings, nullptr);
    for (const auto& file : files) {
      const std::string name = file.string();
      run.play(name, [&](double share) { relay(name, share); });
    }
    calib::Report report = run.finish();
    analysis::add_next_use(report, run, {}, [&](double share) { relay("each part alone", share); });
    return calibration_of(report, run);
  });
}

}  // namespace navcal::api
