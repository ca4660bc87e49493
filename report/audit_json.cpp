// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "report/audit_report.h"

namespace navcal::report {
namespace {

using AuditJson = nlohmann::ordered_json;

AuditJson audit_number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? AuditJson(*value) : AuditJson(nullptr);
}

AuditJson finding_json(const analysis::Finding& finding) {
  return {{"name", finding.name},
          {"channel", finding.channel},
          {"value", audit_number(finding.value)},
          {"low", audit_number(finding.low)},
          {"high", audit_number(finding.high)},
          {"unit", finding.unit},
          {"cost",
           {{"heading_deg", audit_number(finding.heading_deg)},
            {"position_m_10min", audit_number(finding.position_m)}}},
          {"certainty", analysis::name_of(finding.certainty)},
          {"sentence", finding.sentence},
          {"todo", finding.todo},
          {"file", finding.file}};
}

}  // namespace

std::string audit_json(const analysis::Audit& audit) {
  AuditJson json;
  json["class"] = "AUDIT";
  json["files"] = AuditJson::array();
  json["findings"] = AuditJson::array();
  json["nothing_found"] = audit.nothing_found();
  json["clear"] = AuditJson::array();
  json["changes"] = AuditJson::array();
  for (const analysis::AuditedFile& file : audit.files) {
    json["files"].push_back({{"file", file.file},
                             {"duration_s", file.duration_s},
                             {"speed_m_s", file.speed_m_s},
                             {"partial", file.is_partial},
                             {"remarks", file.remarks}});
    for (const analysis::Finding& finding : file.findings)
      json[finding.certainty == analysis::Certainty::nothing ? "clear" : "findings"].push_back(
          finding_json(finding));
  }
  for (const analysis::AuditChange& change : audit.changes)
    json["changes"].push_back({{"name", change.name},
                               {"channel", change.channel},
                               {"before", audit_number(change.before)},
                               {"after", audit_number(change.after)},
                               {"low", audit_number(change.low)},
                               {"high", audit_number(change.high)},
                               {"unit", change.unit},
                               {"sentence", change.sentence},
                               {"file", change.file}});
  // A file's name may be any bytes.
  return json.dump(-1, ' ', false, AuditJson::error_handler_t::replace) + "\n";
}

}  // namespace navcal::report
