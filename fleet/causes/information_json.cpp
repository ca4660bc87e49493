// SPDX-License-Identifier: Apache-2.0
#include "fleet/causes/information_json.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "record/json/put_members.h"

namespace navcal::base {

NAVCAL_JSON_MEMBERS(GeodeticPosition, latitude_rad, longitude_rad, height_m)

}  // namespace navcal::base

namespace navcal::gap {

/// A bound of a parameter is null where there is none.
static void to_json(nlohmann::ordered_json& json, const ParameterName& name) {
  NAVCAL_PUT_MEMBERS(json, name, effect, parameter, typical, least, greatest);
  for (const char* const bound : {"least", "greatest"}) {
    if (!std::isfinite(json[bound].get<double>())) json[bound] = nullptr;
  }
}

}  // namespace navcal::gap

namespace navcal::fleet {
namespace {

using InformationJson = nlohmann::ordered_json;

const InformationJson& member(const InformationJson& json, const char* key) {
  if (!json.is_object()) throw std::invalid_argument(fmt::format("{} is looked for in what is no object", key));
  const auto found = json.find(key);
  if (found == json.end()) throw std::invalid_argument(fmt::format("the key {} is missing", key));
  return *found;
}

double number(const InformationJson& json, const char* key) {
  const InformationJson& value = member(json, key);
  if (!value.is_number() || !std::isfinite(value.get<double>())) {
    throw std::invalid_argument(fmt::format("{} is not a number", key));
  }
  return value.get<double>();
}

std::string text(const InformationJson& json, const char* key) {
  const InformationJson& value = member(json, key);
  if (!value.is_string()) throw std::invalid_argument(fmt::format("{} is not a text", key));
  return value.get<std::string>();
}

double bound(const InformationJson& json, const char* key, double none) {
  return member(json, key).is_null() ? none : number(json, key);
}

Eigen::VectorXd numbers(const InformationJson& json, const char* key, Eigen::Index count) {
  const InformationJson& list = member(json, key);
  if (!list.is_array() || static_cast<Eigen::Index>(list.size()) != count) {
    throw std::invalid_argument(fmt::format("{} is not a list of {} numbers", key, count));
  }
  Eigen::VectorXd values(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const InformationJson& value = list[static_cast<std::size_t>(i)];
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
      throw std::invalid_argument(fmt::format("{}: element {} is not a number", key, i));
    }
    values[i] = value.get<double>();
  }
  return values;
}

std::vector<gap::ParameterName> parameters_from(const InformationJson& json) {
  const InformationJson& list = member(json, "parameters");
  if (!list.is_array()) throw std::invalid_argument("parameters is not a list");
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::vector<gap::ParameterName> names;
  for (const InformationJson& each : list) {
    names.push_back({text(each, "effect"), text(each, "parameter"), number(each, "typical"),
                     bound(each, "least", -kNone), bound(each, "greatest", kNone)});
  }
  return names;
}

}  // namespace

InformationJson information_json(const gap::RecordingInformation& of) {
  InformationJson json{{"parameters", of.parameters},
                       {"score", std::vector<double>(of.score.begin(), of.score.end())},
                       {"model_error", std::vector<double>(of.model_error.begin(), of.model_error.end())},
                       {"information", InformationJson::array()}};
  // The lower triangle, row by row: the matrix is symmetric.
  for (Eigen::Index i = 0; i < of.information.rows(); ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) json["information"].push_back(of.information(i, j));
  }
  NAVCAL_PUT_MEMBERS(json, of, power, measurements, null_power, null_power_std, about, place, utc_ns, duration_s);
  return json;
}

gap::RecordingInformation information_from(const InformationJson& json) {
  gap::RecordingInformation of;
  of.parameters = parameters_from(json);
  const auto n = static_cast<Eigen::Index>(of.parameters.size());
  of.score = numbers(json, "score", n);
  of.model_error = numbers(json, "model_error", n);
  const Eigen::VectorXd triangle = numbers(json, "information", n * (n + 1) / 2);
  of.information.resize(n, n);
  for (Eigen::Index i = 0, at = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j, ++at) of.information(i, j) = of.information(j, i) = triangle[at];
  }
  of.power = number(json, "power");
  of.measurements = number(json, "measurements");
  of.null_power = number(json, "null_power");
  of.null_power_std = number(json, "null_power_std");
  const InformationJson& about = member(json, "about");
  if (!about.is_array()) throw std::invalid_argument("about is not a list");
  for (const InformationJson& effect : about) {
    if (!effect.is_string()) throw std::invalid_argument("about has a name that is no text");
    of.about.push_back(effect.get<std::string>());
  }
  if (const InformationJson& place = member(json, "place"); !place.is_null()) {
    of.place = base::GeodeticPosition{number(place, "latitude_rad"), number(place, "longitude_rad"),
                                      number(place, "height_m")};
  }
  if (const InformationJson& utc = member(json, "utc_ns"); utc.is_number_integer()) {
    of.utc_ns = utc.get<std::int64_t>();
  } else if (!utc.is_null()) {
    throw std::invalid_argument("utc_ns is not a whole number");
  }
  of.duration_s = number(json, "duration_s");
  return of;
}

}  // namespace navcal::fleet
