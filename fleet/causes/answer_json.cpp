// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "fleet/causes/answer_report.h"
#include "record/json/put_members.h"

namespace navcal::fleet {

NAVCAL_JSON_MEMBERS(MissionGap, before, after, floor)

namespace {

using FleetJson = nlohmann::ordered_json;

/// Seconds of UTC, as everywhere in JSON.
double utc_s(std::int64_t utc_ns) { return static_cast<double>(utc_ns) * 1e-9; }

FleetJson mission_json(std::size_t m, const PooledMissions& missions) {
  const FleetMission& of = missions.missions()[m];
  return {{"recording", of.recording}, {"time", utc_s(of.utc_ns)}};
}

/// What, of which level and unit, and from which mission to which; null: from the first one, or to the last one.
FleetJson possible_json(const PossibleCause& cause, const PooledMissions& missions) {
  FleetJson json{{"name", missions.effects()[cause.effect].name},
                 {"level", name_of(cause.level)},
                 {"of", cause.of},
                 {"missions", cause.missions.size()}};
  json["since"] = cause.since ? mission_json(cause.missions.front(), missions) : FleetJson();
  json["until"] = cause.until ? mission_json(cause.missions.back(), missions) : FleetJson();
  return json;
}

FleetJson cause_json(const FoundCause& cause, const PooledMissions& missions) {
  FleetJson json = possible_json(cause.acting.cause, missions);
  NAVCAL_PUT_MEMBERS(json, cause, probability, probability_of_time);
  json["log_odds_nats"] = cause.log_odds;
  const EffectColumns& effect = missions.effects()[cause.acting.cause.effect];
  for (Eigen::Index j = 0; j < effect.count; ++j) {
    const gap::ParameterName& name =
        missions.missions().front().information.parameters[static_cast<std::size_t>(effect.first + j)];
    json["parameters"][name.parameter] = cause.mean[j] * name.typical;
    json["std_errors"][name.parameter] = cause.std[j] * name.typical;
  }
  json["alternatives"] = FleetJson::array();
  for (const Alternative& other : cause.alternatives) {
    FleetJson each = possible_json(other.cause, missions);
    each["probability"] = other.probability;
    json["alternatives"].push_back(std::move(each));
  }
  return json;
}

FleetJson causes_json(const std::vector<FoundCause>& causes, const PooledMissions& missions) {
  FleetJson list = FleetJson::array();
  for (const FoundCause& cause : causes) list.push_back(cause_json(cause, missions));
  return list;
}

FleetJson vehicle_json(const VehicleAnswer& vehicle) {
  FleetJson json{{"vehicle", vehicle.vehicle}, {"verdict", name_of(vehicle.verdict)}, {"gap", vehicle.gap}};
  NAVCAL_PUT_MEMBERS(json["gap"], vehicle, closed, closed_ci);
  json["reason"] = vehicle.reason;
  return json;
}

FleetJson history_json(const CalibrationHistory& history) {
  FleetJson json{{"of", history.subject}, {"quantity", history.quantity}, {"course", name_of(history.course)}};
  if (history.course == CalibrationCourse::drift) {
    json["drift_per_day"] = history.drift_per_day;
    json["drift_per_day_std"] = history.drift_std;
  } else if (history.course == CalibrationCourse::step) {
    json["step"] = history.step;
    json["step_std"] = history.step_std;
    json["step_at"] = history.points[history.step_at].recording;
  } else if (history.course != CalibrationCourse::too_few) {
    NAVCAL_PUT_MEMBERS(json, history, mean, mean_std);
  }
  json["excess_std"] = history.excess_std;
  json["values"] = FleetJson::array();
  for (const CalibrationPoint& point : history.points) {
    json["values"].push_back({{"recording", point.recording},
                              {"vehicle", point.vehicle},
                              {"time", utc_s(point.utc_ns)},
                              {"value", point.value},
                              {"std", point.std}});
  }
  return json;
}

}  // namespace

std::string fleet_json(const FleetStory& story) {
  const PooledMissions& missions = story.missions;
  FleetJson json;
  json["causes"] = causes_json(story.answer.causes, missions);
  json["undecided"] = causes_json(story.answer.undecided, missions);
  json["tolerances"] = causes_json(story.answer.tolerances, missions);
  json["vehicles"] = FleetJson::array();
  for (const VehicleAnswer& vehicle : story.answer.vehicles) json["vehicles"].push_back(vehicle_json(vehicle));
  json["missions"] = FleetJson::array();
  for (std::size_t m = 0; m < missions.missions().size(); ++m) {
    const FleetMission& of = missions.missions()[m];
    FleetJson each = mission_json(m, missions);
    NAVCAL_PUT_MEMBERS(each, of, vehicle, design, day);
    each["gap"] = story.answer.missions[m];
    json["missions"].push_back(std::move(each));
  }
  json["calibrations"] = FleetJson::array();
  for (const CalibrationHistory& history : story.calibrations)
    json["calibrations"].push_back(history_json(history));
  json["remarks"] = story.remarks;
  return json.dump(-1, ' ', false, FleetJson::error_handler_t::replace) + "\n";
}

}  // namespace navcal::fleet
