// SPDX-License-Identifier: Apache-2.0
#include "analysis/import/ros_messages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "base/angles.h"
#include "protocols/ros2/cdr_reader.h"
#include "protocols/ros2/ros_messages.h"

namespace navcal::analysis::ros {
namespace {

using protocols::samples_line::LineWriter;
namespace ros2 = protocols::ros2;

/// Forward, left, up to forward, starboard, down.
std::array<double, 3> turned(const ros2::Vector3& flu) { return {flu.x, -flu.y, -flu.z}; }

/// Standard error of each axis; nothing where the covariance is unknown (0) or the value absent (-1).
std::optional<double> std_of(double variance_x, double variance_y) {
  if (!(variance_x > 0) || !(variance_y > 0)) return std::nullopt;
  return std::sqrt((variance_x + variance_y) / 2);
}

/// The same where senders state a kilometre, or a kilometre a second, for what they do not know.
std::optional<double> known_std_of(double variance_x, double variance_y) {
  return variance_x < ros2::kUnknownVariance ? std_of(variance_x, variance_y) : std::nullopt;
}

/// Heading, pitch and roll of a body (forward, left, up) in the world (east, north, up).
void write_attitude(LineWriter& line, const ros2::Quaternion& q) {
  const double yaw = std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z));
  const double pitch = std::asin(std::clamp(2 * (q.w * q.y - q.z * q.x), -1.0, 1.0));
  const double roll = std::atan2(2 * (q.w * q.x + q.y * q.z), 1 - 2 * (q.x * q.x + q.y * q.y));
  line.number("heading_rad", base::as_heading(std::numbers::pi / 2 - yaw)).boolean("heading_is_true", true);
  line.number("pitch_rad", -pitch).number("roll_rad", roll);
}

/// A message with its topic and the time at which it was logged, on its way to the sink.
struct Taken {
  const Topic& topic;
  std::int64_t log_time_ns;
  ImportSink& sink;

  [[nodiscard]] ImportedSample sample(const ros2::Header& header, PortKind kind) const {
    return sample_of(topic, kind, log_time_ns, header.stamp_ns());
  }
};

void take(const ros2::Imu& imu, const Taken& to) {
  constexpr double kAbsent = -1;
  ImportedSample sample = to.sample(imu.header, PortKind::imu);
  LineWriter line("IMU");
  const auto &rate = imu.angular_velocity_covariance, &force = imu.linear_acceleration_covariance;
  if (rate[0] != kAbsent) {
    line.vector("rate_rad_s", turned(imu.angular_velocity));
    line.number("rate_std_rad_s", std_of(rate[0], rate[4]));
  }
  if (force[0] != kAbsent) {
    line.vector("specific_force_m_s2", turned(imu.linear_acceleration));
    line.number("specific_force_std_m_s2", std_of(force[0], force[4]));
  }
  const auto& q = imu.orientation;
  const double norm = std::hypot(std::hypot(q.x, q.y), std::hypot(q.z, q.w));
  constexpr double kNear = 0.01;
  const bool has_attitude = imu.orientation_covariance[0] != kAbsent && std::abs(norm - 1) < kNear;
  if (!has_attitude || rate[0] != kAbsent || force[0] != kAbsent) to.sink.sample(sample, line);
  if (!has_attitude) return;
  LineWriter attitude("COMPASS");
  write_attitude(attitude, q);
  sample.port = port_name(PortKind::attitude, to.topic.instance);
  to.sink.sample(sample, attitude);
}

void take(const ros2::MagneticField& field, const Taken& to) {
  constexpr double kMicrotesla = 1e6;
  auto field_uT = turned(field.magnetic_field);
  for (double& component : field_uT) component *= kMicrotesla;
  LineWriter line("COMPASS");
  line.vector("field_body_uT", field_uT);
  const auto& covariance = field.magnetic_field_covariance;
  if (const auto std_T = std_of(covariance[0], covariance[4])) line.number("field_std_uT", *std_T * kMicrotesla);
  to.sink.sample(to.sample(field.header, PortKind::compass), line);
}

void take(const ros2::NavSatFix& fix, const Taken& to) {
  LineWriter line("GPS");
  const bool has_fix = fix.status.status >= ros2::NavSatStatus::kFix;
  line.text("fix", !has_fix ? "none" : std::isfinite(fix.altitude) ? "3d" : "2d");
  if (has_fix) {
    line.number("lat", fix.latitude).number("lon", fix.longitude).number("height_m", fix.altitude);
    const auto& covariance = fix.position_covariance;
    if (fix.position_covariance_type != ros2::NavSatFix::kUnknown) {
      line.number("position_std_m", known_std_of(covariance[0], covariance[4]));
      line.number("height_std_m", known_std_of(covariance[8], covariance[8]));
    }
  }
  to.sink.sample(to.sample(fix.header, PortKind::gps), line);
}

void take(const ros2::FluidPressure& pressure, const Taken& to) {
  LineWriter line("DEPTH");
  line.number("pressure_Pa", pressure.fluid_pressure);
  line.number("pressure_std_Pa", std_of(pressure.variance, pressure.variance));
  to.sink.sample(to.sample(pressure.header, PortKind::depth), line);
}

void take(const ros2::Temperature& temperature, const Taken& to) {
  LineWriter line("SENSOR");
  line.text("quantity", "temperature").text("unit", "degC").number("value", temperature.temperature);
  line.number("value_std", std_of(temperature.variance, temperature.variance));
  to.sink.sample(to.sample(temperature.header, PortKind::sensors), line);
}

void take(const ros2::TwistWithCovarianceStamped& stamped, const Taken& to) {
  constexpr std::size_t kYy = 7;
  const auto& [twist, covariance] = stamped.twist;
  LineWriter line("DVL");
  line.text("frame", "body").vector("bottom_velocity_m_s", turned(twist.linear));
  line.number("bottom_velocity_std_m_s", known_std_of(covariance[0], covariance[kYy]));
  to.sink.sample(to.sample(stamped.header, PortKind::dvl), line);
}

void take(const ros2::BatteryState& battery, const Taken& to) {
  LineWriter line("POWER");
  line.number("voltage_V", static_cast<double>(battery.voltage));
  line.number("current_A", -static_cast<double>(battery.current));
  to.sink.sample(to.sample(battery.header, PortKind::battery), line);
}

void take(const ros2::Range& range, const Taken& to) {
  LineWriter line("ALTIMETER");
  if (range.range >= range.min_range && range.range <= range.max_range) {
    line.number("altitude_m", static_cast<double>(range.range));
    const auto variance = static_cast<double>(range.variance.value_or(0));
    line.number("altitude_std_m", std_of(variance, variance));
  }
  to.sink.sample(to.sample(range.header, PortKind::altimeter), line);
}

template <class Message>
bool decode_and_take(std::string_view cdr, const Topic& topic, std::int64_t log_time_ns, ImportSink& sink) {
  const auto message = ros2::decode<Message>(cdr);
  if (message) take(*message, Taken{topic, log_time_ns, sink});
  return message.has_value();
}

template <class Message>
MessageType type_of(PortKind kind) {
  return {ros2::full_name(Message::kType), kind, decode_and_take<Message>};
}

}  // namespace

ImportedSample sample_of(const Topic& topic, PortKind kind, std::int64_t log_time_ns, std::int64_t stamp_ns) {
  constexpr std::int64_t kHour_ns = 3'600'000'000'000;
  ImportedSample sample{topic.name, port_name(kind, topic.instance), log_time_ns};
  if (stamp_ns > 0 && std::abs(stamp_ns - log_time_ns) < kHour_ns) sample.utc_ns = stamp_ns;
  return sample;
}

const MessageType* message_type(std::string_view name) {
  static const std::array kTypes{type_of<ros2::Imu>(PortKind::imu),
                                 type_of<ros2::MagneticField>(PortKind::compass),
                                 type_of<ros2::NavSatFix>(PortKind::gps),
                                 type_of<ros2::FluidPressure>(PortKind::depth),
                                 type_of<ros2::Temperature>(PortKind::sensors),
                                 type_of<ros2::BatteryState>(PortKind::battery),
                                 type_of<ros2::Range>(PortKind::altimeter),
                                 type_of<ros2::TwistWithCovarianceStamped>(PortKind::dvl)};
  const auto found = std::ranges::find_if(kTypes, [&](const MessageType& t) { return t.name == name; });
  return found == kTypes.end() ? nullptr : &*found;
}

}  // namespace navcal::analysis::ros
