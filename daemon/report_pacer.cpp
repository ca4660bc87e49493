// SPDX-License-Identifier: Apache-2.0
#include "daemon/report_pacer.h"

#include <algorithm>

namespace navcal::daemon {

bool ReportPacer::is_due(ReportClass report, std::uint16_t slot, std::int64_t interval_ns,
                         std::int64_t now_ns) const {
  for (const Next& next : next_) {
    if (next.report == report && next.slot == slot) return now_ns >= next.due_ns - interval_ns / 2;
  }
  return true;
}

bool ReportPacer::take(ReportClass report, std::uint16_t slot, std::int64_t interval_ns, std::int64_t now_ns) {
  if (!is_due(report, slot, interval_ns, now_ns)) return false;
  auto found = std::find_if(next_.begin(), next_.end(),
                            [&](const Next& next) { return next.report == report && next.slot == slot; });
  if (found == next_.end()) found = next_.insert(next_.end(), Next{report, slot, now_ns});
  found->due_ns = std::max(found->due_ns, now_ns - interval_ns / 2) + interval_ns;
  return true;
}

}  // namespace navcal::daemon
