// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Messages of ROS 2 (common_interfaces) that navcal writes or reads, without ROS. Units are SI, axes those of REP
/// 103; covariances are row-major.
namespace navcal::protocols::ros2 {

/// The members of a message, once, in the order of the wire: CDR, definition and type hash follow this list.
#define NAVCAL_ROS_MEMBERS(type, ...)                        \
  static constexpr std::string_view kType = type;            \
  static constexpr std::string_view kMembers = #__VA_ARGS__; \
  template <class Visitor>                                   \
  void visit(Visitor& visitor) {                             \
    visitor(__VA_ARGS__);                                    \
  }                                                          \
  template <class Visitor>                                   \
  void visit(Visitor& visitor) const {                       \
    visitor(__VA_ARGS__);                                    \
  }

using Matrix3 = std::array<double, 9>;
using Matrix6 = std::array<double, 36>;
/// Variance of an axis whose error is unknown, or which is not measured, in a matrix where others are known.
inline constexpr double kUnknownVariance = 1e6;
inline constexpr float kUnmeasured = std::numeric_limits<float>::quiet_NaN();

struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  NAVCAL_ROS_MEMBERS("builtin_interfaces/Time", sec, nanosec)
};

struct Header {
  Time stamp;  ///< UTC
  std::string frame_id;
  NAVCAL_ROS_MEMBERS("std_msgs/Header", stamp, frame_id)

  /// Nanoseconds since 1970.
  [[nodiscard]] std::int64_t stamp_ns() const { return stamp.sec * kSecond_ns + stamp.nanosec; }
  void set_stamp(std::int64_t ns) {
    stamp = {static_cast<std::int32_t>(ns / kSecond_ns), static_cast<std::uint32_t>(ns % kSecond_ns)};
  }

 private:
  static constexpr std::int64_t kSecond_ns = 1'000'000'000;
};

struct Vector3 {
  double x = 0, y = 0, z = 0;
  NAVCAL_ROS_MEMBERS("geometry_msgs/Vector3", x, y, z)
};

struct Point {
  double x = 0, y = 0, z = 0;
  NAVCAL_ROS_MEMBERS("geometry_msgs/Point", x, y, z)
};

struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
  NAVCAL_ROS_MEMBERS("geometry_msgs/Quaternion", x, y, z, w)
};

struct Pose {
  Point position;
  Quaternion orientation;
  NAVCAL_ROS_MEMBERS("geometry_msgs/Pose", position, orientation)
};

/// Order of the covariance: x, y, z, turns about x, y, z.
struct PoseWithCovariance {
  Pose pose;
  Matrix6 covariance{};
  NAVCAL_ROS_MEMBERS("geometry_msgs/PoseWithCovariance", pose, covariance)
};

struct Twist {
  Vector3 linear, angular;
  NAVCAL_ROS_MEMBERS("geometry_msgs/Twist", linear, angular)
};

struct TwistWithCovariance {
  Twist twist;
  Matrix6 covariance{};
  NAVCAL_ROS_MEMBERS("geometry_msgs/TwistWithCovariance", twist, covariance)
};

struct TwistWithCovarianceStamped {
  Header header;
  TwistWithCovariance twist;
  NAVCAL_ROS_MEMBERS("geometry_msgs/TwistWithCovarianceStamped", header, twist)
};

/// Velocities are those of the child frame, in its axes.
struct Odometry {
  Header header;
  std::string child_frame_id;
  PoseWithCovariance pose;
  TwistWithCovariance twist;
  NAVCAL_ROS_MEMBERS("nav_msgs/Odometry", header, child_frame_id, pose, twist)
};

/// -1 in the first place of a covariance: the quantity is absent; all zeros: its error is unknown.
struct Imu {
  Header header;
  Quaternion orientation;
  Matrix3 orientation_covariance{-1};
  Vector3 angular_velocity;
  Matrix3 angular_velocity_covariance{-1};
  Vector3 linear_acceleration;  ///< specific force: +9.81 in z when level and still
  Matrix3 linear_acceleration_covariance{-1};
  NAVCAL_ROS_MEMBERS("sensor_msgs/Imu", header, orientation, orientation_covariance, angular_velocity,
                     angular_velocity_covariance, linear_acceleration, linear_acceleration_covariance)
};

/// Zeros: the error is unknown, here and in the two that follow.
struct MagneticField {
  Header header;
  Vector3 magnetic_field;  ///< T
  Matrix3 magnetic_field_covariance{};
  NAVCAL_ROS_MEMBERS("sensor_msgs/MagneticField", header, magnetic_field, magnetic_field_covariance)
};

struct FluidPressure {
  Header header;
  double fluid_pressure = 0;  ///< Pa, absolute
  double variance = 0;
  NAVCAL_ROS_MEMBERS("sensor_msgs/FluidPressure", header, fluid_pressure, variance)
};

struct Temperature {
  Header header;
  double temperature = 0;  ///< degrees Celsius
  double variance = 0;
  NAVCAL_ROS_MEMBERS("sensor_msgs/Temperature", header, temperature, variance)
};

struct NavSatStatus {
  static constexpr std::int8_t kNoFix = -1, kFix = 0;
  static constexpr std::uint16_t kGps = 1;
  std::int8_t status = kNoFix;
  std::uint16_t service = kGps;
  NAVCAL_ROS_MEMBERS("sensor_msgs/NavSatStatus", status, service)
};

struct NavSatFix {
  static constexpr std::uint8_t kUnknown = 0, kApproximated = 1, kDiagonalKnown = 2;
  Header header;
  NavSatStatus status;
  double latitude = 0, longitude = 0;  ///< degrees, WGS84
  double altitude = 0;                 ///< above the ellipsoid; not a number: unknown
  Matrix3 position_covariance{};       ///< east, north, up
  std::uint8_t position_covariance_type = kUnknown;
  NAVCAL_ROS_MEMBERS("sensor_msgs/NavSatFix", header, status, latitude, longitude, altitude, position_covariance,
                     position_covariance_type)
};

struct BatteryState {
  Header header;
  float voltage = kUnmeasured, temperature = kUnmeasured;
  float current = kUnmeasured;  ///< negative while it is discharged
  float charge = kUnmeasured, capacity = kUnmeasured, design_capacity = kUnmeasured;  ///< Ah
  float percentage = kUnmeasured;                                                     ///< 0 to 1
  std::uint8_t power_supply_status = 0, power_supply_health = 0, power_supply_technology = 0;
  bool present = true;
  std::vector<float> cell_voltage, cell_temperature;
  std::string location, serial_number;
  NAVCAL_ROS_MEMBERS("sensor_msgs/BatteryState", header, voltage, temperature, current, charge, capacity,
                     design_capacity, percentage, power_supply_status, power_supply_health,
                     power_supply_technology, present, cell_voltage, cell_temperature, location, serial_number)
};

struct Range {
  Header header;
  std::uint8_t radiation_type = 0;  ///< 0: sound
  float field_of_view = 0, min_range = 0, max_range = 0, range = 0;
  std::optional<float> variance;  ///< absent in Humble
  NAVCAL_ROS_MEMBERS("sensor_msgs/Range", header, radiation_type, field_of_view, min_range, max_range, range,
                     variance)
};

struct KeyValue {
  std::string key, value;
  NAVCAL_ROS_MEMBERS("diagnostic_msgs/KeyValue", key, value)
};

struct DiagnosticStatus {
  static constexpr std::byte kOk{0}, kWarning{1}, kError{2}, kStale{3};
  std::byte level = kOk;
  std::string name, message, hardware_id;
  std::vector<KeyValue> values;
  NAVCAL_ROS_MEMBERS("diagnostic_msgs/DiagnosticStatus", level, name, message, hardware_id, values)
};

struct DiagnosticArray {
  Header header;
  std::vector<DiagnosticStatus> status;
  NAVCAL_ROS_MEMBERS("diagnostic_msgs/DiagnosticArray", header, status)
};

struct Transform {
  Vector3 translation;
  Quaternion rotation;
  NAVCAL_ROS_MEMBERS("geometry_msgs/Transform", translation, rotation)
};

struct TransformStamped {
  Header header;
  std::string child_frame_id;
  Transform transform;
  NAVCAL_ROS_MEMBERS("geometry_msgs/TransformStamped", header, child_frame_id, transform)
};

struct TransformMessage {
  std::vector<TransformStamped> transforms;
  NAVCAL_ROS_MEMBERS("tf2_msgs/TFMessage", transforms)
};

/// A number alone, and a list of numbers: std_msgs Float32, Float64, Float32MultiArray, Float64MultiArray.
template <class T>
struct Number {
  T data = 0;
  NAVCAL_ROS_MEMBERS(sizeof(T) == sizeof(float) ? "std_msgs/Float32" : "std_msgs/Float64", data)
};

struct MultiArrayDimension {
  std::string label;
  std::uint32_t size = 0, stride = 0;
  NAVCAL_ROS_MEMBERS("std_msgs/MultiArrayDimension", label, size, stride)
};

struct MultiArrayLayout {
  std::vector<MultiArrayDimension> dim;
  std::uint32_t data_offset = 0;
  NAVCAL_ROS_MEMBERS("std_msgs/MultiArrayLayout", dim, data_offset)
};

template <class T>
struct NumberArray {
  MultiArrayLayout layout;
  std::vector<T> data;
  NAVCAL_ROS_MEMBERS(sizeof(T) == sizeof(float) ? "std_msgs/Float32MultiArray" : "std_msgs/Float64MultiArray",
                     layout, data)
};

/// Pulses of an autopilot's outputs, us.
struct RcOut {
  Header header;
  std::vector<std::uint16_t> channels;
  NAVCAL_ROS_MEMBERS("mavros_msgs/RCOut", header, channels)
};

/// Positions (rad, m), velocities and efforts in the order of the names; each list may be empty.
struct JointState {
  Header header;
  std::vector<std::string> name;
  std::vector<double> position, velocity, effort;
  NAVCAL_ROS_MEMBERS("sensor_msgs/JointState", header, name, position, velocity, effort)
};

#undef NAVCAL_ROS_MEMBERS

/// A type that navcal writes, as recorders and middleware know it.
struct MessageType {
  std::string name;        ///< "sensor_msgs/msg/Imu"
  std::string_view hash;   ///< "RIHS01_..." (REP 2011)
  std::string definition;  ///< ros2msg: its members, then those of all types that it refers to
};

/// "sensor_msgs/Imu" to "sensor_msgs/msg/Imu".
[[nodiscard]] std::string full_name(std::string_view type);
/// The type of a full name; null where it is not written.
[[nodiscard]] const MessageType* written_type(std::string_view name);

}  // namespace navcal::protocols::ros2
