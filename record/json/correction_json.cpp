// SPDX-License-Identifier: Apache-2.0
#include "record/json/correction_json.h"

#include <cmath>

#include "base/angles.h"

namespace navcal::record {
namespace {

using Json = nlohmann::ordered_json;
using calib::Calibrator;

/// UTC seconds.
Json time_json(std::int64_t utc_ns) {
  return utc_ns == 0 ? Json(nullptr) : Json(static_cast<double>(utc_ns) * 1e-9);
}

/// "bias_rad_s" -> "bias_deg_s", with the factor.
double in_degrees(std::string& name) {
  constexpr std::string_view kRadians = "_rad";
  const auto at = name.rfind(kRadians);
  if (at == std::string::npos) return 1;
  name.replace(at, kRadians.size(), "_deg");
  return base::kDegreesPerRadian;
}

/// A number, or a list of numbers, or a list of the rows of a matrix.
Json numbers_json(const calib::NamedNumbers& numbers, double unit) {
  const auto number = [&](double value) { return number_json(value * unit); };
  if (numbers.rows == 0) return number(numbers.values.front());
  Json rows = Json::array();
  const std::size_t columns = numbers.values.size() / numbers.rows;
  for (std::size_t row = 0; row < numbers.rows; ++row) {
    Json json = Json::array();
    for (std::size_t i = 0; i < columns; ++i) json.push_back(number(numbers.values[row * columns + i]));
    rows.push_back(std::move(json));
  }
  return numbers.rows == 1 ? rows.front() : rows;
}

}  // namespace

Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json vector_json(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

Json matrix_json(const Eigen::Matrix3d& matrix) {
  Json json = Json::array();
  for (Eigen::Index row = 0; row < 3; ++row) json.push_back(vector_json(matrix.row(row).transpose()));
  return json;
}

Json correction_json(const calib::Correction& correction, Calibrator calibrator) {
  Json json;
  for (const calib::NamedNumbers& numbers : calib::values_of(correction, calibrator)) {
    std::string name(numbers.name);
    const double unit = in_degrees(name);
    json[name] = numbers_json(numbers, unit);
  }
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
