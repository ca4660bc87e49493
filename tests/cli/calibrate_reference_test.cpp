// SPDX-License-Identifier: Apache-2.0
// A compass that is calibrated against an external reference of the true heading: errors that `navcal calibrate`
// states, on recordings of `navcal simulate` with a reference beside the other instruments.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <sstream>
#include <string>

#include "base/angles.h"
#include "tests/cli/calibrate_program.h"

namespace navcal::cli::test {
namespace {

constexpr double kBegin_s = 1'767'225'600;
constexpr double kDuration_s = 420;
constexpr double kReferenceRad = base::kRadiansPerDegree;

constexpr const char* kReferenceConfig = R"(
[roles]
heading_reference = "reference"
[environment]
declination_deg = 1.80872
[port.compass]
protocol = "tcm2"
path = "/dev/compass"
baud = 38400
[port.imu]
protocol = "imu-card"
path = "/dev/imu"
baud = 57600
[port.gps]
protocol = "oncore"
path = "/dev/gps"
[port.motor]
protocol = "motor-card"
path = "/dev/motor"
baud = 19200
[port.reference]
protocol = "samples"
address = "unix-listen:/run/reference"
)";

double yaw_at(double time_s) { return 0.12 * time_s + 1.5 * std::sin(0.05 * time_s); }

class CalibrateReference : public CalibrateProgram {
 protected:
  CalibrateReference() {
    write("navcald.toml", kReferenceConfig);
    write_path("path.csv", kDuration_s, [](double time_s) { return Angles{0, 0, yaw_at(time_s)}; });
  }

  struct Case {
    double iron_x_uT = 0, iron_y_uT = 0;
    double offset_rad = 0;  ///< the reference's line is turned by -A
  };

  /// A recording with a reference at 5 Hz: white noise of 0.3 degrees, and slow errors of 0.2 degrees.
  void record(const Case& of, unsigned seed) const {
    write("iron.toml", fmt::format("[hard_iron]\nx_uT = {}\ny_uT = {}\n", of.iron_x_uT, of.iron_y_uT));
    output_of(fmt::format("simulate --path path.csv --effects iron.toml --seed {} -o plain.cap", seed));
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal;
    std::istringstream plain(navcal::test::read_file(folder_ / "plain.cap"));
    std::string all, line;
    double next_s = kBegin_s + 0.5, slow_rad = 0.2 * kReferenceRad * normal(engine);
    bool in_head = true;
    while (std::getline(plain, line)) {
      if (in_head && !line.starts_with("#capture") && !line.starts_with("#port")) {
        all += "#port reference samples 4000000\n";
        in_head = false;
      }
      const double stamp_s = line.starts_with('#') ? 0 : std::stod(line.substr(0, line.find(' ')));
      for (; !in_head && stamp_s > next_s + 0.02 && next_s < kBegin_s + kDuration_s - 1; next_s += 0.2) {
        constexpr double kKeep = 0.99;  // 20 s
        slow_rad = kKeep * slow_rad + std::sqrt(1 - kKeep * kKeep) * 0.2 * kReferenceRad * normal(engine);
        const double heading_rad = base::as_heading(yaw_at(next_s - kBegin_s) - of.offset_rad + slow_rad +
                                                    0.3 * kReferenceRad * normal(engine));
        all += fmt::format("{:.9f} reference < ", next_s + 0.02);
        const std::string sample = fmt::format(
            R"({{"class":"COMPASS","heading_rad":{:.9f},"heading_is_true":true,"heading_std_rad":0.006,"time":{:.9f},)"
            R"("time_std":0.002}})",
            heading_rad, next_s);
        for (const char c : sample + "\n") all += fmt::format("{:02x}", static_cast<unsigned char>(c));
        all += '\n';
      }
      all += line + '\n';
    }
    write("a.cap", all);
  }
  /// A..E of the compass's own heading: what five harmonics can say of an error by iron, on the headings sailed.
  static Eigen::Matrix<double, 5, 1> truth(const Case& of) {
    const double declination_rad = std::atan2(0.6, 19.0), level_uT = std::hypot(0.6, 19.0);
    Eigen::Matrix<double, 5, 5> information = Eigen::Matrix<double, 5, 5>::Zero();
    Eigen::Matrix<double, 5, 1> right = Eigen::Matrix<double, 5, 1>::Zero();
    for (double t = 0; t < kDuration_s; t += 0.1) {
      const double magnetic_rad = yaw_at(t) - declination_rad;
      const double measured_rad = std::atan2(level_uT * std::sin(magnetic_rad) - of.iron_y_uT,
                                             level_uT * std::cos(magnetic_rad) + of.iron_x_uT);
      Eigen::Matrix<double, 5, 1> row;
      row << 1, std::sin(measured_rad), std::cos(measured_rad), std::sin(2 * measured_rad),
          std::cos(2 * measured_rad);
      information += row * row.transpose();
      right += row * (std::remainder(measured_rad - magnetic_rad, 2 * std::numbers::pi) + of.offset_rad);
    }
    return information.ldlt().solve(right);
  }
};

constexpr std::array<const char*, 5> kNames{"A_deg", "B_deg", "C_deg", "D_deg", "E_deg"};

TEST_F(CalibrateReference, StatedErrorsContainTheTruth) {
  int within = 0, count = 0, offsets = 0, offsets_within = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const double angle_rad = 0.7 * seed;
    const Case of{1.2 * std::cos(angle_rad), 1.2 * std::sin(angle_rad), (seed % 7 - 3.0) * kReferenceRad};
    record(of, seed);
    const auto json = calibrated("--config navcald.toml a.cap");
    const auto& found = json["reference_compass"];
    ASSERT_TRUE(found.is_object()) << json.dump().substr(0, 300);
    EXPECT_EQ(found["accepted"], true) << found["reason"];
    const auto expected = truth(of);
    for (int i = 0; i < 5; ++i) {
      const char* const name = kNames[static_cast<std::size_t>(i)];
      const double error = found["estimate"][name].get<double>() - expected[i] * base::kDegreesPerRadian;
      within += std::abs(error) <= 1.96 * found["std"][name].get<double>() ? 1 : 0;
      ++count;
    }
    // What is left of the heading of the calibrated field is a constant.
    const auto& field = json["reference_field"];
    if (field["accepted"] != true) continue;
    ++offsets;
    const double error = field["estimate"]["A_deg"].get<double>() - of.offset_rad * base::kDegreesPerRadian;
    offsets_within += std::abs(error) <= 1.96 * field["std"]["A_deg"].get<double>() ? 1 : 0;
  }
  EXPECT_GE(within, 0.90 * count) << within << " of " << count;
  EXPECT_LE(within, 0.99 * count) << within << " of " << count;
  EXPECT_GE(offsets, 20);
  EXPECT_GE(offsets_within, 0.85 * offsets) << offsets_within << " of " << offsets;
  RecordProperty("within", within);
  RecordProperty("count", count);
  std::printf("within 1.96 stated errors: %d of %d coefficients; A of the field: %d of %d\n", within, count,
              offsets_within, offsets);
}

TEST_F(CalibrateReference, TheHeadingIsBetterByItAndThereIsNoneWithoutTheRole) {
  record({1.2, -0.8, 3 * kReferenceRad}, 77);
  const auto json = calibrated("--config navcald.toml a.cap");
  EXPECT_EQ(json["reference_compass"]["verdict"], "in_force") << json["reference_compass"];
  EXPECT_LT(json["reference_compass"]["held_out"]["after"], 1.0);
  EXPECT_GT(json["reference_compass"]["held_out"]["before"], 3.0);
  const std::string text = output_of("calibrate --config navcald.toml a.cap");
  EXPECT_NE(text.find("Compass by reference"), std::string::npos) << text;
  std::string config = kReferenceConfig;
  config.replace(config.find("heading_reference"), 17, "heading");
  config.replace(config.find("\"reference\""), 11, "\"compass\"");
  write("without.toml", config);
  const auto without = calibrated("--config without.toml a.cap");
  EXPECT_EQ(without["reference_compass"]["accepted"], false);
  EXPECT_TRUE(without["reference_compass"]["estimate"].empty());
  EXPECT_NE(without["reference_field"]["reason"].get<std::string>().find("lacks an instrument"),
            std::string::npos);
}

}  // namespace
}  // namespace navcal::cli::test
