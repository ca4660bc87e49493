// SPDX-License-Identifier: Apache-2.0
#include "gap/design/next_mission.h"

#include <fmt/format.h>
#include <navcal/next_mission.h>

#include "api/diagnosis_request.h"
#include "api/guard.h"
#include "config/mission_limits.h"
#include "config/mission_text.h"
#include "diagnosis/next_layout_mission.h"
#include "emulation/chosen_vehicle.h"
#include "gap/verdict/study.h"
#include "report/next_mission.h"

namespace navcal::api {
namespace {

constexpr double kLeastMinutes = 1, kMostMinutes = 120;

config::MissionLimits limits_of(const NextMissionOptions& options) {
  config::MissionLimits limits;
  if (!options.limits.empty()) limits = config::load_mission_limits(options.limits);
  if (options.minutes) {
    if (!(*options.minutes >= kLeastMinutes && *options.minutes <= kMostMinutes))
      throw Error(ErrorKind::bad_argument, fmt::format("minutes: must be 1 to 120, not {}", *options.minutes));
    limits.duration_s = 60 * *options.minutes;
  }
  return limits;
}

report::NextMissionSource source_of(const std::vector<std::filesystem::path>& missions,
                                    const NextMissionOptions& options) {
  report::NextMissionSource source;
  source.recordings.assign(missions.begin(), missions.end());
  source.holdouts.assign(options.diagnosis.holdouts.begin(), options.diagnosis.holdouts.end());
  source.nominals.assign(options.diagnosis.nominals.begin(), options.diagnosis.nominals.end());
  source.vehicle = options.diagnosis.vehicle;
  source.limits = options.limits;
  source.mission = options.mission_out;
  return source;
}

gap::NextMission plan_of(const std::vector<std::filesystem::path>& missions, const NextMissionOptions& options,
                         const config::MissionLimits& limits, const gap::Progress& tell) {
  const auto layout = emulation::layout_to_diagnose(
      options.diagnosis.vehicle, !options.diagnosis.nominals.empty() || options.diagnosis.steady);
  const gap::Request request = request_of(missions, options.diagnosis, layout.has_value());
  if (!layout) return gap::plan_next_mission(*gap::study(request, tell), limits, tell);
  return diagnosis::plan_next_mission(
      *diagnosis::study(request, {.layout = *layout, .excluded = {}, .is_steady = options.diagnosis.steady},
                        options.diagnosis.nominals, tell),
      limits, tell);
}

}  // namespace

NextMission plan_next_mission(const std::vector<std::filesystem::path>& missions,
                              const NextMissionOptions& options) {
  return guarded_with_progress(options.diagnosis.progress, [&](ProgressRelay& relay) {
    const auto tell = [&](std::string_view step, double share) { relay(step, share); };
    const config::MissionLimits limits = limits_of(options);
    const gap::NextMission plan = plan_of(missions, options, limits, tell);
    const report::NextMissionSource source = source_of(missions, options);
    NextMission next;
    next.decides = plan.decides;
    next.probability_now = plan.probability_now;
    next.probability_exact = plan.probability_exact;
    next.duration_s = plan.path.duration_s;
    next.manoeuvres = plan.manoeuvres;
    next.sentence = plan.sentence;
    next.remarks = plan.remarks;
    next.mission_toml = config::mission_text(plan.mission, report::next_mission_head(plan));
    next.json = report::next_mission_json(plan, source);
    next.page = report::next_mission_page(plan, source);
    return next;
  });
}

}  // namespace navcal::api
