// The answer of `navcal calibrate`.
#include <numbers>

#include "record/calibration_json.h"
#include "record/correction_json.h"

namespace navcal::record {
namespace {

using Json = nlohmann::ordered_json;
using calib::Calibrator;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr std::array<const char*, 5> kCoefficients{"A", "B", "C", "D", "E"};

Json value_of(const calib::CalibratorReport* report, std::string_view name, double calib::Quantity::*which,
              double unit = 1) {
  const calib::Quantity* quantity = report == nullptr ? nullptr : report->quantity(name);
  return quantity == nullptr ? Json(nullptr) : number_json(quantity->*which * unit);
}

/// What stands against it and what would help, in one sentence for people.
std::string reason_of(const calib::CalibratorReport* report) {
  if (report == nullptr) return "the recording has no such instrument";
  const auto& judgement = report->judgement;
  if (judgement.accepted || judgement.manoeuvre.empty()) return judgement.reason;
  return judgement.reason + "; " + judgement.manoeuvre;
}

void append_judgement(Json& json, const calib::CalibratorReport* report) {
  json["accepted"] = report != nullptr && report->judgement.accepted;
  json["reason"] = reason_of(report);
  json["condition"] = report == nullptr ? Json(nullptr) : number_json(report->judgement.condition);
}

Json gyro_json(const calib::CalibratorReport* report) {
  Json json;
  json["scale"] = value_of(report, "scale", &calib::Quantity::value);
  json["scale_std"] = value_of(report, "scale", &calib::Quantity::std);
  json["bias_rad_s"] = value_of(report, "bias_rad_s", &calib::Quantity::value);
  json["bias_std"] = value_of(report, "bias_rad_s", &calib::Quantity::std);
  json["samples"] = report == nullptr ? 0 : report->judgement.samples;
  append_judgement(json, report);
  return json;
}

/// A..E in degrees; A, which no turn tells, from `a`.
Json deviation_answer(const calib::CalibratorReport* report, const calib::CalibratorReport* a) {
  Json value, std;
  for (const std::string name : kCoefficients) {
    const auto* source = name == "A" ? a : report;
    value[name] = value_of(source, name + "_rad", &calib::Quantity::value, kDegrees);
    std[name] = value_of(source, name + "_rad", &calib::Quantity::std, kDegrees);
  }
  Json json;
  json["deviation_deg"] = std::move(value);
  json["deviation_std_deg"] = std::move(std);
  json["samples"] = report == nullptr ? 0 : report->judgement.samples;
  append_judgement(json, report);
  return json;
}

Json magnetometer_json(const calib::Report& report) {
  const auto* magnetometer = report.find(Calibrator::magnetometer);
  const auto& field = report.estimates.magnetometer;
  Json json;
  json["offset_uT"] = field ? vector_json(field->offset_uT) : Json(nullptr);
  json["matrix"] = field ? matrix_json(field->matrix) : Json(nullptr);
  json["residual_uT"] = value_of(magnetometer, "residual_uT", &calib::Quantity::value);
  json["coverage"] = magnetometer == nullptr ? Json(0.0) : number_json(magnetometer->judgement.coverage);
  json["samples"] = magnetometer == nullptr ? 0 : magnetometer->judgement.samples;
  append_judgement(json, magnetometer);
  return json;
}

Json beside(const calib::Report& report, Calibrator calibrator) {
  const auto* found = report.find(calibrator);
  Json json;
  json["estimate"] = found == nullptr ? Json::object() : values_json(found->estimate, &calib::Quantity::value);
  json["std"] = found == nullptr ? Json::object() : values_json(found->estimate, &calib::Quantity::std);
  append_judgement(json, found);
  return json;
}

Json heading_json(const calib::HeadingCheck& heading) {
  Json json;
  json["before_rms_deg"] = heading.blocks > 0 ? number_json(heading.before_rad * kDegrees) : Json(nullptr);
  json["after_rms_deg"] = heading.blocks > 0 ? number_json(heading.after_rad * kDegrees) : Json(nullptr);
  json["held_out"] = true;
  json["blocks"] = heading.blocks;
  return json;
}

}  // namespace

void append_calibrate_json(std::string& out, const calib::Report& report) {
  Json json;
  json["gyro"] = gyro_json(report.find(Calibrator::gyro));
  json["gyro_b"] = gyro_json(report.find(Calibrator::gyro_b));
  const auto* misalignment = report.find(Calibrator::misalignment);
  json["compass"] = deviation_answer(report.find(Calibrator::compass), misalignment);
  json["magnetometer"] = magnetometer_json(report);
  json["heading"] = heading_json(report.heading);
  const auto* gps_compass = report.find(Calibrator::gps_compass);
  json["gps_compass"] = deviation_answer(gps_compass, gps_compass);
  for (const Calibrator calibrator :
       {Calibrator::misalignment, Calibrator::swing, Calibrator::compass_delay, Calibrator::course_delay}) {
    json[std::string(calib::name_of(calibrator))] = beside(report, calibrator);
  }
  json["rose"] = report.rose;
  json["left_out"] = gate_json(report.gate);
  out += json.dump();
}

}  // namespace navcal::record
