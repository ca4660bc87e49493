// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/audit/audited_log.h"
#include "analysis/audit/bounded.h"

namespace navcal::analysis {

enum class Certainty : std::uint8_t {
  found,       ///< held-out readings confirm it, or it is counted
  likely,      ///< the readings show it, but another cause is possible
  cannot_say,  ///< the log lacks what would tell
  nothing,     ///< looked for, and not there
};
/// "found", "likely", "cannot say", "nothing found".
[[nodiscard]] std::string_view name_of(Certainty certainty);

/// Readings that show a finding: points of each trace, by its name.
struct AuditPicture {
  using Points = std::vector<std::pair<double, double>>;
  std::string title, x, y;  ///< `x` and `y` name quantity and unit
  std::vector<std::pair<std::string, Points>> traces;
};

/// One answer of the audit.
struct Finding {
  std::string name, title, channel;  ///< stable: "compass.iron"; "Iron at the compass"; port, or ports
  Certainty certainty = Certainty::nothing;
  std::optional<double> value{}, low{}, high{};       ///< with its 95 % interval, in `unit`; a count has no width
  std::string unit{};                                 ///< "deg", "uT/A"; of a share "%"
  std::optional<double> heading_deg{}, position_m{};  ///< cost: error of the heading; of the place in ten minutes
  std::string sentence{}, todo{};                     ///< evidence; what to do
  std::optional<AuditPicture> picture{};
  std::optional<double> stated{};  ///< what the device itself says of `value`, such as the error of its heading
  std::string quantity{};  ///< "bias of imu.rate_z": that of all findings that state it, each in its own way

  void put(const Bounded& bounds, std::string_view of_unit);
  void put_count(double count, std::string_view of_unit) { put({count, count, count}, of_unit); }
  /// True where the whole interval lies beyond the limits. Where it reaches beyond, it cannot be said.
  [[nodiscard]] bool is_beyond(double least, double most);
  /// The same as a finding that cannot be made.
  [[nodiscard]] Finding cannot(std::string why, std::string remedy = {}) const;
  /// The cost of a heading that is off by so much all the time.
  void put_heading(double error_deg, double speed_m_s);
};

/// Most certain first, and of these the most costly first.
void sort_findings(std::vector<Finding>& findings);

/// The audit of one log.
struct AuditedFile {
  std::string file;
  double duration_s = 0, speed_m_s = 1;  ///< speed by which costs count
  bool is_partial = false;
  std::vector<std::string> remarks;
  std::vector<Finding> findings;  ///< sorted; also what was not found and what cannot be said
};

/// A quantity whose value differs from that in the first log by more than both intervals allow.
struct AuditChange {
  std::string file, name, channel, unit, sentence;
  double before = 0, after = 0, low = 0, high = 0;  ///< the last two: interval of the difference
};

struct Audit {
  std::vector<AuditedFile> files;
  /// Neither found nor likely in any file.
  [[nodiscard]] bool nothing_found() const;
  /// Of each further log against the first. Findings without an interval are left out.
  [[nodiscard]] std::vector<AuditChange> changes() const;
};

/// All findings of a log; `more` are of other rooms.
[[nodiscard]] AuditedFile audited(const AuditedLog& log, std::vector<Finding> more = {});

// The findings of each group of instruments: one answer for each thing that is looked for in each instrument, and
// none where the log lacks the instrument.
/// Rates, gaps, repeated and lost readings, order of times.
[[nodiscard]] std::vector<Finding> sampling_findings(const AuditedLog& log);
/// Iron, steps of the field, field of the motor, stated headings, two compasses.
[[nodiscard]] std::vector<Finding> compass_findings(const AuditedLog& log);
/// Bias and scale of the gyros; vibration and clipping of the accelerometers; delays.
[[nodiscard]] std::vector<Finding> inertial_findings(const AuditedLog& log);
/// Depth at the surface, altimeter, receiver, Doppler log.
[[nodiscard]] std::vector<Finding> water_findings(const AuditedLog& log);

/// The time for which costs count.
inline constexpr double kCostTime_s = 600;
/// A finding that cannot be made, with what a calibrator says against it.
[[nodiscard]] Finding refused(const Finding& finding, const calib::CalibratorReport& report);

}  // namespace navcal::analysis
