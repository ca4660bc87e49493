// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>

#include "base/utc_text.h"
#include "fleet/causes/answer_report.h"

namespace navcal::fleet {
namespace {

/// Largest number of histories that the text lists; JSON and page have all.
constexpr std::size_t kMostLines = 40;

/// "since 2026-06-04 (a.cap)", from the first mission that a cause acts in; empty: in all.
std::string time_text(const PossibleCause& cause, const PooledMissions& missions) {
  const auto mission = [&](std::size_t m) {
    const FleetMission& of = missions.missions()[m];
    return fmt::format("{} ({})", base::utc_date_text(of.utc_ns), of.recording);
  };
  std::string text;
  if (cause.since) text += " since " + mission(cause.missions.front());
  if (cause.until) text += " until " + mission(cause.missions.back());
  return text;
}

std::string owner_text(const PossibleCause& cause) {
  switch (cause.level) {
    case CauseLevel::vehicle: return "vehicle " + cause.of;
    case CauseLevel::design: return "all vehicles of " + cause.of;
    case CauseLevel::day: return "the day " + cause.of;
  }
  return "";
}

void append_causes(const char* title, const std::vector<FoundCause>& causes, const PooledMissions& missions,
                   std::string& text) {
  if (causes.empty()) return;
  text += fmt::format("\n{}\n", title);
  for (const FoundCause& cause : causes) {
    text += "  " + text_of(cause, missions) + "\n";
    for (const Alternative& other : cause.alternatives) {
      text += fmt::format("      or, with probability {:.2f}: {}\n", other.probability,
                          text_of(other.cause, missions));
    }
  }
}

std::string course_text(const CalibrationHistory& history) {
  switch (history.course) {
    case CalibrationCourse::drift:
      return fmt::format("drifts by {:.3g} +- {:.2g} a day", history.drift_per_day, history.drift_std);
    case CalibrationCourse::step: {
      const CalibrationPoint& at = history.points[history.step_at];
      return fmt::format("changes by {:.3g} +- {:.2g} on {} ({}, vehicle {})", history.step, history.step_std,
                         base::utc_date_text(at.utc_ns), at.recording, at.vehicle);
    }
    case CalibrationCourse::scatter:
      return fmt::format("scatters by {:.3g} beyond the stated errors", history.excess_std);
    default: return fmt::format("{:.4g} +- {:.2g}, constant", history.mean, history.mean_std);
  }
}

void append_calibrations(const std::vector<CalibrationHistory>& histories, std::string& text) {
  std::size_t lines = 0, constant = 0, few = 0;
  for (const CalibrationHistory& history : histories) {
    if (history.course == CalibrationCourse::constant) ++constant;
    if (history.course == CalibrationCourse::too_few) ++few;
    if (history.course == CalibrationCourse::constant || history.course == CalibrationCourse::too_few) continue;
    if (lines++ == 0) text += "\nCalibrations that changed\n";
    if (lines <= kMostLines) {
      text += fmt::format("  {} {}: {}\n", history.subject, history.quantity, course_text(history));
    }
  }
  if (lines > kMostLines) text += fmt::format("  and {} more (--json, --report)\n", lines - kMostLines);
  if (!histories.empty()) {
    text += fmt::format("\n{} calibrated values are constant; {} have fewer than three values.\n", constant, few);
  }
}

}  // namespace

std::string text_of(const PossibleCause& cause, const PooledMissions& missions) {
  return fmt::format("{} of {}{}", missions.effects()[cause.effect].name, owner_text(cause),
                     time_text(cause, missions));
}

std::string text_of(const FoundCause& cause, const PooledMissions& missions) {
  const PossibleCause& of = cause.acting.cause;
  const EffectColumns& effect = missions.effects()[of.effect];
  std::string values;
  for (Eigen::Index j = 0; j < effect.count; ++j) {
    const gap::ParameterName& name =
        missions.missions().front().information.parameters[static_cast<std::size_t>(effect.first + j)];
    values += fmt::format("{}{} {:.3g} +- {:.2g}", j > 0 ? ", " : "", name.parameter, cause.mean[j] * name.typical,
                          cause.std[j] * name.typical);
  }
  std::string text = fmt::format("{}: {}; probability {:.3f}", text_of(of, missions), values, cause.probability);
  if (of.since || of.until) text += fmt::format(", of these missions {:.2f}", cause.probability_of_time);
  return text;
}

std::string fleet_text(const FleetStory& story) {
  const PooledMissions& missions = story.missions;
  const FleetAnswer& answer = story.answer;
  std::string text = fmt::format("{} missions of {} vehicles, {} designs, {} days\n", missions.missions().size(),
                                 missions.vehicles().size(), missions.designs().size(), missions.days().size());
  append_causes("Causes", answer.causes, missions, text);
  append_causes("Not decided", answer.undecided, missions, text);
  append_causes("Within tolerance", answer.tolerances, missions, text);
  text += "\nVehicles (power of the residuals; 1 is the noise of the nominal vehicle)\n";
  for (const VehicleAnswer& vehicle : answer.vehicles) {
    text += fmt::format("  {:<16} {:<10} before {:.3f}, after {:.3f}, floor {:.3f}", vehicle.vehicle,
                        name_of(vehicle.verdict), vehicle.gap.before, vehicle.gap.after, vehicle.gap.floor);
    if (vehicle.closed) text += fmt::format(", closed {:.0f} %", 100 * *vehicle.closed);
    text += vehicle.reason.empty() ? "\n" : fmt::format("\n      {}\n", vehicle.reason);
  }
  append_calibrations(story.calibrations, text);
  for (const std::string& remark : story.remarks) text += fmt::format("\nremark: {}", remark);
  if (!story.remarks.empty()) text += "\n";
  return text;
}

}  // namespace navcal::fleet
