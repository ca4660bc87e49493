// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages.h"

#include <gtest/gtest.h>

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
  void on_sample(const instruments::Sample&) override {}
  void on_stream_event(const StreamEvent& event) override {
    events.push_back(std::string(event.name) + ": " + event.message);
  }
  void on_earth_field(const EarthField& field) override { fields.push_back(field); }
  void on_navigation(const NavigationSample& sample) override { newest = sample; }
  std::vector<std::string> events;
  std::vector<EarthField> fields;
  NavigationSample newest;
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

}  // namespace
}  // namespace navcal::pipeline
