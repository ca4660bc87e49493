// SPDX-License-Identifier: Apache-2.0
#include "record/export/sensor_places.h"

#include <gtest/gtest.h>

#include "config/load.h"
#include "record/export/export.h"
#include "record/log/log_encoder.h"
#include "tests/record/temporary_folder.h"

namespace navcal::record {
namespace {

constexpr std::int64_t kTrackSecond_ns = 1'000'000'000;

TEST(PositionTrack, IsLinearBetweenEstimatesAndEmptyElsewhere) {
  PositionTrack track;
  EXPECT_FALSE(track.at(0));
  track.add(100 * kTrackSecond_ns, {10, 20});
  track.add(110 * kTrackSecond_ns, {11, 18});
  track.add(300 * kTrackSecond_ns, {12, 18});
  EXPECT_FALSE(track.at(99 * kTrackSecond_ns));
  EXPECT_EQ(track.at(100 * kTrackSecond_ns)->lat, 10);
  EXPECT_NEAR(track.at(102'500'000'000)->lat, 10.25, 1e-12);
  EXPECT_NEAR(track.at(102'500'000'000)->lon, 19.5, 1e-12);
  EXPECT_FALSE(track.at(200 * kTrackSecond_ns)) << "the estimates are too far apart";
  EXPECT_EQ(track.at(300 * kTrackSecond_ns)->lat, 12);
  EXPECT_FALSE(track.at(301 * kTrackSecond_ns));
}

TEST(PositionTrack, CrossesTheDateLineTheShortWay) {
  PositionTrack track;
  track.add(0, {0, 179.9});
  track.add(10 * kTrackSecond_ns, {0, -179.9});
  EXPECT_NEAR(track.at(4 * kTrackSecond_ns)->lon, 179.98, 1e-9);
  EXPECT_NEAR(track.at(6 * kTrackSecond_ns)->lon, -179.98, 1e-9);
}

using SensorExport = testing::TemporaryFolder;

TEST_F(SensorExport, AMissionSensorHasThePositionOfItsTimeOfValidity) {
  config::Settings settings;
  settings.ports.push_back(config::default_port("ctd", protocols::Protocol::samples, 4'000'000));
  LogEncoder encoder(settings, config::to_toml(settings));
  std::string log;
  encoder.begin(log, 0, {pipeline::UtcMapping::Source::file, 0, 0, 0});
  const auto add_estimate = [&](std::int64_t time_ns, double latitude_rad) {
    pipeline::NavigationSample estimate;
    estimate.stamp = {time_ns, time_ns, 0, time_ns, time_ns};
    estimate.source = pipeline::PositionSource::fixes;
    estimate.latitude_rad = latitude_rad;
    estimate.longitude_rad = 0.5;
    encoder.navigation(log, estimate);
  };
  const auto add_sensor = [&](std::int64_t time_ns) {
    instruments::ScalarSample oxygen;
    oxygen.quantity = decltype(oxygen.quantity)("oxygen");
    oxygen.value = 250.5;
    instruments::Sample sample;
    sample.stamp = {time_ns, time_ns, 0, time_ns, time_ns};
    sample.value = oxygen;
    encoder.sample(log, sample);
  };
  add_sensor(1 * kTrackSecond_ns);
  add_estimate(10 * kTrackSecond_ns, 0.75);
  add_sensor(15 * kTrackSecond_ns);
  add_estimate(20 * kTrackSecond_ns, 0.75);
  encoder.finish(log, 20 * kTrackSecond_ns);
  (void)export_csv(write("a.mcap", log), path_ / "csv", [](double) {});
  const std::string table = read(path_ / "csv" / "sensor.csv");
  EXPECT_NE(table.find("value_std,calibration,lat_deg,lon_deg\n"), std::string::npos) << table;
  EXPECT_NE(table.find("\n1.000000000,0.000000000,1.000000000,ctd,oxygen,,250.5,,,,\n"), std::string::npos)
      << table;
  EXPECT_NE(table.find("\n15.000000000,0.000000000,15.000000000,ctd,oxygen,,250.5,,,42.9"), std::string::npos)
      << table;
}

}  // namespace
}  // namespace navcal::record
