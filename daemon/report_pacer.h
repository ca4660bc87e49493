// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "daemon/report_class.h"

namespace navcal::daemon {

/// Lets reports of one client through at most so often, for each class and slot (a device, a part). The average
/// keeps to the interval; a report may come half an interval early, so that a device whose rate is just the limit
/// is not halved by its jitter.
class ReportPacer {
 public:
  /// True when this report may pass; it is then counted.
  [[nodiscard]] bool take(ReportClass report, std::uint16_t slot, std::int64_t interval_ns, std::int64_t now_ns);
  /// True when a report might pass; none is counted.
  [[nodiscard]] bool is_due(ReportClass report, std::uint16_t slot, std::int64_t interval_ns,
                            std::int64_t now_ns) const;
  void forget() { next_.clear(); }

 private:
  struct Next {
    ReportClass report{};
    std::uint16_t slot = 0;
    std::int64_t due_ns = 0;
  };
  std::vector<Next> next_;
};

}  // namespace navcal::daemon
