// SPDX-License-Identifier: Apache-2.0
#include "pipeline/navigation_stage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "base/durations.h"
#include "base/local_plane.h"
#include "pipeline/readings.h"

namespace navcal::pipeline {
namespace {

constexpr double kLatitude_rad = 37 * base::kRadiansPerDegree, kLongitude_rad = -80 * base::kRadiansPerDegree;
enum Port : std::uint16_t { compass, imu, gps, motor, second_gps };

config::Settings vehicle() {
  using protocols::Protocol;
  config::Settings settings;
  for (const auto protocol :
       {Protocol::tcm2, Protocol::imu_card, Protocol::oncore, Protocol::motor_card, Protocol::nmea})
    settings.ports.emplace_back().protocol = protocol;
  return settings;
}

struct Told : Sink {
  void on_sample(const instruments::Sample&) override {}
  void on_navigation(const NavigationSample& sample) override { samples.push_back(sample); }
  std::vector<NavigationSample> samples;
};

instruments::ImuSample still_card() {
  instruments::ImuSample card;
  card.rate_rad_s = instruments::Vector3{};
  return card;
}

/// A vehicle that runs north at 10 revolutions a second; time passes in steps of 50 ms.
class NavigationStageTest : public testing::Test {
 protected:
  explicit NavigationStageTest(const config::Settings& settings = vehicle()) : stage_(settings) {}

  void give(Port port, const decltype(instruments::Sample::value)& value, instruments::CalibrationName name = {}) {
    instruments::Sample sample;
    sample.port = port;
    sample.stamp = {now_ns_ + 10 * base::kMillisecond_ns, now_ns_, base::kMillisecond_ns,
                    now_ns_ + 10 * base::kMillisecond_ns + mapping_.offset_ns, now_ns_ + mapping_.offset_ns};
    sample.calibration = name;
    sample.value = value;
    stage_.take(sample, sample, tilt_, mapping_, told_);
  }
  [[nodiscard]] instruments::GpsSample fix(double latitude_rad = kLatitude_rad) const {
    instruments::GpsSample gps;
    gps.fix = instruments::Fix::fix_3d;
    gps.latitude_rad = latitude_rad;
    gps.longitude_rad = kLongitude_rad;
    return gps;
  }
  void run(double seconds, bool fixes, double heading_rad = 0) {
    const auto steps = static_cast<int>(seconds * 20);
    for (int i = 0; i < steps; ++i) {
      now_ns_ += 50 * base::kMillisecond_ns;
      instruments::MotorSample shaft;
      shaft.rpm = 600;
      give(motor, shaft);
      give(imu, still_card());
      instruments::CompassSample word;
      word.heading_rad = heading_rad;
      word.heading_is_true = heading_is_true_;
      word.pitch_rad = word.roll_rad = 0;
      give(compass, word);
      if (fixes && now_ns_ % 1'000'000'000 == 0) give(gps, fix());
    }
  }
  [[nodiscard]] const NavigationSample& newest() const { return told_.samples.back(); }

  NavigationStage stage_;
  UtcMapping mapping_{UtcMapping::Source::gps, 1'900'000'000'000'000'000, 0, 0};
  Told told_;
  std::int64_t now_ns_ = 500'000'000'000;
  bool heading_is_true_ = false;
  std::optional<nav::TiltReading> tilt_;  ///< by the accelerometers
};

TEST_F(NavigationStageTest, AccelerometersHoldTheTiltWhereNoInclinometerDoes) {
  for (int i = 0; i < 100; ++i) {
    now_ns_ += 50 * base::kMillisecond_ns;
    tilt_ = nav::TiltReading{now_ns_, 0.1, -0.05};
    give(imu, still_card());
  }
  EXPECT_NEAR(newest().estimate.roll_rad.value(), 0.1, 1e-3);
  EXPECT_NEAR(newest().estimate.pitch_rad.value(), -0.05, 1e-3);
  run(20, false);
  EXPECT_NEAR(newest().estimate.roll_rad.value(), 0, 5e-3) << "the inclinometer comes first";
}

TEST_F(NavigationStageTest, DepthAndVelocityMayComeFromOtherPorts) {
  RolePorts ports = Sources(vehicle()).serving();
  ports.ports.at(static_cast<std::size_t>(Role::velocity)) = second_gps;
  stage_.use(ports);
  for (int i = 0; i < 10; ++i) {
    run(0.5, false);
    auto other = fix();
    other.speed_m_s = 1.5;
    other.course_rad = 0;
    give(second_gps, other);
    run(0.5, true);
  }
  // The shaft makes 0.872 m/s; what the velocity has over it is the set.
  EXPECT_GT(newest().estimate.set_m_s.x(), 0.2);
}

TEST_F(NavigationStageTest, TellsAtTheInterval) {
  run(10, false);
  ASSERT_EQ(told_.samples.size(), 11U);
  EXPECT_EQ(told_.samples.front().stamp.validity_ns, 500'050'000'000) << "the first at once";
  told_.samples.erase(told_.samples.begin());
  for (const auto& sample : told_.samples) {
    EXPECT_EQ(sample.stamp.validity_ns % 1'000'000'000, 0) << "at the first frame within each";
    EXPECT_EQ(sample.stamp.validity_utc_ns, mapping_.to_utc(sample.stamp.validity_ns));
    EXPECT_EQ(sample.source, PositionSource::none);
    EXPECT_FALSE(sample.latitude_rad);
  }
}

TEST_F(NavigationStageTest, ReckonsOnFromTheLastFix) {
  give(gps, fix());
  run(1, false);
  EXPECT_EQ(newest().source, PositionSource::fixes);
  run(99, false);
  EXPECT_EQ(newest().source, PositionSource::reckoned);
  // 100 s at 0.872 m/s; one minute of latitude is a nautical mile, nearly.
  const double run_m = (*newest().latitude_rad - kLatitude_rad) / base::kRadiansPerDegree * 60 * 1852;
  EXPECT_NEAR(run_m, 87.2, 1);
  EXPECT_NEAR(*newest().longitude_rad, kLongitude_rad, 1e-9);
}

TEST_F(NavigationStageTest, AFixThatEndsAStretchWithoutTellsAtOnceHowFarOffItWas) {
  give(gps, fix());
  run(100.25, false);
  EXPECT_FALSE(newest().outage);
  give(gps, fix());
  ASSERT_TRUE(newest().outage);
  EXPECT_EQ(newest().source, PositionSource::fixes);
  EXPECT_NEAR(newest().outage->duration_s, 100.25, 0.1);
  EXPECT_NEAR(newest().outage->error_m, 87, 2);
  EXPECT_NEAR(*newest().outage_error_uncalibrated_m, newest().outage->error_m, 1e-9);
  EXPECT_EQ(words_for_outage(newest()).rfind("100 s and 87 m without a fix ended 8", 0), 0U)
      << words_for_outage(newest());
  run(2, false);
  EXPECT_FALSE(newest().outage) << "told once";
  EXPECT_EQ(words_for_outage(newest()), "");
}

TEST_F(NavigationStageTest, ACalibratedHeadingIsPreferredByTheOneAndUnknownToTheOther) {
  give(gps, fix());
  for (int i = 0; i < 2000; ++i) {
    now_ns_ += 50 * base::kMillisecond_ns;
    instruments::MotorSample shaft;
    shaft.rpm = 600;
    give(motor, shaft);
    give(imu, still_card(), {1, 2});
    instruments::CompassSample word;
    word.heading_rad = 0.2;
    word.heading_calibrated_rad = 0;
    word.pitch_rad = word.roll_rad = 0;
    give(compass, word, {1, 2});
  }
  EXPECT_NEAR(*newest().estimate.heading_rad, 0, 1e-6);
  EXPECT_LT(newest().estimate.heading_std_rad, 2 * base::kRadiansPerDegree);
  instruments::GpsSample there = fix(kLatitude_rad + 87.2 / 1852 / 60 * base::kRadiansPerDegree);
  give(gps, there, {1, 2});
  ASSERT_TRUE(newest().outage);
  EXPECT_LT(newest().outage->error_m, 2);
  EXPECT_NEAR(*newest().outage_error_uncalibrated_m, 0.2 * 87, 2);
  EXPECT_NE(words_for_outage(newest()).find("without calibrations 1"), std::string::npos);
}

TEST_F(NavigationStageTest, OnlyTheFirstReceiverAndOnlyRealFixesCount) {
  for (const auto kind : {instruments::Fix::none, instruments::Fix::propagated, instruments::Fix::hold,
                          instruments::Fix::acquiring, instruments::Fix::bad_geometry}) {
    auto gps_sample = fix();
    gps_sample.fix = kind;
    give(gps, gps_sample);
  }
  give(second_gps, fix());
  run(2, false);
  EXPECT_EQ(newest().source, PositionSource::none);
}

TEST_F(NavigationStageTest, BeginsAnew) {
  give(gps, fix());
  run(5, false);
  stage_.begin_run();
  run(5, false);
  EXPECT_EQ(newest().source, PositionSource::none);
}

class WithDeclination : public NavigationStageTest {
 protected:
  static config::Settings declined() {
    auto settings = vehicle();
    settings.environment.declination_rad = -10 * base::kRadiansPerDegree;
    return settings;
  }
  WithDeclination() : NavigationStageTest(declined()) {}
};

TEST_F(WithDeclination, MagneticHeadingsAreMadeTrueAndTrueOnesLeft) {
  run(30, false, 5 * base::kRadiansPerDegree);
  EXPECT_NEAR(*newest().estimate.heading_rad, 355 * base::kRadiansPerDegree, 1e-6);
  heading_is_true_ = true;
  stage_.begin_run();
  run(30, false, 5 * base::kRadiansPerDegree);
  EXPECT_NEAR(*newest().estimate.heading_rad, 5 * base::kRadiansPerDegree, 1e-6);
}

TEST(NavigationStageMake, IsNotMadeForNothing) {
  auto settings = vehicle();
  EXPECT_NE(NavigationStage::make(settings), nullptr);
  settings.navigation.enabled = false;
  EXPECT_EQ(NavigationStage::make(settings), nullptr);
  settings = {};
  settings.ports.emplace_back().protocol = protocols::Protocol::motor_card;
  EXPECT_EQ(NavigationStage::make(settings), nullptr);
}

config::Settings with_antenna_ahead(double ahead_m) {
  config::Settings settings = vehicle();
  settings.ports[gps].mounting.position_m = {ahead_m, 0, 0};
  return settings;
}

class AntennaAhead : public NavigationStageTest {
 protected:
  AntennaAhead() : NavigationStageTest(with_antenna_ahead(3)) {}

  [[nodiscard]] instruments::Sample sample_of(const instruments::GpsSample& fix) const {
    instruments::Sample sample;
    sample.port = gps;
    sample.stamp.validity_ns = now_ns_;
    sample.value = fix;
    return sample;
  }
};

TEST_F(AntennaAhead, BeforeAHeadingIsKnownTheFixStaysAsItIs) { EXPECT_FALSE(stage_.at_origin(sample_of(fix()))); }

TEST_F(AntennaAhead, TheFixIsBroughtToTheOriginAlongTheHeading) {
  run(20, false, std::numbers::pi / 2);  // east
  const auto moved = stage_.at_origin(sample_of(fix()));
  ASSERT_TRUE(moved);
  const auto& at_origin = std::get<instruments::GpsSample>(moved->value);
  const base::LocalPlane plane(kLatitude_rad, kLongitude_rad);
  const auto [north_m, east_m] = plane.position_m(*at_origin.latitude_rad, *at_origin.longitude_rad);
  EXPECT_NEAR(north_m, 0, 0.01);
  EXPECT_NEAR(east_m, -3, 0.01) << "the antenna is 3 m further east than the origin";
}

TEST_F(AntennaAhead, TheVelocityOfTheArmIsTakenOff) {
  for (int i = 0; i < 400; ++i) {
    now_ns_ += 50 * base::kMillisecond_ns;
    instruments::ImuSample card;
    card.rate_rad_s = instruments::Vector3{0, 0, 0.2};
    give(imu, card);
    instruments::CompassSample word;
    word.heading_rad = 0.01 * i;
    word.pitch_rad = word.roll_rad = 0;
    give(compass, word);
  }
  auto moving = fix();
  moving.speed_m_s = 1;
  moving.course_rad = 0;
  const auto moved = stage_.at_origin(sample_of(moving));
  ASSERT_TRUE(moved);
  const auto velocity_m_s = ground_velocity_m_s(std::get<instruments::GpsSample>(moved->value));
  ASSERT_TRUE(velocity_m_s);
  // 3 m at 0.2 rad/s.
  EXPECT_NEAR((*velocity_m_s - Eigen::Vector2d(1, 0)).norm(), 0.6, 0.02);
}

TEST_F(NavigationStageTest, AnAntennaAtTheOriginLeavesTheFixAlone) {
  run(20, false);
  instruments::Sample sample;
  sample.port = gps;
  sample.stamp.validity_ns = now_ns_;
  sample.value = fix();
  EXPECT_FALSE(stage_.at_origin(sample));
}

config::Settings with_gauge_ahead() {
  config::Settings settings = vehicle();
  settings.ports[imu].mounting.position_m = {2, 0, 0.1};
  return settings;
}

class GaugeAhead : public NavigationStageTest {
 protected:
  GaugeAhead() : NavigationStageTest(with_gauge_ahead()) {}
};

TEST_F(GaugeAhead, DepthIsThatOfTheOrigin) {
  constexpr double kPitch_rad = 0.3;
  for (int i = 0; i < 600; ++i) {
    now_ns_ += 50 * base::kMillisecond_ns;
    instruments::CompassSample word;
    word.heading_rad = 0;
    word.pitch_rad = kPitch_rad;
    word.roll_rad = 0;
    give(compass, word);
    auto card = still_card();
    card.depth_m = 5;
    give(imu, card);
  }
  EXPECT_NEAR(newest().estimate.depth_m.value(), 5 + 2 * std::sin(kPitch_rad) - 0.1 * std::cos(kPitch_rad), 0.02);
}

}  // namespace
}  // namespace navcal::pipeline
