// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace navcal::analysis {

enum class Certainty : std::uint8_t {
  found,       ///< held-out readings confirm it, or it is counted
  likely,      ///< the readings show it, but another cause is possible
  cannot_say,  ///< the log lacks what would tell
  nothing,     ///< looked for, and not there
};
/// "found", "likely", "cannot say", "nothing found".
[[nodiscard]] std::string_view name_of(Certainty certainty);

/// Readings or curves that show a finding.
struct AuditPicture {
  struct Trace {
    std::string name;
    std::vector<std::pair<double, double>> points;
    bool is_line = false;
  };
  std::string title, x, y, caption;  ///< `x` and `y` name quantity and unit
  std::vector<Trace> traces;
};

/// One answer of the audit.
struct Finding {
  std::string name;     ///< stable: "compass.iron"
  std::string channel;  ///< port, or ports
  Certainty certainty = Certainty::nothing;
  std::optional<double> value, low, high;         ///< with its 95 % interval, in `unit`; a count has no width
  std::string unit;                               ///< "deg", "uT/A"; of a share "%"
  std::optional<double> heading_deg, position_m;  ///< cost: error of the heading, and of the place in ten minutes
  std::string sentence;                           ///< evidence
  std::string todo;
  std::optional<AuditPicture> picture{};
  std::string file{};
};

/// Most certain first, and of these the most costly first.
void sort_findings(std::vector<Finding>& findings);

/// A quantity whose value differs between two logs by more than both intervals allow.
struct AuditChange {
  std::string name, channel, unit, sentence;
  double before = 0, after = 0, low = 0, high = 0;  ///< the last two: interval of the difference
  std::string file{};                               ///< of `after`
};
/// Changes of the findings of one log against those of the other. Findings without an interval are left out.
[[nodiscard]] std::vector<AuditChange> changes_between(const std::vector<Finding>& before,
                                                       const std::vector<Finding>& after);

}  // namespace navcal::analysis
