#include "pipeline/sources.h"

#include <gtest/gtest.h>

namespace navcal::pipeline {
namespace {

using protocols::Protocol;
constexpr std::int64_t kSecond_ns = 1'000'000'000;

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

TEST(Sources, LinesWithoutAHeadingAreNone) {
  instruments::Sample rate_of_turn = at(0, 0);
  instruments::CompassSample compass;
  compass.turn_rate_rad_s = 0.1;
  rate_of_turn.value = compass;
  EXPECT_EQ(role_of(rate_of_turn), std::nullopt);
  instruments::Sample no_fix = at(0, 0);
  no_fix.value = instruments::GpsSample{};
  EXPECT_EQ(role_of(no_fix), std::nullopt);
  EXPECT_EQ(role_of(heading(0, 0)), Role::heading);
  EXPECT_EQ(role_of(fix(0, 0)), Role::position);
}

TEST(Sources, AnInstrumentThatAlwaysSaysItComesBeforeNmea) {
  const auto settings = with({Protocol::nmea, Protocol::tcm2, Protocol::nmea});
  EXPECT_EQ(candidates(settings, Role::heading), (std::vector<std::uint16_t>{1, 0, 2}));
  EXPECT_EQ(candidates(settings, Role::position), (std::vector<std::uint16_t>{0, 2}));
  EXPECT_TRUE(candidates(settings, Role::shaft).empty());
  EXPECT_EQ(Sources(settings).serving().compass, 1);
}

TEST(Sources, TheOrderOfTheConfigurationDecidesNothingThatADeviceDoesNotDeliver) {
  // A sounder, a receiver, a compass: all NMEA.
  for (const std::uint16_t receiver : {std::uint16_t{1}, std::uint16_t{2}}) {
    const auto compass = static_cast<std::uint16_t>(3 - receiver);
    Sources sources(with({Protocol::nmea, Protocol::nmea, Protocol::nmea}));
    EXPECT_TRUE(sources.take(fix(receiver, 0.1)));
    EXPECT_TRUE(sources.take(heading(compass, 0.2)));
    EXPECT_FALSE(sources.take(fix(receiver, 1.1)));
    EXPECT_FALSE(sources.take(heading(compass, 3.5)));
    EXPECT_FALSE(sources.take(fix(receiver, 3.6)));
    EXPECT_EQ(sources.serving().gps, receiver);
    EXPECT_EQ(sources.serving().compass, compass);
    EXPECT_EQ(sources.learnt().gps, receiver);
    EXPECT_EQ(sources.learnt().compass, compass);
  }
}

TEST(Sources, ASilentOneIsReplacedAndTakenBack) {
  Sources sources(with({Protocol::tcm2, Protocol::nmea}));
  EXPECT_FALSE(sources.take(heading(0, 1)));
  EXPECT_FALSE(sources.take(heading(1, 1.5)));
  EXPECT_FALSE(sources.take(heading(1, 3.9)));
  const auto fallen = sources.take(heading(1, 4.1));
  ASSERT_TRUE(fallen);
  EXPECT_EQ(fallen->port, 1);
  EXPECT_EQ(fallen->before, 0);
  EXPECT_TRUE(fallen->silent);
  EXPECT_EQ(sources.serving().compass, 1);
  EXPECT_EQ(sources.learnt().compass, 0) << "calibrators do not mix two compasses";
  EXPECT_FALSE(sources.take(heading(1, 5)));
  const auto back = sources.take(heading(0, 6));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->port, 0);
  EXPECT_FALSE(back->silent);
  EXPECT_EQ(sources.serving().compass, 0);
}

TEST(Sources, CalibratorsWaitForTheBestThatDelivers) {
  Sources sources(with({Protocol::nmea, Protocol::nmea}));
  (void)sources.take(heading(1, 0.1));
  EXPECT_FALSE(sources.learnt().compass) << "another one may be better";
  EXPECT_TRUE(sources.take(heading(0, 0.5)));
  (void)sources.take(heading(1, 3.2));
  EXPECT_EQ(sources.learnt().compass, 0);
  EXPECT_EQ(sources.serving().compass, 0);
}

TEST(Sources, ASlowReceiverIsNotTakenForSilent) {
  Sources sources(with({Protocol::nmea, Protocol::nmea}));
  int changes = 0;
  for (int second = 0; second < 120; ++second) {
    if (second % 5 == 0 && sources.take(fix(0, second))) ++changes;
    if (sources.take(fix(1, second + 0.5))) ++changes;
  }
  EXPECT_LE(changes, 2) << "at most until its interval is known";
}

TEST(Sources, ACompassThatNeverComesIsWaitedForAWhile) {
  Sources sources(with({Protocol::tcm2, Protocol::nmea}));
  EXPECT_FALSE(sources.take(heading(1, 10)));
  EXPECT_FALSE(sources.take(heading(1, 12)));
  const auto fallen = sources.take(heading(1, 10 + 1e-9 * Sources::kSilent_ns + 0.1));
  ASSERT_TRUE(fallen);
  EXPECT_TRUE(fallen->silent);
}

TEST(Sources, OtherSamplesAndPortsChangeNothing) {
  Sources sources(with({Protocol::motor_card}));
  EXPECT_FALSE(sources.take(heading(0, 1)));
  EXPECT_FALSE(sources.take(fix(7, 1)));
  EXPECT_FALSE(sources.serving().compass);
  sources.begin_run();
  EXPECT_EQ(sources.serving().motor, 0);
  static_assert(Sources::kSilent_ns == 3 * kSecond_ns);
}

}  // namespace
}  // namespace navcal::pipeline
