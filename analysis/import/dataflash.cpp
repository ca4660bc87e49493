// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "analysis/import/dataflash_plan.h"
#include "analysis/import/gps_week.h"
#include "analysis/import/log_readers.h"
#include "analysis/import/port_name.h"
#include "analysis/import/servo_parameters.h"
#include "base/angles.h"
#include "instruments/autopilot_compass.h"

namespace navcal::analysis {
namespace {

using dataflash::Kind;
using dataflash::Plan;
using dataflash::Table;
using protocols::samples_line::LineWriter;

constexpr std::string_view kSync = "\xA3\x95";
constexpr int kNoInstance = -1;

/// Reads the records of one file, from front to back.
class DataFlashFile {
 public:
  DataFlashFile(std::string_view file, ImportSink& sink, MotorChannels& channels, bool undoes_calibration)
      : file_(file), sink_(sink), channels_(channels), undoes_calibration_(undoes_calibration) {}
  ImportFindings read();

 private:
  /// Length of the record at `at_`, 0 when none begins there.
  [[nodiscard]] std::size_t length_here() const;
  void read_records(const std::function<void(std::uint8_t, std::string_view)>& on_record);
  const Plan& plan_of(std::uint8_t type);
  void take(std::uint8_t type, std::string_view record);
  void take_known(const Plan& plan, std::uint8_t type, std::string_view record);
  /// Shaft and fins that the map makes of a record; false: none.
  bool take_channels(const Plan& plan, std::uint8_t type, std::string_view record);
  [[nodiscard]] bool has_instances(std::uint8_t type) const { return table_[type].instance() != nullptr; }
  const std::string& label(std::uint8_t type, int instance, bool has_instances);

  void take_imu(const Plan& plan, std::string_view record, ImportedSample sample);
  void take_mag(const Plan& plan, std::string_view record, ImportedSample sample);
  void take_baro(const Plan& plan, std::string_view record, ImportedSample sample);
  void take_gps(const Plan& plan, std::string_view record, ImportedSample sample);
  void take_attitude(const Plan& plan, std::string_view record, ImportedSample sample);
  void take_battery(const Plan& plan, std::string_view record, ImportedSample sample);
  void take_outputs(const Plan& plan, std::string_view record, ImportedSample sample);
  void take_text(const Plan& plan, std::string_view record);
  void take_compass_parameter(const Plan& plan, std::string_view record);
  /// Field without the autopilot's calibration; as it is logged where that is not known.
  std::array<double, 3> measured_uT(const Plan& plan, std::string_view record);

  [[nodiscard]] std::optional<double> field(const Plan& plan, std::string_view record, std::size_t i) const {
    return plan.field(table_, record, i);
  }
  [[nodiscard]] std::array<double, 3> vector(const Plan& plan, std::string_view record, std::size_t first) const {
    return {field(plan, record, first).value_or(NAN), field(plan, record, first + 1).value_or(NAN),
            field(plan, record, first + 2).value_or(NAN)};
  }

  std::string_view file_;
  ImportSink& sink_;
  MotorChannels& channels_;
  ServoParameters servos_;
  ImportFindings findings_;
  std::size_t at_ = 0;
  Table table_;
  std::array<Plan, 256> plans_;
  std::map<std::pair<std::uint8_t, int>, std::string> labels_;
  std::map<int, std::array<std::optional<double>, 3>> accuracies_;  ///< newest GPA of each receiver
  std::optional<double> heading_std_rad_;                           ///< by the newest XKV1
  bool is_submarine_ = false;  ///< ArduSub: its primary barometer is in the water
  std::int64_t primary_baro_ = 0;
  bool undoes_calibration_;
  instruments::AutopilotCompass compass_;
};

std::size_t DataFlashFile::length_here() const {
  const std::string_view rest = file_.substr(at_);
  if (rest.size() < dataflash::kHead_bytes || !rest.starts_with(kSync)) return 0;
  return table_[static_cast<std::uint8_t>(rest[2])].length;
}

// Fields are logged before all parameters are. So the first value of each, which the second reading overwrites,
// holds from the beginning.
ImportFindings DataFlashFile::read() {
  constexpr std::size_t kProgressBytes = 1 << 16;
  std::set<std::string, std::less<>> taken;
  read_records([&](std::uint8_t type, std::string_view record) {
    if (table_.learn(type, record)) return;
    const Plan& plan = plan_of(type);
    if (plan.kind() == Kind::parameter && taken.emplace(plan.text(record, 0)).second)
      take_compass_parameter(plan, record);
  });
  table_ = Table();
  plans_.fill({});
  findings_ = {};
  std::size_t told = 0;
  read_records([&](std::uint8_t type, std::string_view record) {
    take(type, record);
    if (at_ - told >= kProgressBytes) sink_.progress(told = at_);
  });
  if (std::string words = servos_.words(); !words.empty()) findings_.remarks.push_back(std::move(words));
  return std::move(findings_);
}

void DataFlashFile::read_records(const std::function<void(std::uint8_t, std::string_view)>& on_record) {
  for (at_ = 0; at_ < file_.size();) {
    const std::size_t length = length_here();
    const std::size_t rest = file_.size() - at_;
    if (length > rest || (length == 0 && rest < dataflash::kHead_bytes)) {
      findings_.cut_at = at_;
      break;
    }
    if (length == 0) {
      const std::size_t next = std::min(file_.find(kSync, at_ + 1), file_.size());
      findings_.damaged_bytes += next - at_;
      at_ = next;
    } else {
      const std::string_view record = file_.substr(at_, length);
      at_ += length;
      on_record(static_cast<std::uint8_t>(record[2]), record);
    }
  }
}

const Plan& DataFlashFile::plan_of(std::uint8_t type) {
  Plan& plan = plans_[type];
  if (plan.version() != table_.version()) plan = Plan(table_, table_[type]);
  return plan;
}

void DataFlashFile::take(std::uint8_t type, std::string_view record) {
  if (table_.learn(type, record)) return;
  const Plan& plan = plan_of(type);
  const std::string& name = label(type, 0, false);
  if (plan.kind() == Kind::parameter || plan.kind() == Kind::text) take_text(plan, record);
  const bool is_mapped = take_channels(plan, type, record);
  if (is_mapped && plan.kind() == Kind::other) return;
  if (!plan.why_not().empty() && plan.kind() != Kind::other) {
    sink_.left(fmt::format("{} ({})", name, plan.why_not()));
  } else if (plan.kind() == Kind::other || plan.kind() == Kind::parameter || plan.kind() == Kind::text) {
    sink_.left(name);
  } else {
    take_known(plan, type, record);
  }
}

void DataFlashFile::take_known(const Plan& plan, std::uint8_t type, std::string_view record) {
  const int instance = plan.instance(record);
  const auto time_ns = plan.time_ns(record);
  const std::string& name = label(type, instance, has_instances(type));
  if (!time_ns) return sink_.left(fmt::format("{} (impossible time)", name));
  ImportedSample sample{name, {}, *time_ns};
  switch (plan.kind()) {
    case Kind::imu: sample.port = port_name(PortKind::imu, instance); return take_imu(plan, record, sample);
    case Kind::mag: sample.port = port_name(PortKind::compass, instance); return take_mag(plan, record, sample);
    case Kind::baro: return take_baro(plan, record, sample);
    case Kind::gps: sample.port = port_name(PortKind::gps, instance); return take_gps(plan, record, sample);
    case Kind::gps_accuracy:
      accuracies_[instance] = {field(plan, record, 0), field(plan, record, 1), field(plan, record, 2)};
      return sink_.left(fmt::format("{} (its errors go with the next fix)", name));
    case Kind::state_variances:
      heading_std_rad_ = heading_std_of(field(plan, record, 0), field(plan, record, 1));
      return sink_.left(fmt::format("{} (its error of the heading goes with the next attitude)", name));
    case Kind::attitude:
      sample.port = port_name(PortKind::attitude, instance);
      return take_attitude(plan, record, sample);
    case Kind::battery:
      sample.port = port_name(PortKind::battery, instance);
      return take_battery(plan, record, sample);
    default: sample.port = port_name(PortKind::motor, instance); return take_outputs(plan, record, sample);
  }
}

bool DataFlashFile::take_channels(const Plan& plan, std::uint8_t type, std::string_view record) {
  const std::string& name = label(type, plan.instance(record), has_instances(type));
  if (!channels_.has(name)) return false;
  const auto time_ns = plan.time_ns(record);
  if (!time_ns) return false;
  const auto read = [&](std::string_view member) -> std::optional<double> {
    const dataflash::Column* const column = table_[type].find(member);
    return column == nullptr ? std::nullopt : table_.value(*column, record);
  };
  return channels_.emit(name, read, {name, {}, *time_ns}, sink_);
}

const std::string& DataFlashFile::label(std::uint8_t type, int instance, bool has_instances) {
  std::string& name = labels_[{type, has_instances ? instance : kNoInstance}];
  if (name.empty()) {
    name = table_[type].name.empty() ? fmt::format("type {}", type) : table_[type].name;
    if (has_instances) name += fmt::format("[{}]", instance);
  }
  return name;
}

void DataFlashFile::take_imu(const Plan& plan, std::string_view record, ImportedSample sample) {
  LineWriter line("IMU");
  line.vector("rate_rad_s", vector(plan, record, 0)).vector("specific_force_m_s2", vector(plan, record, 3));
  line.number("temperature_C", field(plan, record, 6));
  sink_.sample(sample, line);
}

void DataFlashFile::take_mag(const Plan& plan, std::string_view record, ImportedSample sample) {
  if (field(plan, record, 3).value_or(1) == 0) return sink_.left(fmt::format("{} (not healthy)", sample.message));
  LineWriter line("COMPASS");
  line.vector("field_body_uT", measured_uT(plan, record));
  sink_.sample(sample, line);
}

std::array<double, 3> DataFlashFile::measured_uT(const Plan& plan, std::string_view record) {
  enum : std::size_t { sent = 0, motor = 4, offset = 7 };
  instruments::Vector3 field_uT = vector(plan, record, sent);
  const int unit = plan.instance(record);
  if (undoes_calibration_ && unit >= 0 && unit < instruments::AutopilotCompass::kUnits) {
    compass_.take_offset(unit, vector(plan, record, offset));
    instruments::Vector3 without_motor_uT = field_uT;
    for (std::size_t axis = 0; axis < 3; ++axis)
      without_motor_uT[axis] -= field(plan, record, motor + axis).value_or(0);
    if (const auto measured = compass_.measured_uT(unit, without_motor_uT, std::nullopt)) return *measured;
  }
  findings_.has_corrected_fields = true;
  return field_uT;
}

void DataFlashFile::take_baro(const Plan& plan, std::string_view record, ImportedSample sample) {
  const int instance = plan.instance(record);
  const bool is_depth = is_submarine_ && instance == primary_baro_;
  sample.port = is_depth ? port_name(PortKind::depth, 0) : port_name(PortKind::baro, instance);
  LineWriter line("DEPTH");
  const auto altitude_m = field(plan, record, 2);
  if (is_depth && altitude_m) line.number("depth_m", -*altitude_m);
  line.number("pressure_Pa", field(plan, record, 0)).number("temperature_C", field(plan, record, 1));
  sink_.sample(sample, line);
}

void DataFlashFile::take_gps(const Plan& plan, std::string_view record, ImportedSample sample) {
  enum : std::size_t { status, ms, week, satellites, dop, lat, lon, height, speed, course, down };
  constexpr std::int64_t kLeast2d = 2, kLeast3d = 3, kMostWeek = 10'000, kWeek_ms = 604'800'000;
  const std::int64_t quality = plan.integer(record, status).value_or(0);
  const auto of_week = plan.integer(record, ms), number = plan.integer(record, week);
  if (number && of_week && *number > 0 && *number < kMostWeek && *of_week >= 0 && *of_week < kWeek_ms) {
    sample.utc_ns = utc_of_gps_week(*number, *of_week);
    if (quality >= kLeast3d) sink_.utc(sample.time_ns, *sample.utc_ns);
  }
  LineWriter line("GPS");
  line.text("fix", quality >= kLeast3d ? "3d" : quality == kLeast2d ? "2d" : "none");
  if (quality >= kLeast2d) {
    line.number("lat", field(plan, record, lat)).number("lon", field(plan, record, lon));
    line.number("height_msl_m", field(plan, record, height));
    line.number("speed_m_s", field(plan, record, speed));
    if (const auto course_rad = field(plan, record, course))
      line.number("course_rad", base::as_heading(*course_rad));
    if (const auto down_m_s = field(plan, record, down)) line.number("climb_m_s", -*down_m_s);
    line.number("dop", field(plan, record, dop));
    if (const auto found = accuracies_.find(plan.instance(record)); found != accuracies_.end()) {
      line.number("position_std_m", found->second[0]).number("height_std_m", found->second[1]);
      line.number("velocity_std_m_s", found->second[2]);
    }
  }
  line.number("tracked", field(plan, record, satellites));
  sink_.sample(sample, line);
}

void DataFlashFile::take_attitude(const Plan& plan, std::string_view record, ImportedSample sample) {
  LineWriter line("COMPASS");
  line.number("heading_rad", base::as_heading(field(plan, record, 2).value_or(NAN)));
  line.boolean("heading_is_true", true);
  // XKV1 is of the third estimator; the attitude is that of the active one.
  constexpr double kThird = 3;
  const auto stated_rad = field(plan, record, 3).value_or(0) == kThird ? heading_std_rad_ : std::nullopt;
  line.number("heading_std_rad", stated_rad.value_or(instruments::kAutopilotHeadingStd_rad));
  line.number("pitch_rad", field(plan, record, 1)).number("roll_rad", field(plan, record, 0));
  sink_.sample(sample, line);
}

void DataFlashFile::take_battery(const Plan& plan, std::string_view record, ImportedSample sample) {
  LineWriter line("POWER");
  line.number("voltage_V", field(plan, record, 0)).number("current_A", field(plan, record, 1));
  sink_.sample(sample, line);
}

// What a pulse moves is known to the vehicle's builder only: without a map it stays a pulse.
void DataFlashFile::take_outputs(const Plan& plan, std::string_view record, ImportedSample sample) {
  for (const dataflash::Column* channel : plan.channels()) {
    const auto pulse_us = table_.value(*channel, record);
    if (!pulse_us || *pulse_us == 0) continue;  // an output that is not used
    if (channels_.has(sample.message, channel->name)) continue;
    LineWriter line("SENSOR");
    line.text("quantity", fmt::format("output{}", channel->name.substr(1))).text("unit", "us");
    line.number("value", *pulse_us);
    sink_.sample(sample, line);
    sample.continues = true;
  }
  if (!sample.continues && !channels_.has(sample.message))
    sink_.left(fmt::format("{} (no output in use)", sample.message));
}

void DataFlashFile::take_text(const Plan& plan, std::string_view record) {
  if (plan.kind() == Kind::text && plan.text(record, 0).starts_with("ArduSub")) is_submarine_ = true;
  if (plan.kind() != Kind::parameter) return;
  const auto value = field(plan, record, 1);
  if (plan.text(record, 0) == "BARO_PRIMARY") primary_baro_ = std::llround(value.value_or(0));
  if (value) servos_.take(plan.text(record, 0), *value);
  take_compass_parameter(plan, record);
}

// Each message states the motor's field that was taken off.
void DataFlashFile::take_compass_parameter(const Plan& plan, std::string_view record) {
  const auto value = field(plan, record, 1);
  const std::string_view name = plan.text(record, 0);
  if (value && name != "COMPASS_MOTCT") compass_.take(name, *value);
}

}  // namespace

bool is_dataflash(std::string_view head) {
  constexpr std::size_t kFormatRecord_bytes = 89;
  return head.size() >= kFormatRecord_bytes && head.starts_with(kSync) && head[2] == '\x80' && head[3] == '\x80' &&
         head.substr(5, 3) == "FMT";
}

ImportFindings read_dataflash(std::string_view file, ImportSink& sink, MotorChannels& channels,
                              bool undoes_calibration) {
  return DataFlashFile(file, sink, channels, undoes_calibration).read();
}

}  // namespace navcal::analysis
