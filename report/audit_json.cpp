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

AuditJson finding_json(const analysis::Finding& finding, const std::string& file) {
  return {{"name", finding.name},
          {"channel", finding.channel},
          {"value", audit_number(finding.value)},
          {"low", audit_number(finding.low)},
          {"high", audit_number(finding.high)},
          {"stated", audit_number(finding.stated)},
          {"unit", finding.unit},
          {"cost",
           {{"heading_deg", audit_number(finding.heading_deg)},
            {"position_m_10min", audit_number(finding.position_m)}}},
          {"certainty", analysis::name_of(finding.certainty)},
          {"title", finding.title},
          {"sentence", finding.sentence},
          {"todo", finding.todo},
          {"file", file}};
}

}  // namespace

std::string audit_json(const analysis::Audit& audit) {
  AuditJson json{{"class", "AUDIT"},
                 {"files", AuditJson::array()},
                 {"findings", AuditJson::array()},
                 {"nothing_found", audit.nothing_found()},
                 {"clear", AuditJson::array()},
                 {"changes", AuditJson::array()}};
  for (const analysis::AuditedFile& file : audit.files) {
    json["files"].push_back({{"file", file.file},
                             {"duration_s", file.duration_s},
                             {"speed_m_s", file.speed_m_s},
                             {"partial", file.is_partial},
                             {"remarks", file.remarks}});
    for (const analysis::Finding& finding : file.findings)
      json[finding.certainty == analysis::Certainty::nothing ? "clear" : "findings"].push_back(
          finding_json(finding, file.file));
  }
  for (const analysis::AuditChange& change : audit.changes())
    json["changes"].push_back({{"name", change.name},
                               {"channel", change.channel},
                               {"before", change.before},
                               {"after", change.after},
                               {"low", change.low},
                               {"high", change.high},
                               {"unit", change.unit},
                               {"sentence", change.sentence},
                               {"file", change.file}});
  // A file's name may be any bytes.
  return json.dump(-1, ' ', false, AuditJson::error_handler_t::replace) + "\n";
}

}  // namespace navcal::report
