// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::daemon {

/// Classes of reports that a client of the status socket can select. Answers to requests belong to no class.
enum class ReportClass : std::uint8_t {
  tpv,
  sky,
  att,
  motor,
  altimeter,
  nav,
  health,
  time,
  log,
  calib,
  device,
  state,
  power,
  battery,
  dvl,
  depth,
  sensor,
  record
};
inline constexpr std::size_t kReportClasses = 18;

/// "TPV", "SKY", ...
[[nodiscard]] std::string_view name_of(ReportClass report);
[[nodiscard]] std::optional<ReportClass> report_class_named(std::string_view name);
/// "TPV, SKY, ...", for people.
[[nodiscard]] std::string known_report_classes();

/// A set of them.
class ReportClasses {
 public:
  /// All classes but STATE and RECORD: the default of a client that does not choose.
  [[nodiscard]] static ReportClasses usual();

  void add(ReportClass report) { bits_ |= 1U << static_cast<unsigned>(report); }
  [[nodiscard]] bool has(ReportClass report) const { return (bits_ >> static_cast<unsigned>(report) & 1U) != 0; }
  bool operator==(const ReportClasses&) const = default;

 private:
  unsigned bits_ = 0;
};

/// Shortest time between two reports of each class, nanoseconds; 0: no limit.
using ReportIntervals = std::array<std::int64_t, kReportClasses>;

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
