// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/rotation.h"
#include "web/foxglove/channels.h"

namespace navcal::web::foxglove {
namespace {

using nlohmann::json;

constexpr std::int64_t kTime_ns = 1'700'000'000'123'456'789;

json location_of(Deriver& deriver, std::string_view topic, const std::string& message) {
  const Derived derived = deriver.derive({topic, "gps", kTime_ns, message}, kTime_ns);
  return derived.location ? json::parse(*derived.location) : json();
}

TEST(FoxgloveOrientation, IsTheRotationOfNavcalBetweenTheOtherAxes) {
  Eigen::Matrix3d map_of_ned, body_of_vehicle;
  map_of_ned << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  body_of_vehicle << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  for (const double heading : {-3.0, 0.0, 0.4, 1.6, 3.1, 6.2}) {
    for (const double pitch : {-1.5, -0.3, 0.0, 0.7}) {
      for (const double roll : {-3.0, -0.2, 0.0, 1.1}) {
        const Eigen::Matrix3d expected = map_of_ned * base::rotation_of({roll, pitch, heading}) * body_of_vehicle;
        const Quaternion q = orientation_in_map(heading, pitch, roll);
        const Eigen::Quaterniond turn(q.w, q.x, q.y, q.z);
        EXPECT_NEAR(turn.norm(), 1, 1e-12);
        EXPECT_LT((turn.toRotationMatrix() - expected).norm(), 1e-12) << heading << ' ' << pitch << ' ' << roll;
      }
    }
  }
}

TEST(FoxgloveOrientation, HeadingEastLooksAlongXAndABowUpPointsUp) {
  const Quaternion east = orientation_in_map(std::acos(0.0), 0, 0);
  EXPECT_NEAR(east.w, 1, 1e-12);
  const Quaternion q = orientation_in_map(std::acos(0.0), 0.1, 0);
  const Eigen::Vector3d bow = Eigen::Quaterniond(q.w, q.x, q.y, q.z) * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(bow.z(), std::sin(0.1), 1e-12);
  EXPECT_NEAR(bow.x(), std::cos(0.1), 1e-12);
}

TEST(FoxgloveDerived, AFixCarriesItsStandardErrorsAsACovariance) {
  Deriver deriver;
  const auto fix = location_of(deriver, "/gps",
                               R"({"device":"gps","lat":59.3,"lon":18.1,"speed_m_s":2,"course_rad":0,"fix":"3d",
                                   "height_m":31.5,"climb_m_s":0.5,"position_std_m":1.5,"height_std_m":3})");
  EXPECT_EQ(fix["timestamp"], (json{{"sec", 1'700'000'000}, {"nsec", 123'456'789}}));
  EXPECT_EQ(fix["frame_id"], "gps");
  EXPECT_EQ(fix["latitude"], 59.3);
  EXPECT_EQ(fix["longitude"], 18.1);
  EXPECT_EQ(fix["altitude"], 31.5);
  EXPECT_EQ(fix["position_covariance"], (json{2.25, 0., 0., 0., 2.25, 0., 0., 0., 9.}));
  EXPECT_EQ(fix["position_covariance_type"], 2);
  EXPECT_EQ(fix["velocity"], (json{{"x", 0.}, {"y", 2.}, {"z", 0.5}}));
}

TEST(FoxgloveDerived, AnUnknownStandardErrorIsNotAZero) {
  Deriver deriver;
  const auto flat = location_of(
      deriver, "/gps", R"({"lat":1,"lon":2,"fix":"2d","height_m":null,"position_std_m":2,"height_std_m":4})");
  EXPECT_EQ(flat["position_covariance_type"], 1);
  EXPECT_EQ(flat["position_covariance"][0], 4.);
  EXPECT_EQ(flat["position_covariance"][8], kUnknownStd_m * kUnknownStd_m);
  const auto unknown = location_of(deriver, "/gps", R"({"lat":1,"lon":2,"fix":"2d","position_std_m":null})");
  EXPECT_EQ(unknown["position_covariance_type"], 0);
  EXPECT_EQ(unknown["position_covariance"].size(), 9U);
}

TEST(FoxgloveDerived, WithoutAFixThereIsNoLocation) {
  Deriver deriver;
  for (const char* message :
       {R"({"lat":null,"lon":null,"fix":"none"})", R"({"lat":1,"lon":2,"fix":"acquiring"})",
        R"({"lat":1,"lon":2,"fix":"none"})", R"({"lat":91,"lon":2,"fix":"3d"})", "{}", "[]", "not json"})
    EXPECT_TRUE(location_of(deriver, "/gps", message).is_null()) << message;
}

TEST(FoxgloveDerived, ThePositionOfTheEstimateIsALocationOnlyWhileItIsReckoned) {
  Deriver deriver;
  const std::string estimate = R"("lat":59.3,"lon":18,"north_std_m":3,"east_std_m":4,"depth_m":5,"heading_rad":1,)"
                               R"("velocity_m_s":[1,2,3]})";
  EXPECT_TRUE(location_of(deriver, "/nav", R"({"position":"fixes",)" + estimate).is_null());
  const auto reckoned = location_of(deriver, "/nav", R"({"position":"reckoned",)" + estimate);
  EXPECT_EQ(reckoned["frame_id"], "vehicle");
  EXPECT_EQ(reckoned["altitude"], -5.);
  EXPECT_EQ(reckoned["position_covariance"][0], 16.) << "east is first";
  EXPECT_EQ(reckoned["position_covariance"][4], 9.);
  EXPECT_EQ(reckoned["position_covariance_type"], 1) << "the standard error of the depth is not stated";
  EXPECT_EQ(reckoned["velocity"], (json{{"x", 2.}, {"y", 1.}, {"z", -3.}}));
  EXPECT_EQ(reckoned["heading"], 1.);
}

json transform_at(Deriver& deriver, double latitude_deg, double longitude_deg) {
  const json message{{"position", "fixes"}, {"lat", latitude_deg}, {"lon", longitude_deg}, {"depth_m", 2},
                     {"heading_rad", 0.3},  {"pitch_rad", 0.1},    {"roll_rad", -0.1}};
  const std::string text = message.dump();
  const Derived derived = deriver.derive({"/nav", "navigation", kTime_ns, text}, kTime_ns);
  EXPECT_TRUE(derived.pose && derived.transform);
  const auto pose = json::parse(derived.pose.value()), transform = json::parse(derived.transform.value());
  EXPECT_EQ(pose["pose"]["position"], transform["translation"]);
  EXPECT_EQ(pose["pose"]["orientation"], transform["rotation"]);
  EXPECT_EQ(pose["frame_id"], transform["parent_frame_id"]);
  return transform;
}

TEST(FoxgloveDerived, TheMapBeginsAtTheFirstPositionAndCountsEastNorthUp) {
  Deriver deriver;
  const auto first = transform_at(deriver, 59, 18);
  EXPECT_EQ(first["parent_frame_id"], "map");
  EXPECT_EQ(first["child_frame_id"], "vehicle");
  EXPECT_EQ(first["translation"], (json{{"x", 0.}, {"y", 0.}, {"z", -2.}}));
  const auto north = transform_at(deriver, 59.001, 18)["translation"];
  EXPECT_NEAR(north["y"].get<double>(), 111.4, 0.2);
  EXPECT_NEAR(north["x"].get<double>(), 0, 1e-6);
  const auto east = transform_at(deriver, 59, 18.001)["translation"];
  EXPECT_NEAR(east["x"].get<double>(), 57.5, 0.2);
}

TEST(FoxgloveDerived, APlaceFarFromTheOriginBecomesTheOrigin) {
  Deriver deriver;
  EXPECT_EQ(transform_at(deriver, 59, 18)["translation"]["x"], 0.);
  EXPECT_EQ(transform_at(deriver, -33, 151)["translation"]["x"], 0.);
  EXPECT_NEAR(transform_at(deriver, -33, 151.001)["translation"]["x"].get<double>(), 93.5, 0.5);
}

TEST(FoxgloveDerived, WithoutAHeadingThereIsNoPoseAndWithoutAPositionItStandsAtTheOrigin) {
  Deriver deriver;
  const auto derive = [&](const char* message) {
    return deriver.derive({"/nav", "navigation", kTime_ns, message}, kTime_ns);
  };
  EXPECT_FALSE(derive(R"({"lat":1,"lon":2,"heading_rad":null})").transform);
  const auto transform = derive(R"({"lat":null,"lon":null,"heading_rad":0,"depth_m":null})").transform;
  ASSERT_TRUE(transform);
  EXPECT_EQ(json::parse(*transform)["translation"]["x"], 0.);
}

TEST(FoxgloveDerived, EventsKeepTheirSeverity) {
  Deriver deriver;
  const auto log_of = [&](const std::string& severity) {
    const std::string message = R"({"severity":")" + severity + R"(","name":"leak","port":"imu","message":"wet"})";
    const Derived derived = deriver.derive({"/event", "imu", kTime_ns, message}, kTime_ns);
    return json::parse(derived.log.value());
  };
  EXPECT_EQ(log_of("info")["level"], 2);
  EXPECT_EQ(log_of("warning")["level"], 3);
  EXPECT_EQ(log_of("error")["level"], 4);
  EXPECT_EQ(log_of("alarm")["level"], 5);
  EXPECT_EQ(log_of("what")["level"], 0);
  EXPECT_EQ(log_of("info")["message"], "imu: wet");
  EXPECT_EQ(log_of("info")["name"], "leak");
}

TEST(FoxgloveDerived, OtherTopicsGiveNothing) {
  Deriver deriver;
  const Derived derived = deriver.derive({"/imu", "imu", kTime_ns, R"({"lat":1,"lon":2,"fix":"3d"})"}, kTime_ns);
  EXPECT_FALSE(derived.location || derived.pose || derived.transform || derived.log);
}

}  // namespace
}  // namespace navcal::web::foxglove
