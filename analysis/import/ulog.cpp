// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>

#include "analysis/import/log_readers.h"
#include "analysis/import/port_name.h"
#include "analysis/import/servo_parameters.h"
#include "analysis/import/ulog_format.h"
#include "analysis/import/wire_reader.h"
#include "base/angles.h"
#include "base/rotation.h"

namespace navcal::analysis {
namespace {

using protocols::samples_line::LineWriter;
using ulog::UlogFormat;

constexpr std::string_view kUlogMagic{"ULog\x01\x12\x35", 7};
constexpr std::size_t kUlogHeader = 16, kUlogMessageHead = 3;

struct UlogMessage {
  const UlogFormat& format;
  std::string_view bytes;

  [[nodiscard]] std::optional<double> number(std::string_view name, std::size_t i = 0) const {
    return format.number(bytes, name, i);
  }
  /// The first of two names that the message has: names change between versions of PX4.
  [[nodiscard]] std::optional<double> either(std::string_view now, double factor_now, std::string_view before,
                                             double factor_before) const {
    if (const auto value = number(now)) return *value * factor_now;
    const auto value = number(before);
    return value ? std::optional(*value * factor_before) : std::nullopt;
  }
  [[nodiscard]] std::array<double, 3> vector(std::string_view name, double factor = 1) const {
    return {factor * number(name, 0).value_or(NAN), factor * number(name, 1).value_or(NAN),
            factor * number(name, 2).value_or(NAN)};
  }
};

void take_combined(const UlogMessage& message, const ImportedSample& sample, ImportSink& sink) {
  LineWriter line("IMU");
  line.vector("rate_rad_s", message.vector("gyro_rad"));
  line.vector("specific_force_m_s2", message.vector("accelerometer_m_s2"));
  sink.sample(sample, line);
}

void take_air(const UlogMessage& message, const ImportedSample& sample, ImportSink& sink) {
  LineWriter line("DEPTH");
  line.number("pressure_Pa", message.number("baro_pressure_pa"));
  line.number("temperature_C", message.either("baro_temp_celcius", 1, "ambient_temperature", 1));
  sink.sample(sample, line);
}

void take_receiver(const UlogMessage& message, ImportedSample sample, ImportSink& sink) {
  constexpr double kLeast2d = 2, kLeast3d = 3;
  constexpr std::uint64_t kFirstUtc_us = 315'964'800'000'000, kLastUtc_us = 4'102'444'800'000'000;
  const double quality = message.number("fix_type").value_or(0);
  if (const auto utc_us = message.format.unsigned_number(message.bytes, "time_utc_usec");
      utc_us && *utc_us > kFirstUtc_us && *utc_us < kLastUtc_us) {
    sample.utc_ns = static_cast<std::int64_t>(*utc_us) * 1000;
    if (quality >= kLeast3d) sink.utc(sample.time_ns, *sample.utc_ns);
  }
  LineWriter line("GPS");
  line.text("fix", quality >= kLeast3d ? "3d" : quality == kLeast2d ? "2d" : "none");
  if (quality >= kLeast2d) {
    line.number("lat", message.either("latitude_deg", 1, "lat", 1e-7));
    line.number("lon", message.either("longitude_deg", 1, "lon", 1e-7));
    line.number("height_m", message.either("altitude_ellipsoid_m", 1, "alt_ellipsoid", 1e-3));
    line.number("height_msl_m", message.either("altitude_msl_m", 1, "alt", 1e-3));
    line.number("speed_m_s", message.number("vel_m_s"));
    if (const auto course_rad = message.number("cog_rad"))
      line.number("course_rad", base::as_heading(*course_rad));
    if (const auto down_m_s = message.number("vel_d_m_s")) line.number("climb_m_s", -*down_m_s);
    line.number("dop", message.number("hdop"));
    line.number("position_std_m", message.number("eph")).number("height_std_m", message.number("epv"));
    line.number("velocity_std_m_s", message.number("s_variance_m_s"));
  }
  line.number("tracked", message.number("satellites_used"));
  sink.sample(sample, line);
}

void take_battery(const UlogMessage& message, const ImportedSample& sample, ImportSink& sink) {
  LineWriter line("POWER");
  line.number("voltage_V", message.number("voltage_v")).number("current_A", message.number("current_a"));
  sink.sample(sample, line);
}

/// A list of commands, each a sensor of its own. A number that is not finite is an output that is not used.
struct UlogCommands {
  std::string_view message, member, quantity;
};
constexpr std::array kUlogCommands{UlogCommands{"actuator_outputs", "output", "output"},
                                   UlogCommands{"actuator_motors", "control", "motor"},
                                   UlogCommands{"actuator_servos", "control", "servo"}};

// Commands have the unit of their driver: a pulse, a share of the full throttle.
void take_commands(const UlogCommands& commands, const UlogMessage& message, ImportedSample sample,
                   ImportSink& sink, const MotorChannels& channels) {
  constexpr double kMostOutputs = 64;
  const auto used = static_cast<std::size_t>(message.number("noutputs").value_or(kMostOutputs));
  for (std::size_t i = 0; i < used; ++i) {
    const auto output = message.number(commands.member, i);
    if (!output) break;
    if (!std::isfinite(*output)) continue;
    if (channels.has(sample.message, fmt::format("{}[{}]", commands.member, i))) continue;
    LineWriter line("SENSOR");
    line.text("quantity", fmt::format("{}{}", commands.quantity, i + 1)).text("unit", "").number("value", *output);
    sink.sample(sample, line);
    sample.continues = true;
  }
  if (!sample.continues && !channels.has(sample.message))
    sink.left(fmt::format("{} (no output in use)", sample.message));
}

/// Number of a member, of a list with its index: "control[0]".
std::optional<double> member_of(const UlogMessage& message, std::string_view member) {
  std::size_t index = 0;
  if (const std::size_t bracket = member.find('['); bracket != std::string_view::npos) {
    const std::string_view digits = member.substr(bracket + 1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
    const auto used = static_cast<std::size_t>(end - digits.data());
    if (error != std::errc{} || digits.substr(used) != "]") return std::nullopt;
    member = member.substr(0, bracket);
  }
  return message.number(member, index);
}

struct UlogTarget {
  std::string_view message;
  PortKind kind;
  void (*take)(const UlogMessage&, ImportedSample, ImportSink&);  ///< null: UlogFile::take_field, take_attitude
};

template <void (*Take)(const UlogMessage&, const ImportedSample&, ImportSink&)>
void taken_by(const UlogMessage& message, ImportedSample sample, ImportSink& sink) {
  Take(message, sample, sink);
}

constexpr std::array kUlogTargets{UlogTarget{"sensor_combined", PortKind::imu, taken_by<take_combined>},
                                  UlogTarget{"vehicle_magnetometer", PortKind::compass, nullptr},
                                  UlogTarget{"vehicle_air_data", PortKind::baro, taken_by<take_air>},
                                  UlogTarget{"vehicle_gps_position", PortKind::gps, take_receiver},
                                  UlogTarget{"sensor_gps", PortKind::gps, take_receiver},
                                  UlogTarget{"vehicle_attitude", PortKind::attitude, nullptr},
                                  UlogTarget{"vehicle_local_position", PortKind::attitude, nullptr},
                                  UlogTarget{"estimator_states", PortKind::attitude, nullptr},
                                  UlogTarget{"estimator_status", PortKind::attitude, nullptr},
                                  UlogTarget{"battery_status", PortKind::battery, taken_by<take_battery>}};

class UlogFile {
 public:
  UlogFile(std::string_view file, ImportSink& sink, MotorChannels& channels, bool undoes_calibration)
      : file_(file), sink_(sink), channels_(channels), undoes_calibration_(undoes_calibration) {}
  ImportFindings read();

 private:
  struct Subscription {
    std::string name, label;
    int instance = 0;
    const UlogTarget* target = nullptr;
    const UlogCommands* commands = nullptr;
  };

  [[nodiscard]] static bool is_type(char type) {
    return std::string_view("BFIMPQARDLCSO").find(type) != std::string_view::npos;
  }
  void take(char type, std::string_view content);
  void subscribe(std::string_view content);
  void take_data(std::string_view content);
  void take_parameter(std::string_view content);
  void take_field(const UlogMessage& message, const ImportedSample& sample, int instance);
  void take_attitude(const UlogMessage& message, const ImportedSample& sample, int instance);

  std::string_view file_;
  ImportSink& sink_;
  MotorChannels& channels_;
  ServoParameters servos_;
  ImportFindings findings_;
  ulog::UlogFormats formats_;
  std::map<std::uint16_t, Subscription> subscriptions_;
  std::string_view receiver_;  ///< the message that gives the position; the other one repeats it
  std::uint64_t dropouts_ = 0, dropped_ms_ = 0;
  bool undoes_calibration_;
  std::map<std::string, double> parameters_;
  std::optional<double> heading_std_rad_;  ///< the newest that the estimator stated
};

ImportFindings UlogFile::read() {
  constexpr std::size_t kProgressBytes = 1 << 16;
  std::size_t at = kUlogHeader, told = 0;
  while (at < file_.size()) {
    const std::string_view rest = file_.substr(at);
    const std::size_t length = kUlogMessageHead + little_endian_at<std::uint16_t>(rest, 0);
    if (rest.size() < kUlogMessageHead || (is_type(rest[2]) && rest.size() < length)) {
      findings_.cut_at = at;
      break;
    }
    if (!is_type(rest[2])) {
      ++findings_.damaged_bytes;
      ++at;
      continue;
    }
    take(rest[2], rest.substr(kUlogMessageHead, length - kUlogMessageHead));
    at += length;
    if (at - told >= kProgressBytes) sink_.progress(told = at);
  }
  if (dropouts_ > 0)
    findings_.remarks.push_back(fmt::format("{} dropouts of the logger, {} ms in all", dropouts_, dropped_ms_));
  if (std::string words = servos_.words(); !words.empty()) findings_.remarks.push_back(std::move(words));
  return std::move(findings_);
}

void UlogFile::take(char type, std::string_view content) {
  // Definitions stand before all data.
  if (type == 'F' && subscriptions_.empty()) formats_.learn(content);
  if (type == 'A') subscribe(content);
  if (type == 'D') take_data(content);
  if (type == 'P') take_parameter(content);
  if (type == 'O') {
    ++dropouts_;
    dropped_ms_ += little_endian_at<std::uint16_t>(content, 0);
  }
}

/// Length of the key, the key with its type ("float PWM_MAIN_MIN1"), and the value.
void UlogFile::take_parameter(std::string_view content) {
  const std::size_t length = content.empty() ? 0 : static_cast<std::uint8_t>(content[0]);
  if (content.size() < 1 + length + sizeof(float)) return;
  const std::string_view key = content.substr(1, length), value = content.substr(1 + length);
  constexpr std::string_view kFloat = "float ", kInteger = "int32_t ";
  const auto keep = [this](std::string_view name, double number) {
    servos_.take(name, number);
    parameters_.insert_or_assign(std::string(name), number);
  };
  if (key.starts_with(kFloat)) keep(key.substr(kFloat.size()), little_endian_at<float>(value, 0));
  if (key.starts_with(kInteger)) keep(key.substr(kInteger.size()), little_endian_at<std::int32_t>(value, 0));
}

/// The autopilot's calibration is undone where it is known to be that of this compass, turns no axes, and takes no
/// motor's field off: field = D (measured - OFF).
void UlogFile::take_field(const UlogMessage& message, const ImportedSample& sample, int instance) {
  constexpr double kMicroteslaPerGauss = 100, kLeastDeterminant = 1e-3;
  const auto parameter = [&](const std::string& name) {
    const auto found = parameters_.find(name);
    return found == parameters_.end() ? 0 : found->second;
  };
  const auto of = [&](const char* name) { return parameter(fmt::format("CAL_MAG{}_{}", instance, name)); };
  Eigen::Matrix3d d;
  d << of("XSCALE"), of("XODIAG"), of("YODIAG"),  //
      of("XODIAG"), of("YSCALE"), of("ZODIAG"),   //
      of("YODIAG"), of("ZODIAG"), of("ZSCALE");
  const bool is_turned = of("ROT") > 0 || parameter("SENS_BOARD_ROT") > 0 || parameter("SENS_BOARD_X_OFF") != 0 ||
                         parameter("SENS_BOARD_Y_OFF") != 0 || parameter("SENS_BOARD_Z_OFF") != 0;
  auto field_uT = message.vector("magnetometer_ga", kMicroteslaPerGauss);
  if (undoes_calibration_ && message.number("device_id") == of("ID") && !is_turned &&
      parameter("CAL_MAG_COMP_TYP") == 0 && std::abs(d.determinant()) > kLeastDeterminant) {
    Eigen::Map<Eigen::Vector3d> field(field_uT.data());
    field = d.inverse() * field + kMicroteslaPerGauss * Eigen::Vector3d(of("XOFF"), of("YOFF"), of("ZOFF"));
  } else {
    findings_.has_corrected_fields = true;
  }
  LineWriter line("COMPASS");
  line.vector("field_body_uT", field_uT);
  sink_.sample(sample, line);
}

/// Rotation of the body (forward, starboard, down) in the world (north, east, down), scalar first; or what the
/// estimator states of its error. The variances of a quaternion are those of 24 states; of 25 they are of angles.
void UlogFile::take_attitude(const UlogMessage& message, const ImportedSample& sample, int instance) {
  constexpr std::size_t kLast = 23;
  if (!message.number("q")) {
    auto std_rad = message.number("heading_var");
    if (std_rad) std_rad = *std_rad > 0 ? std::optional(std::sqrt(*std_rad)) : std::nullopt;
    if (message.number("covariances", kLast) && !message.number("states", kLast + 1))
      std_rad = heading_std_of(message.number("covariances", 0), message.number("covariances", 3));
    if (std_rad && instance == 0) heading_std_rad_ = std_rad;
    if (!channels_.has(sample.message)) sink_.left(sample.message);
    return;
  }
  LineWriter line("COMPASS");
  const auto q = [&](std::size_t i) { return message.number("q", i).value_or(NAN); };
  const auto angles = base::angles_of(Eigen::Quaterniond(q(0), q(1), q(2), q(3)).toRotationMatrix());
  line.number("heading_rad", base::as_heading(angles.yaw_rad)).boolean("heading_is_true", true);
  line.number("heading_std_rad", heading_std_rad_);
  line.number("pitch_rad", angles.pitch_rad).number("roll_rad", angles.roll_rad);
  sink_.sample(sample, line);
}

void UlogFile::subscribe(std::string_view content) {
  constexpr std::size_t kName = 3;
  if (content.size() <= kName) return;
  Subscription subscription;
  subscription.instance = static_cast<std::uint8_t>(content[0]);
  subscription.name = content.substr(kName, kLongestName);
  subscription.label = subscription.instance == 0
                           ? subscription.name
                           : fmt::format("{}[{}]", subscription.name, subscription.instance);
  const auto target = std::ranges::find(kUlogTargets, subscription.name, &UlogTarget::message);
  if (target != kUlogTargets.end()) subscription.target = &*target;
  const auto commands = std::ranges::find(kUlogCommands, subscription.name, &UlogCommands::message);
  if (commands != kUlogCommands.end()) subscription.commands = &*commands;
  subscriptions_[little_endian_at<std::uint16_t>(content, 1)] = std::move(subscription);
}

void UlogFile::take_data(std::string_view content) {
  const auto found = subscriptions_.find(little_endian_at<std::uint16_t>(content, 0));
  if (found == subscriptions_.end() || content.size() < 2) return sink_.left("data without a subscription");
  const Subscription& subscription = found->second;
  const bool is_mapped = channels_.has(subscription.label);
  if (subscription.target == nullptr && subscription.commands == nullptr && !is_mapped)
    return sink_.left(subscription.label);
  const UlogFormat* const format = formats_.find(subscription.name);
  if (format == nullptr) return sink_.left(fmt::format("{} (no format)", subscription.label));
  const UlogMessage message{*format, content.substr(2)};
  const auto sampled = format->unsigned_number(message.bytes, "timestamp_sample");
  const auto time_us = sampled && *sampled > 0 ? sampled : format->unsigned_number(message.bytes, "timestamp");
  constexpr std::uint64_t kMost_us = 4'000'000'000'000'000;
  if (!time_us || *time_us > kMost_us) return sink_.left(fmt::format("{} (no time)", subscription.label));
  const PortKind kind = subscription.target != nullptr ? subscription.target->kind : PortKind::motor;
  const ImportedSample sample{subscription.label, port_name(kind, subscription.instance),
                              static_cast<std::int64_t>(*time_us) * 1000};
  if (is_mapped)
    channels_.emit(
        subscription.label, [&](std::string_view member) { return member_of(message, member); }, sample, sink_);
  if (subscription.commands != nullptr)
    return take_commands(*subscription.commands, message, sample, sink_, channels_);
  if (subscription.target == nullptr) return;
  if (kind == PortKind::gps) {
    if (receiver_.empty()) receiver_ = subscription.target->message;
    if (receiver_ != subscription.target->message)
      return sink_.left(fmt::format("{} (the same as {})", subscription.label, receiver_));
  }
  if (kind == PortKind::compass) return take_field(message, sample, subscription.instance);
  if (kind == PortKind::attitude) return take_attitude(message, sample, subscription.instance);
  subscription.target->take(message, sample, sink_);
}

}  // namespace

bool is_ulog(std::string_view head) { return head.size() >= kUlogHeader && head.starts_with(kUlogMagic); }

ImportFindings read_ulog(std::string_view file, ImportSink& sink, MotorChannels& channels,
                         bool undoes_calibration) {
  return UlogFile(file, sink, channels, undoes_calibration).read();
}

}  // namespace navcal::analysis
