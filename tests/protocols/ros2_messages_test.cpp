// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <nettle/sha2.h>

#include <array>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "protocols/ros2/cdr_reader.h"
#include "protocols/ros2/cdr_writer.h"
#include "protocols/ros2/ros_messages.h"

namespace navcal::protocols::ros2 {
namespace {

constexpr std::array kTypes{"sensor_msgs/msg/Imu",
                            "sensor_msgs/msg/MagneticField",
                            "sensor_msgs/msg/FluidPressure",
                            "sensor_msgs/msg/NavSatFix",
                            "sensor_msgs/msg/BatteryState",
                            "sensor_msgs/msg/Range",
                            "sensor_msgs/msg/Temperature",
                            "nav_msgs/msg/Odometry",
                            "geometry_msgs/msg/TwistWithCovarianceStamped",
                            "diagnostic_msgs/msg/DiagnosticArray",
                            "tf2_msgs/msg/TFMessage"};

/// The description of a type that is hashed (REP 2011), made of the lines of its definition.
class TypeDescription {
 public:
  explicit TypeDescription(const MessageType& type) {
    std::istringstream lines("MSG: " + type.name + "\n" + type.definition);
    std::string* fields = nullptr;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("=")) continue;
      if (line.starts_with("MSG: ")) {
        const std::string name = line.substr(5);
        fields = &types_[name == type.name ? name : full_name(name)];
        continue;
      }
      const auto blank = line.find(' ');
      *fields += (fields->empty() ? "" : ", ") + field(line.substr(blank + 1), line.substr(0, blank));
    }
    main_ = type.name;
  }
  [[nodiscard]] std::string hash() const {
    std::string others;
    for (const auto& [name, fields] : types_) {
      if (name != main_) others += (others.empty() ? "" : ", ") + described(name);
    }
    const std::string json =
        "{\"type_description\": " + described(main_) + ", \"referenced_type_descriptions\": [" + others + "]}";
    sha256_ctx context;
    sha256_init(&context);
    sha256_update(&context, json.size(), reinterpret_cast<const std::uint8_t*>(json.data()));
    std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
    sha256_digest(&context, digest.size(), digest.data());
    std::string text = "RIHS01_";
    for (const unsigned byte : digest) text += {"0123456789abcdef"[byte / 16], "0123456789abcdef"[byte % 16]};
    return text;
  }

 private:
  [[nodiscard]] std::string described(const std::string& name) const {
    return "{\"type_name\": \"" + name + "\", \"fields\": [" + types_.at(name) + "]}";
  }
  static std::string field(const std::string& name, std::string type) {
    static const std::map<std::string, int> kIds{{"int8", 2},   {"uint8", 3},    {"uint16", 5},   {"int32", 6},
                                                 {"uint32", 7}, {"float32", 10}, {"float64", 11}, {"bool", 15},
                                                 {"byte", 16},  {"string", 17}};
    constexpr int kNested = 1, kArray = 48, kSequence = 144;
    int capacity = 0, kind = 0;
    if (const auto bracket = type.find('['); bracket != std::string::npos) {
      const std::string inside = type.substr(bracket + 1, type.size() - bracket - 2);
      kind = inside.empty() ? kSequence : kArray;
      if (!inside.empty()) capacity = std::stoi(inside);
      type.resize(bracket);
    }
    const auto id = kIds.find(type);
    const bool is_nested = id == kIds.end();
    return "{\"name\": \"" + name +
           "\", \"type\": {\"type_id\": " + std::to_string(kind + (is_nested ? kNested : id->second)) +
           ", \"capacity\": " + std::to_string(capacity) + ", \"string_capacity\": 0, \"nested_type_name\": \"" +
           (is_nested ? full_name(type) : "") + "\"}}";
  }

  std::map<std::string, std::string> types_;  ///< fields by name
  std::string main_;
};

TEST(RosMessages, TypeHashesFollowFromTheMembersThatAreWritten) {
  for (const char* const name : kTypes) {
    const MessageType* const type = written_type(name);
    ASSERT_NE(type, nullptr) << name;
    EXPECT_EQ(TypeDescription(*type).hash(), type->hash) << name << "\n" << type->definition;
  }
  EXPECT_EQ(written_type("sensor_msgs/msg/Image"), nullptr);
}

TEST(RosMessages, ADefinitionHasEachTypeOnce) {
  const std::string line(80, '=');
  EXPECT_EQ(
      written_type("sensor_msgs/msg/MagneticField")->definition,
      "std_msgs/Header header\ngeometry_msgs/Vector3 magnetic_field\nfloat64[9] magnetic_field_covariance\n" +
          line + "\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" + line +
          "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n" + line +
          "\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n");
}

/// A message as other middleware wrote it; what is written of it again has the same bytes, but for their padding.
template <class Message>
Message of_others(const std::string& name) {
  std::ifstream file(NAVCAL_SHARED_DIR "/data/wires/cdr_" + name + ".bin", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const auto message = decode<Message>(bytes);
  if (!message) return Message{};
  const std::string again = encode(*message);
  EXPECT_LE(bytes.size() - again.size(), 3U) << name;
  EXPECT_EQ(again.substr(4), bytes.substr(4, again.size() - 4)) << name;
  return *message;
}

TEST(RosMessages, AreThoseOfCycloneDds) {
  if (!std::ifstream(NAVCAL_SHARED_DIR "/data/wires/cdr_imu.bin")) GTEST_SKIP() << "no samples of CycloneDDS here";
  const auto imu = of_others<Imu>("imu");
  EXPECT_EQ(imu.header.frame_id, "base_link");
  EXPECT_EQ(imu.orientation.x, 0.8);
  EXPECT_EQ(imu.orientation.w, 0.6);
  EXPECT_EQ(imu.orientation_covariance[8], 1e-4);
  EXPECT_EQ(imu.angular_velocity.z, 6);
  EXPECT_EQ(imu.linear_acceleration.z, 9.80665);
  EXPECT_EQ(of_others<MagneticField>("mag").magnetic_field.z, -3.46e-5);
  EXPECT_EQ(of_others<FluidPressure>("pressure").fluid_pressure, 125000.5);
  const auto fix = of_others<NavSatFix>("fix");
  EXPECT_EQ(fix.latitude, 60.3912345);
  EXPECT_EQ(fix.position_covariance[8], 6.25);
  EXPECT_EQ(fix.position_covariance_type, NavSatFix::kDiagonalKnown);
  const auto odometry = of_others<Odometry>("odometry");
  EXPECT_EQ(odometry.child_frame_id, "base_link");
  EXPECT_EQ(odometry.pose.pose.position.x, 1.5);
  EXPECT_EQ(odometry.twist.covariance[35], 0.001);
  EXPECT_EQ(of_others<TwistWithCovarianceStamped>("dvl").twist.twist.linear.y, 6);
}

DiagnosticArray diagnostics() {
  DiagnosticArray array;
  array.header.set_stamp(1'700'000'000'000'000'007);
  array.status.resize(2);
  array.status[1] = {DiagnosticStatus::kError, "compass", "silent", "TCM2", {{"frames", "12"}, {"", ""}}};
  return array;
}

TEST(RosMessages, ListsAndTextsComeBack) {
  const auto read = decode<DiagnosticArray>(encode(diagnostics()));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->header.stamp_ns(), 1'700'000'000'000'000'007);
  ASSERT_EQ(read->status.size(), 2U);
  EXPECT_EQ(read->status[1].level, DiagnosticStatus::kError);
  EXPECT_EQ(read->status[1].values.at(0).value, "12");
  BatteryState battery;
  battery.cell_voltage = {3.5F, 3.25F};
  battery.serial_number = "A7";
  const auto pack = decode<BatteryState>(encode(battery));
  ASSERT_TRUE(pack);
  EXPECT_EQ(pack->cell_voltage, battery.cell_voltage);
  EXPECT_EQ(pack->serial_number, "A7");
  EXPECT_TRUE(pack->present);
}

TEST(RosMessages, ARangeOfHumbleHasNoVariance) {
  Range range;
  range.range = 12.5F;
  range.variance = 0.25F;
  std::string bytes = encode(range);
  EXPECT_EQ(decode<Range>(bytes)->variance, 0.25F);
  bytes.resize(bytes.size() - sizeof(float));
  EXPECT_EQ(decode<Range>(bytes)->range, 12.5F);
  EXPECT_FALSE(decode<Range>(bytes)->variance);
  bytes.pop_back();
  EXPECT_FALSE(decode<Range>(bytes));
}

TEST(RosMessages, NoLengthIsBelieved) {
  const std::string whole = encode(diagnostics());
  for (std::size_t at = 4; at + 4 <= whole.size(); at += 4) {
    std::string bytes = whole;
    bytes.replace(at, 4, "\xff\xff\xff\xff");
    if (const auto read = decode<DiagnosticArray>(bytes)) {
      EXPECT_LE(read->status.size(), whole.size());
    }
  }
  for (std::size_t cut = 0; cut < whole.size(); ++cut)
    EXPECT_FALSE(decode<DiagnosticArray>(whole.substr(0, cut))) << cut;
}

}  // namespace
}  // namespace navcal::protocols::ros2
