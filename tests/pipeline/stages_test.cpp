// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "base/angles.h"
#include "base/durations.h"

namespace navcal::pipeline {
namespace {

using protocols::Protocol;
constexpr std::int64_t kJune2026_s = 1'780'272'000;
enum StagePort : std::uint16_t { first_compass, second_compass, receiver };

config::Settings two_compasses_and_a_receiver() {
  config::Settings settings;
  for (const auto& [name, protocol] :
       {std::pair{"one", Protocol::nmea}, {"two", Protocol::nmea}, {"gps", Protocol::oncore}}) {
    auto& port = settings.ports.emplace_back();
    port.name = name;
    port.protocol = protocol;
  }
  return settings;
}

struct Events : Sink {
  void on_sample(const instruments::Sample& sample) override { newest_of[sample.value.index()] = sample; }
  void on_stream_event(const StreamEvent& event) override {
    events.push_back(std::string(event.name) + ": " + event.message);
  }
  void on_earth_field(const EarthField& field) override { fields.push_back(field); }
  void on_navigation(const NavigationSample& sample) override { newest = sample; }
  std::vector<std::string> events;
  std::vector<EarthField> fields;
  NavigationSample newest;
  std::map<std::size_t, instruments::Sample> newest_of;  ///< by kind
};

class StagesTest : public testing::Test {
 protected:
  void give(Stages& stages, std::uint16_t port, std::int64_t second,
            const decltype(instruments::Sample::value)& value) {
    instruments::Sample sample;
    sample.port = port;
    sample.stamp.arrival_ns = sample.stamp.validity_ns = second * base::kSecond_ns;
    sample.stamp.validity_utc_ns = (kJune2026_s + second) * base::kSecond_ns;
    sample.value = value;
    stages.take(sample, mapping_, told_);
  }
  void heading(Stages& stages, std::uint16_t port, std::int64_t second) {
    instruments::CompassSample compass;
    compass.heading_rad = 1;
    give(stages, port, second, compass);
  }
  void fix(Stages& stages, std::int64_t second) {
    instruments::GpsSample fix;
    fix.fix = instruments::Fix::fix_3d;
    fix.latitude_rad = 48 * base::kRadiansPerDegree;
    fix.longitude_rad = -123 * base::kRadiansPerDegree;
    fix.time_utc_ns = (kJune2026_s + second) * base::kSecond_ns;
    give(stages, receiver, second, fix);
  }
  UtcMapping mapping_{UtcMapping::Source::gps, kJune2026_s* base::kSecond_ns, 0, 0};
  Events told_;
};

TEST_F(StagesTest, TheFirstFixMakesHeadingsTrue) {
  Stages stages(two_compasses_and_a_receiver());
  heading(stages, first_compass, 1);
  EXPECT_NEAR(told_.newest.estimate.heading_rad.value(), 1, 1e-9) << "magnetic, as long as nothing is known";
  fix(stages, 2);
  ASSERT_EQ(told_.fields.size(), 1U);
  const double declination_rad = told_.fields.front().declination_rad;
  EXPECT_NEAR(declination_rad / base::kRadiansPerDegree, 15.5, 1.5) << "east, off Victoria";
  ASSERT_FALSE(told_.events.empty());
  EXPECT_EQ(told_.events.back().find("earth_field: declination 1"), 0U) << told_.events.back();
  fix(stages, 3);
  EXPECT_NEAR(told_.newest.estimate.heading_rad.value(), 1 + declination_rad, 1e-9) << "at once";
  for (std::int64_t second = 4; second < 120; ++second) {
    heading(stages, first_compass, second);
    fix(stages, second);
  }
  EXPECT_NEAR(told_.newest.estimate.heading_rad.value(), 1 + declination_rad, 1e-3);
  EXPECT_EQ(told_.fields.size(), 1U) << "it did not move";
}

TEST_F(StagesTest, AKnownDelayOfTheCompassIsTakenOffItsTimes) {
  auto settings = two_compasses_and_a_receiver();
  settings.calibration.compass_delay_s = 0.4;
  Stages stages(settings);
  heading(stages, first_compass, 10);
  const instruments::Stamp& stamp = told_.newest_of.begin()->second.stamp;
  EXPECT_EQ(stamp.validity_ns, 9'600'000'000);
  EXPECT_EQ(stamp.validity_utc_ns, kJune2026_s * base::kSecond_ns + 9'600'000'000);
  EXPECT_EQ(stamp.arrival_ns, 10'000'000'000);
}

TEST_F(StagesTest, AHeadingThatIsTrueAlreadyStays) {
  Stages stages(two_compasses_and_a_receiver());
  instruments::CompassSample gyrocompass;
  gyrocompass.heading_rad = 1;
  gyrocompass.heading_is_true = true;
  give(stages, first_compass, 1, gyrocompass);
  fix(stages, 2);
  fix(stages, 3);
  ASSERT_EQ(told_.fields.size(), 1U);
  EXPECT_NEAR(told_.newest.estimate.heading_rad.value(), 1, 1e-9);
}

TEST_F(StagesTest, ARestoredStateKeepsInstrumentAndPlace) {
  Stages stages(two_compasses_and_a_receiver());
  for (std::int64_t second = 1; second < 10; ++second) {
    heading(stages, second_compass, second);  // the first one is not yet there
    fix(stages, second);
  }
  ASSERT_EQ(stages.sources().learnt().compass, second_compass);
  const std::string state = stages.calibration()->beginning(10 * base::kSecond_ns).state;

  Stages other(two_compasses_and_a_receiver());
  ASSERT_TRUE(other.restore_calibration(state));
  other.begin_navigation_run();
  EXPECT_EQ(other.earth_field().declination_rad, stages.earth_field().declination_rad);
  for (std::int64_t second = 11; second < 20; ++second) {
    heading(other, first_compass, second);
    heading(other, second_compass, second);
  }
  EXPECT_EQ(other.sources().learnt().compass, second_compass) << "the state is of that one";
  EXPECT_EQ(other.sources().serving()[Role::heading], first_compass) << "which navigation does not mind";

  EXPECT_FALSE(other.restore_calibration("no state")) << "and nothing has changed";
  EXPECT_EQ(other.sources().learnt().compass, second_compass);
}

TEST_F(StagesTest, AConfiguredDeclinationIsNotReplacedByARestoredOne) {
  Stages stages(two_compasses_and_a_receiver());
  heading(stages, first_compass, 1);
  fix(stages, 2);
  const std::string state = stages.calibration()->beginning(10 * base::kSecond_ns).state;
  auto settings = two_compasses_and_a_receiver();
  settings.environment.declination_rad = 0.2;
  settings.environment.field_uT = 50;
  Stages other(settings);
  ASSERT_TRUE(other.restore_calibration(state));
  EXPECT_EQ(other.earth_field().declination_rad, 0.2);
  EXPECT_EQ(other.earth_field().size_uT, 50);
}

/// A level vehicle behind an autopilot turns at 0.2 rad/s, whose own heading is off by 0.1 rad.
class AutopilotStagesTest : public StagesTest {
 protected:
  static config::Settings autopilot() {
    config::Settings settings;
    settings.ports.emplace_back().name = "rov";
    settings.ports.back().protocol = Protocol::mavlink;
    settings.environment.declination_rad = 0.3;
    settings.calibration.automatic = false;
    return settings;
  }
  void turn(int seconds, bool has_attitude = true) {
    for (const std::int64_t end_ms = now_ms_ + 1000 * seconds; now_ms_ < end_ms; now_ms_ += 50) {
      const double magnetic_rad = 0.2e-3 * static_cast<double>(now_ms_);
      true_rad_ = base::positive_angle(magnetic_rad + 0.3);
      instruments::ImuSample imu;
      imu.rate_rad_s = instruments::Vector3{0, 0, 0.2};
      put(imu);
      instruments::CompassSample attitude, field;
      attitude.roll_rad = attitude.pitch_rad = field.roll_rad = field.pitch_rad = 0;
      attitude.heading_rad = base::positive_angle(true_rad_ + 0.1);
      attitude.heading_is_true = true;
      attitude.heading_std_rad = 0.17;
      if (has_attitude) put(attitude);
      field.field_body_uT =
          instruments::Vector3{20 * std::cos(magnetic_rad) + 3, -20 * std::sin(magnetic_rad) - 2, 40};
      if (now_ms_ % 100 == 0) put(field);
    }
  }
  void put(const decltype(instruments::Sample::value)& value) {
    instruments::Sample sample;
    sample.stamp.arrival_ns = sample.stamp.validity_ns = now_ms_ * base::kMillisecond_ns;
    sample.value = value;
    stages_.take(sample, mapping_, told_);
  }
  [[nodiscard]] nav::Estimate estimate() const { return stages_.navigation(mapping_).value().estimate; }
  [[nodiscard]] double heading_error_rad() const {
    return base::wrapped(estimate().heading_rad.value_or(9) - true_rad_);
  }
  Stages stages_{autopilot()};
  std::int64_t now_ms_ = 1000;
  double true_rad_ = 0;
};

TEST_F(AutopilotStagesTest, ItsHeadingServesUntilThatOfACalibrationIsInForce) {
  turn(2);
  EXPECT_EQ(stages_.sources().delivering()[Role::heading], 0);
  EXPECT_NEAR(heading_error_rad(), 0.1, 0.03) << "from the first second on";
  EXPECT_NEAR(estimate().heading_std_rad, 0.17, 0.01) << "as it is stated";
  turn(120);
  ASSERT_EQ(stages_.calibration()->order(CalibrationOrder::force, calib::Calibrator::magnetometer, 0, told_), "");
  turn(60);
  EXPECT_NEAR(heading_error_rad(), 0, 0.02) << "nothing of the autopilot's is mixed in";
  EXPECT_LT(estimate().heading_std_rad, 0.03);
  const auto& own = std::get<instruments::ScalarSample>(told_.newest_of.at(9).value);
  EXPECT_EQ(own.quantity.view(), "autopilot_heading");
  EXPECT_NEAR(base::wrapped(own.value - true_rad_), 0.1, 0.02);
  EXPECT_EQ(own.value_std, 0.17);
  const auto& attitude = std::get<instruments::CompassSample>(told_.newest_of.at(0).value);
  EXPECT_FALSE(attitude.heading_rad || attitude.heading_std_rad || attitude.heading_is_true);
  EXPECT_EQ(attitude.roll_rad, 0);
}

TEST_F(AutopilotStagesTest, NoCalibratorLearnsFromIt) {
  turn(120);
  const auto report = stages_.calibration()->report();
  stages_ = Stages(autopilot());
  now_ms_ = 1000;
  turn(120, false);
  const auto expected = stages_.calibration()->report();
  ASSERT_EQ(report.calibrators.size(), expected.calibrators.size());
  for (std::size_t i = 0; i < report.calibrators.size(); ++i) {
    const auto &with = report.calibrators[i], &one = expected.calibrators[i];
    EXPECT_EQ(with.judgement.samples, one.judgement.samples) << i;
    ASSERT_EQ(with.estimate.size(), one.estimate.size());
    for (std::size_t k = 0; k < with.estimate.size(); ++k) {
      const double value = with.estimate[k].value, other = one.estimate[k].value;
      EXPECT_TRUE(value == other || (std::isnan(value) && std::isnan(other))) << with.estimate[k].name;
    }
  }
}

}  // namespace
}  // namespace navcal::pipeline
