// SPDX-License-Identifier: Apache-2.0
#include "analysis/audit/audit.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "analysis/audit/bounded.h"
#include "analysis/audit/heading_errors.h"
#include "analysis/import/import_log.h"
#include "protocols/checked_line.h"
#include "tests/support/temporary_folder.h"

namespace navcal::analysis {
namespace {

constexpr double kRadians = 3.14159265358979 / 180;

const Finding* find(const std::vector<Finding>& findings, const std::string& name) {
  const auto found =
      std::find_if(findings.begin(), findings.end(), [&](const Finding& finding) { return finding.name == name; });
  return found == findings.end() ? nullptr : &*found;
}

std::vector<double> times(std::size_t count, double period_s) {
  std::vector<double> made(count);
  for (std::size_t i = 0; i < count; ++i) made[i] = static_cast<double>(i) * period_s;
  return made;
}

AuditedStream stream(std::vector<double> time_s, const std::string& kind = "imu") {
  AuditedStream made;
  made.channel = kind;
  made.kind = kind;
  made.time_s = std::move(time_s);
  return made;
}

RecordedChannel channel(const std::string& port, const std::string& quantity, std::vector<double> values,
                        double period_s) {
  for (const NoiseChannel& row : noise_channels()) {
    if (row.name != quantity) continue;
    RecordedChannel made{port, quantity, std::string(row.unit), &row, {}, {}};
    made.series.time_s = times(values.size(), period_s);
    made.series.values = std::move(values);
    return made;
  }
  throw std::invalid_argument(quantity);
}

std::vector<double> normal(std::size_t count, double mean, double std) {
  std::mt19937 random(7);
  std::normal_distribution<double> one(mean, std);
  std::vector<double> made(count);
  for (double& value : made) value = one(random);
  return made;
}

bool claims_anything(const AuditedFile& file) {
  Audit audit;
  audit.files.push_back(file);
  return !audit.nothing_found();
}

TEST(Audit, EmptyLogClaimsNothing) {
  AuditedLog log;
  log.file = "empty.cap";
  const AuditedFile file = audited(log);
  EXPECT_TRUE(file.findings.empty());
  EXPECT_FALSE(claims_anything(file));
}

TEST(Audit, EvenReadingsHaveARateAndNoFinding) {
  AuditedLog log;
  log.streams.push_back(stream(times(1000, 0.05)));
  const auto findings = sampling_findings(log);
  const Finding* rate = find(findings, "sampling.rate");
  ASSERT_NE(rate, nullptr);
  EXPECT_EQ(rate->certainty, Certainty::nothing);
  EXPECT_NEAR(*rate->value, 20, 1e-6);
  EXPECT_EQ(findings.size(), 1U);
}

TEST(Audit, FewReadingsCannotBeJudged) {
  AuditedLog log;
  log.streams.push_back(stream(times(3, 0.05)));
  EXPECT_EQ(sampling_findings(log).at(0).certainty, Certainty::cannot_say);
}

TEST(Audit, AGapIsCountedWithItsPlace) {
  AuditedLog log;
  auto time_s = times(1000, 0.1);
  for (std::size_t i = 500; i < time_s.size(); ++i) time_s[i] += 3;
  log.streams.push_back(stream(time_s));
  const auto findings = sampling_findings(log);
  const Finding* gap = find(findings, "sampling.gaps");
  ASSERT_NE(gap, nullptr);
  EXPECT_EQ(gap->certainty, Certainty::found);
  EXPECT_NE(gap->sentence.find("3.1 s, from 49.9 s on"), std::string::npos) << gap->sentence;
  EXPECT_NEAR(*gap->value, 100.0 * 30 / 1029, 0.01);
  EXPECT_TRUE(gap->picture);
}

TEST(Audit, UnevenReadingsAreNoGaps) {
  AuditedLog log;
  std::vector<double> time_s{0};
  for (int i = 1; i < 500; ++i) time_s.push_back(time_s.back() + (i % 3 == 0 ? 30 : 5));
  log.streams.push_back(stream(time_s));
  const auto findings = sampling_findings(log);
  EXPECT_EQ(find(findings, "sampling.gaps"), nullptr);
  EXPECT_NE(find(findings, "sampling.irregular"), nullptr);
}

TEST(Audit, PausesByDesignAreNoFaultOfACable) {
  const auto gaps_of = [](double period_s, std::size_t every, double pause_s) {
    AuditedLog log;
    auto time_s = times(1000, period_s);
    for (std::size_t i = 0; i < time_s.size(); ++i)
      time_s[i] += pause_s * std::floor(static_cast<double>(i) / static_cast<double>(every));
    log.streams.push_back(stream(time_s));
    return *find(sampling_findings(log), "sampling.gaps");
  };
  EXPECT_EQ(gaps_of(6.8, 400, 970).certainty, Certainty::likely) << "a glider at 0.15 Hz";
  EXPECT_EQ(gaps_of(0.1, 400, 30).certainty, Certainty::found);
  EXPECT_EQ(gaps_of(6.8, 400, 970).todo.find("cable"), std::string::npos);
}

/// A log made of a file's text.
AuditedLog loaded(const std::string& name, const std::string& text, const std::string& map = {}) {
  const navcal::test::TemporaryFolder folder;
  AuditRequest request{(folder / name).string()};
  std::ofstream(folder / name) << text;
  if (!map.empty()) {
    request.import.map = (folder / "map.toml").string();
    std::ofstream(request.import.map) << map;
  }
  return load_audited(request, [](std::string_view, double) { return true; });
}

TEST(Audit, AnInstrumentThatIsZeroAllTheTimeIsNotThere) {
  std::string map = "[time]\ncolumn = \"t\"\nformat = \"s\"\n", rows = "t";
  for (const char* quantity : {"rate", "force"}) {
    for (const char axis : {'x', 'y', 'z'}) {
      for (const int instance : {1, 2}) {
        const std::string meaning = std::string(quantity) + "_" + axis,
                          column = meaning + std::to_string(instance);
        map += "[column." + column + "]\nmeaning = \"" + meaning + "\"\ninstance = " + std::to_string(instance) +
               "\n";
        rows += "," + column;
      }
    }
  }
  rows += "\n";
  const auto noise = normal(1200, 0, 0.1);
  for (std::size_t i = 0; i < 200; ++i) {
    rows += std::to_string(0.1 * static_cast<double>(i));
    for (std::size_t axis = 0; axis < 6; ++axis) rows += "," + std::to_string(noise[6 * i + axis]) + ",0";
    rows += "\n";
  }
  const AuditedLog log = loaded("a.csv", rows, map);
  ASSERT_EQ(log.streams.size(), 1U);
  EXPECT_EQ(log.streams.front().channel, "imu");
  EXPECT_EQ(log.all("rate_z").size(), 1U);
  EXPECT_EQ(log.all("force_z").size(), 1U);
}

TEST(Audit, NothingIsSaidOfTimesThatNobodyStated) {
  std::string bytes;
  for (int i = 0; i < 100; ++i) {
    for (int same = 0; same < (i % 10 == 0 ? 30 : 1); ++same) {
      const auto line = protocols::checked_line("HEHDT,123.4,T");
      bytes.append(line.begin(), line.end());
    }
    bytes += "$HEROT,,V*1E\r\n";
  }
  const AuditedLog log = loaded("a.nmea", bytes);
  EXPECT_FALSE(log.states_times);
  int of_times = 0;
  for (const Finding& finding : audited(log).findings) {
    if (!finding.name.starts_with("sampling.") && !finding.name.starts_with("delay.")) continue;
    EXPECT_EQ(finding.certainty, Certainty::cannot_say) << finding.name;
    of_times += finding.name.starts_with("sampling.") ? 1 : 0;
  }
  EXPECT_EQ(of_times, 1) << "it is said once";
}

TEST(Audit, RepeatedReadingsAndTimesThatGoBackAreCounted) {
  AuditedLog log;
  auto repeated = stream(times(1000, 0.1), "compass");
  repeated.vectors = 1000;
  repeated.repeated = 500;
  log.streams.push_back(repeated);
  auto time_s = times(1000, 0.1);
  for (std::size_t i = 10; i < time_s.size(); i += 20) std::swap(time_s[i], time_s[i + 1]);
  log.streams.push_back(stream(time_s));
  const auto findings = sampling_findings(log);
  const Finding* found = find(findings, "sampling.repeated");
  ASSERT_NE(found, nullptr);
  EXPECT_DOUBLE_EQ(*found->value, 50);
  EXPECT_NE(find(findings, "sampling.order"), nullptr);
}

TEST(Audit, ClippedForcesAreFoundAndLargeOnesAreNot) {
  auto values = normal(5000, 0, 12);
  AuditedLog free;
  free.channels.push_back(channel("imu", "force_x", values, 0.01));
  for (double& value : values) value = std::clamp(value, -19.62, 19.62);
  AuditedLog clipped;
  clipped.channels.push_back(channel("imu", "force_x", values, 0.01));
  EXPECT_EQ(find(inertial_findings(free), "force.clipping")->certainty, Certainty::nothing);
  const auto findings = inertial_findings(clipped);
  const Finding* found = find(findings, "force.clipping");
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->certainty, Certainty::found);
  EXPECT_NE(found->sentence.find("19.6 m/s2"), std::string::npos) << found->sentence;
}

TEST(Audit, SlowReadingsTellNoVibration) {
  AuditedLog log;
  log.channels.push_back(channel("imu", "force_x", normal(500, 0, 1), 0.5));
  EXPECT_EQ(find(inertial_findings(log), "force.vibration")->certainty, Certainty::cannot_say);
  log.channels = {channel("imu", "force_x", normal(5000, 0, 40), 0.01)};
  EXPECT_EQ(find(inertial_findings(log), "force.vibration")->certainty, Certainty::likely);
}

TEST(Audit, BiasAtRestIsFoundWithItsIntervalAndNotWithoutRest) {
  AuditedLog log;
  log.channels.push_back(channel("imu", "rate_x", normal(4000, 0.3, 0.05), 0.05));
  EXPECT_EQ(find(inertial_findings(log), "gyro.rest")->certainty, Certainty::cannot_say);
  log.rest = {{0, 40}, {120, 200}};
  const auto findings = inertial_findings(log);
  const Finding* bias = find(findings, "gyro.rest");
  EXPECT_EQ(bias->certainty, Certainty::found);
  EXPECT_LT(*bias->low, 0.3);
  EXPECT_GT(*bias->high, 0.3);
  EXPECT_NEAR(*bias->value, 0.3, 0.01);
}

AuditedLog with_fixes(double jump_m) {
  AuditedLog log;
  std::vector<double> north, east;
  for (int i = 0; i < 200; ++i) {
    north.push_back(2.0 * i + (i == 100 ? jump_m : 0));
    east.push_back(0.1 * std::sin(i));
  }
  log.channels.push_back(channel("gps", "north", north, 1));
  log.channels.push_back(channel("gps", "east", east, 1));
  log.channels.push_back(channel("gps", "velocity_north", std::vector<double>(200, 2), 1));
  log.channels.push_back(channel("gps", "velocity_east", std::vector<double>(200, 0), 1));
  return log;
}

TEST(Audit, AJumpOfTheReceiverIsFound) {
  EXPECT_EQ(find(water_findings(with_fixes(0)), "gps.jumps")->certainty, Certainty::nothing);
  const auto findings = water_findings(with_fixes(80));
  const Finding* jump = find(findings, "gps.jumps");
  EXPECT_EQ(jump->certainty, Certainty::found);
  EXPECT_DOUBLE_EQ(*jump->value, 2);  // there and back
}

TEST(Audit, DepthAtTheSurfaceNeedsFixes) {
  AuditedLog log;
  auto depth = normal(4000, 1.2, 0.05);
  for (std::size_t i = 2000; i < depth.size(); ++i) depth[i] += 8;  // after the last fix
  log.channels.push_back(channel("gauge", "gauge_depth", depth, 0.1));
  EXPECT_EQ(find(water_findings(log), "depth.surface")->certainty, Certainty::cannot_say);
  for (const RecordedChannel& one : with_fixes(0).channels) log.channels.push_back(one);
  const auto findings = water_findings(log);
  const Finding* offset = find(findings, "depth.surface");
  EXPECT_EQ(offset->certainty, Certainty::likely);
  EXPECT_NEAR(*offset->value, 1.2, 0.05);
  // A vehicle with fixes at all times, in the air say, tells nothing of the surface.
  log.channels.front().series.values.assign(4000, 9.7);
  EXPECT_EQ(find(water_findings(log), "depth.surface")->certainty, Certainty::cannot_say);
}

TEST(Audit, ScaleAndZerosOfADopplerLog) {
  AuditedLog log = with_fixes(0);
  auto ahead = normal(2000, 2 / 1.1, 0.01);
  for (std::size_t i = 0; i < 200; ++i) ahead[i] = 0;
  log.channels.push_back(channel("dvl", "bottom_velocity_1", ahead, 0.1));
  auto across = std::vector<double>(2000, 0);
  log.channels.push_back(channel("dvl", "bottom_velocity_2", across, 0.1));
  const auto findings = water_findings(log);
  const Finding* scale = find(findings, "dvl.scale");
  ASSERT_NE(scale, nullptr);
  EXPECT_EQ(scale->certainty, Certainty::likely);
  EXPECT_NEAR(*scale->value, 1.1, 0.01);
  EXPECT_EQ(find(findings, "dvl.zeros")->certainty, Certainty::likely);
  EXPECT_DOUBLE_EQ(*find(findings, "dvl.zeros")->value, 10);
}

TEST(Audit, NoiseOfASlowReceiverIsNoScaleOfTheDopplerLog) {
  AuditedLog log = with_fixes(0);
  const auto noise = normal(400, 0, 0.1);
  for (RecordedChannel& one : log.channels) {
    for (std::size_t i = 0; i < 200; ++i) {
      if (one.quantity == "velocity_north") one.series.values[i] = 0.48 + noise[i];
      if (one.quantity == "velocity_east") one.series.values[i] = noise[200 + i];
    }
  }
  log.channels.push_back(channel("dvl", "bottom_velocity_1", std::vector<double>(2000, 0.48), 0.1));
  log.channels.push_back(channel("dvl", "bottom_velocity_2", std::vector<double>(2000, 0), 0.1));
  EXPECT_EQ(find(water_findings(log), "dvl.scale")->certainty, Certainty::cannot_say);
}

calib::CalibratorReport delay_of(calib::Calibrator calibrator, double delay_s, double std_s, bool accepted) {
  calib::CalibratorReport report;
  report.calibrator = calibrator;
  report.judgement.accepted = accepted;
  report.estimate = {{"delay_s", delay_s, std_s}};
  return report;
}

TEST(Audit, ADelayThatNoCalibrationWouldUseIsStillOne) {
  AuditedLog log;
  // Of a compass that is 0.3 s late; the receiver is not late, but its course comes before that heading.
  log.whole.report.calibrators = {delay_of(calib::Calibrator::compass_delay, 0.281, 0.004, false),
                                  delay_of(calib::Calibrator::course_delay, -0.29, 0.1, true)};
  const auto findings = inertial_findings(log);
  const Finding* const late = find(findings, "delay.compass");
  ASSERT_NE(late, nullptr);
  EXPECT_EQ(late->certainty, Certainty::likely);  // no half confirms it
  EXPECT_LT(*late->low, 0.3);
  EXPECT_GT(*late->high, 0.3);
  EXPECT_EQ(find(findings, "delay.course")->certainty, Certainty::nothing);
  log.whole.report.calibrators = {delay_of(calib::Calibrator::compass_delay, 0.281, 0.2, false)};
  EXPECT_EQ(find(inertial_findings(log), "delay.compass")->certainty, Certainty::cannot_say);
}

TEST(Audit, WhatTheCalibratorsWereSpareOfADelayIsAdded) {
  AuditedLog log;
  log.compass_lag_s = 0.6;
  log.whole.report.calibrators = {delay_of(calib::Calibrator::compass_delay, 0.01, 0.002, true),
                                  delay_of(calib::Calibrator::course_delay, 0.05, 0.05, true)};
  for (AuditedCalibration& half : log.halves) half = log.whole;
  const auto findings = inertial_findings(log);
  const Finding* const late = find(findings, "delay.compass");
  EXPECT_EQ(late->certainty, Certainty::found);
  EXPECT_NEAR(*late->value, 0.61, 1e-9);
  EXPECT_NEAR(*late->high - *late->value, 1.96 * 0.002 + 0.15 * 0.01, 1e-9);  // linear in what is left only
  EXPECT_NEAR(*find(findings, "delay.course")->value, 0.06, 1e-9);            // its heading was no longer late
}

TEST(Audit, ABiasThatShowsAtRestIsSaidOnce) {
  AuditedLog log;
  log.channels.push_back(channel("imu", "rate_z", normal(4000, 0.3, 0.05), 0.05));
  // True rate = measured rate + bias: the gyro shows -bias when the vehicle does not turn.
  const auto findings_with = [&](double shown_deg_s) {
    calib::CalibratorReport gyro = delay_of(calib::Calibrator::gyro, 0, 0, true);
    gyro.outcome = calib::Outcome::accepted;
    gyro.judgement.held_out_quantity = calib::HeldOutQuantity::heading;
    gyro.judgement.held_out_before = 0.02;
    gyro.judgement.held_out_after = 0.01;
    gyro.estimate = {{"bias_rad_s", -shown_deg_s * kRadians, 0.02 * kRadians}, {"scale", 1, 0.001}};
    log.whole.report.calibrators = {gyro};
    return audited(log).findings;
  };
  const auto alone = findings_with(0.31);
  EXPECT_EQ(find(alone, "gyro.bias")->certainty, Certainty::found) << "nothing is known at rest";
  log.rest = {{0, 40}, {120, 200}};
  const auto same = findings_with(0.31);
  EXPECT_EQ(find(same, "gyro.rest")->certainty, Certainty::found);
  EXPECT_EQ(find(same, "gyro.bias"), nullptr);
  // The case: iron at the compass. The turns gave -0.69 +- 0.13 deg/s as found, beside the true -0.30 at rest.
  const auto apart = findings_with(0.69);
  EXPECT_EQ(find(apart, "gyro.rest")->certainty, Certainty::likely);
  EXPECT_NE(find(apart, "gyro.rest")->sentence.find("contradicts it: 0.651 to 0.729 deg/s"), std::string::npos)
      << find(apart, "gyro.rest")->sentence;
  EXPECT_EQ(find(apart, "gyro.bias")->certainty, Certainty::cannot_say);
  EXPECT_FALSE(find(apart, "gyro.bias")->value);
}

TEST(Audit, TheVehiclesOwnTurnIsNoBias) {
  AuditedLog log;
  log.rest = {{0, 40}, {120, 200}};
  std::vector<double> ahead, down;
  for (int i = 0; i < 4000; ++i) {
    const double pitch_rad = 0.05 * kRadians * 0.05 * i;
    ahead.push_back(9.81 * std::sin(pitch_rad));
    down.push_back(-9.81 * std::cos(pitch_rad));
  }
  log.channels.push_back(channel("imu", "rate_y", normal(4000, 0.05, 0.005), 0.05));
  EXPECT_EQ(find(inertial_findings(log), "gyro.rest")->certainty, Certainty::found);
  log.channels.push_back(channel("imu", "force_x", ahead, 0.05));
  log.channels.push_back(channel("imu", "force_z", down, 0.05));
  const auto findings = inertial_findings(log);
  EXPECT_EQ(find(findings, "gyro.rest")->certainty, Certainty::cannot_say);
  EXPECT_LT(*find(findings, "gyro.rest")->low, 0.001);
}

TEST(Audit, OneLongRestTellsTheBias) {
  AuditedLog log;
  log.channels.push_back(channel("imu", "rate_z", normal(4000, 0.3, 0.05), 0.05));
  log.rest = {{20, 180}};
  const auto findings = inertial_findings(log);
  EXPECT_EQ(find(findings, "gyro.rest")->certainty, Certainty::found);
  EXPECT_NEAR(*find(findings, "gyro.rest")->value, 0.3, 0.01);
}

TEST(Audit, AnIntervalAcrossItsLimitIsNoAnswer) {
  AuditedLog log;
  log.rest = {{0, 40}, {120, 200}};
  log.channels.push_back(channel("imu", "rate_x", normal(4000, 0.0, 1.0), 0.05));
  const auto wide = inertial_findings(log);
  EXPECT_EQ(find(wide, "gyro.rest")->certainty, Certainty::cannot_say);
  EXPECT_NE(find(wide, "gyro.rest")->sentence.find("too wide to tell"), std::string::npos);
  log.channels = {channel("imu", "rate_x", normal(4000, 0.0, 0.05), 0.05)};
  EXPECT_EQ(find(inertial_findings(log), "gyro.rest")->certainty, Certainty::nothing);
}

TEST(Audit, WhatTellsNoBiasTellsNoScaleEither) {
  AuditedLog log;
  log.channels.push_back(channel("imu", "rate_z", normal(400, 0, 1), 0.05));
  log.whole.report.calibrators = {delay_of(calib::Calibrator::gyro, 0, 0, false)};
  const auto findings = inertial_findings(log);
  for (const char* name : {"gyro.bias", "gyro.scale"})
    EXPECT_EQ(find(findings, name)->certainty, Certainty::cannot_say);
}

TEST(Audit, AnEstimateThatHeldOutReadingsContradictIsNoAnswer) {
  AuditedLog log;
  log.channels.push_back(channel("imu", "rate_z", normal(400, 0, 1), 0.05));
  auto gyro = delay_of(calib::Calibrator::gyro, 0, 0, true);
  gyro.estimate = {{"scale", 0.97, 0.001}, {"bias_rad_s", 0.005, 0.001}};
  gyro.outcome = calib::Outcome::no_better;
  gyro.judgement.held_out_quantity = calib::HeldOutQuantity::heading;
  gyro.judgement.held_out_before = 0.03;
  for (const double after : {0.04, 0.0302}) {
    gyro.judgement.held_out_after = after;
    log.whole.report.calibrators = {gyro};
    const auto findings = inertial_findings(log);
    for (const char* name : {"gyro.bias", "gyro.scale"}) {
      EXPECT_EQ(find(findings, name)->certainty, Certainty::cannot_say) << name << after;
      EXPECT_EQ(find(findings, name)->low.has_value(), after < 0.035) << name << after;
    }
  }
}

TEST(Audit, AReceiverIsNeverEarly) {
  AuditedLog log;
  log.whole.report.calibrators = {delay_of(calib::Calibrator::course_delay, -0.8, 0.1, true)};
  EXPECT_EQ(find(inertial_findings(log), "delay.course")->certainty, Certainty::cannot_say);
  log.whole.report.calibrators = {delay_of(calib::Calibrator::course_delay, 0.8, 0.1, true)};
  EXPECT_EQ(find(inertial_findings(log), "delay.course")->certainty, Certainty::likely);
}

/// A vehicle that turns and tilts slowly, 10 readings a second; `axes` makes the field that is sent.
AuditedLog turning(const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& axes) {
  constexpr double kStep_s = 0.1;
  std::array<std::vector<double>, 6> values;
  Eigen::Matrix3d world_from_body = Eigen::Matrix3d::Identity();
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d rate_rad_s(0.1 * std::sin(0.02 * i), 0.1 * std::cos(0.013 * i), 0.2);
    const Eigen::Vector3d iron_uT(3, -5, 4);
    const Eigen::Vector3d field_uT = axes(world_from_body.transpose() * Eigen::Vector3d(20, 2, 45) + iron_uT);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      values.at(axis).push_back(rate_rad_s[static_cast<Eigen::Index>(axis)] / kRadians);
      values.at(3 + axis).push_back(field_uT[static_cast<Eigen::Index>(axis)]);
    }
    world_from_body *= Eigen::AngleAxisd(rate_rad_s.norm() * kStep_s, rate_rad_s.normalized()).matrix();
  }
  AuditedLog log;
  const std::array names{"rate_x", "rate_y", "rate_z", "field_x", "field_y", "field_z"};
  for (std::size_t i = 0; i < names.size(); ++i)
    log.channels.push_back(channel(i < 3 ? "imu" : "compass", names.at(i), values.at(i), kStep_s));
  return log;
}

TEST(Audit, AxesOfTheFieldThatTheRatesContradict) {
  const auto axes_of = [](const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& axes) {
    return *find(compass_findings(turning(axes)), "compass.axes");
  };
  EXPECT_EQ(axes_of([](const auto& field) { return field; }).certainty, Certainty::nothing);
  EXPECT_EQ(axes_of([](const auto& field) -> Eigen::Vector3d { return 1.2 * field; }).certainty,
            Certainty::nothing);
  const Finding swapped = axes_of([](const auto& f) { return Eigen::Vector3d(f.y(), f.x(), f.z()); });
  EXPECT_EQ(swapped.certainty, Certainty::likely);
  EXPECT_NE(swapped.sentence.find("With axes y, x, z"), std::string::npos) << swapped.sentence;
  const Finding upwards = axes_of([](const auto& f) { return Eigen::Vector3d(f.x(), -f.y(), -f.z()); });
  EXPECT_NE(upwards.sentence.find("With axes -x, y, z, or all of these reversed"), std::string::npos)
      << upwards.sentence;
  AuditedLog still = turning([](const auto& field) { return field; });
  for (RecordedChannel& one : still.channels) one.series.values.assign(3000, 0.01);
  EXPECT_EQ(find(compass_findings(still), "compass.axes")->certainty, Certainty::cannot_say);
}

TEST(Audit, ALateFieldIsAsLateAsItIs) {
  const auto same = [](const auto& field) { return field; };
  for (const double lag_s : {0.0, 0.1, 0.3, 0.6, 1.2, 1.9}) {
    AuditedLog log = turning(same);
    for (RecordedChannel& one : log.channels) {
      if (one.port != "compass") continue;
      for (double& time_s : one.series.time_s) time_s += lag_s;
    }
    EXPECT_NEAR(field_lag_s(log, "compass"), lag_s, 0.06);
  }
  AuditedLog still = turning(same);
  for (RecordedChannel& one : still.channels) one.series.values.assign(3000, 0.01);
  EXPECT_EQ(field_lag_s(still, "compass"), 0);
  EXPECT_EQ(field_lag_s(AuditedLog{}, "compass"), 0);
  EXPECT_EQ(field_lag_s(turning([](const auto& f) { return Eigen::Vector3d(f.y(), f.x(), f.z()); }), "compass"),
            0);
}

/// A field on all headings of a level vehicle, with what the magnetometer's calibrator says of it.
AuditedLog with_magnetometer(bool is_accepted, double iron_uT, double worst_std_rad) {
  AuditedLog log;
  log.compass = "compass";
  calib::CalibratorReport report = delay_of(calib::Calibrator::magnetometer, 0, 0, is_accepted);
  report.outcome = is_accepted ? calib::Outcome::accepted : calib::Outcome::refused;
  report.judgement.reason = "the vertical offset is uncertain by 4.0 uT";
  report.judgement.held_out_quantity = calib::HeldOutQuantity::field;
  report.judgement.held_out_before = 0.1;
  report.judgement.held_out_after = 0.01;
  report.estimate = {{"worst_heading_rad", 0, worst_std_rad}};
  log.whole.report.calibrators = {report};
  log.whole.report.estimates.magnetometer = calib::FieldCorrection{{iron_uT, 0, 0}, Eigen::Matrix3d::Identity()};
  for (int i = 0; i < 1000; ++i) {
    TurnedSample sample;
    sample.reading.time_s = 0.1 * i;
    sample.reading.utc_ns = 100'000'000LL * i;
    sample.reading.roll_rad = sample.reading.pitch_rad = 0;
    sample.reading.field_body_uT =
        Eigen::Vector3d(20 * std::cos(0.05 * i) + iron_uT, -20 * std::sin(0.05 * i), 40);
    log.whole.samples.push_back(sample);
    log.halves.at(i < 500 ? 0 : 1).samples.push_back(sample);
  }
  return log;
}

TEST(Audit, IronThatIsNotKnownWellEnoughToCorrectIsStillIron) {
  const auto certainty_of = [](bool is_accepted, double iron_uT, double worst_std_rad) {
    return find(compass_findings(with_magnetometer(is_accepted, iron_uT, worst_std_rad)), "compass.iron")
        ->certainty;
  };
  EXPECT_EQ(certainty_of(true, 4, 0.01), Certainty::found);
  EXPECT_EQ(certainty_of(false, 4, 0.04), Certainty::likely);
  EXPECT_EQ(certainty_of(false, 4, 0.2), Certainty::cannot_say);
  EXPECT_EQ(certainty_of(false, 0, 0.001), Certainty::cannot_say) << "nothing is not said of what is refused";
  EXPECT_EQ(certainty_of(false, 4, INFINITY), Certainty::cannot_say);
}

TEST(Audit, TheErrorThatAHeadingStatesIsShownBesideItsOwn) {
  AuditedLog log = with_magnetometer(true, 0, 0.005);
  log.begin_utc_ns = 0;
  std::vector<double> headings;
  for (int i = 0; i < 1000; ++i) headings.push_back(std::remainder(0.05 * i / kRadians + 9 + std::sin(i), 360.0));
  for (double& heading : headings) heading += heading < 0 ? 360 : 0;
  log.channels.push_back(channel("attitude", "heading", headings, 0.1));
  log.earth.emplace().declination_source = pipeline::EarthField::Source::model;
  const auto heading_with = [&](double stated_deg) {
    Series& stated = log.heading_std_deg["attitude"] = {times(1000, 0.1), std::vector<double>(1000, stated_deg)};
    stated.values.back() += 0.001;
    return *find(compass_findings(log), "compass.heading");
  };
  EXPECT_NEAR(*heading_with(2).value, 9, 0.5);
  EXPECT_NEAR(*heading_with(2).stated, 2, 1e-3);
  EXPECT_NE(heading_with(2).sentence.find("states an error of 2.0 deg, which does not hold"), std::string::npos)
      << heading_with(2).sentence;
  EXPECT_NE(heading_with(12).sentence.find("12.0 deg, which holds"), std::string::npos);
  auto& magnetometer = log.whole.report.calibrators.front();
  magnetometer.judgement.accepted = false;
  EXPECT_EQ(heading_with(2).certainty, Certainty::likely) << "what is too uncertain to correct by may judge";
  EXPECT_NE(heading_with(2).sentence.find("as far as that determines it"), std::string::npos);
  magnetometer.estimate.front().std = 0.1;
  EXPECT_EQ(heading_with(2).certainty, Certainty::cannot_say) << "but not what is as wrong as the heading";
  magnetometer.estimate.front().std = INFINITY;
  EXPECT_NE(heading_with(2).sentence.find("nor the error of 2.0 deg that it states"), std::string::npos);
  log.heading_std_deg["attitude"].values.back() = 2;
  EXPECT_FALSE(find(compass_findings(log), "compass.heading")->stated) << "a constant is of the configuration";
}

TEST(Audit, ATrueHeadingOfTheCompassOwnPortIsComparedWithTrueNorth) {
  AuditedLog log = with_magnetometer(true, 0, 0.005);
  log.begin_utc_ns = 0;
  std::vector<double> headings;
  for (int i = 0; i < 1000; ++i)
    headings.push_back(base::positive_angle(0.05 * i + 0.2 + 0.05 * std::sin(i)) / kRadians);
  log.channels.push_back(channel(log.compass, "heading", headings, 0.1));
  log.earth.emplace().declination_source = pipeline::EarthField::Source::model;
  log.earth->declination_rad = 0.2;
  EXPECT_GT(*find(compass_findings(log), "compass.heading")->value, 10) << "as a magnetic one";
  log.true_headings.insert(log.compass);
  EXPECT_LT(*find(compass_findings(log), "compass.heading")->value, 3);
}

TEST(Audit, AHeadingIsNotJudgedWhereTheRatesAreWrong) {
  AuditedLog log = with_magnetometer(false, 0, 0.005);
  std::vector<double> headings;
  for (int i = 0; i < 1000; ++i) headings.push_back(std::remainder(0.05 * i / kRadians + 9, 360.0));
  log.channels.push_back(channel("attitude", "heading", headings, 0.1));
  log.earth.emplace().declination_source = pipeline::EarthField::Source::model;
  EXPECT_EQ(find(audited(log).findings, "compass.heading")->certainty, Certainty::likely);
  Finding wrong{"convention.degrees_for_radians", "Conventions", "rate"};
  wrong.certainty = Certainty::found;
  const AuditedFile file = audited(log, {wrong});
  const Finding& heading = *find(file.findings, "compass.heading");
  EXPECT_EQ(heading.certainty, Certainty::cannot_say);
  EXPECT_NE(heading.sentence.find("The rates are not what they should be"), std::string::npos) << heading.sentence;
}

TEST(Audit, ACompassWithoutAFieldTellsNoStep) {
  AuditedLog log;
  log.compass = "compass";
  log.whole.report.calibrators = {delay_of(calib::Calibrator::magnetometer, 0, 0, false)};
  EXPECT_EQ(find(compass_findings(log), "compass.step"), nullptr);
}

TEST(Audit, WhatFollowsFromWrongRatesIsNotSaid) {
  Finding sign{"convention.sign", "Convention", "rate_z", Certainty::found},
      bias{"gyro.bias", "Bias", "imu.rate_z"};
  bias.certainty = Certainty::found;
  const auto certainty_beside = [&](const Finding& convention) {
    return find(audited({}, {convention, bias}).findings, "gyro.bias")->certainty;
  };
  EXPECT_EQ(certainty_beside(sign), Certainty::cannot_say);
  sign.channel = "position";
  EXPECT_EQ(certainty_beside(sign), Certainty::found);
}

TEST(Audit, WhatFollowsFromATiltByDisturbedForcesIsNotSaid) {
  Finding vibration{"force.vibration", "Vibration", "imu", Certainty::found},
      step{"compass.step", "Step", "compass"}, jumps{"gps.jumps", "Jumps", "gps"};
  step.certainty = jumps.certainty = Certainty::found;
  const auto certainty_of = [&](const char* name) {
    return find(audited({}, {vibration, step, jumps}).findings, name)->certainty;
  };
  EXPECT_EQ(certainty_of("compass.step"), Certainty::cannot_say);
  EXPECT_EQ(certainty_of("gps.jumps"), Certainty::found);
  for (const Certainty calm : {Certainty::nothing, Certainty::cannot_say}) {
    vibration.certainty = calm;
    EXPECT_EQ(certainty_of("compass.step"), Certainty::found);
  }
}

TEST(Audit, SeveralStepsHaveOneReasonNotToBeJudged) {
  const Finding vibration{"force.vibration", "Vibration", "imu", Certainty::found};
  Finding first{"compass.step", "Step", "compass", Certainty::found}, second = first, other = first;
  first.sentence = "at 1 s";
  second.sentence = "at 2 s";
  other.channel = "compass2";
  const auto steps_in = [](const std::vector<Finding>& findings) {
    return std::ranges::count(findings, "compass.step", &Finding::name);
  };
  EXPECT_EQ(steps_in(audited({}, {vibration, first, second, other}).findings), 2) << "one of each compass";
  EXPECT_EQ(steps_in(audited({}, {first, second}).findings), 2);
}

TEST(Audit, TheDelayOfAFieldNeedsNoTilt) {
  AuditedLog log = turning([](const auto& field) { return field; });
  log.whole.report.calibrators = {delay_of(calib::Calibrator::compass_delay, 0.2, 0.002, true),
                                  delay_of(calib::Calibrator::course_delay, 0.5, 0.01, true)};
  const Finding vibration{"force.vibration", "Vibration", "imu", Certainty::found};
  const auto findings = audited(log, {vibration}).findings;
  EXPECT_LE(find(findings, "delay.compass")->certainty, Certainty::likely);
  EXPECT_EQ(find(findings, "delay.course")->certainty, Certainty::cannot_say);
  std::erase_if(log.channels, [](const RecordedChannel& one) { return one.port == "compass"; });
  EXPECT_EQ(find(audited(log, {vibration}).findings, "delay.compass")->certainty, Certainty::cannot_say);
}

TEST(Audit, TwoCompassesThatPointApart) {
  AuditedLog log;
  for (const char* port : {"compass", "compass2"}) {
    const double angle = std::string(port) == "compass" ? 0 : 0.2;
    log.channels.push_back(channel(port, "field_x", normal(1000, 40 * std::cos(angle), 0.1), 0.1));
    log.channels.push_back(channel(port, "field_y", normal(1000, 40 * std::sin(angle), 0.1), 0.1));
    log.channels.push_back(channel(port, "field_z", normal(1000, 0, 0.1), 0.1));
  }
  const auto findings = compass_findings(log);
  const Finding* pair = find(findings, "compass.pair");
  ASSERT_NE(pair, nullptr);
  EXPECT_EQ(pair->certainty, Certainty::found);
  EXPECT_NEAR(*pair->value, 11.46, 0.1);
  EXPECT_EQ(find(findings, "compass.size")->certainty, Certainty::nothing);
}

Finding valued(const std::string& name, double value, double half) {
  Finding finding{name, name, "imu"};
  finding.put({value, value - half, value + half}, "deg");
  return finding;
}

std::vector<AuditChange> changes(const Finding& before, const Finding& after) {
  Audit audit;
  audit.files.resize(2);
  audit.files[0].findings = {before};
  audit.files[1].findings = {after};
  return audit.changes();
}

TEST(Audit, ChangesAreTellingBeyondBothIntervalsOnly) {
  EXPECT_TRUE(changes(valued("a", 1, 0.5), valued("a", 1.6, 0.5)).empty());
  const auto other = changes(valued("a", 1, 0.5), valued("a", 2, 0.5));
  ASSERT_EQ(other.size(), 1U);
  EXPECT_NEAR(other[0].low, 1 - std::sqrt(0.5), 1e-9);
  EXPECT_TRUE(changes(valued("a", 1, 0), valued("a", 2, 0)).empty());
  EXPECT_TRUE(changes(valued("a", 1, 0.1), valued("b", 2, 0.1)).empty());
}

TEST(Audit, TheMostCostlyComesFirst) {
  std::vector<Finding> findings{valued("nothing", 1, 0.1), valued("cheap", 1, 0.1), valued("dear", 1, 0.1)};
  findings[1].certainty = findings[2].certainty = Certainty::found;
  findings[1].put_heading(1, 1);
  findings[2].put_heading(20, 1);
  sort_findings(findings);
  EXPECT_EQ(findings[0].name, "dear");
  EXPECT_EQ(findings[2].name, "nothing");
  EXPECT_NEAR(*findings[0].position_m, 600 * 2 * std::sin(10 * 3.14159265358979 / 180), 1e-6);
}

TEST(Bounded, IntervalOfAMeanHoldsInNineteenOfTwenty) {
  std::mt19937 random(3);
  std::normal_distribution<double> one(5, 2);
  int holds = 0;
  constexpr int kTrials = 4000;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> numbers(10);
    for (double& number : numbers) number = one(random);
    const auto mean = mean_bounded(numbers);
    holds += mean->low <= 5 && mean->high >= 5 ? 1 : 0;
  }
  EXPECT_NEAR(holds / double{kTrials}, 0.95, 0.01);
  EXPECT_FALSE(mean_bounded({1, 2, 3}));
  EXPECT_FALSE(root_mean_square_bounded({}, {}));
}

}  // namespace
}  // namespace navcal::analysis
