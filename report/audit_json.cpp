// SPDX-License-Identifier: Apache-2.0
#include "record/json/put_members.h"
#include "report/audit_report.h"

namespace navcal::analysis {

NAVCAL_JSON_MEMBERS(AuditChange, name, channel, before, after, low, high, unit, sentence, file)

static void to_json(nlohmann::ordered_json& json, const Finding& finding) {
  NAVCAL_PUT_MEMBERS(json, finding, name, channel, value, low, high, stated, unit);
  json["cost"] = {{"heading_deg", finding.heading_deg}, {"position_m_10min", finding.position_m}};
  json["certainty"] = name_of(finding.certainty);
  NAVCAL_PUT_MEMBERS(json, finding, title, sentence, todo);
}

}  // namespace navcal::analysis

namespace navcal::report {

std::string audit_json(const analysis::Audit& audit) {
  using AuditJson = nlohmann::ordered_json;
  AuditJson json{{"class", "AUDIT"},
                 {"files", AuditJson::array()},
                 {"findings", AuditJson::array()},
                 {"nothing_found", audit.nothing_found()},
                 {"clear", AuditJson::array()},
                 {"changes", audit.changes()}};
  for (const analysis::AuditedFile& file : audit.files) {
    json["files"].push_back({{"file", file.file},
                             {"duration_s", file.duration_s},
                             {"speed_m_s", file.speed_m_s},
                             {"partial", file.is_partial},
                             {"remarks", file.remarks}});
    for (const analysis::Finding& finding : file.findings) {
      auto& list = json[finding.certainty == analysis::Certainty::nothing ? "clear" : "findings"];
      list.push_back(finding);
      list.back()["file"] = file.file;
    }
  }
  // A file's name may be any bytes.
  return json.dump(-1, ' ', false, AuditJson::error_handler_t::replace) + "\n";
}

}  // namespace navcal::report
