// SPDX-License-Identifier: Apache-2.0
#include "record/ros2/sample_messages.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <utility>

#include "base/angles.h"
#include "base/rotation.h"
#include "protocols/ros2/cdr_writer.h"

namespace navcal::record {
namespace {

namespace ros2 = protocols::ros2;
using std::numbers::pi;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

double squared(double x) { return x * x; }
double variance_or(const std::optional<double>& std, double unknown) { return std ? squared(*std) : unknown; }

/// A diagonal matrix; zeros where the error is unknown.
ros2::Matrix3 same_in_all_axes(const std::optional<double>& std) {
  const double variance = variance_or(std, 0);
  return {variance, 0, 0, 0, variance, 0, 0, 0, variance};
}

/// A diagonal matrix of x, y, z, and turns about x, y, z.
ros2::Matrix6 diagonal(const std::array<double, 6>& variances) {
  ros2::Matrix6 matrix{};
  for (std::size_t i = 0; i < variances.size(); ++i) matrix[7 * i] = variances[i];
  return matrix;
}

/// One message of the log on its way to messages of ROS.
class Maker {
 public:
  Maker(const FlatJson& json, RosAxes axes, std::optional<base::LocalPlane>& origin, std::int64_t utc_ns,
        std::vector<RosMessage>& made)
      : json_(json), axes_(axes), origin_(origin), utc_ns_(utc_ns), made_(made), device_(json.get("device")) {
    // Names in ROS have no other characters.
    for (char& c : device_) {
      if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    }
    if (!device_.empty() && std::isdigit(static_cast<unsigned char>(device_[0])) != 0) device_.insert(0, "_");
  }

  void imu() {
    auto rate = vector("rate_rad_s");
    if (rate) (*rate)[2] = number("yaw_rate_calibrated_rad_s").value_or((*rate)[2]);
    const auto force = vector("specific_force_m_s2");
    if (!rate && !force) return;
    ros2::Imu imu;
    if (rate) {
      imu.angular_velocity = turned(*rate);
      imu.angular_velocity_covariance = same_in_all_axes(number("rate_std_rad_s"));
    }
    if (force) {
      imu.linear_acceleration = turned(*force);
      imu.linear_acceleration_covariance = same_in_all_axes(number("specific_force_std_m_s2"));
    }
    add("data", body(), std::move(imu));
  }

  void compass() {
    constexpr double kTesla = 1e-6;
    if (auto field = vector("field_body_uT")) {
      for (double& component : *field) component *= kTesla;
      auto std_T = number("field_std_uT");
      if (std_T) *std_T *= kTesla;
      add("mag", body(), ros2::MagneticField{{}, turned(*field), same_in_all_axes(std_T)});
    }
    const auto heading = number("heading_rad"), pitch = number("pitch_rad"), roll = number("roll_rad");
    if (json_.get("heading_is_true") != "true" || !heading || !pitch || !roll) return;
    ros2::Imu attitude;
    attitude.orientation = orientation(*heading, *pitch, *roll);
    const auto heading_std = number("heading_std_rad"), tilt_std = number("tilt_std_rad");
    const double unknown = heading_std || tilt_std ? ros2::kUnknownVariance : 0;
    const double tilt = variance_or(tilt_std, unknown);
    attitude.orientation_covariance = {tilt, 0, 0, 0, tilt, 0, 0, 0, variance_or(heading_std, unknown)};
    add("attitude", body(), std::move(attitude));
  }

  void fix() {
    const auto lat = number("lat"), lon = number("lon"), height = number("height_m");
    const std::string_view kind = json_.get("fix");
    ros2::NavSatFix fix;
    if (lat && lon && kind != "none" && kind != "acquiring" && kind != "bad_geometry")
      fix.status.status = ros2::NavSatStatus::kFix;
    fix.latitude = lat.value_or(kNoNumber);
    fix.longitude = lon.value_or(kNoNumber);
    fix.altitude = height.value_or(kNoNumber);
    const auto level_std = number("position_std_m"), up_std = height ? number("height_std_m") : std::nullopt;
    if (level_std || up_std) {
      const double level = variance_or(level_std, ros2::kUnknownVariance);
      fix.position_covariance = {level, 0, 0, 0, level, 0, 0, 0, variance_or(up_std, ros2::kUnknownVariance)};
      fix.position_covariance_type =
          level_std && up_std ? ros2::NavSatFix::kDiagonalKnown : ros2::NavSatFix::kApproximated;
    }
    add("fix", device_, std::move(fix));
  }

  void pressure() {
    if (const auto pressure_Pa = number("pressure_Pa"))
      add("pressure", device_, ros2::FluidPressure{{}, *pressure_Pa, variance_or(number("pressure_std_Pa"), 0)});
  }

  void doppler_log() {
    altitude();
    const auto velocity = vector("bottom_velocity_m_s");
    if (!velocity || json_.get("frame") != "body") return;
    ros2::TwistWithCovarianceStamped stamped;
    stamped.twist.twist.linear = turned(*velocity);
    constexpr double kUnknown = ros2::kUnknownVariance;
    const double variance = variance_or(number("bottom_velocity_std_m_s"), kUnknown);
    stamped.twist.covariance = diagonal({variance, variance, variance, kUnknown, kUnknown, kUnknown});
    add("twist", body(), std::move(stamped));
  }

  void altitude() {
    const auto altitude_m = number("altitude_m");
    if (!altitude_m) return;
    ros2::Range range;
    range.max_range = std::numeric_limits<float>::infinity();
    range.range = static_cast<float>(*altitude_m);
    range.variance = static_cast<float>(variance_or(number("altitude_std_m"), 0));
    add("range", device_, std::move(range));
  }

  void temperature(std::string_view member, std::string_view std_member) {
    if (const auto temperature_C = number(member))
      add("temperature", device_, ros2::Temperature{{}, *temperature_C, variance_or(number(std_member), 0)});
  }

  void sensor() {
    if (json_.get("quantity") == "temperature" && json_.get("unit") == "degC") temperature("value", "value_std");
  }

  void battery() {
    constexpr std::uint8_t kCharging = 1, kDischarging = 2;
    const double current_A = number("current_A").value_or(kNoNumber);
    ros2::BatteryState battery;
    battery.voltage = static_cast<float>(number("voltage_V").value_or(kNoNumber));
    battery.current = static_cast<float>(-current_A);
    battery.charge = static_cast<float>(number("charge_Ah").value_or(kNoNumber));
    battery.percentage = static_cast<float>(number("charge_percent").value_or(kNoNumber) / 100);
    battery.power_supply_status = current_A > 0 ? kDischarging : current_A < 0 ? kCharging : 0;
    add("battery", device_, std::move(battery));
  }

  /// The estimate of what is left, which no gauge sends.
  void charge() {
    device_.clear();
    battery();
  }

  /// Axes that are not known are 0, with a variance that says so.
  void odometry() {
    constexpr double kUnknown = ros2::kUnknownVariance;
    const auto heading = number("heading_rad"), pitch = number("pitch_rad"), roll = number("roll_rad");
    if (!heading) return;
    const bool is_ned = axes_ == RosAxes::ned;
    ros2::Odometry odometry;
    odometry.child_frame_id = body();
    odometry.pose.pose.orientation = orientation(*heading, pitch.value_or(0), roll.value_or(0));
    std::array<double, 6> variances{kUnknown, kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
    variances[5] = variance_or(number("heading_std_rad"), kUnknown);
    auto& position = odometry.pose.pose.position;
    position.z = number("depth_m").value_or(0) * (is_ned ? 1 : -1);
    variances[2] = variance_or(number("depth_std_m"), kUnknown);
    const auto lat = number("lat"), lon = number("lon");
    if (lat && lon) {
      const double lat_rad = *lat * base::kRadiansPerDegree, lon_rad = *lon * base::kRadiansPerDegree;
      if (!origin_) origin_.emplace(lat_rad, lon_rad);
      const auto [north_m, east_m] = origin_->position_m(lat_rad, lon_rad);
      position.x = is_ned ? north_m : east_m;
      position.y = is_ned ? east_m : north_m;
      variances[is_ned ? 0 : 1] = variance_or(number("north_std_m"), kUnknown);
      variances[is_ned ? 1 : 0] = variance_or(number("east_std_m"), kUnknown);
    }
    odometry.pose.covariance = diagonal(variances);
    if (const auto ned = vector("velocity_m_s")) {
      const Eigen::Matrix3d rotation = base::rotation_of({roll.value_or(0), pitch.value_or(0), *heading});
      const Eigen::Vector3d v = rotation.transpose() * Eigen::Vector3d((*ned)[0], (*ned)[1], (*ned)[2]);
      odometry.twist.twist.linear = turned({v.x(), v.y(), v.z()});
    }
    odometry.twist.covariance = diagonal({kUnknown, kUnknown, kUnknown, kUnknown, kUnknown, kUnknown});
    device_.clear();
    add("odometry", is_ned ? "odom_ned" : "odom", std::move(odometry));
  }

  void diagnostics() {
    ros2::DiagnosticArray array;
    const auto add_status = [&](bool is_good, std::string_view name, std::string_view message) -> auto& {
      array.status.push_back({is_good ? ros2::DiagnosticStatus::kOk : ros2::DiagnosticStatus::kError,
                              "navcal: " + std::string(name),
                              std::string(message),
                              {},
                              {}});
      return array.status.back();
    };
    for (int i = 0;; ++i) {
      const std::string alarm = "alarms." + std::to_string(i) + '.';
      if (json_.find(alarm + "alarm") == nullptr) break;
      add_status(false, json_.get(alarm + "alarm"), json_.get(alarm + "device"));
    }
    for (int i = 0;; ++i) {
      const std::string port = "ports." + std::to_string(i) + '.';
      if (json_.find(port + "device") == nullptr) break;
      const std::string_view state = json_.get(port + "state"), reason = json_.get(port + "reason");
      auto& status = add_status(state == "running" || state == "off", json_.get(port + "device"),
                                reason.empty() ? state : reason);
      status.hardware_id = json_.get(port + "serial_number");
      for (const char* const key : {"protocol", "state", "frames", "samples", "bad", "gaps"})
        status.values.push_back({key, std::string(json_.get(port + key))});
    }
    const std::string_view log = json_.get("log.state");
    if (!log.empty()) add_status(log != "full" && log != "failing", "log", log);
    append("/diagnostics", {}, std::move(array));
  }

 private:
  [[nodiscard]] std::optional<double> number(std::string_view member) const {
    const double value = number_or_nan(json_.get(member));
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  }
  [[nodiscard]] std::optional<std::array<double, 3>> vector(const std::string& member) const {
    const auto x = number(member + ".0"), y = number(member + ".1"), z = number(member + ".2");
    if (!x || !y || !z) return std::nullopt;
    return std::array{*x, *y, *z};
  }
  [[nodiscard]] std::string body() const { return axes_ == RosAxes::ned ? "base_link_frd" : "base_link"; }
  [[nodiscard]] ros2::Vector3 turned(const std::array<double, 3>& frd) const {
    const double sign = axes_ == RosAxes::ned ? 1 : -1;
    return {frd[0], sign * frd[1], sign * frd[2]};
  }
  /// Heading from true north.
  [[nodiscard]] ros2::Quaternion orientation(double heading_rad, double pitch_rad, double roll_rad) const {
    const bool is_ned = axes_ == RosAxes::ned;
    const Eigen::Quaterniond q(base::rotation_of(
        {roll_rad, is_ned ? pitch_rad : -pitch_rad, is_ned ? heading_rad : pi / 2 - heading_rad}));
    return {q.x(), q.y(), q.z(), q.w()};
  }
  template <class Message>
  void add(std::string_view name, const std::string& frame, Message message) {
    append("/navcal/" + device_ + (device_.empty() ? "" : "/") + std::string(name), frame, std::move(message));
  }
  template <class Message>
  void append(std::string topic, const std::string& frame, Message message) {
    static const ros2::MessageType* const type = ros2::written_type(ros2::full_name(Message::kType));
    message.header.set_stamp(utc_ns_);
    message.header.frame_id = frame;
    made_.push_back({std::move(topic), type, utc_ns_, ros2::encode(message)});
  }

  const FlatJson& json_;
  RosAxes axes_;
  std::optional<base::LocalPlane>& origin_;
  std::int64_t utc_ns_;
  std::vector<RosMessage>& made_;
  std::string device_;
};

}  // namespace

void SampleMessages::learn_north(std::string_view topic, const FlatJson& json) {
  if (topic == "/health") {
    const std::string_view source = json.get("earth_field.declination_source");
    knows_declination_ = !source.empty() && source != "none";
  } else if (topic == "/event") {
    knows_declination_ |= json.get("name") == "earth_field" && json.get("message").starts_with("declination ");
  } else if (topic == "/config") {
    constexpr std::string_view kKey = "\ndeclination_deg = ";
    const std::string_view toml = json.get("toml");
    const std::size_t found = toml.find(kKey);
    if (found == std::string_view::npos) return;
    knows_declination_ = std::strtod(std::string(toml.substr(found + kKey.size(), 32)).c_str(), nullptr) != 0;
  } else if (topic == "/compass" && !json.get("heading_rad").empty()) {
    (json.get("heading_is_true") == "true" ? has_true_heading_ : has_magnetic_heading_) = true;
  }
}

std::vector<RosMessage> SampleMessages::made_of(std::string_view topic, std::string_view json,
                                                std::int64_t utc_ns) {
  static constexpr std::array<std::pair<std::string_view, void (Maker::*)()>, 11> kMakers{
      {{"/imu", &Maker::imu},
       {"/compass", &Maker::compass},
       {"/gps", &Maker::fix},
       {"/depth", &Maker::pressure},
       {"/dvl", &Maker::doppler_log},
       {"/altimeter", &Maker::altitude},
       {"/power", &Maker::battery},
       {"/battery", &Maker::charge},
       {"/sensor", &Maker::sensor},
       {"/nav", &Maker::odometry},
       {"/health", &Maker::diagnostics}}};
  std::vector<RosMessage> made;
  const auto known = std::ranges::find_if(kMakers, [&](const auto& maker) { return maker.first == topic; });
  if (known == kMakers.end() && topic != "/event" && topic != "/config") return made;
  const auto members = FlatJson::parse(json);
  if (!members) return made;
  learn_north(topic, *members);
  const bool knows_north = knows_declination_ || (has_true_heading_ && !has_magnetic_heading_);
  if (known == kMakers.end() || (topic == "/nav" && !knows_north)) return made;
  Maker maker(*members, axes_, origin_, utc_ns, made);
  (maker.*known->second)();
  maker.temperature("temperature_C", "");
  return made;
}

}  // namespace navcal::record
