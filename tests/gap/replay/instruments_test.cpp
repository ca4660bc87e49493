// SPDX-License-Identifier: Apache-2.0
// Replay, whitening and null missions follow the instruments of the recording (Mission::instruments).
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "config/load.h"
#include "gap/inference/whitening.h"
#include "gap/nulls/null_mission.h"
#include "gap/replay/regimes.h"
#include "gap/replay/replay.h"
#include "tests/gap/simulated_mission.h"
#include "tests/support/temporary_folder.h"

namespace navcal::gap {
namespace {

double instrument_rms(const Innovations& innovations, Channel channel) {
  constexpr Eigen::Index kSettled = 300;
  double square = 0;
  int count = 0;
  for (Eigen::Index i = kSettled; i < innovations.grid.rows(); ++i) {
    const double value = innovations.grid(i, channel);
    if (!std::isfinite(value)) continue;
    square += value * value;
    ++count;
  }
  return std::sqrt(square / count);
}

Innovations residuals_of(const Mission& mission, const devices::InstrumentModel& believed) {
  Mission other = mission;
  other.instruments = believed;
  return Replay(other, {}).run({});
}

TEST(GapInstruments, TheReplayPredictsWithTheLagOfTheRecording) {
  devices::InstrumentModel slow;
  slow.compass.tilt_lag_s = 1.2;
  const devices::InstrumentModel usual;
  const Mission of_slow = test::simulated_mission("identification", "", 120, 3, slow);
  const Mission of_usual = test::simulated_mission("identification", "", 120, 3, usual);
  EXPECT_GT(instrument_rms(residuals_of(of_slow, usual), tilt_pitch),
            1.5 * instrument_rms(residuals_of(of_slow, slow), tilt_pitch));
  EXPECT_GT(instrument_rms(residuals_of(of_usual, slow), tilt_pitch),
            1.5 * instrument_rms(residuals_of(of_usual, usual), tilt_pitch));
}

TEST(GapInstruments, NullMissionsAreAsNoisyAndAsLateAsTheRecordingsInstruments) {
  const Mission mission = test::simulated_mission("identification", "", 90, 3);
  const auto null_of = [&](const devices::InstrumentModel& believed) {
    Mission recorded = mission;
    recorded.instruments = believed;
    const config::VehicleSettings vehicle;
    const Replay replay(recorded, vehicle);
    Trajectory10Hz course;
    (void)replay.run({}, &course);
    return null_mission({replay, course, vehicle}, sim::EffectSet(), 5);
  };
  devices::InstrumentModel other;
  other.compass.field_noise_uT *= 6;
  other.imu.depth_noise_m *= 6;
  other.imu.timing.rate_Hz = 10;
  const Mission usual = null_of({}), null = null_of(other);
  EXPECT_EQ(null.instruments.compass.field_noise_uT, other.compass.field_noise_uT);
  EXPECT_NEAR(static_cast<double>(null.card.size()) / static_cast<double>(usual.card.size()), 0.5, 0.02);
  const Innovations quiet = Replay(usual, {}).run({}), loud = Replay(null, {}).run({});
  EXPECT_NEAR(instrument_rms(loud, field_z) / instrument_rms(quiet, field_z), 6, 1.5);
  EXPECT_GT(instrument_rms(loud, depth) / instrument_rms(quiet, depth), 4);
}

TEST(GapInstruments, TheNominalWhiteningIsTheNoiseOfTheMeanOfAnInterval) {
  devices::InstrumentModel model;
  const Whitening usual = Whitening::nominal(model);
  model.compass.field_noise_uT *= 2;
  model.imu.gyro_noise_rad_s *= 3;
  model.imu.timing.rate_Hz *= 4;
  model.gps.velocity_noise_m_s *= 5;
  const Whitening other = Whitening::nominal(model);
  EXPECT_NEAR(other.grid_factor(field_y, field_y) / usual.grid_factor(field_y, field_y), 2, 1e-12);
  EXPECT_NEAR(other.grid_factor(gyro_pitch, gyro_pitch) / usual.grid_factor(gyro_pitch, gyro_pitch), 1.5, 1e-12);
  EXPECT_NEAR(other.grid_factor(depth, depth) / usual.grid_factor(depth, depth), 0.5, 1e-12);
  EXPECT_NEAR(other.fix_factor(velocity_east, velocity_east) / usual.fix_factor(velocity_east, velocity_east), 5,
              1e-12);
}

TEST(GapInstruments, SlowCardsHaveAtMostTheNoiseOfOneReading) {
  devices::InstrumentModel model;
  model.imu.timing.rate_Hz = 2;
  const Whitening slow = Whitening::nominal(model);
  EXPECT_EQ(slow.grid_factor(depth, depth), model.imu.depth_noise_m);
}

TEST(GapInstruments, TheSurfaceIsWhereTheAntennaSeesTheSky) {
  Trajectory10Hz course;
  course.depth_m = {0.1, 0.2, 1, 2};
  course.heading_rad.assign(4, 0);
  constexpr std::size_t kSurface = 13;
  ASSERT_EQ(regimes().at(kSurface), "surface");
  course.instruments.gps.antenna_depth_m = 0.15;
  EXPECT_NEAR(drivers_of(kSurface, course)(0, 0), 0.75, 1e-12);
  course.instruments.gps.antenna_depth_m = 1.5;
  EXPECT_NEAR(drivers_of(kSurface, course)(0, 0), 0.25, 1e-12);
}

TEST(GapInstruments, TheConfigurationGivenReplacesThatOfTheRecording) {
  const navcal::test::TemporaryFolder folder;
  test::write_mission(folder / "a.cap", "identification", "", 10, 1);
  const auto load = [&](const std::optional<config::Settings>& stated) {
    return load_mission(
        folder / "a.cap", [](double) {}, stated);
  };
  EXPECT_EQ(load({}).instruments.imu.timing.latency_s, 0.025);
  const auto settings = config::parse(
      "[port.compass]\nprotocol = \"tcm2\"\npath = \"/dev/a\"\n[port.imu]\nprotocol = \"imu-card\"\npath = "
      "\"/dev/b\"\nlatency_ms = 125\n[port.motor]\nprotocol = \"motor-card\"\npath = \"/dev/c\"\n"
      "[instruments]\ncompass_tilt_lag_s = 0.1\n",
      "n.toml");
  const Mission own = load({}), mission = load(settings);
  EXPECT_EQ(mission.instruments.compass.tilt_lag_s, 0.1);
  EXPECT_EQ(mission.instruments.imu.timing.latency_s, 0.125);
  ASSERT_EQ(mission.card.size(), own.card.size());
  EXPECT_NEAR(own.card[50].time_s - mission.card[50].time_s, 0.1, 0.01) << "its readings are older";
  EXPECT_TRUE(mission.fixes.empty()) << "the configuration has no receiver";
  ASSERT_EQ(mission.remarks.size(), own.remarks.size() + 1);
  EXPECT_NE(mission.remarks.front().find("port gps is not in the configuration"), std::string::npos);
}

}  // namespace
}  // namespace navcal::gap
