// SPDX-License-Identifier: Apache-2.0
#include "gap/data/mission.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "base/angles.h"
#include "base/local_plane.h"
#include "instruments/compass_error.h"
#include "protocols/motor_card.h"
#include "record/json/flat_json.h"
#include "record/port_matching.h"
#include "record/recording.h"

namespace navcal::gap {
namespace {

enum Kind : std::size_t { compass, card, fixes, motor };

/// Fixes further apart belong to different surfacings.
constexpr double kSightLost_s = 3.5;
/// Shorter than this the estimator has hardly settled.
constexpr double kShortest_s = 40;

/// Puts readings into the order of their times, in seconds from begin_ns, each time once.
template <class Reading>
void set_in_order(std::vector<Reading>& readings, const std::vector<std::int64_t>& times_ns,
                  std::int64_t begin_ns) {
  for (std::size_t i = 0; i < readings.size(); ++i) {
    readings[i].time_s = static_cast<double>(times_ns[i] - begin_ns) * 1e-9;
  }
  const auto by_time = [](const Reading& a, const Reading& b) { return a.time_s < b.time_s; };
  std::stable_sort(readings.begin(), readings.end(), by_time);
  const auto same = [](const Reading& a, const Reading& b) { return a.time_s == b.time_s; };
  readings.erase(std::unique(readings.begin(), readings.end(), same), readings.end());
}

/// The model of a vehicle has its instruments at the origin. Throws record::BadRecording for others; rotations are
/// undone by the pipeline.
void expect_instruments_at_origin(const config::Settings& settings, const std::filesystem::path& file) {
  for (const config::PortSettings& port : settings.ports) {
    if (port.mounting.position_m == std::array<double, 3>{}) continue;
    throw record::BadRecording(fmt::format(
        "{}: port.{}.mounting.position_m is not 0: the diagnosis has no model of an instrument away from the "
        "vehicle's origin",
        file.string(), port.name));
  }
}

Vector3 fins_rad(const protocols::motor_card::Command& command) {
  Vector3 fins_rad{};
  for (std::size_t i = 0; i < fins_rad.size(); ++i) fins_rad[i] = command.fins_deg[i] * base::kRadiansPerDegree;
  return fins_rad;
}

/// Names what an incomplete sample lacks; the shortest list of all incomplete samples counts.
void set_lacks(std::string& lacks, std::initializer_list<std::pair<bool, std::string_view>> parts) {
  std::string words;
  for (const auto& [has, what] : parts) {
    if (!has) words.append(words.empty() ? "" : ", ").append(what);
  }
  if (lacks.empty() || words.size() < lacks.size()) lacks = words;
}

}  // namespace

std::vector<double> Mission::fix_times_s() const {
  std::vector<double> times_s;
  for (const FixReading& fix : fixes) times_s.push_back(fix.time_s);
  return times_s;
}

std::string Mission::shortcoming() const {
  std::string reasons;
  const auto add = [&](std::string_view none, const std::string& missing, std::string_view instrument,
                       std::string_view consequence) {
    if (!reasons.empty()) reasons += "; ";
    reasons += missing.empty() ? fmt::format("{}: {}", none, consequence)
                               : fmt::format("the {} reports no {}: {}", instrument, missing, consequence);
  };
  if (card.empty())
    add("no inertial card in the recording", lacks.card, "inertial unit",
        "nothing carries the motion from sample to sample");
  if (compass.empty())
    add("no compass with field and tilt in the recording", lacks.compass, "compass", "heading is not known");
  if (motor.empty())
    add("no motor card in the recording", lacks.motor, "motor card",
        "what the vehicle was told to do is not known");
  if (!reasons.empty()) return reasons;
  if (duration_s < kShortest_s) {
    return fmt::format("the recording lasts {:.1f} s; at least {:.0f} s are needed", duration_s, kShortest_s);
  }
  return {};
}

void MissionGatherer::on_sample(const instruments::Sample& sample) {
  const std::int64_t time_ns = sample.stamp.validity_ns;
  std::visit(
      [&](const auto& value) {
        if constexpr (requires { add(value, time_ns); }) add(value, time_ns);
      },
      sample.value);
}

void MissionGatherer::add(const instruments::CompassSample& sample, std::int64_t time_ns) {
  const instruments::CompassError error(sample.error);
  if (error.distortion) ++mission_.distorted;
  if (error.unknown) return;
  if (!sample.field_body_uT || !sample.roll_rad || !sample.pitch_rad) {
    set_lacks(mission_.lacks.compass, {{sample.field_body_uT.has_value(), "field"},
                                       {sample.roll_rad.has_value(), "roll"},
                                       {sample.pitch_rad.has_value(), "pitch"}});
    return;
  }
  mission_.compass.push_back(
      {0, sample.heading_rad, *sample.roll_rad, *sample.pitch_rad, *sample.field_body_uT, sample.temperature_C});
  times_ns_[compass].push_back(time_ns);
}

void MissionGatherer::add(const instruments::ImuSample& sample, std::int64_t time_ns) {
  if (!sample.rate_rad_s || !sample.yaw_rate_b_rad_s || !sample.specific_force_m_s2 || !sample.depth_m) {
    set_lacks(mission_.lacks.card, {{sample.rate_rad_s.has_value(), "rates"},
                                    {sample.yaw_rate_b_rad_s.has_value(), "yaw rate of a second gyro"},
                                    {sample.specific_force_m_s2.has_value(), "specific force"},
                                    {sample.depth_m.has_value(), "depth in the same sample"}});
    return;
  }
  const auto& [roll, pitch, yaw] = *sample.rate_rad_s;
  mission_.card.push_back(
      {0, {roll, yaw, pitch, *sample.yaw_rate_b_rad_s}, *sample.specific_force_m_s2, *sample.depth_m});
  times_ns_[card].push_back(time_ns);
}

void MissionGatherer::add(const instruments::GpsSample& sample, std::int64_t time_ns) {
  using instruments::Fix;
  if (!sample.latitude_rad || !sample.longitude_rad || (sample.fix != Fix::fix_2d && sample.fix != Fix::fix_3d)) {
    return;
  }
  FixReading fix;
  if (sample.speed_m_s && sample.course_rad) {
    fix.velocity_m_s = {*sample.speed_m_s * std::cos(*sample.course_rad),
                        *sample.speed_m_s * std::sin(*sample.course_rad)};
  }
  auto& first = mission_.field.place;
  if (!first) {
    first = {*sample.latitude_rad, *sample.longitude_rad, sample.height_m.value_or(0)};
    mission_.field.utc_ns = sample.time_utc_ns;
  }
  const base::LocalPlane plane(first->latitude_rad, first->longitude_rad);
  fix.position_m = plane.position_m(*sample.latitude_rad, *sample.longitude_rad);
  mission_.fixes.push_back(fix);
  times_ns_[fixes].push_back(time_ns);
}

void MissionGatherer::add(const instruments::MotorSample& sample, std::int64_t time_ns) {
  const bool has_fins = std::all_of(sample.fins_rad.begin(), sample.fins_rad.end(),
                                    [](const auto& fin_rad) { return fin_rad.has_value(); });
  if (!sample.rpm || !sample.current_A || !has_fins) {
    set_lacks(mission_.lacks.motor, {{sample.rpm.has_value(), "shaft speed (rpm)"},
                                     {sample.current_A.has_value(), "current"},
                                     {has_fins, "fin angles"}});
    return;
  }
  MotorReading reading{0, *sample.rpm, {}, *sample.current_A};
  for (std::size_t i = 0; i < 3; ++i) reading.fins_rad[i] = *sample.fins_rad[i];
  mission_.motor.push_back(reading);
  times_ns_[motor].push_back(time_ns);
}

EarthField MissionGatherer::field(const Said& said) const {
  EarthField field = mission_.field;
  if (!field.utc_ns && field.place) field.utc_ns = times_ns_[fixes].front() + said.utc_minus_stamps_ns;
  if (said.field_uT) {
    field.source = EarthField::Source::stated;
    field.north_east_down_uT = *said.field_uT;
    return field;
  }
  if (!field.place) return fitted_field(mission_.compass);
  field.set_by_model();
  return field;
}

Mission MissionGatherer::take(std::int64_t begin_ns, const Said& said) {
  mission_.field = field(said);
  set_in_order(mission_.compass, times_ns_[compass], begin_ns);
  set_in_order(mission_.card, times_ns_[card], begin_ns);
  set_in_order(mission_.fixes, times_ns_[fixes], begin_ns);
  set_in_order(mission_.motor, times_ns_[motor], begin_ns);
  int number = 0;
  for (std::size_t i = 0; i < mission_.fixes.size(); ++i) {
    auto& fix = mission_.fixes[i];
    number = i > 0 && fix.time_s - mission_.fixes[i - 1].time_s < kSightLost_s ? number + 1 : 0;
    fix.number = number;
  }
  if (!mission_.card.empty()) mission_.duration_s = mission_.card.back().time_s;
  return std::move(mission_);
}

config::Settings samples_only(config::Settings settings) {
  settings.calibration.enabled = false;
  settings.navigation.enabled = false;
  return settings;
}

Mission load_mission(const std::filesystem::path& file, const std::function<void(double)>& progress,
                     const std::optional<config::Settings>& stated) {
  const auto recording = record::Recording::open(file);
  const config::Settings& settings = stated ? *stated : recording->settings();
  expect_instruments_at_origin(settings, file);
  const record::PortMatch ports(recording->settings(), settings);
  pipeline::Pipeline pipeline(samples_only(settings));
  MissionGatherer gatherer;
  std::optional<std::int64_t> begin_ns;
  std::vector<std::int64_t> orders_ns;
  std::vector<Vector3> ordered_fins_rad;
  std::optional<protocols::motor_card::Command> last_order;
  MissionGatherer::Said said;
  while (const auto entry = recording->next()) {
    if (const auto* raw = std::get_if<record::RawRead>(&*entry)) {
      if (!begin_ns) begin_ns = raw->time_ns;
      if (raw->direction == record::Direction::received) {
        if (const auto port = ports[raw->port]) pipeline.bytes(*port, raw->time_ns, raw->bytes, gatherer);
      } else if (const auto order = protocols::motor_card::decode_command(raw->bytes);
                 order && order != last_order) {
        // A repeated order moves nothing.
        orders_ns.push_back(raw->time_ns);
        ordered_fins_rad.push_back(fins_rad(*order));
        last_order = order;
      }
    } else if (const auto* event = std::get_if<record::LoggedEvent>(&*entry); event != nullptr && !said.field_uT) {
      if (const auto json = record::FlatJson::parse(event->json))
        said.field_uT = stated_field_uT(json->get("message"));
    } else if (const auto* change = std::get_if<record::MappingChange>(&*entry)) {
      pipeline.set_mapping(change->mapping, gatherer);
      if (change->mapping.source != pipeline::UtcMapping::Source::none) {
        said.utc_minus_stamps_ns = change->mapping.offset_ns;
      }
    }
    progress(recording->progress());
  }
  Mission mission = gatherer.take(begin_ns.value_or(0), said);
  // The samples are in body axes already.
  mission.instruments = devices::without_mounting(devices::instrument_model(settings));
  for (const std::int64_t time_ns : orders_ns) {
    mission.order_times_s.push_back(static_cast<double>(time_ns - *begin_ns) * 1e-9);
  }
  mission.ordered_fins_rad = std::move(ordered_fins_rad);
  if (mission.distorted > 0) {
    mission.remarks.push_back(fmt::format("{}: {} words with E001: the compass reports magnetic distortion",
                                          file.string(), mission.distorted));
  }
  for (const auto& port : ports.missing()) {
    mission.remarks.push_back(
        fmt::format("{}: port {} is not in the configuration: left out", file.string(), port));
  }
  for (const auto& remark : recording->remarks()) mission.remarks.push_back(file.string() + ": " + remark);
  return mission;
}

}  // namespace navcal::gap
