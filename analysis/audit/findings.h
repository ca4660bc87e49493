// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/audit/audited_log.h"
#include "analysis/audit/bounded.h"
#include "analysis/audit/finding.h"

/// The kinds of findings, one function for each group of instruments. A function gives one answer for each thing
/// that it looks for in each instrument, also where nothing is found, and none where the log lacks the instrument.
namespace navcal::analysis {

/// Rates, gaps, repeated and lost readings, order of times.
[[nodiscard]] std::vector<Finding> sampling_findings(const AuditedLog& log);
/// Iron, steps of the field, field of the motor, heading of the device and of the autopilot, two compasses.
[[nodiscard]] std::vector<Finding> compass_findings(const AuditedLog& log);
/// Bias and scale of the gyros; vibration and clipping of the accelerometers.
[[nodiscard]] std::vector<Finding> inertial_findings(const AuditedLog& log);
/// Depth at the surface, altimeter, receiver, Doppler log.
[[nodiscard]] std::vector<Finding> water_findings(const AuditedLog& log);
/// Delays of compass and course.
[[nodiscard]] std::vector<Finding> delay_findings(const AuditedLog& log);

/// Time of the costs of a place.
inline constexpr double kCostTime_s = 600;

// Parts of findings.
[[nodiscard]] inline Finding finding_of(std::string name, std::string channel) {
  Finding finding;
  finding.name = std::move(name);
  finding.channel = std::move(channel);
  return finding;
}
inline void put_value(Finding& finding, const Bounded& value, std::string unit) {
  finding.value = value.value;
  finding.low = value.low;
  finding.high = value.high;
  finding.unit = std::move(unit);
}
/// The cost of a heading that is off by so much all the time, at the speed of this vehicle.
void put_heading_cost(Finding& finding, const AuditedLog& log, double heading_deg);
/// Judgement of a calibrator that refused, as a finding that cannot be made.
[[nodiscard]] Finding refused(Finding finding, const calib::CalibratorReport& report);

}  // namespace navcal::analysis
