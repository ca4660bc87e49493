// SPDX-License-Identifier: Apache-2.0
#include "daemon/gpsd_reports.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>

namespace navcal::daemon {
namespace {

using nlohmann::json;
using namespace instruments;

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr std::int64_t kFirstOfMarch2026_ns = 1'772'323'200'000'000'000;

Stamp stamp_at(std::int64_t utc_ns) {
  Stamp stamp;
  stamp.validity_utc_ns = utc_ns;
  return stamp;
}

std::string tpv(const GpsSample& gps) {
  std::string out;
  append_tpv(out, gps, stamp_at(kFirstOfMarch2026_ns), {"gps"});
  return out;
}

std::string att(const CompassSample& compass, double declination_rad = 0) {
  std::string out;
  config::EnvironmentSettings environment;
  environment.declination_rad = declination_rad;
  append_att(out, compass, pipeline::EarthField(environment), stamp_at(kFirstOfMarch2026_ns + 123'456'789),
             {"compass"});
  return out;
}

std::string found(const std::string& line, const char* pattern) {
  std::smatch match;
  return std::regex_search(line, match, std::regex(pattern)) ? match[1].str() : "";
}

GpsSample fix_3d() {
  GpsSample gps;
  gps.fix = Fix::fix_3d;
  gps.time_utc_ns = kFirstOfMarch2026_ns + 100'000'000;
  gps.latitude_rad = 57.71283 * kRadians;
  gps.longitude_rad = -12.02259 * kRadians;
  gps.height_m = 1234.56;
  gps.speed_m_s = 0.31;
  gps.course_rad = 32 * kRadians;
  return gps;
}

TEST(GpsdReports, AReckonedPositionIsMarkedAsSuch) {
  pipeline::NavigationSample sample;
  sample.stamp = stamp_at(kFirstOfMarch2026_ns);
  sample.source = pipeline::PositionSource::reckoned;
  sample.latitude_rad = 57.71283 * kRadians;
  sample.longitude_rad = -12.02259 * kRadians;
  sample.estimate.position_std_m = {3, 4};
  sample.estimate.velocity_m_s = Eigen::Vector3d(0, -1.5, 0.25);
  sample.estimate.depth_m = 2.5;
  std::string line;
  append_tpv(line, sample, true);
  const json report = json::parse(line);
  EXPECT_EQ(report["class"], "TPV");
  EXPECT_EQ(report["device"], "navigation");
  EXPECT_EQ(report["mode"], 2);
  EXPECT_EQ(report["status"], 5) << "gpsd's dead reckoning";
  EXPECT_EQ(report["time"], "2026-03-01T00:00:00.000Z");
  EXPECT_NEAR(report["lat"].get<double>(), 57.71283, 1e-8);
  EXPECT_EQ(report["epy"], 3);
  EXPECT_EQ(report["epx"], 4);
  EXPECT_EQ(report["eph"], 5);
  EXPECT_EQ(report["track"], 270);
  EXPECT_EQ(report["speed"], 1.5);
  EXPECT_EQ(report["climb"], -0.25);
  EXPECT_EQ(report["depth"], 2.5);
  sample.estimate.velocity_m_s = Eigen::Vector3d::Zero();
  line.clear();
  append_tpv(line, sample, false);
  EXPECT_FALSE(json::parse(line).contains("time"));
  EXPECT_FALSE(json::parse(line).contains("track")) << "where nothing moves there is no direction";
}

TEST(GpsdReports, TpvHasGpsdsKeysUnitsAndOrder) {
  const std::string line = tpv(fix_3d());
  EXPECT_EQ(found(line, R"re("class":"TPV".*?"time":"([^"]+)")re"), "2026-03-01T00:00:00.100Z");
  EXPECT_EQ(found(line, R"re("class":"TPV".*?"altHAE":(-?[0-9.]+))re"), "1234.5600");
  const json report = json::parse(line);
  EXPECT_EQ(report["mode"], 3);
  EXPECT_NEAR(report["lat"].get<double>(), 57.71283, 1e-9);
  EXPECT_NEAR(report["lon"].get<double>(), -12.02259, 1e-9);
  EXPECT_NEAR(report["track"].get<double>(), 32, 1e-4);
  EXPECT_FALSE(report.contains("altMSL"));
  EXPECT_FALSE(report.contains("status"));
}

TEST(GpsdReports, TpvWithoutAFixHasNoPosition) {
  for (const Fix fix : {Fix::none, Fix::acquiring, Fix::bad_geometry}) {
    GpsSample gps = fix_3d();
    gps.fix = fix;
    const json report = json::parse(tpv(gps));
    EXPECT_EQ(report["mode"], 1);
    EXPECT_FALSE(report.contains("lat"));
    EXPECT_TRUE(report.contains("time"));
  }
}

TEST(GpsdReports, TpvSaysWhenAPositionIsPropagatedOrHeld) {
  GpsSample gps = fix_3d();
  gps.fix = Fix::propagated;
  EXPECT_EQ(json::parse(tpv(gps))["status"], 5);
  gps.fix = Fix::hold;
  EXPECT_EQ(json::parse(tpv(gps))["status"], 7);
}

TEST(GpsdReports, TpvTellsWhatIsWrongWithItsTime) {
  GpsSample gps = fix_3d();
  gps.time_corrected = true;
  gps.leap_known = false;
  gps.time_utc_ns = kFirstOfMarch2026_ns + 12'345;
  const json report = json::parse(tpv(gps));
  EXPECT_EQ(report["time_corrected"], true);
  EXPECT_EQ(report["leap_known"], false);
  EXPECT_EQ(report["time"], "2026-03-01T00:00:00.000012345Z");
}

TEST(GpsdReports, HeadingIsPassedOnAsTheDeviceSaidItWhenNothingCorrectsIt) {
  for (int heading = 1; heading <= 60000; heading += 7) {
    CompassSample compass;
    compass.heading_rad = heading * kRadians;
    const std::string text = found(att(compass), R"re("class":"ATT".*?"heading":([0-9.]+))re");
    EXPECT_EQ(text, std::to_string(heading) + ".0000") << "a mis-set unit must stay visible";
  }
}

TEST(GpsdReports, DeclinationMakesTrueNorthOfMagneticHeadingsOnly) {
  CompassSample compass;
  compass.heading_rad = 355 * kRadians;
  EXPECT_NEAR(json::parse(att(compass, 10 * kRadians))["heading"].get<double>(), 5, 1e-4);
  EXPECT_NEAR(json::parse(att(compass, -10 * kRadians))["heading"].get<double>(), 345, 1e-4);
  compass.heading_rad = 5 * kRadians;
  EXPECT_NEAR(json::parse(att(compass, -10 * kRadians))["heading"].get<double>(), 355, 1e-4);
  compass.heading_is_true = true;
  EXPECT_NEAR(json::parse(att(compass, -10 * kRadians))["heading"].get<double>(), 5, 1e-4);
}

TEST(GpsdReports, TheHeadingBehindAnAutopilotNamesItsSource) {
  const auto source_of = [](const CompassSample& compass, bool is_autopilot) {
    std::string out;
    append_att(out, compass, {}, Stamp{}, {"rov", true, {}, is_autopilot});
    return json::parse(out).value("heading_source", "");
  };
  CompassSample attitude, field;
  attitude.heading_rad = 1;
  attitude.heading_is_true = true;
  field.heading_calibrated_rad = 1;
  EXPECT_EQ(source_of(attitude, true), "autopilot");
  EXPECT_EQ(source_of(field, true), "calibration");
  EXPECT_EQ(source_of(CompassSample{}, true), "") << "no heading";
  EXPECT_EQ(source_of(attitude, false), "");
}

TEST(GpsdReports, TwoDecimalsOfAFieldComeBackDigitByDigit) {
  for (int hundredths = -7000; hundredths <= 7000; ++hundredths) {
    CompassSample compass;
    compass.field_body_uT = Vector3{hundredths / 100.0, 0, 0};
    const double said = json::parse(att(compass))["mag_x"].get<double>();
    EXPECT_EQ(said, hundredths / 100.0);
  }
}

TEST(GpsdReports, AbsentQuantitiesAreAbsent) {
  const json report = json::parse(att(CompassSample{}));
  EXPECT_EQ(report.size(), 3U) << report.dump() << ": class, device, time and no more";
  std::string out;
  append_att(out, CompassSample{}, {}, Stamp{}, {"compass", false});
  EXPECT_FALSE(json::parse(out).contains("time")) << "no mapping to UTC: no time";
}

TEST(GpsdReports, StandardErrorsAreSaidWhereTheyAreKnown) {
  GpsSample gps = fix_3d();
  EXPECT_FALSE(json::parse(tpv(gps)).contains("epx"));
  gps.position_std_m = 3;
  gps.height_std_m = 5;
  gps.velocity_std_m_s = 0.1;
  gps.speed_m_s = 0.1;
  const json position = json::parse(tpv(gps));
  EXPECT_EQ(position["epx"], 3);
  EXPECT_EQ(position["epy"], 3);
  EXPECT_NEAR(position["eph"].get<double>(), 3 * std::sqrt(2), 1e-3);
  EXPECT_EQ(position["epv"], 5);
  EXPECT_EQ(position["eps"], 0.1);
  EXPECT_NEAR(position["epd"].get<double>(), 45, 1e-3);
  gps.speed_m_s = 0;
  EXPECT_FALSE(json::parse(tpv(gps)).contains("epd")) << "without speed there is no course";
  gps.fix = Fix::none;
  EXPECT_FALSE(json::parse(tpv(gps)).contains("epx"));

  CompassSample compass;
  compass.heading_std_rad = compass.tilt_std_rad = 1 * kRadians;
  EXPECT_FALSE(json::parse(att(compass)).contains("heading_std")) << "of what is not there";
  compass.heading_rad = compass.roll_rad = 0.1;
  const json attitude = json::parse(att(compass));
  EXPECT_EQ(attitude["heading_std"], 1);
  EXPECT_EQ(attitude["roll_std"], 1);
  EXPECT_FALSE(attitude.contains("pitch_std"));
  Stamp stamp;
  stamp.std_ns = 2'000'000;
  std::string out;
  append_att(out, compass, {}, stamp, {"compass", true});
  EXPECT_EQ(json::parse(out)["time_std"], 0.002);
}

TEST(GpsdReports, CompassTimeHasMicroseconds) {
  EXPECT_EQ(json::parse(att(CompassSample{}))["time"], "2026-03-01T00:00:00.123456Z");
}

TEST(GpsdReports, DipFollowsFromFieldAndTiltHoweverTheBodyIsTurned) {
  // World field: 20 uT north, 45 uT down. Body at heading h, pitch p, roll r.
  const double true_dip = std::atan2(45.0, 20.0);
  for (double heading = 0; heading < 6.2; heading += 0.4) {
    for (double pitch = -0.6; pitch <= 0.6; pitch += 0.3) {
      for (double roll = -0.8; roll <= 0.8; roll += 0.4) {
        const double n = 20 * std::cos(heading), e = -20 * std::sin(heading), d = 45;
        const double x = n * std::cos(pitch) - d * std::sin(pitch);
        const double z1 = n * std::sin(pitch) + d * std::cos(pitch);
        CompassSample compass;
        compass.field_body_uT =
            Vector3{x, e * std::cos(roll) + z1 * std::sin(roll), -e * std::sin(roll) + z1 * std::cos(roll)};
        compass.pitch_rad = pitch;
        compass.roll_rad = roll;
        EXPECT_NEAR(dip_of(compass).value(), true_dip, 1e-9);
      }
    }
  }
}

TEST(GpsdReports, ImuIsInDegreesAndMetres) {
  ImuSample imu;
  imu.rate_rad_s = {0.1, -0.2, 0.3};
  imu.specific_force_m_s2 = {0, 0, -9.80665};
  imu.depth_m = 12.5;
  std::string out;
  append_att(out, imu, stamp_at(kFirstOfMarch2026_ns), {"imu"});
  const json report = json::parse(out);
  EXPECT_NEAR(report["gyro_y"].get<double>(), -0.2 / kRadians, 1e-4);
  EXPECT_NEAR(report["gyro_z"].get<double>(), 0.3 / kRadians, 1e-4);
  EXPECT_NEAR(report["acc_z"].get<double>(), -9.80665, 1e-4);
  EXPECT_NEAR(report["acc_len"].get<double>(), 9.80665, 1e-4);
  EXPECT_EQ(report["depth"], 12.5);
}

TEST(GpsdReports, SkyCountsSatellitesAndBorrowsTheDilution) {
  SkySample sky;
  sky.count = 2;
  sky.satellites[0] = {5, 43.0F, 174.0F, 44.0F, true};
  sky.satellites[1] = {7, std::nullopt, std::nullopt, 30.5F, false};
  GpsSample position = fix_3d();
  position.dop = 1.94;
  std::string out;
  append_sky(out, sky, &position, stamp_at(kFirstOfMarch2026_ns), {"gps"});
  const json report = json::parse(out);
  EXPECT_EQ(report["nSat"], 2);
  EXPECT_EQ(report["uSat"], 1);
  EXPECT_EQ(report["pdop"], 1.94);
  EXPECT_EQ(report["satellites"][0]["az"], 174.0);
  EXPECT_FALSE(report["satellites"][1].contains("el"));
  EXPECT_EQ(report["satellites"][1]["ss"], 30.5);
}

}  // namespace
}  // namespace navcal::daemon
