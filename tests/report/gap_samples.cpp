// SPDX-License-Identifier: Apache-2.0
#include "tests/report/gap_samples.h"

#include <array>
#include <cmath>
#include <limits>

namespace navcal::cli::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct ChannelUnit {
  const char *channel, *unit;
  double floor;
};
constexpr std::array<ChannelUnit, 12> kChannels{{{"compass.heading", "deg", 0.4},
                                                 {"compass.field", "uT", 0.15},
                                                 {"compass.tilt", "deg", 0.12},
                                                 {"imu.gyro", "deg/s", 0.05},
                                                 {"imu.accel", "m/s2", 0.02},
                                                 {"imu.depth", "m", 0.02},
                                                 {"gps.position", "m", 1},
                                                 {"gps.velocity", "m/s", 0.1},
                                                 {"vehicle.yaw_rate", "deg/s", 0.3},
                                                 {"vehicle.pitch_rate", "deg/s", 0.3},
                                                 {"vehicle.speed", "m/s", 0.02},
                                                 {"vehicle.depth_rate", "m/s", 0.01}}};
constexpr std::array kRegimes{"mean",        "heading",       "motor_current", "motor_current_squared",
                              "temperature", "time",          "yaw_rate",      "yaw_acceleration",
                              "pitch",       "depth",         "speed",         "fin_angle",
                              "fin_rate",    "field_history", "course"};

/// Without a gap; times the floor where one is wanted.
void fill_map(gap::Diagnosis& diagnosis) {
  for (std::size_t i = 0; i < kChannels.size(); ++i) {
    for (std::size_t k = 0; k < kRegimes.size(); ++k) {
      const double times = 0.6 + 0.07 * static_cast<double>((5 * i + 3 * k) % 9);
      diagnosis.map.push_back({kChannels[i].channel, kRegimes[k], times * kChannels[i].floor, kChannels[i].floor,
                               kChannels[i].unit, 0.9});
    }
  }
}

void widen(gap::Diagnosis& diagnosis, const char* channel, const char* regime, double times, double p_value) {
  for (auto& entry : diagnosis.map) {
    if (entry.channel != channel || entry.regime != regime) continue;
    entry.gap = times * entry.floor;
    entry.p_value = p_value;
    if (p_value < 0.01) diagnosis.where.push_back(entry);
  }
}

double made_up_noise(int i) { return std::sin(12.9898 * i) + std::sin(78.233 * i + 1); }

void fill_courses(gap::Diagnosis& diagnosis, bool explained) {
  gap::Scatter scatter{"compass.field", "uT", "motor_current", "A", {}, {}, {}};
  for (int i = 0; i < 900; ++i) {
    const double current_A = 0.4 + 0.7 * ((i / 60) % 3) + 0.02 * made_up_noise(i + 7);
    const double noise_uT = 0.12 * made_up_noise(i);
    scatter.driver_value.push_back(current_A);
    scatter.before.push_back(0.9 * (current_A - 1.1) + noise_uT);
    scatter.after.push_back(explained ? noise_uT : 0.5 * (current_A - 1.1) + noise_uT);
  }
  diagnosis.scatter = std::move(scatter);
  diagnosis.tracks = gap::Tracks{{{0, 60, 120}, {0, 50, 90}, {0, 2, 40}}, {{0, 60}, {0, 55}, {0, 9}}, {}};
  if (explained) diagnosis.tracks->improved = {{0, 60}, {0, 51}, {0, 2}};
  for (const auto& channel : kChannels) {
    gap::Course course{channel.channel, channel.unit, {}, {}, {}};
    for (int i = 0; i < 120; ++i) {
      const double wave = std::sin(0.11 * i), noise = 0.3 * made_up_noise(i);
      course.time_s.push_back(5.0 * i);
      course.before.push_back(channel.floor * (3 * wave + noise));
      course.after.push_back(channel.floor * (explained ? noise : 2 * wave + noise));
    }
    diagnosis.courses.push_back(std::move(course));
  }
}

gap::Diagnosis begun(gap::Verdict verdict, const char* sentence) {
  gap::Diagnosis diagnosis;
  diagnosis.verdict = verdict;
  diagnosis.sentence = sentence;
  diagnosis.bank = {100, 1, false, 84};
  diagnosis.duration_s = 612;
  diagnosis.seconds = 3.4;
  diagnosis.gyro_bias_rad_s = {0.003, -0.002, 0.001, 0.004};
  fill_map(diagnosis);
  return diagnosis;
}

}  // namespace

gap::Diagnosis explained_gap() {
  auto diagnosis = begun(gap::Verdict::explained,
                         "A magnetic field of the motor's current and a scale error of the gyros explain the gap; "
                         "98 % of it closes on recordings that had no part in the fit.");
  widen(diagnosis, "compass.field", "motor_current", 14.2, 1e-14);
  widen(diagnosis, "compass.heading", "motor_current", 7.1, 3e-9);
  widen(diagnosis, "compass.heading", "yaw_rate", 4.4, 2e-6);
  widen(diagnosis, "vehicle.yaw_rate", "yaw_rate", 2.1, 0.004);
  widen(diagnosis, "compass.field", "speed", 1.8, 0.08);
  gap::EffectFinding motor{
      "motor_field",
      0.9996,
      {{"x_uT_per_A", 0.8031, 0.0042}, {"y_uT_per_A", -0.31, 0.004}, {"z_uT_per_A", 0.52, 0.005}},
      {}};
  gap::EffectFinding gyro{"gyro_scale",
                          0.973,
                          {{"scale_ax", 0.002, 0.02},
                           {"scale_az", 0.031, 0.0011},
                           {"scale_by", -0.01, 0.012},
                           {"scale_bz", 0.029, 0.0012}},
                          {{"fin_gain", "net turns of two revolutions at two speeds", 6.4}}};
  gap::EffectFinding other{"adc_droop", 0.02, {{"per_A", 0.0001, 0.0002}}, {}};
  diagnosis.effects = {motor, gyro};
  diagnosis.candidates = {motor, gyro, other};
  diagnosis.gap.pooled = {14.2, 1.23, 1.03, 0.983, std::array{0.954, 1.012}};
  diagnosis.gap.channels = {{"compass.field", "uT", {2.13, 0.17, 0.15, 0.99, std::array{0.97, 1.01}}},
                            {"compass.heading", "deg", {2.8, 0.52, 0.4, 0.95, std::array{0.88, 1.02}}},
                            {"gps.position", "m", {1.02, 1.01, 1.0, std::nullopt, std::nullopt}},
                            {"vehicle.yaw_rate", "deg/s", {0.63, 0.66, 0.3, -0.09, std::array{-0.3, 0.12}}}};
  diagnosis.gap.held_out = true;
  diagnosis.gap.heading_error_rad = std::array{0.056, 0.007};
  diagnosis.gap.dead_reckoning_m_per_100m = std::array{5.1, 0.8};
  diagnosis.next = {"Add motor_field and gyro_scale to the model, or calibrate them away.",
                    "Two net turns at two speeds would tell gyro_scale from fin_gain for certain."};
  fill_courses(diagnosis, true);
  return diagnosis;
}

gap::Diagnosis unknown_gap() {
  auto diagnosis =
      begun(gap::Verdict::unknown,
            "There is a gap, in how the field follows the motor's current, that nothing in the library "
            "explains.");
  widen(diagnosis, "compass.field", "motor_current_squared", 9.3, 1e-10);
  widen(diagnosis, "compass.field", "motor_current", 5.2, 1e-7);
  diagnosis.candidates = {{"motor_field", 0.62, {{"x_uT_per_A", 0.4, 0.01}}, {}},
                          {"adc_droop", 0.11, {{"per_A", 0.001, 0.0002}}, {}}};
  diagnosis.gap.pooled = {9.1, 4.0, 1.03, 0.63, std::array{0.5, 0.7}};
  diagnosis.unexplained = {
      "compass.field follows the square of the motor's current: 1.4 uT RMS, 9 times the floor.",
      "motor_field is the best candidate; it closes 63 % and leaves a curve."};
  diagnosis.changes = {{"compass.field", 312, 0.1, 2.3, "uT"}};
  diagnosis.next = {"Step the shaft speed at constant heading, slow to full, both ways round."};
  diagnosis.remarks = {"Without --holdout the answer rests on blocks of one recording."};
  fill_courses(diagnosis, false);
  const gap::ErrorFinding error{
      "x", "compass.field", "motor_current", "motor_current x motor_current", {"current"}, 0.4, 0.02, "uT"};
  diagnosis.sources = {{"compass.field", "the compass's magnetic field", 90, {error}},
                       {"compass.heading", "the compass's heading", 30, {}}};
  diagnosis.proposal = gap::Proposal{diagnosis.sources.front(), true, 73, {4.2, 1.3, 1.05, {}, {}}};
  return diagnosis;
}

gap::Diagnosis no_gap() {
  auto diagnosis =
      begun(gap::Verdict::no_gap, "Nothing exceeds what a tolerance of 2 % on everything would show.");
  diagnosis.gap.pooled = {1.04, 1.04, 1.03, std::nullopt, std::nullopt};
  diagnosis.bank.from_cache = true;
  fill_courses(diagnosis, true);
  return diagnosis;
}

gap::Diagnosis hostile_gap() {
  const std::string bad = "<b>&\"\xff\x01" + std::string(200, 'w');
  gap::Diagnosis diagnosis;
  diagnosis.sentence = bad;
  const gap::WhereEntry entry{bad, bad, kNan, kInfinity, bad, kNan};
  diagnosis.where = {entry};
  diagnosis.map = {entry, {bad, "zero floor", 1, 0, "", 0}, {"other", bad, -1, -1, bad, kInfinity}};
  diagnosis.effects = {{bad, kNan, {{bad, kNan, kInfinity}, {"", kInfinity, kNan}}, {{bad, bad, kNan}}}};
  diagnosis.candidates = {{"another", -kInfinity, {}, {}}};
  diagnosis.gap.pooled = {kNan, kInfinity, -kInfinity, kNan, std::array{kNan, kInfinity}};
  diagnosis.gap.channels = {{bad, bad, {1e300, 1e-300, 0, 1e9, std::array{-1e9, 1e9}}},
                            {"x", "", {0, 0, 0, -kInfinity, std::array{kNan, kNan}}}};
  diagnosis.gap.heading_error_rad = std::array{kNan, kInfinity};
  diagnosis.gap.dead_reckoning_m_per_100m = std::array{kInfinity, kNan};
  diagnosis.unexplained = diagnosis.next = diagnosis.remarks = {bad, ""};
  diagnosis.gyro_bias_rad_s.fill(kNan);
  diagnosis.changes = {{bad, kNan, kNan, kInfinity, bad}};
  diagnosis.tracks =
      gap::Tracks{{{0, 1}, {kNan, 1e300}, {kInfinity, 1}}, {{0}, {kNan}, {1}}, {{0}, {1}, {kInfinity}}};
  diagnosis.scatter = gap::Scatter{bad, bad, bad, bad, {kNan, 1, kInfinity}, {1, kNan}, {}};
  diagnosis.courses = {{bad, bad, {}, {}, {}},
                       {"x", "y", {0, kNan, 2}, {kNan, kNan, kNan}, {1, kInfinity, 1e300}}};
  diagnosis.bank.missions = -1;
  diagnosis.duration_s = diagnosis.seconds = diagnosis.bank.seconds = kNan;
  const gap::ErrorFinding error{"<x>", "", "", "a & b", {}, kNan, kInfinity, "<uT>"};
  diagnosis.sources = {{"<source>", "\"words\" & <more>", kInfinity, {error}}, {"b", "", kNan, {}}};
  diagnosis.proposal = gap::Proposal{diagnosis.sources.front(), false, kNan, {kNan, kInfinity, -1, {}, {}}};
  return diagnosis;
}

report::GapSource gap_source() { return {{"dives/a.cap"}, {"b.cap", "c.cap"}, "", {"adc_droop"}, "found.toml"}; }

}  // namespace navcal::cli::test
