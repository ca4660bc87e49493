// SPDX-License-Identifier: Apache-2.0
#include "gap/design/next_mission.h"

#include <fmt/format.h>
#include <navcal/next_mission.h>

#include "api/diagnosis_request.h"
#include "api/guard.h"
#include "config/mission_limits.h"
#include "config/mission_text.h"
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
  source.vehicle = options.diagnosis.vehicle;
  source.limits = options.limits;
  source.mission = options.mission_out;
  return source;
}

}  // namespace

NextMission plan_next_mission(const std::vector<std::filesystem::path>& missions,
                              const NextMissionOptions& options) {
  return guarded_with_progress(options.diagnosis.progress, [&](ProgressRelay& relay) {
    const auto tell = [&](std::string_view step, double share) { relay(step, share); };
    const config::MissionLimits limits = limits_of(options);
    if (emulation::layout_in(options.diagnosis.vehicle))
      throw Error(ErrorKind::bad_argument,
                  "vehicle: missions are planned for vehicle files only, not for layouts");
    const auto study = gap::study(request_of(missions, options.diagnosis), tell);
    const gap::NextMission plan = gap::plan_next_mission(*study, limits, tell);
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
