// SPDX-License-Identifier: Apache-2.0
#include "gap/data/mission.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "base/angles.h"
#include "record/recording.h"
#include "sim/recording.h"
#include "tests/gap/simulated_mission.h"
#include "tests/support/temporary_folder.h"

namespace navcal::gap {
namespace {

using test::simulated_mission;

TEST(Mission, IsReadWhole) {
  const Mission mission = simulated_mission("identification", "", 60, 1);
  EXPECT_EQ(mission.shortcoming(), "");
  EXPECT_NEAR(static_cast<double>(mission.card.size()), 1200, 3);
  EXPECT_NEAR(static_cast<double>(mission.compass.size()), 600, 3);
  EXPECT_NEAR(static_cast<double>(mission.motor.size()), 600, 3);
  for (std::size_t i = 1; i < mission.card.size(); ++i)
    EXPECT_LT(mission.card[i - 1].time_s, mission.card[i].time_s);
  for (std::size_t i = 1; i < mission.fixes.size(); ++i) {
    const bool same_sight = mission.fixes[i].time_s - mission.fixes[i - 1].time_s < 2;
    EXPECT_EQ(mission.fixes[i].number, same_sight ? mission.fixes[i - 1].number + 1 : 0);
  }
}

TEST(Mission, KnowsWhenTheFinsWereToldSomethingIfThatWasRecorded) {
  const navcal::test::TemporaryFolder folder;
  const auto file = folder / "mission.cap";
  test::write_mission(file, "identification", "", 60, 1);
  const auto recorded = load_mission(file, [](double) {}).order_times_s;
  EXPECT_GT(recorded.size(), 100U);
  EXPECT_TRUE(std::is_sorted(recorded.begin(), recorded.end()));
  // What each order said is kept beside its time, as the card takes it.
  const auto told_rad = load_mission(file, [](double) {}).ordered_fins_rad;
  ASSERT_EQ(told_rad.size(), recorded.size());
  double most_deg = 0;
  for (const Vector3& fins_rad : told_rad) {
    for (const double fin_rad : fins_rad) {
      const double tenths = fin_rad / base::kRadiansPerDegree * 10;
      EXPECT_NEAR(tenths, std::round(tenths), 1e-9);
      most_deg = std::max(most_deg, std::abs(tenths) / 10);
    }
  }
  EXPECT_GT(most_deg, 1);

  std::ifstream lines(file);
  std::string line, without, with_others;
  while (std::getline(lines, line)) {
    if (line.find(" motor > ") == std::string::npos) without += line + "\n";
    with_others += line + "\n";
    if (line.find(" motor > ") != std::string::npos) with_others += line + "\n";  // once more
    if (line.find(" motor < ") == std::string::npos) continue;
    with_others += line.substr(0, line.find(' ')) + " motor > 244d43430d0a\n";  // no order
  }
  std::ofstream(file) << without;
  EXPECT_TRUE(load_mission(file, [](double) {}).order_times_s.empty());
  EXPECT_TRUE(load_mission(file, [](double) {}).ordered_fins_rad.empty());
  std::ofstream(file) << with_others;
  EXPECT_EQ(load_mission(file, [](double) {}).order_times_s, recorded);
  EXPECT_EQ(load_mission(file, [](double) {}).ordered_fins_rad, told_rad);
}

TEST(Mission, RotationsOfInstrumentsAreUndoneAndPositionsRefused) {
  const navcal::test::TemporaryFolder folder;
  const auto file = folder / "mission.cap";
  devices::InstrumentModel turned;
  turned.compass.mounting.rotation_deg = {5, -10, 90};
  turned.imu.mounting.rotation_deg = {180, 0, 30};
  test::write_mission(file, "identification", "", 60, 1, turned);
  config::Settings settings;
  settings.ports = sim::recording_ports(turned);
  const Mission mission = load_mission(
      file, [](double) {}, settings);
  const Mission straight = simulated_mission("identification", "", 60, 1);
  ASSERT_EQ(mission.card.size(), straight.card.size());
  EXPECT_EQ(mission.instruments.compass.mounting, config::MountingSettings{});
  double worst_rad_s = 0;
  for (std::size_t i = 0; i < mission.card.size(); ++i) {
    for (std::size_t gyro = 0; gyro < 4; ++gyro) {
      const double off_rad_s = mission.card[i].gyro_rad_s[gyro] - straight.card[i].gyro_rad_s[gyro];
      worst_rad_s = std::max(worst_rad_s, std::abs(off_rad_s));
    }
  }
  EXPECT_LT(worst_rad_s, 0.06) << "noise and turn-on bias, each twice";

  settings.ports[2].mounting.position_m = {0, 0, -0.3};
  try {
    (void)load_mission(
        file, [](double) {}, settings);
    FAIL();
  } catch (const record::BadRecording& error) {
    EXPECT_NE(std::string(error.what()).find("port.gps.mounting.position_m"), std::string::npos) << error.what();
  }
}

TEST(Mission, AMotorCardWithoutShaftSpeedIsToldAsSuch) {
  MissionGatherer gatherer;
  instruments::MotorSample motor;
  motor.current_A = 1;
  motor.fins_rad = {0, 0, 0};
  instruments::Sample sample;
  sample.value = motor;
  gatherer.on_sample(sample);
  Mission mission = gatherer.take(0, {});
  const Mission whole = simulated_mission("identification", "", 60, 1);
  mission.card = whole.card;
  mission.compass = whole.compass;
  mission.duration_s = whole.duration_s;
  EXPECT_EQ(mission.shortcoming(),
            "the motor card reports no shaft speed (rpm): what the vehicle was told to do is not known");
}

TEST(Mission, ItsFieldIsStatedOrTheModelsOrFitted) {
  const navcal::test::TemporaryFolder folder;
  const auto file = folder / "mission.cap";
  test::write_mission(file, "identification", "", 60, 1);
  const EarthField stated = load_mission(file, [](double) {}).field;
  EXPECT_EQ(stated.source, EarthField::Source::stated);
  EXPECT_EQ(stated.north_east_down_uT, (Vector3{19, 0.6, 44}));

  std::ifstream lines(file);
  std::string line, without_mark, without_fixes;
  while (std::getline(lines, line)) {
    if (line.starts_with("#event")) continue;
    without_mark += line + "\n";
    if (line.find(" gps < ") == std::string::npos) without_fixes += line + "\n";
  }
  std::ofstream(file) << without_mark;
  const EarthField model = load_mission(file, [](double) {}).field;
  EXPECT_EQ(model.source, EarthField::Source::model);
  EXPECT_EQ(model.date(), "2026-01-01");
  const auto there = base::world_magnetic_field({37.0629 / 57.2957795, -80.6275 / 57.2957795, 562}, 2026.0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(model.north_east_down_uT[static_cast<std::size_t>(i)], there.north_east_down_uT[i], 0.01);
  }

  std::ofstream(file) << without_fixes;
  const EarthField fitted = load_mission(file, [](double) {}).field;
  EXPECT_EQ(fitted.source, EarthField::Source::fitted);
  EXPECT_NEAR(fitted.north_east_down_uT[0], std::hypot(19, 0.6), 0.1);
  EXPECT_EQ(fitted.north_east_down_uT[1], 0);
  EXPECT_NEAR(fitted.north_east_down_uT[2], 44, 0.1);
}

TEST(Mission, SaysWhatItLacks) {
  const Mission whole = simulated_mission("identification", "", 60, 1);
  Mission mission = whole;
  mission.card.clear();
  find_silences(mission);
  EXPECT_EQ(mission.shortcoming(), "") << "judged by the others";
  mission = whole;
  mission.compass.clear();
  find_silences(mission);
  EXPECT_EQ(mission.shortcoming(), "");
  mission.card.clear();
  mission.fixes.clear();
  find_silences(mission);
  EXPECT_NE(mission.shortcoming().find("nothing can be said"), std::string::npos);
  mission = whole;
  mission.motor.clear();
  EXPECT_EQ(mission.shortcoming(), "") << "the commands are recorded";
  mission.orders.clear();
  EXPECT_NE(mission.shortcoming().find("no motor card in the recording, and no commands"), std::string::npos);
  EXPECT_NE(simulated_mission("identification", "", 10, 1).shortcoming().find("lasts 9."), std::string::npos);
  EXPECT_NE(Mission{}.shortcoming(), "");
}

// Samples of an inertial unit or a magnetometer beside complete ones would disturb what those say.
TEST(Mission, PartsOfSamplesServeOnlyWhereThereAreNoCompleteOnes) {
  instruments::Sample sample;
  instruments::ImuSample whole;
  whole.rate_rad_s = {1, 2, 3};
  whole.yaw_rate_b_rad_s = 4;
  whole.specific_force_m_s2 = {0, 0, -9.81};
  whole.depth_m = 5;
  instruments::ImuSample part;
  part.rate_rad_s = {6, 7, 8};
  MissionGatherer gatherer;
  for (int i = 0; i < 1000; ++i) {
    const bool is_whole = i < 500;
    sample.stamp.validity_ns = i * 100'000'000LL;
    sample.value = is_whole || i % 2 == 0 ? whole : part;
    if (i >= 600) sample.value = part;
    gatherer.on_sample(sample);
  }
  const Mission mission = gatherer.take(0, {});
  double last_whole_s = 0, first_part_s = 1e9;
  for (const CardReading& reading : mission.card) {
    if (std::isfinite(reading.depth_m)) last_whole_s = std::max(last_whole_s, reading.time_s);
    if (!std::isfinite(reading.depth_m)) {
      first_part_s = std::min(first_part_s, reading.time_s);
      EXPECT_EQ(reading.gyro_rad_s[1], 8);
      EXPECT_TRUE(std::isnan(reading.gyro_rad_s[3]) && std::isnan(reading.force_m_s2[0]));
    }
  }
  EXPECT_NEAR(last_whole_s, 59.8, 0.01);
  EXPECT_NEAR(first_part_s, 59.9, 0.01);
}

TEST(Mission, OutputsOfAnAutopilotAreCommandsOnlyWithAMap) {
  instruments::Sample sample;
  MissionGatherer unmapped;
  for (const char* name : {"output1", "output3", "oxygen", "motor temperature"}) {
    sample.value = instruments::ScalarSample{instruments::Text<24>(name), instruments::Text<16>("us"), 1500, {}};
    unmapped.on_sample(sample);
  }
  const std::string reason = unmapped.take(0, {}).shortcoming();
  EXPECT_NE(reason.find("outputs (output1, output3), and nothing says what they move"), std::string::npos)
      << reason;

  MissionGatherer mapped;
  instruments::MotorSample motor;
  motor.rpm_commanded = 700;
  motor.fins_rad = {0.1, 0, 0};
  for (int i = 0; i < 10; ++i) {
    if (i == 5) motor.fins_rad[0] = 0.2;
    sample.stamp.validity_ns = i * 100'000'000LL;
    sample.value = motor;
    mapped.on_sample(sample);
  }
  const Mission mission = mapped.take(0, {});
  ASSERT_EQ(mission.orders.size(), 2U) << "a repeated order moves nothing";
  EXPECT_EQ(mission.commanded_s.size(), 10U);
  EXPECT_EQ(mission.orders[1].rpm, 700);
  EXPECT_NEAR(mission.orders[1].time_s, 0.5, 1e-9);
  EXPECT_TRUE(mission.motor.empty());
}

}  // namespace
}  // namespace navcal::gap
