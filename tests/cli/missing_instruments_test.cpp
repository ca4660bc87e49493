// SPDX-License-Identifier: Apache-2.0
// A recording without one or two of its four instruments, through `navcal replay`, `calibrate` and `gap`: each
// says what the others show, and refuses nothing for ever.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/calibrate_program.h"

namespace navcal::cli::test {
namespace {

using Names = std::vector<std::string>;
constexpr std::array<const char*, 4> kPorts{"compass", "imu", "gps", "motor"};

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Each instrument alone, and each pair.
std::vector<Names> omissions() {
  std::vector<Names> all;
  for (std::size_t i = 0; i < kPorts.size(); ++i) {
    all.push_back({kPorts.at(i)});
    for (std::size_t j = i + 1; j < kPorts.size(); ++j) all.push_back({kPorts.at(i), kPorts.at(j)});
  }
  return all;
}

class MissingInstruments : public CalibrateProgram, public testing::WithParamInterface<Names> {
 protected:
  void SetUp() override {
    output_of("simulate --mission calibration_swing --seconds 240 --seed 7 -o all.cap");
    std::ifstream all(folder_ / "all.cap");
    std::string rest;
    for (std::string line; std::getline(all, line);) {
      std::istringstream words(line);
      std::string first, port;
      words >> first >> port;
      const bool of_port = first == "#port" || !first.starts_with('#');
      if (!of_port || !missing(port)) rest += line + "\n";
    }
    write("rest.cap", rest);
  }
  [[nodiscard]] static bool missing(const std::string& port) { return contains(GetParam(), port); }
};

TEST_P(MissingInstruments, NavigationGoesOnWithTheOthers) {
  const std::string out = output_of("replay rest.cap");
  nlohmann::json last;
  int reports = 0;
  std::istringstream lines(out);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("\"class\":\"NAV\"") == std::string::npos) continue;
    last = nlohmann::json::parse(line);
    ++reports;
  }
  ASSERT_GT(reports, 100);
  EXPECT_EQ(last["heading_rad"].is_number(), !missing("compass")) << last;
  EXPECT_EQ(last["roll_rad"].is_number(), !missing("compass") || !missing("imu")) << last;
  EXPECT_EQ(last["lat"].is_number(), !missing("gps")) << last;
  EXPECT_EQ(last["depth_m"].is_number(), !missing("imu")) << last;
}

TEST_P(MissingInstruments, EveryCalibratorWithInstrumentsSaysSomething) {
  if (missing("compass")) {
    const std::string words = output_of("calibrate rest.cap");
    EXPECT_NE(words.find("the recording has no compass"), std::string::npos) << words;
    return;
  }
  const auto json = calibrated("rest.cap");
  EXPECT_EQ(json.contains("gyro") && json["gyro"]["accepted"] == true, !missing("imu")) << json["gyro"];
  for (const auto& [name, part] : json.items()) {
    if (!part.is_object() || !part.contains("accepted")) continue;
    const bool says = part["accepted"] == true || !part["reason"].get<std::string>().empty();
    EXPECT_TRUE(says) << name << ": " << part;
  }
}

TEST_P(MissingInstruments, TheDiagnosisSaysWhatTheOthersShow) {
  if (GetParam() == Names{"gps"}) return;  // a whole diagnosis, which gap_test makes
  const auto json = nlohmann::json::parse(output_of("gap --bank 10 --cache banks --json - rest.cap"));
  const std::string sentence = json["sentence"];
  if (missing("motor")) {  // and with it the commands
    EXPECT_EQ(json["verdict"], "unknown");
    EXPECT_TRUE(json["effects"].empty());
    EXPECT_NE(sentence.find("The causes of a gap cannot be found: "), std::string::npos) << sentence;
    EXPECT_EQ(json.contains("instruments_alone"), !missing("compass")) << sentence;
    if (!missing("compass") && !missing("imu")) {
      EXPECT_EQ(json["instruments_alone"]["gyro"]["accepted"], true) << json["instruments_alone"]["gyro"];
    }
    return;
  }
  Names instruments;
  if (missing("compass")) instruments.push_back("compass");
  if (missing("imu")) instruments.push_back("inertial card");
  if (missing("gps")) instruments.push_back("GPS");
  EXPECT_EQ(json["instruments"]["missing"].get<Names>(), instruments);
  EXPECT_NE(json["remarks"].dump().find("the recording has no " + instruments.front()), std::string::npos);
  const auto not_judged = json["instruments"]["not_judged"].get<Names>();
  EXPECT_EQ(contains(not_judged, "hard_iron"), missing("compass"));
  EXPECT_EQ(contains(not_judged, "gyro_scale"), missing("imu"));
  EXPECT_TRUE(!missing("gps") || contains(not_judged, "water_current"));
  EXPECT_TRUE(json["effects"].empty()) << "a nominal vehicle: " << sentence;
}

INSTANTIATE_TEST_SUITE_P(Each, MissingInstruments, testing::ValuesIn(omissions()), [](const auto& omitted) {
  std::string name;
  for (const std::string& port : omitted.param) name += (name.empty() ? "" : "_and_") + port;
  return name;
});

/// Recordings of a thrust that is twice the typical error too strong.
class DoubtfulRecording : public CalibrateProgram {
 protected:
  void SetUp() override {
    write("thrust.toml", "[thrust_scale]\nscale = 0.16\n");
    output_of("simulate --mission identification --seconds 200 --seed 5 --effects thrust.toml -o all.cap");
  }
  /// Writes a capture of those lines that `line_of` makes of these, empty ones left out, in order of time.
  void rewrite(const std::string& to, const std::function<std::string(const std::string&)>& line_of) const {
    std::ifstream all(folder_ / "all.cap");
    std::string head;
    std::multimap<double, std::string> lines;
    for (std::string line; std::getline(all, line);) {
      if (line.starts_with('#')) {
        head += line + "\n";
      } else if (const std::string made = line_of(line); !made.empty()) {
        lines.emplace(std::stod(made), made);
      }
    }
    for (const auto& [time_s, line] : lines) head += line + "\n";
    write(to, head);
  }
  [[nodiscard]] nlohmann::json gap(const std::string& arguments) const {
    return nlohmann::json::parse(output_of("gap --bank 10 --cache banks --json - " + arguments));
  }
};

TEST_F(DoubtfulRecording, AStrippedDeviceIsWhatIsLeftOut) {
  rewrite("no_card.cap",
          [](const std::string& line) { return line.find(" imu ") == std::string::npos ? line : std::string(); });
  const auto stripped = gap("no_card.cap"), left_out = gap("--without card all.cap");
  EXPECT_EQ(stripped["instruments"], left_out["instruments"]);
  EXPECT_EQ(stripped["verdict"], left_out["verdict"]);
  EXPECT_TRUE(stripped["effects"].empty()) << stripped["sentence"];
}

TEST_F(DoubtfulRecording, CommandsServeWhereNothingReports) {
  rewrite("no_report.cap", [](const std::string& line) {
    return line.find(" motor < ") == std::string::npos ? line : std::string();
  });
  const auto json = gap("no_report.cap");
  EXPECT_EQ(json["instruments"]["missing"], nlohmann::json::array({"motor report"}));
  EXPECT_NE(json["remarks"].dump().find("nominal servos that obey the commands"), std::string::npos);
  for (const auto& effect : json["effects"]) EXPECT_EQ(effect["name"], "thrust_scale");
}

TEST_F(DoubtfulRecording, CommandsThatAreLateAreToldByHowMuch) {
  const auto earlier = [](const std::string& line, double by_s) {
    if (line.find(" motor > ") == std::string::npos) return line;
    return fmt::format("{:.9f}", std::max(0.0, std::stod(line) - by_s)) + line.substr(line.find(' '));
  };
  rewrite("late.cap", [&](const std::string& line) { return earlier(line, 0.8); });
  const auto reported = gap("late.cap");
  EXPECT_NEAR(reported["commands"]["delay_s"].get<double>(), 0.8, 0.1);
  EXPECT_NE(reported["remarks"].dump().find("the fins follow the recorded commands 0."), std::string::npos)
      << reported["remarks"];
  rewrite("late_alone.cap", [&](const std::string& line) {
    return line.find(" motor < ") == std::string::npos ? earlier(line, 1.5) : std::string();
  });
  const auto alone = gap("late_alone.cap");
  EXPECT_EQ(alone["verdict"], "unknown");
  EXPECT_TRUE(alone["effects"].empty());
  EXPECT_NE(alone["sentence"].get<std::string>().find("later than these commands say"), std::string::npos)
      << alone["sentence"];
}

TEST_F(DoubtfulRecording, AnotherVehicleIsToldByItsRatio) {
  write("other.toml",
        "[hull]\nmass_kg = 8.5\nlift_slope_per_rad = 1.5\n[fins]\narea_m2 = 0.009\n[propeller]\n"
        "thrust_at_rest = 0.6\n[damping]\nyaw_per_s = 0.6\npitch_ratio = 1.0\n");
  const auto json = gap("--vehicle other.toml all.cap");
  EXPECT_EQ(json["verdict"], "unknown") << json["sentence"];
  EXPECT_TRUE(json["effects"].empty());
  EXPECT_GT(json["least_ratio"].get<double>(), 2);
  EXPECT_NE(json["unexplained"].dump().find("the recording of another vehicle"), std::string::npos);
}

/// Without the compass nothing but the card tells of roll and pitch.
class NoInclinometer : public CalibrateProgram {
 protected:
  static constexpr double kBegin_s = 1767225600;
  /// Roll and pitch by the time since the beginning.
  [[nodiscard]] std::map<double, std::array<double, 2>> truth_of(const std::string& name) const {
    std::ifstream file(folder_ / name);
    std::string line;
    std::getline(file, line);  // t,x,y,z,phi,theta,...
    std::map<double, std::array<double, 2>> truth;
    while (std::getline(file, line)) {
      std::array<double, 6> values{};
      std::istringstream words(line);
      std::string word;
      for (double& value : values) {
        std::getline(words, word, ',');
        value = std::stod(word);
      }
      truth[values[0]] = {values[4], values[5]};
    }
    return truth;
  }
};

TEST_F(NoInclinometer, RollAndPitchAreByTheAccelerometers) {
  output_of("simulate --mission survey --seconds 120 --seed 7 -o all.cap --truth all.csv");
  std::ifstream all(folder_ / "all.cap");
  std::string rest;
  for (std::string line; std::getline(all, line);) {
    if (line.find(" compass ") == std::string::npos) rest += line + "\n";
  }
  write("rest.cap", rest);
  const auto truth = truth_of("all.csv");
  std::istringstream lines(output_of("replay rest.cap"));
  double sum = 0;
  int count = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("\"class\":\"NAV\"") == std::string::npos) continue;
    const auto nav = nlohmann::json::parse(line);
    const double time_s = nav["time"].get<double>() - kBegin_s;
    const auto at = truth.lower_bound(time_s);
    if (time_s < 10 || at == truth.end()) continue;
    sum += std::pow(nav["roll_rad"].get<double>() - at->second[0], 2) +
           std::pow(nav["pitch_rad"].get<double>() - at->second[1], 2);
    count += 2;
  }
  ASSERT_GT(count, 100);
  EXPECT_LT(std::sqrt(sum / count) * 180 / std::numbers::pi, 0.6) << "degrees, root-mean-square under way";
}

}  // namespace
}  // namespace navcal::cli::test
