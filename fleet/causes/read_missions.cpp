// SPDX-License-Identifier: Apache-2.0
#include "fleet/causes/read_missions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/angles.h"
#include "base/failure.h"
#include "base/utc_text.h"
#include "fleet/causes/information_json.h"
#include "fleet/causes/limits.h"

namespace navcal::fleet {
namespace {

using AnswerJson = nlohmann::ordered_json;

/// The vehicle that a recording names, else the folder that it lies in.
std::string vehicle_named(const AnswerJson& identity, const std::filesystem::path& file) {
  const auto id = identity.at("vehicle_id").get<std::string>();
  return id.empty() ? file.parent_path().filename().string() : id;
}

/// Short name of a nominal vehicle, by its hash.
std::string design_of(const std::string& vehicle) { return "design " + vehicle.substr(0, 8); }

/// Distance on a sphere of the Earth's mean radius, m; enough to tell waters apart.
double distance_m(const base::GeodeticPosition& a, const base::GeodeticPosition& b) {
  constexpr double kEarth_m = 6.371e6;
  const double north = a.latitude_rad - b.latitude_rad;
  const double east = std::remainder(a.longitude_rad - b.longitude_rad, 2 * M_PI) *
                      std::cos(0.5 * (a.latitude_rad + b.latitude_rad));
  return kEarth_m * std::hypot(north, east);
}

std::string text_of(const base::GeodeticPosition& place) {
  const double latitude = place.latitude_rad * base::kDegreesPerRadian;
  const double longitude = place.longitude_rad * base::kDegreesPerRadian;
  return fmt::format("{:.2f} {} {:.2f} {}", std::abs(latitude), latitude < 0 ? 'S' : 'N', std::abs(longitude),
                     longitude < 0 ? 'W' : 'E');
}

/// Names the days: missions of one date whose first fixes are near each other share one.
void set_days(std::vector<FleetMission>& missions) {
  struct Water {
    base::GeodeticPosition place;
    std::vector<FleetMission*> missions;
  };
  std::map<std::string, std::vector<Water>> dates;
  for (FleetMission& mission : missions) {
    const auto& of = mission.information;
    if (!of.utc_ns || !of.place) {
      mission.day = "day of " + mission.recording;
      continue;
    }
    auto& waters = dates[base::utc_date_text(*of.utc_ns)];
    auto found = std::ranges::find_if(
        waters, [&](const Water& water) { return distance_m(water.place, *of.place) < kSameWater_m; });
    if (found == waters.end()) found = waters.insert(found, {*of.place, {}});
    found->missions.push_back(&mission);
  }
  for (auto& [date, waters] : dates) {
    for (Water& water : waters) {
      for (FleetMission* mission : water.missions) {
        mission->day = waters.size() > 1 ? date + " at " + text_of(water.place) : date;
      }
    }
  }
}

/// The mission of an answer; nullopt: the recording cannot be compared, and a remark says why.
std::optional<FleetMission> mission_of(const Task& task, const std::string& path, const std::string& text,
                                       std::vector<std::string>& remarks) {
  const std::filesystem::path file(path);
  const std::string name = file.filename().string();
  try {
    const AnswerJson answer = AnswerJson::parse(text);
    if (answer.at("information").is_null()) {
      remarks.push_back(fmt::format("{} (task {}): {}", name, task.number, answer.value("shortcoming", "")));
      return std::nullopt;
    }
    FleetMission mission;
    mission.information = information_from(answer.at("information"));
    mission.vehicle_error = answer.at("vehicle_error").get<std::vector<double>>();
    mission.recording = name;
    const AnswerJson& identity = answer.at("identity");
    mission.vehicle = vehicle_named(identity, file);
    mission.design = design_of(task.vehicle);
    const AnswerJson& began = identity.at("began_utc_ns");
    mission.utc_ns = mission.information.utc_ns.value_or(began.is_null() ? 0 : began.get<std::int64_t>());
    return mission;
  } catch (const std::exception& error) {
    throw base::Failure(base::Exit::bad_input,
                        fmt::format("the answer of task {} ({}) is damaged: {}", task.number, name, error.what()));
  }
}

}  // namespace

namespace {

/// A value of a calibrator and its standard deviation: paths within the calibrator's object, and the device that
/// is calibrated.
struct CalibratedValue {
  const char* calibrator;
  const char* value;
  const char* std;
  const char* serial;  ///< key of the identity
};
constexpr std::array kCalibratedValues{
    CalibratedValue{"gyro", "/scale", "/scale_std", "gyro_serial"},
    CalibratedValue{"gyro", "/bias_rad_s", "/bias_std", "gyro_serial"},
    CalibratedValue{"gyro_b", "/scale", "/scale_std", "gyro_serial"},
    CalibratedValue{"gyro_b", "/bias_rad_s", "/bias_std", "gyro_serial"},
    CalibratedValue{"compass", "/deviation_deg", "/deviation_std_deg", "compass_serial"},
    CalibratedValue{"gps_compass", "/deviation_deg", "/deviation_std_deg", "compass_serial"},
    CalibratedValue{"magnetometer", "/offset_uT", "/std/offset_uT", "compass_serial"},
    CalibratedValue{"magnetometer", "/matrix", "/std/matrix", "compass_serial"},
    CalibratedValue{"motor_current", "/slope_uT_per_A", "/std", "compass_serial"},
    CalibratedValue{"misalignment", "/estimate", "/std", "gyro_serial"},
    CalibratedValue{"swing", "/estimate", "/std", "compass_serial"},
    CalibratedValue{"compass_delay", "/estimate", "/std", "compass_serial"},
    CalibratedValue{"reference_compass", "/estimate", "/std", "compass_serial"},
    CalibratedValue{"reference_field", "/estimate", "/std", "compass_serial"}};

using Histories = std::map<std::pair<std::string, std::string>, CalibrationHistory>;

/// Adds a number and its standard deviation, or all that lie below two objects or lists of the same shape.
void add_points(const AnswerJson& value, const AnswerJson& std, const std::string& subject,
                const std::string& quantity, const CalibrationPoint& of, Histories& histories) {
  if (value.is_number() && std.is_number() && std.get<double>() > 0) {
    CalibrationHistory& history = histories[{subject, quantity}];
    history.subject = subject;
    history.quantity = quantity;
    history.points.push_back({of.recording, of.vehicle, of.utc_ns, value.get<double>(), std.get<double>()});
  } else if (value.is_object() && std.is_object()) {
    for (const auto& [key, each] : value.items()) {
      if (std.contains(key))
        add_points(each, std.at(key), subject, fmt::format("{}.{}", quantity, key), of, histories);
    }
  } else if (value.is_array() && std.is_array()) {
    for (std::size_t i = 0; i < std::min(value.size(), std.size()); ++i) {
      add_points(value[i], std[i], subject, fmt::format("{}[{}]", quantity, i), of, histories);
    }
  }
}

void add_calibration(const AnswerJson& answer, const std::filesystem::path& file, Histories& histories) {
  const AnswerJson& identity = answer.at("identity");
  if (identity.at("began_utc_ns").is_null()) return;
  const CalibrationPoint of{file.filename().string(), vehicle_named(identity, file),
                            identity.at("began_utc_ns").get<std::int64_t>(), 0, 0};
  for (const CalibratedValue& each : kCalibratedValues) {
    const auto calibrator = answer.find(each.calibrator);
    if (calibrator == answer.end() || !calibrator->value("accepted", false)) continue;
    const AnswerJson::json_pointer value(each.value), std(each.std);
    if (!calibrator->contains(value) || !calibrator->contains(std)) continue;
    const auto serial = identity.at(each.serial).get<std::string>();
    const std::string subject = serial.empty() ? of.vehicle : "serial number " + serial;
    add_points(calibrator->at(value), calibrator->at(std), subject,
               fmt::format("{}{}", each.calibrator, std::string(each.value).replace(0, 1, ".")), of, histories);
  }
}

}  // namespace

std::vector<CalibrationHistory> read_calibrations(const Plan& plan, const ResultStore& results) {
  const ResultStore::States states = results.states();
  Histories histories;
  std::map<std::string, const Task*> latest;  // of each recording
  for (const Task& task : plan.tasks) {
    if (task.job == "calibrate" && state_in(states, task) == TaskState::done) latest[task.recording] = &task;
  }
  for (const auto& [recording, task] : latest) {
    const auto file = plan.recordings.find(recording);
    const auto text = results.text_of(*task, TaskState::done);
    if (file == plan.recordings.end() || !text) continue;
    try {
      add_calibration(AnswerJson::parse(*text), file->second.path, histories);
    } catch (const nlohmann::json::exception& error) {
      throw base::Failure(base::Exit::bad_input, fmt::format("the answer of task {} ({}) is damaged: {}",
                                                             task->number, file->second.path, error.what()));
    }
  }
  std::vector<CalibrationHistory> judged;
  for (auto& [key, history] : histories) {
    judge_course(history);
    judged.push_back(std::move(history));
  }
  return judged;
}

MissionsRead read_missions(const Plan& plan, const ResultStore& results) {
  MissionsRead read;
  const ResultStore::States states = results.states();
  std::map<std::string, const Task*> latest;  // of each recording
  for (const Task& task : plan.tasks) {
    if (task.job == "evidence") latest[task.recording] = &task;
  }
  for (const auto& [recording, task] : latest) {
    const auto file = plan.recordings.find(recording);
    const TaskState state = state_in(states, *task);
    const auto text = results.text_of(*task, state);
    if (file == plan.recordings.end() || state == TaskState::open || !text) {
      ++read.open;
    } else if (state == TaskState::failed) {
      ++read.failed;
      read.remarks.push_back(fmt::format("{} (task {}): {}", file->second.path, task->number, *text));
    } else if (auto mission = mission_of(*task, file->second.path, *text, read.remarks)) {
      read.missions.push_back(std::move(*mission));
    }
  }
  set_days(read.missions);
  return read;
}

}  // namespace navcal::fleet
