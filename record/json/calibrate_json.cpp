// SPDX-License-Identifier: Apache-2.0
// The answer of `navcal calibrate`.

#include "base/angles.h"
#include "record/json/calibration_json.h"
#include "record/json/correction_json.h"

namespace navcal::record {
namespace {

using Json = nlohmann::ordered_json;
using calib::Calibrator;

constexpr std::array<const char*, 5> kCoefficients{"A", "B", "C", "D", "E"};

Json value_of(const calib::CalibratorReport* report, std::string_view name, double calib::Quantity::*which,
              double unit = 1) {
  const calib::Quantity* quantity = report == nullptr ? nullptr : report->quantity(name);
  return quantity == nullptr ? Json(nullptr) : number_json(quantity->*which * unit);
}

std::string reason_of(const calib::CalibratorReport* report, Calibrator calibrator) {
  if (report != nullptr) return objection_of(*report);
  return "the recording lacks an instrument: it takes " + std::string(calib::row_of(calibrator).needs_text);
}

Json held_out_json(const calib::CalibratorReport* report) {
  const auto quantity = report == nullptr ? calib::HeldOutQuantity::none : report->judgement.held_out_quantity;
  if (quantity == calib::HeldOutQuantity::none) return nullptr;
  const bool heading = quantity == calib::HeldOutQuantity::heading;
  const bool field = quantity == calib::HeldOutQuantity::field;
  const double unit = heading ? base::kDegreesPerRadian : field ? 100 : 1;
  Json json;
  json["before"] = number_json(report->judgement.held_out_before * unit);
  json["after"] = number_json(report->judgement.held_out_after * unit);
  json["unit"] = heading ? "deg" : field ? "%" : "uT";
  return json;
}

void append_judgement(Json& json, const calib::CalibratorReport* report, Calibrator calibrator) {
  json["accepted"] = report != nullptr && report->judgement.accepted;
  json["verdict"] = calib::name_of(report == nullptr ? calib::Verdict::refused : report->verdict);
  json["judgement"] = calib::name_of(report == nullptr ? calib::Outcome::refused : report->outcome);
  json["reason"] = reason_of(report, calibrator);
  json["held_out"] = held_out_json(report);
  json["condition"] = report == nullptr ? Json(nullptr) : number_json(report->judgement.condition);
}

Json gyro_json(const calib::Report& whole, Calibrator calibrator) {
  const calib::CalibratorReport* const report = whole.find(calibrator);
  Json json;
  json["scale"] = value_of(report, "scale", &calib::Quantity::value);
  json["scale_std"] = value_of(report, "scale", &calib::Quantity::std);
  json["bias_rad_s"] = value_of(report, "bias_rad_s", &calib::Quantity::value);
  json["bias_std"] = value_of(report, "bias_rad_s", &calib::Quantity::std);
  json["samples"] = report == nullptr ? 0 : report->judgement.samples;
  append_judgement(json, report, calibrator);
  return json;
}

/// A..E in degrees; A, which no turn tells, from calibrator `a`.
Json deviation_answer(const calib::Report& whole, Calibrator calibrator, Calibrator a) {
  const calib::CalibratorReport* const report = whole.find(calibrator);
  Json value, std;
  for (const std::string name : kCoefficients) {
    const auto* source = name == "A" ? whole.find(a) : report;
    value[name] = value_of(source, name + "_rad", &calib::Quantity::value, base::kDegreesPerRadian);
    std[name] = value_of(source, name + "_rad", &calib::Quantity::std, base::kDegreesPerRadian);
  }
  Json json;
  json["deviation_deg"] = std::move(value);
  json["deviation_std_deg"] = std::move(std);
  json["samples"] = report == nullptr ? 0 : report->judgement.samples;
  append_judgement(json, report, calibrator);
  return json;
}

Json magnetometer_json(const calib::Report& report) {
  const auto* magnetometer = report.find(Calibrator::magnetometer);
  const auto& field = report.estimates.magnetometer;
  Json json;
  json["offset_uT"] = field ? vector_json(field->offset_uT) : Json(nullptr);
  json["matrix"] = field ? matrix_json(field->matrix) : Json(nullptr);
  const auto std = [&](const std::string& name) { return value_of(magnetometer, name, &calib::Quantity::std); };
  json["std"]["offset_uT"] = {std("offset_x_uT"), std("offset_y_uT"), std("offset_z_uT")};
  json["std"]["matrix"] = {{std("matrix_xx"), std("matrix_xy"), std("matrix_xz")},
                           {std("matrix_xy"), std("matrix_yy"), std("matrix_yz")},
                           {std("matrix_xz"), std("matrix_yz"), std("matrix_zz")}};
  json["std"]["worst_heading_deg"] =
      value_of(magnetometer, "worst_heading_rad", &calib::Quantity::std, base::kDegreesPerRadian);
  json["field_scale"] = value_of(magnetometer, "field_scale", &calib::Quantity::value);
  json["std"]["field_scale"] = std("field_scale");
  json["field_uT"] = value_of(magnetometer, "field_uT", &calib::Quantity::value);
  json["residual_uT"] = value_of(magnetometer, "residual_uT", &calib::Quantity::value);
  json["coverage"] = magnetometer == nullptr ? Json(0.0) : number_json(magnetometer->judgement.coverage);
  json["samples"] = magnetometer == nullptr ? 0 : magnetometer->judgement.samples;
  append_judgement(json, magnetometer, Calibrator::magnetometer);
  return json;
}

Json motor_json(const calib::CalibratorReport* report) {
  Json slope, std;
  for (const std::string_view name : {"x_uT_per_A", "y_uT_per_A", "z_uT_per_A"}) {
    if (report == nullptr || report->quantity(name) == nullptr) continue;
    slope.push_back(value_of(report, name, &calib::Quantity::value));
    std.push_back(value_of(report, name, &calib::Quantity::std));
  }
  Json json;
  json["slope_uT_per_A"] = std::move(slope);
  json["std"] = std::move(std);
  append_judgement(json, report, Calibrator::motor_current);
  return json;
}

Json beside(const calib::Report& report, Calibrator calibrator) {
  const auto* found = report.find(calibrator);
  Json json;
  json["estimate"] = found == nullptr ? Json::object() : values_json(found->estimate, &calib::Quantity::value);
  json["std"] = found == nullptr ? Json::object() : values_json(found->estimate, &calib::Quantity::std);
  append_judgement(json, found, calibrator);
  return json;
}

Json heading_json(const calib::HeadingCheck& heading) {
  Json json;
  json["before_rms_deg"] =
      heading.blocks > 0 ? number_json(heading.before_rad * base::kDegreesPerRadian) : Json(nullptr);
  json["after_rms_deg"] =
      heading.blocks > 0 ? number_json(heading.after_rad * base::kDegreesPerRadian) : Json(nullptr);
  json["held_out"] = true;
  json["blocks"] = heading.blocks;
  return json;
}

}  // namespace

void append_calibrate_json(std::string& out, const calib::Report& report) {
  Json json;
  json["gyro"] = gyro_json(report, Calibrator::gyro);
  json["gyro_b"] = gyro_json(report, Calibrator::gyro_b);
  json["compass"] = deviation_answer(report, Calibrator::compass, Calibrator::misalignment);
  json["magnetometer"] = magnetometer_json(report);
  json["heading"] = heading_json(report.heading);
  json["gps_compass"] = deviation_answer(report, Calibrator::gps_compass, Calibrator::gps_compass);
  for (const Calibrator calibrator :
       {Calibrator::misalignment, Calibrator::swing, Calibrator::compass_delay, Calibrator::course_delay}) {
    json[std::string(calib::name_of(calibrator))] = beside(report, calibrator);
  }
  if (report.parts > 0) {
    Json& next = json["next_use"];
    next["parts"] = report.parts;
    next["between"] = report.parts_are_files ? "files" : "quarters";
    for (const auto& one : report.calibrators)
      next["std"][std::string(calib::name_of(one.calibrator))] =
          values_json(one.estimate, &calib::Quantity::next_std);
  }
  json["steps"] = steps_json(report.steps);
  json["changes_of_place"] = report.moves;
  json["segments"] = segments_json(report.segments);
  json["motor_current"] = motor_json(report.find(Calibrator::motor_current));
  json["rose"] = report.rose;
  json["left_out"] = gate_json(report.gate);
  for (const Calibrator calibrator : calib::calibrators().subspan(calib::kNamedCalibrators)) {
    json[std::string(calib::name_of(calibrator))] = beside(report, calibrator);
  }
  out += json.dump();
}

}  // namespace navcal::record
