// SPDX-License-Identifier: Apache-2.0
#include "pipeline/sources.h"

#include <gtest/gtest.h>

#include <optional>

#include "base/durations.h"

namespace navcal::pipeline {
namespace {

using protocols::Protocol;

config::Settings with(std::initializer_list<Protocol> protocols) {
  config::Settings settings;
  for (const Protocol protocol : protocols) settings.ports.emplace_back().protocol = protocol;
  return settings;
}

instruments::Sample at(std::uint16_t port, double time_s) {
  instruments::Sample sample;
  sample.port = port;
  sample.stamp.arrival_ns = static_cast<std::int64_t>(time_s * 1e9);
  return sample;
}
instruments::Sample heading(std::uint16_t port, double time_s) {
  instruments::Sample sample = at(port, time_s);
  instruments::CompassSample compass;
  compass.heading_rad = 1;
  sample.value = compass;
  return sample;
}
instruments::Sample fix(std::uint16_t port, double time_s) {
  instruments::Sample sample = at(port, time_s);
  instruments::GpsSample gps;
  gps.fix = instruments::Fix::fix_3d;
  gps.latitude_rad = gps.longitude_rad = 0.5;
  sample.value = gps;
  return sample;
}
instruments::Sample fix_with(std::uint16_t port, double time_s, double dop) {
  instruments::Sample sample = fix(port, time_s);
  std::get<instruments::GpsSample>(sample.value).dop = dop;
  return sample;
}
/// The change that a sample makes, if it is one.
std::optional<Sources::Change> take(Sources& sources, const instruments::Sample& sample) {
  const auto changes = sources.take(sample);
  EXPECT_LE(changes.size(), 1U);
  return changes.empty() ? std::nullopt : std::optional(changes.front());
}
using Cause = Sources::Change::Cause;

TEST(Sources, ASampleFillsTheRolesOfWhatItMeasured) {
  instruments::Sample sample = at(0, 0);
  instruments::ImuSample imu;
  sample.value = imu;
  EXPECT_TRUE(roles_of(sample).is_empty());
  imu.rate_rad_s = instruments::Vector3{};
  sample.value = imu;
  EXPECT_TRUE(roles_of(sample).has(Role::rates));
  EXPECT_FALSE(roles_of(sample).has(Role::acceleration) || roles_of(sample).has(Role::depth));

  instruments::MotorSample motor;
  motor.current_A = 2;  // of a battery: the calibrator of the motor's field needs no more
  sample.value = motor;
  EXPECT_TRUE(roles_of(sample).has(Role::shaft));

  instruments::DvlSample dvl;
  dvl.altitude_m = 5;
  sample.value = dvl;
  EXPECT_TRUE(roles_of(sample).has(Role::altitude));
  EXPECT_FALSE(roles_of(sample).has(Role::bottom_velocity)) << "no bottom lock";
  dvl.bottom_velocity_m_s = instruments::Vector3{};
  sample.value = dvl;
  EXPECT_TRUE(roles_of(sample).has(Role::bottom_velocity));
  EXPECT_FALSE(roles_of(sample).has(Role::water_velocity));

  instruments::DepthSample gauge;
  gauge.pressure_Pa = 2e5;
  sample.value = gauge;
  EXPECT_TRUE(roles_of(sample).has(Role::depth));
  sample.value = instruments::ScalarSample{};
  EXPECT_TRUE(roles_of(sample).is_empty());
}

TEST(Sources, LinesWithoutAHeadingAreNone) {
  instruments::Sample rate_of_turn = at(0, 0);
  instruments::CompassSample compass;
  compass.turn_rate_rad_s = 0.1;
  rate_of_turn.value = compass;
  EXPECT_TRUE(roles_of(rate_of_turn).is_empty());
  instruments::Sample no_fix = at(0, 0);
  no_fix.value = instruments::GpsSample{};
  EXPECT_TRUE(roles_of(no_fix).is_empty());
  EXPECT_TRUE(roles_of(heading(0, 0)).has(Role::heading));
  EXPECT_FALSE(roles_of(heading(0, 0)).has(Role::field));
  EXPECT_TRUE(roles_of(fix(0, 0)).has(Role::position));
  EXPECT_FALSE(roles_of(fix(0, 0)).has(Role::velocity)) << "it has none";
}

// An autopilot's log has its compass without a heading, and its heading.
TEST(Sources, AFieldThatIsNotCalibratedIsNoHeading) {
  instruments::Sample field = at(0, 0.1);
  instruments::CompassSample compass;
  compass.field_body_uT = instruments::Vector3{20, 0, 40};
  field.value = compass;
  EXPECT_TRUE(roles_of(field).has(Role::field));
  EXPECT_FALSE(roles_of(field).has(Role::heading));
  Sources sources(with({Protocol::samples, Protocol::samples}));
  EXPECT_TRUE(take(sources, heading(1, 0)));
  (void)sources.take(field);
  EXPECT_EQ(sources.serving()[Role::heading], 1);
  EXPECT_EQ(sources.serving()[Role::field], 0);
  compass.heading_calibrated_rad = 1;
  field.value = compass;
  (void)sources.take(field);
  EXPECT_EQ(sources.serving()[Role::heading], 0) << "the first port, now that it has one";
}

TEST(Sources, AnInstrumentThatAlwaysSaysItComesBeforeNmea) {
  const auto settings = with({Protocol::nmea, Protocol::tcm2, Protocol::nmea});
  EXPECT_EQ(candidates(settings, Role::heading), (std::vector<std::uint16_t>{1, 0, 2}));
  EXPECT_EQ(candidates(settings, Role::position), (std::vector<std::uint16_t>{0, 2}));
  EXPECT_TRUE(candidates(settings, Role::shaft).empty());
  EXPECT_EQ(Sources(settings).serving()[Role::heading], 1);
}

TEST(Sources, TheOrderOfTheConfigurationDecidesNothingThatADeviceDoesNotDeliver) {
  // A sounder, a receiver, a compass: all NMEA.
  for (const std::uint16_t receiver : {std::uint16_t{1}, std::uint16_t{2}}) {
    const auto compass = static_cast<std::uint16_t>(3 - receiver);
    Sources sources(with({Protocol::nmea, Protocol::nmea, Protocol::nmea}));
    EXPECT_TRUE(take(sources, fix(receiver, 0.1)));
    EXPECT_TRUE(take(sources, heading(compass, 0.2)));
    EXPECT_FALSE(take(sources, fix(receiver, 1.1)));
    EXPECT_FALSE(take(sources, heading(compass, 3.5)));
    EXPECT_FALSE(take(sources, fix(receiver, 3.6)));
    EXPECT_EQ(sources.serving()[Role::position], receiver);
    EXPECT_EQ(sources.serving()[Role::heading], compass);
    EXPECT_EQ(sources.learnt().gps, receiver);
    EXPECT_EQ(sources.learnt().compass, compass);
  }
}

TEST(Sources, ASilentOneIsReplacedAndTakenBack) {
  Sources sources(with({Protocol::tcm2, Protocol::nmea}));
  EXPECT_FALSE(take(sources, heading(0, 1)));
  EXPECT_FALSE(take(sources, heading(1, 1.5)));
  EXPECT_FALSE(take(sources, heading(1, 3.9)));
  const auto fallen = take(sources, heading(1, 4.1));
  ASSERT_TRUE(fallen);
  EXPECT_EQ(fallen->port, 1);
  EXPECT_EQ(fallen->before, 0);
  EXPECT_EQ(fallen->cause, Cause::silence);
  EXPECT_EQ(sources.serving()[Role::heading], 1);
  EXPECT_EQ(sources.learnt().compass, 0) << "calibrators do not mix two compasses";
  EXPECT_FALSE(take(sources, heading(1, 5)));
  const auto back = take(sources, heading(0, 6));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->port, 0);
  EXPECT_EQ(back->cause, Cause::delivers);
  EXPECT_EQ(sources.serving()[Role::heading], 0);
}

// A magnetometer that is not calibrated yet gives no heading. It served it, and navigation went without.
TEST(Sources, APortServesOnlyWhatItDeliversAndHandsBackWhatItCeasesToDeliver) {
  const auto settings = with({Protocol::samples, Protocol::samples});
  const auto field = [](double time_s, bool is_calibrated) {
    instruments::Sample sample = at(0, time_s);
    instruments::CompassSample compass;
    compass.field_body_uT = instruments::Vector3{20, 0, 40};
    if (is_calibrated) compass.heading_calibrated_rad = 1;
    sample.value = compass;
    return sample;
  };
  Sources sources(settings);
  (void)sources.take(field(0, false));
  (void)sources.take(heading(1, 0.1));
  (void)sources.take(field(0.2, false));
  EXPECT_EQ(sources.delivering()[Role::heading], 1);
  EXPECT_EQ(sources.delivering()[Role::field], 0);
  (void)sources.take(field(1, true));
  EXPECT_EQ(sources.delivering()[Role::heading], 0) << "the first of the configuration, now that it delivers";
  for (const double time_s : {2.0, 3.0, 4.0}) {
    (void)sources.take(field(time_s, false));
    (void)sources.take(heading(1, time_s + 0.1));
  }
  EXPECT_EQ(sources.serving()[Role::heading], 1) << "the field goes on, the heading does not";
  EXPECT_EQ(sources.serving()[Role::field], 0);
}

TEST(Sources, CalibratorsWaitForTheBestThatDelivers) {
  Sources sources(with({Protocol::nmea, Protocol::nmea}));
  (void)take(sources, heading(1, 0.1));
  EXPECT_FALSE(sources.learnt().compass) << "another one may be better";
  EXPECT_TRUE(take(sources, heading(0, 0.5)));
  (void)take(sources, heading(1, 3.2));
  EXPECT_EQ(sources.learnt().compass, 0);
  EXPECT_EQ(sources.serving()[Role::heading], 0);
}

// A port of injected samples could deliver a field. That kept the calibrators from a compass of NMEA for ever.
TEST(Sources, AFieldThatNeverComesIsNotWaitedFor) {
  const auto settings = with({Protocol::nmea, Protocol::samples});
  Sources sources(settings);
  for (const double time_s : {0.0, 1.0, 2.9}) (void)take(sources, heading(0, time_s));
  EXPECT_FALSE(sources.learnt().compass) << "a field may come";
  (void)take(sources, heading(0, 3.1));
  EXPECT_EQ(sources.learnt().compass, 0);

  Sources with_field(settings);
  instruments::Sample field = heading(1, 0.5);
  std::get<instruments::CompassSample>(field.value).field_body_uT = instruments::Vector3{20, 0, 40};
  (void)with_field.take(heading(0, 0));
  (void)with_field.take(field);
  EXPECT_EQ(with_field.learnt().compass, 1) << "the calibrators want the field";
  with_field.begin_run();
  for (const double time_s : {0.0, 4.0}) (void)with_field.take(heading(0, time_s));
  EXPECT_EQ(with_field.learnt().compass, 1) << "they do not mix two compasses";
}

TEST(Sources, ASlowReceiverIsNotTakenForSilent) {
  Sources sources(with({Protocol::nmea, Protocol::nmea}));
  int changes = 0;
  for (int second = 0; second < 120; ++second) {
    if (second % 5 == 0 && take(sources, fix(0, second))) ++changes;
    if (take(sources, fix(1, second + 0.5))) ++changes;
  }
  EXPECT_LE(changes, 2) << "at most until its interval is known";
}

TEST(Sources, ACompassThatNeverComesIsWaitedForAWhile) {
  Sources sources(with({Protocol::tcm2, Protocol::nmea}));
  EXPECT_FALSE(take(sources, heading(1, 10)));
  EXPECT_FALSE(take(sources, heading(1, 12)));
  const auto fallen = take(sources, heading(1, 10 + 1e-9 * Sources::kSilent_ns + 0.1));
  ASSERT_TRUE(fallen);
  EXPECT_EQ(fallen->cause, Cause::silence);
}

TEST(Sources, TheReceiverThatStatesTheSmallerErrorServes) {
  Sources sources(with({Protocol::oncore, Protocol::nmea}));
  std::vector<Sources::Change> changes;
  const auto drive = [&](int from_s, int to_s, double first_dop, double second_dop) {
    for (int second = from_s; second < to_s; ++second) {
      if (const auto change = take(sources, fix_with(0, second, first_dop))) changes.push_back(*change);
      if (const auto change = take(sources, fix_with(1, second + 0.5, second_dop))) changes.push_back(*change);
    }
  };
  drive(0, 30, 2.0, 1.8);
  EXPECT_TRUE(changes.empty()) << "hardly better";
  drive(30, 90, 6.0, 1.8);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes.front().port, 1);
  EXPECT_EQ(changes.front().cause, Cause::error);
  drive(90, 150, 2.0, 1.8);
  ASSERT_EQ(changes.size(), 2U) << "as good again: the first of the configuration";
  EXPECT_EQ(changes.back().port, 0);
  EXPECT_EQ(sources.learnt().gps, 0) << "calibrators do not mix two receivers";
}

TEST(Sources, TheOperatorsChoiceComesFirstWhateverErrorsAreStated) {
  auto settings = with({Protocol::oncore, Protocol::nmea, Protocol::tcm2});
  settings.ports[0].name = "old";
  settings.ports[1].name = "new";
  settings.ports[2].name = "compass";
  settings.roles.port_names.at(static_cast<std::size_t>(Role::position)) = "new";
  settings.roles.port_names.at(static_cast<std::size_t>(Role::heading)) = "new";
  EXPECT_EQ(candidates(settings, Role::position), (std::vector<std::uint16_t>{1, 0}));
  EXPECT_EQ(candidates(settings, Role::velocity), (std::vector<std::uint16_t>{1, 0})) << "follows the position";
  EXPECT_EQ(candidates(settings, Role::heading), (std::vector<std::uint16_t>{1, 2}));
  EXPECT_EQ(candidates(settings, Role::field), (std::vector<std::uint16_t>{2})) << "NMEA has none";
  Sources sources(settings);
  for (int second = 0; second < 60; ++second) {
    EXPECT_FALSE(take(sources, fix_with(1, second, 9)));
    EXPECT_FALSE(take(sources, fix_with(0, second + 0.5, 1)));
  }
  EXPECT_EQ(sources.learnt().gps, 1);
  EXPECT_EQ(sources.learnt().compass, 2) << "the calibrators want the field";
  EXPECT_EQ(sources.serving()[Role::heading], 1);
}

TEST(Sources, AReceiverIsTheHeadingOnlyWhereTheOperatorSaysSo) {
  config::Settings settings = with({Protocol::ubx, Protocol::nmea});
  settings.ports[0].name = "dual";
  EXPECT_EQ(candidates(settings, Role::heading), (std::vector<std::uint16_t>{1}));
  EXPECT_TRUE(candidates(settings, Role::heading_reference).empty());
  for (const Role role : {Role::heading, Role::heading_reference}) {
    ASSERT_TRUE(config::can_deliver(settings.ports[0], role));
    settings.roles.port_names.at(static_cast<std::size_t>(role)) = "dual";
    EXPECT_EQ(candidates(settings, role).front(), 0);
  }
  EXPECT_EQ(candidates(settings, Role::position).front(), 0);
}

TEST(Sources, OnlyWhatHasDeliveredIsSaidToDeliver) {
  Sources sources(with({Protocol::tcm2, Protocol::oncore}));
  EXPECT_EQ(sources.delivering(), RolePorts{});
  (void)take(sources, heading(0, 1));
  EXPECT_EQ(sources.delivering()[Role::heading], 0);
  EXPECT_FALSE(sources.delivering()[Role::position]);
}

TEST(Sources, CalibratorsGoOnWithTheInstrumentsTheyHad) {
  const auto settings = with({Protocol::nmea, Protocol::nmea});
  Sources sources(settings);
  sources.go_on_with({.compass = 1, .imu = {}, .gps = 7, .motor = {}, .reference = {}});
  sources.begin_run();
  for (int second = 0; second < 10; ++second) (void)take(sources, heading(0, second));
  EXPECT_EQ(sources.learnt().compass, 1);
  EXPECT_FALSE(sources.learnt().gps) << "no such port";
}

TEST(Sources, OtherSamplesAndPortsChangeNothing) {
  Sources sources(with({Protocol::motor_card}));
  EXPECT_FALSE(take(sources, heading(0, 1)));
  EXPECT_FALSE(take(sources, fix(7, 1)));
  EXPECT_FALSE(sources.serving()[Role::heading]);
  sources.begin_run();
  EXPECT_EQ(sources.serving()[Role::shaft], 0);
  static_assert(Sources::kSilent_ns == 3 * base::kSecond_ns);
}

}  // namespace
}  // namespace navcal::pipeline
