// SPDX-License-Identifier: Apache-2.0
#include "analysis/audit/finding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "analysis/audit/findings.h"
#include "base/angles.h"

namespace navcal::analysis {

std::string_view name_of(Certainty certainty) {
  switch (certainty) {
    case Certainty::found: return "found";
    case Certainty::likely: return "likely";
    case Certainty::cannot_say: return "cannot say";
    case Certainty::nothing: break;
  }
  return "nothing found";
}

void sort_findings(std::vector<Finding>& findings) {
  std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
    return std::tuple(a.certainty, -a.position_m.value_or(0)) < std::tuple(b.certainty, -b.position_m.value_or(0));
  });
}

std::vector<AuditChange> changes_between(const std::vector<Finding>& before, const std::vector<Finding>& after) {
  std::vector<AuditChange> changes;
  for (const Finding& old : before) {
    if (!old.value || !(*old.high > *old.low)) continue;
    const auto found = std::find_if(after.begin(), after.end(), [&](const Finding& other) {
      return other.name == old.name && other.channel == old.channel && other.unit == old.unit && other.value;
    });
    if (found == after.end() || !(*found->high > *found->low)) continue;
    const double difference = *found->value - *old.value;
    const double below = std::hypot(*found->value - *found->low, *old.high - *old.value);
    const double above = std::hypot(*found->high - *found->value, *old.value - *old.low);
    if (difference - below <= 0 && difference + above >= 0) continue;
    changes.push_back(
        {old.name, old.channel, old.unit,
         fmt::format("{} of {} went from {:.4g} to {:.4g} {}, by {:.3g} to {:.3g}.", old.name, old.channel,
                     *old.value, *found->value, old.unit, difference - below, difference + above),
         *old.value, *found->value, difference - below, difference + above});
  }
  return changes;
}

void put_heading_cost(Finding& finding, const AuditedLog& log, double heading_deg) {
  finding.heading_deg = heading_deg;
  finding.position_m =
      log.speed_m_s() * kCostTime_s * 2 * std::sin(std::min(heading_deg, 180.0) * base::kRadiansPerDegree / 2);
}

Finding refused(Finding finding, const calib::CalibratorReport& report) {
  finding.certainty = Certainty::cannot_say;
  finding.sentence =
      report.judgement.reason.empty() ? "The readings do not determine it." : report.judgement.reason + ".";
  finding.todo = report.judgement.manoeuvre;
  return finding;
}

}  // namespace navcal::analysis
