// SPDX-License-Identifier: Apache-2.0
#include "record/ros2/sample_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "protocols/ros2/cdr_reader.h"

namespace navcal::record {
namespace {

namespace ros2 = protocols::ros2;
using std::numbers::pi;

constexpr std::int64_t kValid_ns = 1'700'000'000'123'456'789;

/// The message of a topic, decoded; its stamp and its frame are judged here.
template <class Message>
std::optional<Message> message_on(const std::vector<RosMessage>& made, std::string_view topic,
                                  std::string_view frame) {
  for (const RosMessage& each : made) {
    if (each.topic != topic) continue;
    EXPECT_EQ(each.type->name, ros2::full_name(Message::kType));
    const auto message = ros2::decode<Message>(each.cdr);
    if (!message) return std::nullopt;
    EXPECT_EQ(each.stamp_ns, kValid_ns);
    EXPECT_EQ(message->header.stamp_ns(), kValid_ns);
    EXPECT_EQ(message->header.frame_id, frame);
    return message;
  }
  return std::nullopt;
}

std::vector<RosMessage> made_of(std::string_view topic, std::string_view json, RosAxes axes = RosAxes::rep103) {
  return SampleMessages(axes).made_of(topic, json, kValid_ns);
}

constexpr std::string_view kImu =
    R"({"class":"IMU","time":1,"device":"imu-2","rate_rad_s":[0.5,0.25,-0.125],"yaw_rate_calibrated_rad_s":-0.25,)"
    R"("specific_force_m_s2":[0.5,1,-9.75],"rate_std_rad_s":0.5,"specific_force_std_m_s2":null,"temperature_C":8.5})";

TEST(SampleMessages, AtRestTheSpecificForcePointsUp) {
  const auto made = made_of("/imu", kImu);
  ASSERT_EQ(made.size(), 2U);
  const auto imu = message_on<ros2::Imu>(made, "/navcal/imu_2/data", "base_link");
  ASSERT_TRUE(imu);
  EXPECT_EQ(imu->orientation_covariance[0], -1) << "absent";
  EXPECT_EQ(imu->angular_velocity.y, -0.25);
  EXPECT_EQ(imu->angular_velocity.z, 0.25) << "calibrated";
  EXPECT_EQ(imu->angular_velocity_covariance[8], 0.25);
  EXPECT_EQ(imu->linear_acceleration.x, 0.5);
  EXPECT_EQ(imu->linear_acceleration.y, -1);
  EXPECT_EQ(imu->linear_acceleration.z, 9.75);
  EXPECT_EQ(imu->linear_acceleration_covariance, ros2::Matrix3{}) << "unknown";
  const auto temperature = message_on<ros2::Temperature>(made, "/navcal/imu_2/temperature", "imu_2");
  EXPECT_EQ(temperature.value().temperature, 8.5);
}

TEST(SampleMessages, AxesMayStayThoseOfNavcal) {
  const auto imu =
      message_on<ros2::Imu>(made_of("/imu", kImu, RosAxes::ned), "/navcal/imu_2/data", "base_link_frd");
  ASSERT_TRUE(imu);
  EXPECT_EQ(imu->angular_velocity.y, 0.25);
  EXPECT_EQ(imu->linear_acceleration.z, -9.75);
}

TEST(SampleMessages, WithoutRatesOrForceThereIsNoImu) {
  EXPECT_TRUE(made_of("/imu", R"({"class":"IMU","device":"imu","rate_rad_s":null,"depth_m":3})").empty());
  EXPECT_TRUE(made_of("/motor", R"({"class":"MOTOR","device":"motor","rpm":3})").empty());
  EXPECT_TRUE(made_of("/imu", "no JSON").empty());
}

TEST(SampleMessages, AMagneticHeadingIsNoYaw) {
  const std::string head = R"({"class":"COMPASS","device":"compass","heading_rad":0.25,"heading_is_true":)";
  const std::string tail = R"(,"pitch_rad":0.25,"roll_rad":0,"field_body_uT":[20,-5,43],"field_std_uT":0.5,)"
                           R"("heading_std_rad":0.125,"tilt_std_rad":null})";
  const auto magnetic = made_of("/compass", head + "false" + tail);
  ASSERT_EQ(magnetic.size(), 1U);
  const auto field = message_on<ros2::MagneticField>(magnetic, "/navcal/compass/mag", "base_link");
  ASSERT_TRUE(field);
  EXPECT_NEAR(field->magnetic_field.y, 5e-6, 1e-18);
  EXPECT_NEAR(field->magnetic_field_covariance[0], 0.25e-12, 1e-24);
  const auto attitude =
      message_on<ros2::Imu>(made_of("/compass", head + "true" + tail), "/navcal/compass/attitude", "base_link");
  ASSERT_TRUE(attitude);
  const auto& q = attitude->orientation;
  EXPECT_NEAR(std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z)), pi / 2 - 0.25, 1e-12);
  EXPECT_NEAR(std::asin(2 * (q.w * q.y - q.z * q.x)), -0.25, 1e-12) << "nose up is a negative turn about y";
  EXPECT_EQ(attitude->orientation_covariance[8], 0.015625);
  EXPECT_EQ(attitude->orientation_covariance[0], ros2::kUnknownVariance) << "no zero beside a known error";
  EXPECT_EQ(attitude->angular_velocity_covariance[0], -1);
}

TEST(SampleMessages, AFixStatesWhatIsKnown) {
  const auto fix = [](const std::string& members) {
    return *message_on<ros2::NavSatFix>(made_of("/gps", R"({"class":"GPS","device":"gps",)" + members + "}"),
                                        "/navcal/gps/fix", "gps");
  };
  const auto whole = fix(R"("lat":60.5,"lon":5.25,"fix":"3d","height_m":50,"position_std_m":2,"height_std_m":4)");
  EXPECT_EQ(whole.status.status, ros2::NavSatStatus::kFix);
  EXPECT_EQ(whole.latitude, 60.5);
  EXPECT_EQ(whole.altitude, 50);
  EXPECT_EQ(whole.position_covariance, (ros2::Matrix3{4, 0, 0, 0, 4, 0, 0, 0, 16}));
  EXPECT_EQ(whole.position_covariance_type, ros2::NavSatFix::kDiagonalKnown);
  const auto flat = fix(R"("lat":60.5,"lon":5.25,"fix":"2d","height_msl_m":3,"position_std_m":2)");
  EXPECT_TRUE(std::isnan(flat.altitude)) << "mean sea level is not the ellipsoid";
  EXPECT_EQ(flat.position_covariance_type, ros2::NavSatFix::kApproximated);
  EXPECT_EQ(flat.position_covariance[8], ros2::kUnknownVariance);
  const auto height = fix(R"("lat":60.5,"lon":5.25,"fix":"3d","height_m":50,"height_std_m":4)");
  EXPECT_EQ(height.position_covariance, (ros2::Matrix3{1e6, 0, 0, 0, 1e6, 0, 0, 0, 16}));
  const auto none = fix(R"("fix":"none")");
  EXPECT_EQ(none.status.status, ros2::NavSatStatus::kNoFix);
  EXPECT_EQ(none.position_covariance_type, ros2::NavSatFix::kUnknown);
}

TEST(SampleMessages, ADopplerLogInTheAxesOfTheBody) {
  const std::string head =
      R"({"class":"DVL","device":"dvl","altitude_m":12.5,"bottom_velocity_m_s":[1,0.5,-0.25],)";
  const auto made = made_of("/dvl", head + R"("bottom_velocity_std_m_s":0.5,"frame":"body"})");
  const auto twist = message_on<ros2::TwistWithCovarianceStamped>(made, "/navcal/dvl/twist", "base_link");
  ASSERT_TRUE(twist);
  EXPECT_EQ(twist->twist.twist.linear.y, -0.5);
  EXPECT_EQ(twist->twist.covariance[7], 0.25);
  EXPECT_EQ(twist->twist.covariance[35], 1e6) << "not measured";
  EXPECT_EQ(message_on<ros2::Range>(made, "/navcal/dvl/range", "dvl").value().range, 12.5F);
  EXPECT_EQ(made_of("/dvl", head + R"("frame":"earth"})").size(), 1U) << "the range";
}

TEST(SampleMessages, PressureRangeTemperatureAndBattery) {
  const auto pressure = message_on<ros2::FluidPressure>(
      made_of("/depth", R"({"device":"depth","depth_m":2,"pressure_Pa":125000.5,"pressure_std_Pa":2})"),
      "/navcal/depth/pressure", "depth");
  EXPECT_EQ(pressure.value().variance, 4);
  const auto range =
      message_on<ros2::Range>(made_of("/altimeter", R"({"device":"7m","altitude_m":12.5,"altitude_std_m":0.5})"),
                              "/navcal/_7m/range", "_7m");
  EXPECT_EQ(range.value().variance, 0.25F);
  EXPECT_EQ(made_of("/sensor", R"({"device":"ctd","quantity":"temperature","unit":"degC","value":4})").size(), 1U);
  EXPECT_TRUE(made_of("/sensor", R"({"device":"ctd","quantity":"oxygen","unit":"umol/l","value":4})").empty());
  const auto gauge = message_on<ros2::BatteryState>(
      made_of("/power", R"({"device":"pack","voltage_V":12.5,"current_A":2})"), "/navcal/pack/battery", "pack");
  EXPECT_EQ(gauge.value().current, -2.0F);
  EXPECT_TRUE(std::isnan(gauge.value().percentage));
  const auto charge = message_on<ros2::BatteryState>(
      made_of("/battery", R"({"device":"pack","voltage_V":12.5,"charge_Ah":20,"charge_percent":50})"),
      "/navcal/battery", "");
  EXPECT_EQ(charge.value().percentage, 0.5F);
}

/// 100 m north of the first position, nose up, going north over the ground.
constexpr std::string_view kFirst = R"({"class":"NAV","device":"navigation","lat":60,"lon":5,"heading_rad":0})";
constexpr std::string_view kSecond =
    R"({"class":"NAV","device":"navigation","lat":60.0009,"lon":5,"heading_rad":1.5707963267948966,"pitch_rad":0,)"
    R"("roll_rad":0,"depth_m":3,"depth_std_m":0.2,"north_std_m":2,"east_std_m":4,"heading_std_rad":0.5,"velocity_m_s":[1,0,0]})";
constexpr std::string_view kNorth = R"({"class":"HEALTH","earth_field":{"declination_source":"model"}})";

TEST(SampleMessages, OdometryStartsAtTheFirstPosition) {
  SampleMessages messages;
  (void)messages.made_of("/health", kNorth, kValid_ns);
  (void)messages.made_of("/nav", kFirst, kValid_ns);
  const auto odometry =
      message_on<ros2::Odometry>(messages.made_of("/nav", kSecond, kValid_ns), "/navcal/odometry", "odom");
  ASSERT_TRUE(odometry);
  EXPECT_EQ(odometry->child_frame_id, "base_link");
  EXPECT_NEAR(odometry->pose.pose.position.x, 0, 1e-6);
  EXPECT_NEAR(odometry->pose.pose.position.y, 100, 0.5);
  EXPECT_EQ(odometry->pose.pose.position.z, -3);
  EXPECT_NEAR(odometry->pose.pose.orientation.w, 1, 1e-12) << "to the east";
  EXPECT_EQ(odometry->pose.covariance[0], 16) << "east";
  EXPECT_EQ(odometry->pose.covariance[7], 4);
  EXPECT_NEAR(odometry->pose.covariance[14], 0.04, 1e-12);
  EXPECT_EQ(odometry->pose.covariance[35], 0.25);
  EXPECT_NEAR(odometry->twist.twist.linear.x, 0, 1e-12);
  EXPECT_NEAR(odometry->twist.twist.linear.y, 1, 1e-12) << "to port";
  SampleMessages ned(RosAxes::ned);
  (void)ned.made_of("/health", kNorth, kValid_ns);
  const auto same =
      message_on<ros2::Odometry>(ned.made_of("/nav", kSecond, kValid_ns), "/navcal/odometry", "odom_ned");
  ASSERT_TRUE(same);
  EXPECT_EQ(same->pose.pose.position.z, 3);
  EXPECT_EQ(same->pose.covariance[0], 4) << "north";
  EXPECT_NEAR(same->twist.twist.linear.y, -1, 1e-12);
}

TEST(SampleMessages, WithoutTrueNorthThereIsNoOdometry) {
  const auto count = [](std::initializer_list<std::pair<std::string_view, std::string_view>> before) {
    SampleMessages messages;
    for (const auto& [topic, json] : before) (void)messages.made_of(topic, json, kValid_ns);
    return messages.made_of("/nav", kSecond, kValid_ns).size();
  };
  constexpr std::string_view kMagnetic = R"({"device":"a","heading_rad":1,"heading_is_true":false})";
  constexpr std::string_view kTrue = R"({"device":"b","heading_rad":1,"heading_is_true":true})";
  EXPECT_EQ(count({}), 0U);
  EXPECT_EQ(count({{"/health", R"({"earth_field":{"declination_source":"none"}})"}}), 0U);
  EXPECT_EQ(count({{"/event", R"({"name":"earth_field","message":"the declination is not known"})"}}), 0U);
  EXPECT_EQ(count({{"/event", R"({"name":"earth_field","message":"declination 1.20 deg east"})"}}), 1U);
  EXPECT_EQ(count({{"/config", R"({"toml":"[environment]\ndeclination_deg = 0.0\n"})"}}), 0U);
  EXPECT_EQ(count({{"/config", R"({"toml":"[environment]\ndeclination_deg = -2.5\n"})"}}), 1U);
  EXPECT_EQ(count({{"/compass", kTrue}}), 1U);
  EXPECT_EQ(count({{"/compass", kTrue}, {"/compass", kMagnetic}}), 0U);
}

TEST(SampleMessages, HealthBecomesDiagnostics) {
  const auto array = message_on<ros2::DiagnosticArray>(
      made_of("/health",
              R"({"alarms":[{"alarm":"leak_aft","device":"imu"}],"ports":[{"device":"imu","state":"running",)"
              R"("reason":"","frames":12},{"device":"gps","state":"silent","reason":"no bytes"}],)"
              R"("log":{"state":"writing"}})"),
      "/diagnostics", "");
  ASSERT_TRUE(array);
  ASSERT_EQ(array->status.size(), 4U);
  EXPECT_EQ(array->status[0].name, "navcal: leak_aft");
  EXPECT_EQ(array->status[0].level, ros2::DiagnosticStatus::kError);
  EXPECT_EQ(array->status[1].level, ros2::DiagnosticStatus::kOk);
  EXPECT_EQ(array->status[1].values.at(2).value, "12");
  EXPECT_EQ(array->status[2].message, "no bytes");
  EXPECT_EQ(array->status[3].level, ros2::DiagnosticStatus::kOk);
}

TEST(SampleMessages, AnErrorThatIsNotKnownIsZeroAndAllOthersAreOnTheDiagonal) {
  const std::string head =
      R"({"device":"c","heading_rad":0.25,"heading_is_true":true,"pitch_rad":0.25,"roll_rad":0)";
  const auto covariance = [&](const std::string& members) {
    return message_on<ros2::Imu>(made_of("/compass", head + members + "}"), "/navcal/c/attitude", "base_link")
        .value()
        .orientation_covariance;
  };
  EXPECT_EQ(covariance(""), ros2::Matrix3{});
  EXPECT_EQ(covariance(R"(,"heading_std_rad":0.5)"), (ros2::Matrix3{1e6, 0, 0, 0, 1e6, 0, 0, 0, 0.25}));
  EXPECT_EQ(covariance(R"(,"tilt_std_rad":0.5)"), (ros2::Matrix3{0.25, 0, 0, 0, 0.25, 0, 0, 0, 1e6}));
  EXPECT_EQ(covariance(R"(,"heading_std_rad":0.5,"tilt_std_rad":0.25)"),
            (ros2::Matrix3{0.0625, 0, 0, 0, 0.0625, 0, 0, 0, 0.25}));
  const auto range = message_on<ros2::Range>(made_of("/altimeter", R"({"device":"a","altitude_m":12.5})"),
                                             "/navcal/a/range", "a");
  EXPECT_EQ(range.value().variance, 0);
  const auto pressure = message_on<ros2::FluidPressure>(made_of("/depth", R"({"device":"d","pressure_Pa":1})"),
                                                        "/navcal/d/pressure", "d");
  EXPECT_EQ(pressure.value().variance, 0);
}

TEST(SampleMessages, ABatteryIsDischargedByACurrentOutOfIt) {
  const auto status = [](const std::string& current) {
    return message_on<ros2::BatteryState>(
               made_of("/power", R"({"device":"pack","voltage_V":12.5,"current_A":)" + current + "}"),
               "/navcal/pack/battery", "pack")
        .value()
        .power_supply_status;
  };
  EXPECT_EQ(status("2"), 2) << "discharging";
  EXPECT_EQ(status("-2"), 1) << "charging";
  EXPECT_EQ(status("0"), 0);
  EXPECT_EQ(status("null"), 0);
}

}  // namespace
}  // namespace navcal::record
