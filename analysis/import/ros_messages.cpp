// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/ros_messages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "analysis/import/cdr_reader.h"
#include "base/angles.h"

namespace navcal::analysis::ros {
namespace {

using protocols::samples_line::LineWriter;
using Numbers3 = std::array<double, 3>;
using Numbers9 = std::array<double, 9>;

/// Forward, left, up to forward, starboard, down.
Numbers3 turned(const Numbers3& flu) { return {flu[0], -flu[1], -flu[2]}; }

/// Standard error of each axis; nothing where the covariance is unknown (0) or the value absent (-1).
std::optional<double> std_of(double variance_x, double variance_y) {
  if (!(variance_x > 0) || !(variance_y > 0)) return std::nullopt;
  return std::sqrt((variance_x + variance_y) / 2);
}

/// Heading, pitch and roll of a body (forward, left, up) in the world (east, north, up).
void write_attitude(LineWriter& line, const std::array<double, 4>& q) {
  const auto [x, y, z, w] = q;
  const double yaw = std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
  const double pitch = std::asin(std::clamp(2 * (w * y - z * x), -1.0, 1.0));
  const double roll = std::atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y));
  line.number("heading_rad", base::as_heading(std::numbers::pi / 2 - yaw)).boolean("heading_is_true", true);
  line.number("pitch_rad", -pitch).number("roll_rad", roll);
}

bool decode_imu(std::string_view cdr, const Topic& topic, std::int64_t log_time_ns, ImportSink& sink) {
  CdrReader reader(cdr);
  const std::int64_t stamp_ns = reader.take_header();
  const auto q = reader.take_doubles<4>();
  const auto q_covariance = reader.take_doubles<9>();
  const auto rate = reader.take_doubles<3>();
  const auto rate_covariance = reader.take_doubles<9>();
  const auto force = reader.take_doubles<3>();
  const auto force_covariance = reader.take_doubles<9>();
  if (!reader.is_good()) return false;
  ImportedSample sample = sample_of(topic, PortKind::imu, log_time_ns, stamp_ns);
  LineWriter line("IMU");
  constexpr double kAbsent = -1;
  if (rate_covariance[0] != kAbsent) {
    line.vector("rate_rad_s", turned(rate));
    line.number("rate_std_rad_s", std_of(rate_covariance[0], rate_covariance[4]));
  }
  if (force_covariance[0] != kAbsent) {
    line.vector("specific_force_m_s2", turned(force));
    line.number("specific_force_std_m_s2", std_of(force_covariance[0], force_covariance[4]));
  }
  sink.sample(sample, line);
  const double norm = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  constexpr double kNear = 0.01;
  if (q_covariance[0] == kAbsent || !(std::abs(norm - 1) < kNear)) return true;
  LineWriter attitude("COMPASS");
  write_attitude(attitude, q);
  sample.port = port_name(PortKind::attitude, topic.instance);
  sink.sample(sample, attitude);
  return true;
}

bool decode_field(std::string_view cdr, const Topic& topic, std::int64_t log_time_ns, ImportSink& sink) {
  constexpr double kMicrotesla = 1e6;
  CdrReader reader(cdr);
  const std::int64_t stamp_ns = reader.take_header();
  auto field = turned(reader.take_doubles<3>());
  const auto covariance = reader.take_doubles<9>();
  if (!reader.is_good()) return false;
  for (double& component : field) component *= kMicrotesla;
  LineWriter line("COMPASS");
  line.vector("field_body_uT", field);
  if (const auto std_T = std_of(covariance[0], covariance[4])) line.number("field_std_uT", *std_T * kMicrotesla);
  sink.sample(sample_of(topic, PortKind::compass, log_time_ns, stamp_ns), line);
  return true;
}

bool decode_fix(std::string_view cdr, const Topic& topic, std::int64_t log_time_ns, ImportSink& sink) {
  CdrReader reader(cdr);
  const std::int64_t stamp_ns = reader.take_header();
  const auto status = reader.take<std::int8_t>();
  (void)reader.take<std::uint16_t>();
  const auto place = reader.take_doubles<3>();
  const auto covariance = reader.take_doubles<9>();
  const auto covariance_type = reader.take<std::uint8_t>();
  if (!reader.is_good()) return false;
  LineWriter line("GPS");
  line.text("fix", status < 0 ? "none" : std::isfinite(place[2]) ? "3d" : "2d");
  if (status >= 0) {
    line.number("lat", place[0]).number("lon", place[1]).number("height_m", place[2]);
    if (covariance_type > 0) {
      line.number("position_std_m", std_of(covariance[0], covariance[4]));
      line.number("height_std_m", std_of(covariance[8], covariance[8]));
    }
  }
  sink.sample(sample_of(topic, PortKind::gps, log_time_ns, stamp_ns), line);
  return true;
}

bool decode_pressure(std::string_view cdr, const Topic& topic, std::int64_t log_time_ns, ImportSink& sink) {
  CdrReader reader(cdr);
  const std::int64_t stamp_ns = reader.take_header();
  const auto pressure_Pa = reader.take<double>(), variance = reader.take<double>();
  if (!reader.is_good()) return false;
  LineWriter line("DEPTH");
  line.number("pressure_Pa", pressure_Pa).number("pressure_std_Pa", std_of(variance, variance));
  sink.sample(sample_of(topic, PortKind::depth, log_time_ns, stamp_ns), line);
  return true;
}

bool decode_temperature(std::string_view cdr, const Topic& topic, std::int64_t log_time_ns, ImportSink& sink) {
  CdrReader reader(cdr);
  const std::int64_t stamp_ns = reader.take_header();
  const auto temperature_C = reader.take<double>(), variance = reader.take<double>();
  if (!reader.is_good()) return false;
  LineWriter line("SENSOR");
  line.text("quantity", "temperature").text("unit", "degC").number("value", temperature_C);
  line.number("value_std", std_of(variance, variance));
  sink.sample(sample_of(topic, PortKind::sensors, log_time_ns, stamp_ns), line);
  return true;
}

bool decode_twist(std::string_view cdr, const Topic& topic, std::int64_t log_time_ns, ImportSink& sink) {
  CdrReader reader(cdr);
  const std::int64_t stamp_ns = reader.take_header();
  const auto velocity = reader.take_doubles<3>();
  (void)reader.take_doubles<3>();
  const auto covariance = reader.take_doubles<36>();
  if (!reader.is_good()) return false;
  constexpr std::size_t kYy = 7;
  LineWriter line("DVL");
  line.text("frame", "body").vector("bottom_velocity_m_s", turned(velocity));
  line.number("bottom_velocity_std_m_s", std_of(covariance[0], covariance[kYy]));
  sink.sample(sample_of(topic, PortKind::dvl, log_time_ns, stamp_ns), line);
  return true;
}

bool decode_battery(std::string_view cdr, const Topic& topic, std::int64_t log_time_ns, ImportSink& sink) {
  CdrReader reader(cdr);
  const std::int64_t stamp_ns = reader.take_header();
  const auto voltage_V = reader.take<float>();
  (void)reader.take<float>();
  const auto current_A = reader.take<float>();  // negative when it is discharged
  if (!reader.is_good()) return false;
  LineWriter line("POWER");
  line.number("voltage_V", static_cast<double>(voltage_V)).number("current_A", -static_cast<double>(current_A));
  sink.sample(sample_of(topic, PortKind::battery, log_time_ns, stamp_ns), line);
  return true;
}

bool decode_range(std::string_view cdr, const Topic& topic, std::int64_t log_time_ns, ImportSink& sink) {
  CdrReader reader(cdr);
  const std::int64_t stamp_ns = reader.take_header();
  (void)reader.take<std::uint8_t>();
  (void)reader.take<float>();
  const auto least = reader.take<float>(), most = reader.take<float>(), range = reader.take<float>();
  if (!reader.is_good()) return false;
  LineWriter line("ALTIMETER");
  if (range >= least && range <= most) line.number("altitude_m", static_cast<double>(range));
  sink.sample(sample_of(topic, PortKind::altimeter, log_time_ns, stamp_ns), line);
  return true;
}

constexpr std::array kTypes{
    MessageType{"sensor_msgs/msg/Imu", PortKind::imu, decode_imu},
    MessageType{"sensor_msgs/msg/MagneticField", PortKind::compass, decode_field},
    MessageType{"sensor_msgs/msg/NavSatFix", PortKind::gps, decode_fix},
    MessageType{"sensor_msgs/msg/FluidPressure", PortKind::depth, decode_pressure},
    MessageType{"sensor_msgs/msg/Temperature", PortKind::sensors, decode_temperature},
    MessageType{"sensor_msgs/msg/BatteryState", PortKind::battery, decode_battery},
    MessageType{"sensor_msgs/msg/Range", PortKind::altimeter, decode_range},
    MessageType{"geometry_msgs/msg/TwistWithCovarianceStamped", PortKind::dvl, decode_twist}};

}  // namespace

ImportedSample sample_of(const Topic& topic, PortKind kind, std::int64_t log_time_ns, std::int64_t stamp_ns) {
  constexpr std::int64_t kHour_ns = 3'600'000'000'000;
  ImportedSample sample{topic.name, port_name(kind, topic.instance), log_time_ns};
  if (stamp_ns > 0 && std::abs(stamp_ns - log_time_ns) < kHour_ns) sample.utc_ns = stamp_ns;
  return sample;
}

const MessageType* message_type(std::string_view name) {
  const auto found =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const MessageType& t) { return t.name == name; });
  return found == kTypes.end() ? nullptr : &*found;
}

}  // namespace navcal::analysis::ros
