// SPDX-License-Identifier: Apache-2.0
#include "record/json/correction_json.h"

#include <cmath>

#include "base/angles.h"

namespace navcal::record {
namespace {

using Json = nlohmann::ordered_json;
using calib::Calibrator;

Json rate_json(const std::optional<calib::RateCorrection>& rate) {
  if (!rate) return nullptr;
  Json json;
  json["scale"] = rate->scale;
  json["bias_deg_s"] = rate->bias_rad_s * base::kDegreesPerRadian;
  return json;
}

Json swing_json(const calib::SwingCorrection& swing) {
  Json json;
  for (const double deviation_rad : swing.deviation_rad)
    json["deviation_deg"].push_back(deviation_rad * base::kDegreesPerRadian);
  return json;
}

Json field_json(const calib::FieldCorrection& field) {
  Json json;
  json["offset_uT"] = vector_json(field.offset_uT);
  json["matrix"] = matrix_json(field.matrix);
  return json;
}

/// UTC seconds.
Json time_json(std::int64_t utc_ns) {
  return utc_ns == 0 ? Json(nullptr) : Json(static_cast<double>(utc_ns) * 1e-9);
}

Json named(std::string_view name, const std::optional<double>& value, double unit) {
  if (!value) return nullptr;
  Json json;
  json[std::string(name)] = *value * unit;
  return json;
}

/// "bias_rad_s" -> "bias_deg_s", with the factor.
double in_degrees(std::string& name) {
  constexpr std::string_view kRadians = "_rad";
  const auto at = name.rfind(kRadians);
  if (at == std::string::npos) return 1;
  name.replace(at, kRadians.size(), "_deg");
  return base::kDegreesPerRadian;
}

}  // namespace

Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json vector_json(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

Json matrix_json(const Eigen::Matrix3d& matrix) {
  Json json = Json::array();
  for (Eigen::Index row = 0; row < 3; ++row) json.push_back(vector_json(matrix.row(row).transpose()));
  return json;
}

Json deviation_json(const calib::DeviationCorrection& deviation) {
  Json json;
  std::string name = "A_deg";
  for (const double coefficient_rad : deviation.coefficients_rad) {
    json[name] = coefficient_rad * base::kDegreesPerRadian;
    ++name.front();
  }
  return json;
}

Json correction_json(const calib::Correction& correction, Calibrator calibrator) {
  switch (calibrator) {
    case Calibrator::gyro:
      return rate_json(correction.gyro);
    case Calibrator::gyro_b:
      return rate_json(correction.gyro_b);
    case Calibrator::compass:
      return correction.compass ? deviation_json(*correction.compass) : Json(nullptr);
    case Calibrator::magnetometer:
      return correction.magnetometer ? field_json(*correction.magnetometer) : Json(nullptr);
    case Calibrator::gps_compass:
      return correction.gps_compass ? deviation_json(*correction.gps_compass) : Json(nullptr);
    case Calibrator::swing:
      return correction.swing ? swing_json(*correction.swing) : Json(nullptr);
    case Calibrator::misalignment:
      return named("A_deg", correction.misalignment_rad, base::kDegreesPerRadian);
    case Calibrator::compass_delay:
      return named("delay_s", correction.compass_delay_s, 1);
    case Calibrator::course_delay:
      return named("delay_s", correction.course_delay_s, 1);
    case Calibrator::motor_current:
      break;
  }
  if (!correction.motor_current) return nullptr;
  Json json;
  json["slope_uT_per_A"] = vector_json(correction.motor_current->slope_uT_per_A);
  return json;
}

Json values_json(const std::vector<calib::Quantity>& quantities, double calib::Quantity::*which) {
  Json json = Json::object();
  for (const auto& quantity : quantities) {
    std::string name(quantity.name);
    const double unit = in_degrees(name);
    json[name] = number_json(quantity.*which * unit);
  }
  return json;
}

Json steps_json(const std::vector<calib::FieldStep>& steps) {
  Json all = Json::array();
  for (const auto& step : steps) {
    Json json;
    json["time"] = time_json(step.utc_ns);
    json["size_uT"] = vector_json(step.size_uT);
    for (const double std_uT : step.std_uT) json["std_uT"].push_back(number_json(std_uT));
    json["returned"] = step.returned;
    all.push_back(std::move(json));
  }
  return all;
}

Json segments_json(const std::vector<calib::FieldSegment>& segments) {
  const auto number = [](const std::optional<double>& value) {
    return value ? number_json(*value) : Json(nullptr);
  };
  Json all = Json::array();
  for (const auto& segment : segments) {
    Json json;
    json["from"] = time_json(segment.begin_utc_ns);
    json["to"] = time_json(segment.end_utc_ns);
    json["readings"] = segment.readings;
    json["spread_raw"] = number(segment.spread_raw());
    json["spread_calibrated"] = number(segment.spread_calibrated);
    all.push_back(std::move(json));
  }
  return all;
}

Json gate_json(const calib::GateCounts& counts) {
  Json json;
  for (std::size_t s = 0; s < calib::kStreams; ++s) {
    Json stream;
    stream["taken"] = counts.taken[s];
    for (std::size_t r = 0; r < calib::kRejections; ++r) {
      if (counts.left_out[s][r] > 0)
        stream[std::string(calib::name_of(static_cast<calib::Rejection>(r)))] = counts.left_out[s][r];
    }
    if (static_cast<calib::Stream>(s) == calib::Stream::compass && counts.distorted > 0)
      stream["distorted"] = counts.distorted;
    stream["gaps"] = counts.gaps[s];
    json[std::string(calib::name_of(static_cast<calib::Stream>(s)))] = std::move(stream);
  }
  json["restarts"] = counts.restarts;
  return json;
}

}  // namespace navcal::record
