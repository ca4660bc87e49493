// SPDX-License-Identifier: Apache-2.0
#include "gap/data/mission.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "base/angles.h"
#include "base/local_plane.h"
#include "instruments/compass_error.h"
#include "record/json/flat_json.h"
#include "record/port_matching.h"

namespace navcal::gap {
namespace {

constexpr double kUnmeasured = std::numeric_limits<double>::quiet_NaN();
constexpr Vector3 kUnmeasuredVector{kUnmeasured, kUnmeasured, kUnmeasured};

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
  std::ranges::stable_sort(readings, by_time);
  const auto same = [](const Reading& a, const Reading& b) { return a.time_s == b.time_s; };
  readings.erase(std::unique(readings.begin(), readings.end(), same), readings.end());
}

/// Adds the parts of incomplete samples where there are no complete ones.
template <class Reading>
void fill_silences(std::vector<Reading>& readings, const std::vector<Reading>& parts, double until_s) {
  if (parts.empty()) return;
  std::vector<double> times_s(readings.size());
  std::ranges::transform(readings, times_s.begin(), &Reading::time_s);
  const auto silences = silences_of(Quantity::heading, times_s, until_s);
  for (const Reading& part : parts) {
    const bool needed = std::ranges::any_of(silences, [&](const Silence& silence) {
      return part.time_s >= silence.from_s && part.time_s <= silence.until_s;
    });
    if (needed) readings.push_back(part);
  }
  std::ranges::stable_sort(readings, {}, &Reading::time_s);
}

template <class Reading>
double last_s(const std::vector<Reading>& readings) {
  return readings.empty() ? 0 : readings.back().time_s;
}

/// The model of a vehicle has its instruments at the origin. Throws record::BadRecording for others; rotations are
/// undone by the pipeline.
void expect_instruments_at_origin(const config::Settings& settings, const std::filesystem::path& file) {
  for (const config::PortSettings& port : settings.ports) {
    if (port.mounting.position_m == std::array<double, 3>{}) continue;
    throw record::BadRecording(
        fmt::format("{}: port.{}.mounting.position_m is not 0: the diagnosis has no model of an instrument away "
                    "from the vehicle's origin",
                    file.string(), port.name));
  }
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

Order order_of(const protocols::motor_card::Command& command, double time_s) {
  Order order{time_s, static_cast<double>(command.rpm), {}};
  for (std::size_t i = 0; i < 3; ++i) order.fins_rad[i] = command.fins_deg[i] * base::kRadiansPerDegree;
  return order;
}

std::vector<double> Mission::fix_times_s() const {
  std::vector<double> times_s;
  for (const FixReading& fix : fixes) times_s.push_back(fix.time_s);
  return times_s;
}

bool Mission::is_silent(Quantity quantity, double time_s) const {
  return std::ranges::any_of(silences, [&](const Silence& silence) {
    return silence.quantity == quantity && silence.contains(time_s, duration_s);
  });
}

bool Mission::is_silent(Quantity quantity) const {
  return std::ranges::any_of(silences, [&](const Silence& silence) { return silence.quantity == quantity; });
}

void Mission::take_order_times() {
  order_times_s.clear();
  ordered_fins_rad.clear();
  for (const Order& order : orders) {
    order_times_s.push_back(order.time_s);
    ordered_fins_rad.push_back(order.fins_rad);
  }
}

std::string Mission::shortcoming() const {
  if (motor.empty() && orders.empty()) {
    std::string reason = lacks.motor.empty() ? "no motor card in the recording, and no commands"
                                             : fmt::format("the motor card reports no {}", lacks.motor);
    reason += ": what the vehicle was told to do is not known";
    if (!outputs.empty()) {
      reason += fmt::format(
          ". The recording has outputs ({}), and nothing says what they move: a map to rpm_commanded and fin_1 to "
          "fin_3 does (navcal log import --map)",
          fmt::join(outputs, ", "));
    }
    return reason;
  }
  const auto is_missing = [&](Quantity quantity) {
    return std::ranges::any_of(silences, [&](const Silence& silence) {
      return silence.quantity == quantity && silence.from_s <= 0 && silence.until_s >= duration_s;
    });
  };
  using enum Quantity;
  const auto measured = {heading, field, tilt, rates, force, depth, fixes};
  if (std::ranges::all_of(measured, is_missing)) {
    return "no instrument in the recording shows how the vehicle moved: nothing can be said";
  }
  const double judged_s = std::min(judged_until_s, duration_s) - judged_from_s;
  if (judged_s < kShortest_s) {
    return judged_s < duration_s
               ? fmt::format("the motor card reports for {:.1f} s of the recording; at least {:.0f} s are needed",
                             judged_s, kShortest_s)
               : fmt::format("the recording lasts {:.1f} s; at least {:.0f} s are needed", duration_s,
                             kShortest_s);
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
  const bool has_tilt = sample.roll_rad && sample.pitch_rad;
  const CompassReading reading{0,
                               sample.heading_rad,
                               has_tilt ? *sample.roll_rad : kUnmeasured,
                               has_tilt ? *sample.pitch_rad : kUnmeasured,
                               sample.field_body_uT.value_or(kUnmeasuredVector),
                               sample.temperature_C};
  if (sample.field_body_uT && has_tilt) return compass_.add(reading, time_ns);
  set_lacks(mission_.lacks.compass, {{sample.field_body_uT.has_value(), "field"},
                                     {sample.roll_rad.has_value(), "roll"},
                                     {sample.pitch_rad.has_value(), "pitch"}});
  if (!sample.field_body_uT && !has_tilt && !sample.heading_rad) return;
  compass_parts_.add(reading, time_ns);
  heading_is_true_.push_back(sample.heading_is_true);
}

void MissionGatherer::add(const instruments::ImuSample& sample, std::int64_t time_ns) {
  const auto [roll, pitch, yaw] = sample.rate_rad_s.value_or(kUnmeasuredVector);
  const CardReading reading{0,
                            {roll, yaw, pitch, sample.yaw_rate_b_rad_s.value_or(kUnmeasured)},
                            sample.specific_force_m_s2.value_or(kUnmeasuredVector),
                            sample.depth_m.value_or(kUnmeasured)};
  if (sample.rate_rad_s && sample.yaw_rate_b_rad_s && sample.specific_force_m_s2 && sample.depth_m) {
    return card_.add(reading, time_ns);
  }
  set_lacks(mission_.lacks.card, {{sample.rate_rad_s.has_value(), "rates"},
                                  {sample.yaw_rate_b_rad_s.has_value(), "yaw rate of a second gyro"},
                                  {sample.specific_force_m_s2.has_value(), "specific force"},
                                  {sample.depth_m.has_value(), "depth in the same sample"}});
  if (sample.rate_rad_s || sample.specific_force_m_s2 || sample.depth_m) card_parts_.add(reading, time_ns);
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
  fixes_.add(fix, time_ns);
}

void MissionGatherer::add(const instruments::MotorSample& sample, std::int64_t time_ns) {
  const bool has_fins =
      std::ranges::all_of(sample.fins_rad, [](const auto& fin_rad) { return fin_rad.has_value(); });
  Vector3 fins_rad{};
  for (std::size_t i = 0; has_fins && i < 3; ++i) fins_rad[i] = *sample.fins_rad[i];
  if (sample.rpm && sample.current_A && has_fins) {
    return motor_.add({0, *sample.rpm, fins_rad, *sample.current_A}, time_ns);
  }
  set_lacks(mission_.lacks.motor, {{sample.rpm.has_value(), "shaft speed (rpm)"},
                                   {sample.current_A.has_value(), "current"},
                                   {has_fins, "fin angles"}});
  if (!has_fins) return;
  if (sample.rpm) {
    motor_parts_.add({0, *sample.rpm, fins_rad, kUnmeasured}, time_ns);
  } else if (sample.rpm_commanded) {
    // An autopilot's outputs: without a measured speed, the angles are commands, too.
    orders_.add({0, *sample.rpm_commanded, fins_rad}, time_ns);
  }
}

void MissionGatherer::add(const instruments::ScalarSample& sample, std::int64_t /*time_ns*/) {
  constexpr std::size_t kMostOutputs = 16;
  const std::string_view name = sample.quantity.view();
  // Outputs of an autopilot as navcal log import names them (docs/import.md).
  const auto is_output = [&](std::string_view kind) {
    return name.starts_with(kind) && name.size() > kind.size() &&
           name.find_first_not_of("0123456789", kind.size()) == std::string_view::npos;
  };
  if (!is_output("output") && !is_output("motor") && !is_output("servo")) return;
  auto& outputs = mission_.outputs;
  const auto place = std::ranges::lower_bound(outputs, name);
  if (outputs.size() < kMostOutputs && (place == outputs.end() || *place != name)) outputs.emplace(place, name);
}

EarthField MissionGatherer::field(const Said& said) const {
  EarthField field = mission_.field;
  if (!field.utc_ns && field.place) field.utc_ns = fixes_.times_ns.front() + said.utc_minus_stamps_ns;
  if (said.field_uT) {
    field.source = EarthField::Source::stated;
    field.north_east_down_uT = *said.field_uT;
    return field;
  }
  if (!field.place) return fitted_field(compass_.readings.empty() ? compass_parts_.readings : compass_.readings);
  field.set_by_model();
  return field;
}

Mission MissionGatherer::take(std::int64_t begin_ns, const Said& said) {
  mission_.field = field(said);
  const auto& [north_uT, east_uT, down_uT] = mission_.field.north_east_down_uT;
  for (std::size_t i = 0; i < heading_is_true_.size(); ++i) {
    auto& heading_rad = compass_parts_.readings[i].heading_rad;
    if (heading_rad && heading_is_true_[i]) *heading_rad -= std::atan2(east_uT, north_uT);
  }
  const auto in_order = [&](auto& gathered) {
    set_in_order(gathered.readings, gathered.times_ns, begin_ns);
    return std::move(gathered.readings);
  };
  mission_.compass = in_order(compass_);
  mission_.card = in_order(card_);
  mission_.fixes = in_order(fixes_);
  mission_.motor = in_order(motor_);
  const auto compass_parts = in_order(compass_parts_);
  const auto card_parts = in_order(card_parts_);
  const auto motor_parts = in_order(motor_parts_);
  for (const Order& order : in_order(orders_)) {
    mission_.commanded_s.push_back(order.time_s);
    const bool is_repeated = !mission_.orders.empty() && mission_.orders.back().rpm == order.rpm &&
                             mission_.orders.back().fins_rad == order.fins_rad;
    if (!is_repeated) mission_.orders.push_back(order);
  }
  const double end_s =
      std::max({last_s(mission_.compass), last_s(mission_.card), last_s(mission_.motor), last_s(mission_.fixes),
                last_s(compass_parts), last_s(card_parts), last_s(motor_parts), last_s(mission_.orders)});
  fill_silences(mission_.compass, compass_parts, end_s);
  fill_silences(mission_.card, card_parts, end_s);
  fill_silences(mission_.motor, motor_parts, end_s);
  int number = 0;
  for (std::size_t i = 0; i < mission_.fixes.size(); ++i) {
    auto& fix = mission_.fixes[i];
    number = i > 0 && fix.time_s - mission_.fixes[i - 1].time_s < kSightLost_s ? number + 1 : 0;
    fix.number = number;
  }
  mission_.duration_s = end_s - last_s(mission_.card) > kSilent_s ? end_s : last_s(mission_.card);
  return std::move(mission_);
}

config::Settings samples_only(config::Settings settings) {
  settings.calibration.enabled = false;
  settings.navigation.enabled = false;
  return settings;
}

Mission load_mission(const std::filesystem::path& file, const std::function<void(double)>& progress,
                     const std::optional<config::Settings>& stated, const record::TimeWindow& window) {
  const auto recording = record::Recording::open(file, window);
  const config::Settings& settings = stated ? *stated : recording->settings();
  expect_instruments_at_origin(settings, file);
  const record::PortMatch ports(recording->settings(), settings);
  pipeline::Pipeline pipeline(samples_only(settings));
  MissionGatherer gatherer;
  std::optional<std::int64_t> begin_ns;
  std::vector<double> commanded_s;
  std::vector<Order> orders;
  std::optional<protocols::motor_card::Command> last_order;
  MissionGatherer::Said said;
  while (const auto entry = recording->next()) {
    ports.give(*entry, pipeline, gatherer);
    if (const auto* raw = std::get_if<record::RawRead>(&*entry)) {
      if (!begin_ns) begin_ns = raw->time_ns;
      if (const auto order = record::sent_command(*entry)) {
        commanded_s.push_back(static_cast<double>(raw->time_ns - *begin_ns) * 1e-9);
        // A repeated order moves nothing.
        if (order != last_order) {
          orders.push_back(order_of(*order, commanded_s.back()));
        }
        last_order = order;
      }
    } else if (const auto* event = std::get_if<record::LoggedEvent>(&*entry); event != nullptr && !said.field_uT) {
      if (const auto json = record::FlatJson::parse(event->json))
        said.field_uT = stated_field_uT(json->get("message"));
    } else if (const auto* change = std::get_if<record::MappingChange>(&*entry)) {
      if (change->mapping.source != pipeline::UtcMapping::Source::none) {
        said.utc_minus_stamps_ns = change->mapping.offset_ns;
      }
    }
    progress(recording->progress());
  }
  Mission mission = gatherer.take(begin_ns.value_or(0), said);
  // The samples are in body axes already.
  mission.instruments = devices::without_mounting(devices::instrument_model(settings));
  if (!orders.empty()) {
    mission.orders = std::move(orders);
    mission.commanded_s = std::move(commanded_s);
  }
  mission.take_order_times();
  find_silences(mission);
  if (mission.distorted > 0) {
    mission.remarks.push_back(fmt::format("{}: {} words with E001: the compass reports magnetic distortion",
                                          file.string(), mission.distorted));
  }
  for (std::string& remark : ports.remarks(file.string())) mission.remarks.push_back(std::move(remark));
  mission.remarks.insert(mission.remarks.end(), recording->remarks().begin(), recording->remarks().end());
  return mission;
}

}  // namespace navcal::gap
