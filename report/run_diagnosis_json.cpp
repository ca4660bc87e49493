// SPDX-License-Identifier: Apache-2.0
#include "report/run_diagnosis_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace navcal::report {
namespace {

nlohmann::ordered_json candidates_json(const std::vector<runs::Candidate>& candidates) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& candidate : candidates) {
    list.push_back({{"name", candidate.name}, {"probability", std::round(candidate.probability * 1e4) / 1e4}});
  }
  return list;
}

nlohmann::ordered_json deviations_json(const runs::RunDiagnosis& diagnosis) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < runs::kParameterCount; ++i) {
    if (std::isnan(diagnosis.deviations[i])) continue;
    const auto& parameter = runs::kParameters[static_cast<std::size_t>(i)];
    list.push_back({{"parameter", parameter.name},
                    {"off", diagnosis.deviations[i]},
                    {"nominal_std", diagnosis.standard_deviations[i]},
                    {"unit", parameter.unit}});
  }
  return list;
}

}  // namespace

std::string run_diagnosis_json(std::string_view kind, std::string_view name, const runs::RunDiagnosis& diagnosis) {
  nlohmann::ordered_json line;
  line[std::string(kind)] = name;
  line["verdict"] = runs::verdict_name(diagnosis.verdict);
  line["effects"] = candidates_json(diagnosis.effects);
  line["candidates"] = candidates_json(diagnosis.candidates);
  line["deviations"] = deviations_json(diagnosis);
  line["runs_used"] = diagnosis.runs_used;
  return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

}  // namespace navcal::report
