// SPDX-License-Identifier: Apache-2.0
// A..E by GPS through `navcal simulate` and `navcal calibrate`, with and without an inertial card.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "tests/cli/calibrate_program.h"

namespace navcal::cli::test {
namespace {

class CalibrateSurface : public CalibrateProgram {
 protected:
  /// Ten minutes at the surface: circles to both sides and straight legs, at 1.2 m/s.
  void simulate() const {
    constexpr double kStep_s = 0.05, kSpeed_m_s = 1.2, kAdvance_m = 0.0872;
    std::ofstream file(folder_ / "path.csv");
    file << "t,x,y,z,phi,theta,psi,u,v,w,p,q,r,rpm,fin1,fin2,fin3\n";
    double x = 0, y = 0, yaw = 0;
    for (int i = 0; i * kStep_s <= 600; ++i) {
      const int leg = static_cast<int>(i * kStep_s / 60) % 4;
      const double rate = leg == 0 ? 0.12 : leg == 2 ? -0.12 : 0;
      file << i * kStep_s << ',' << x << ',' << y << ",0,0,0," << yaw << ',' << kSpeed_m_s << ",0,0,0,0," << rate
           << ',' << kSpeed_m_s / kAdvance_m * 60 << ",0,0,0\n";
      yaw += rate * kStep_s;
      x += kSpeed_m_s * std::cos(yaw) * kStep_s;
      y += kSpeed_m_s * std::sin(yaw) * kStep_s;
    }
    file.close();
    write("iron.toml", "[hard_iron]\nx_uT = 2\ny_uT = -1\nz_uT = 0\n");
    output_of("simulate --path path.csv --effects iron.toml --seed 3 -o all.cap");
  }
  void leave_out(const std::string& port) const {
    std::ifstream all(folder_ / "all.cap");
    std::ofstream rest(folder_ / "rest.cap");
    for (std::string line; std::getline(all, line);) {
      const bool of_port =
          line.rfind("#port " + port + " ", 0) == 0 || line.find(" " + port + " ") != std::string::npos;
      if (!of_port) rest << line << '\n';
    }
  }
  static void expect_deviation(const nlohmann::json& json) {
    const auto& found = json["gps_compass"];
    ASSERT_EQ(found["accepted"], true) << found;
    // First order of 2 and -1 uT in a horizontal field of 19.01 uT.
    const double b = -2 / 19.01 * 180 / std::numbers::pi, c = 1 / 19.01 * 180 / std::numbers::pi;
    EXPECT_NEAR(found["deviation_deg"]["B"], b, 3 * found["deviation_std_deg"]["B"].get<double>()) << found;
    EXPECT_NEAR(found["deviation_deg"]["C"], c, 3 * found["deviation_std_deg"]["C"].get<double>()) << found;
    EXPECT_LT(found["deviation_std_deg"]["B"], 1) << found;
  }
};

TEST_F(CalibrateSurface, DeviationByGpsWithAndWithoutAGyro) {
  simulate();
  const auto with_gyro = calibrated("all.cap");
  expect_deviation(with_gyro);
  EXPECT_EQ(with_gyro["course_delay"]["accepted"], true) << with_gyro["course_delay"];
  leave_out("imu");
  const auto without = calibrated("rest.cap");
  expect_deviation(without);
  EXPECT_EQ(without["gyro"]["accepted"], false);
  EXPECT_NE(without["gyro"]["reason"].get<std::string>().find("inertial card"), std::string::npos)
      << without["gyro"];
}

TEST_F(CalibrateSurface, WithoutEachOtherInstrumentTheAnswerNamesIt) {
  simulate();
  struct Missing {
    const char *port, *calibrator, *word;
  };
  for (const auto& [port, calibrator, word] :
       {Missing{"gps", "gps_compass", "GPS receiver"}, Missing{"motor", "gps_compass", "motor card"},
        Missing{"compass", "magnetometer", "compass"}}) {
    leave_out(port);
    const auto json = calibrated("rest.cap");
    EXPECT_EQ(json[calibrator]["accepted"], false) << port;
    EXPECT_NE(json[calibrator]["reason"].get<std::string>().find(word), std::string::npos)
        << port << ": " << json[calibrator]["reason"];
  }
}

TEST_F(CalibrateSurface, TheShippedSwingShowsAllEightHeadings) {
  output_of("simulate --mission calibration_swing --seed 2 -o all.cap");
  const auto swing = calibrated("all.cap")["swing"];
  EXPECT_EQ(swing["accepted"], true) << swing;
  EXPECT_EQ(swing["estimate"].size(), 8U) << swing;
}

/// The motor's card replaced by a program that knows the current alone.
TEST_F(CalibrateSurface, TheMotorsCurrentNeedsNoSpeedOfItsShaft) {
  write("motor.toml", "[motor_field]\nx_uT_per_A = 0.9\ny_uT_per_A = -0.6\nz_uT_per_A = 1.1\n");
  output_of("simulate --mission identification --seconds 230 --seed 3 --effects motor.toml -o all.cap");
  std::istringstream samples(output_of("replay all.cap"));
  leave_out("motor");
  std::multimap<double, std::string> lines;
  std::ifstream rest(folder_ / "rest.cap");
  std::string head;
  for (std::string line; std::getline(rest, line);) {
    if (line.starts_with('#') && lines.empty())
      head += line + '\n';
    else if (!line.starts_with('#'))
      lines.emplace(std::stod(line), line);
  }
  for (std::string line; std::getline(samples, line);) {
    if (line.find("\"class\":\"MOTOR\"") == std::string::npos) continue;
    const auto sample = nlohmann::json::parse(line);
    const double time_s = sample["time"];
    std::string bytes;
    const std::string text = fmt::format(R"({{"class":"MOTOR","current_A":{},"time":{:.6f},"time_std":0.01}})",
                                         sample["current_A"].get<double>(), time_s) +
                             "\n";
    for (const char c : text) bytes += fmt::format("{:02x}", static_cast<unsigned char>(c));
    lines.emplace(time_s + 0.02, fmt::format("{:.9f} shunt < {}", time_s + 0.02, bytes));
  }
  head += "#port shunt samples 4000000\n";
  for (const auto& [time_s, line] : lines) head += line + '\n';
  write("a.cap", head);
  const auto motor = calibrated("a.cap")["motor_current"];
  EXPECT_EQ(motor["accepted"], true) << motor;
  EXPECT_NEAR(motor["slope_uT_per_A"][0].get<double>(), 0.9, 4 * motor["std"][0].get<double>()) << motor;
}

}  // namespace
}  // namespace navcal::cli::test
