// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "protocols/mavlink.h"
#include "tests/cli/calibrate_command.h"
#include "tests/cli/simulated_recording.h"

namespace navcal::cli::test {
namespace {

using Json = nlohmann::json;

RecordingOptions with_iron(double duration_s) {
  RecordingOptions options;
  options.duration_s = duration_s;
  options.offset_uT = {4, -3, 2};
  options.matrix << 1.05, 0.02, 0, 0.02, 0.97, 0, 0, 0, 1;
  options.gyro_scale = 0.9;
  return options;
}

/// Two minutes among iron, with a gyro that reads a tenth too little.
const std::string& turning() {
  static const std::string capture = simulated_recording(turning_path(120), with_iron(120));
  return capture;
}

class Calibrate : public CalibrateCommand {
 protected:
  Json json_of(const std::vector<std::string>& files) {
    std::vector<std::string> arguments{"--json"};
    arguments.insert(arguments.end(), files.begin(), files.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.message;
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << "one object, one line";
    return Json::parse(outcome.output, nullptr, false);
  }
};

TEST_F(Calibrate, ParametersOfAnAutopilotOnlyOfAnAcceptedEstimate) {
  const std::string file = (folder_ / "a.param").string();
  const Outcome written = run({"--parameters", file, write("a.cap", turning())});
  EXPECT_EQ(written.status, 0) << written.message;
  std::ifstream in(file);
  const std::string content{std::istreambuf_iterator<char>(in), {}};
  const auto value = [&](const std::string& name) {
    const auto at = content.find(name + ',');
    return at == std::string::npos ? 0 : std::stod(content.substr(at + name.size() + 1));
  };
  EXPECT_NEAR(value("COMPASS_OFS_X"), -40, 5) << content;
  EXPECT_NEAR(value("COMPASS_OFS_Y"), 30, 5) << content;

  const std::string not_turned = (folder_ / "b.param").string();
  const auto straight = write("b.cap", simulated_recording(straight_path(60), with_iron(60)));
  const Outcome refused = run({"--parameters", not_turned, straight});
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.message.find("b.param was not written"), std::string::npos) << refused.message;
  EXPECT_FALSE(std::filesystem::exists(not_turned));
}

TEST_F(Calibrate, ErrorsAtTheNextUseAreWhatRecordingsFindAlone) {
  std::vector<std::string> files;
  for (const double x_uT : {3.0, 4.0, 5.5}) {
    RecordingOptions options = with_iron(120);
    options.offset_uT.x() = x_uT;
    options.seed = static_cast<std::uint64_t>(10 * x_uT);
    options.begin_s += static_cast<std::int64_t>(1000 * x_uT);
    files.push_back(
        write(fmt::format("iron{}.cap", files.size()), simulated_recording(turning_path(120), options)));
  }
  const Json answer = json_of(files);
  EXPECT_EQ(answer["next_use"]["parts"], 3);
  EXPECT_EQ(answer["next_use"]["between"], "files");
  const double next_uT = answer["next_use"]["std"]["magnetometer"]["offset_x_uT"];
  EXPECT_GT(next_uT, 2) << "1.26 uT of scatter, times Student's point of two degrees of freedom";
  EXPECT_LT(next_uT, 5);
  EXPECT_LT(answer["magnetometer"]["std"]["offset_uT"][0], 0.5);
  EXPECT_NE(run({files[0], files[1], files[2]}).output.find("(next use +- "), std::string::npos);
}

TEST_F(Calibrate, ARecordingThatIsGivenTwiceTellsNothingOfTheNextUseButByItsQuarters) {
  const std::string file = write("a.cap", turning());
  const Json answer = json_of({file, file});
  EXPECT_EQ(answer["next_use"]["parts"], 4);
  EXPECT_EQ(answer["next_use"]["between"], "quarters");
  const std::string text = run({write("short.cap", simulated_recording(turning_path(60), with_iron(60)))}).output;
  EXPECT_EQ(text.find("ext use"), std::string::npos) << "too short for quarters\n" << text;
}

TEST_F(Calibrate, AnotherPlaceIsSaid) {
  RecordingOptions there = with_iron(120);
  there.matrix *= 0.6;
  there.seed = 2;
  there.begin_s += 100'000;
  const std::string here_file = write("here.cap", turning());
  const std::string there_file = write("there.cap", simulated_recording(turning_path(120), there));
  EXPECT_EQ(json_of({here_file})["changes_of_place"], 0);
  EXPECT_EQ(json_of({here_file, there_file})["changes_of_place"], 1);
  EXPECT_NE(run({here_file, there_file}).output.find("another place once"), std::string::npos);
}

TEST_F(Calibrate, NoParametersOfALiveLogWhoseFieldsAreCorrected) {
  std::string capture = "#capture 1\n#port rov mavlink 4000000\n";
  const auto add = [&](int time_ms, std::uint32_t id, const std::vector<std::uint8_t>& payload) {
    capture += fmt::format("{}.{:03}000000 rov < ", time_ms / 1000, time_ms % 1000);
    for (const std::uint8_t byte : protocols::mavlink::encode(id, {1, 1, 0}, payload))
      capture += fmt::format("{:02x}", byte);
    capture += '\n';
  };
  add(0, 0, {0, 0, 0, 0, 12, 12, 0, 4, 3});  // PX4: of COMPASS_OFS_X it knows nothing
  for (int i = 1; i < 100; ++i) {
    std::vector<std::uint8_t> raw_imu;
    protocols::append_le(raw_imu, std::uint64_t{100'000} * static_cast<std::uint64_t>(i));
    raw_imu.resize(20);
    protocols::append_le(raw_imu, static_cast<std::int16_t>(200 + i));
    add(100 * i, 27, raw_imu);
  }
  const Outcome outcome = run({"--parameters", (folder_ / "a.param").string(), write("a.cap", capture)});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.message.find("own calibration is still in the fields"), std::string::npos) << outcome.message;
}

TEST_F(Calibrate, TheKeysOfTheContract) {
  const Json json = json_of({write("a.cap", turning())});
  for (const char* part : {"gyro", "gyro_b"}) {
    for (const char* key : {"scale", "scale_std", "bias_rad_s", "bias_std", "samples"})
      EXPECT_TRUE(json[part][key].is_number()) << part << ' ' << key;
    EXPECT_TRUE(json[part]["accepted"].is_boolean());
    EXPECT_TRUE(json[part]["reason"].is_string());
  }
  for (const char* key : {"deviation_deg", "deviation_std_deg"}) {
    for (const char* coefficient : {"B", "C", "D", "E"})
      EXPECT_TRUE(json["compass"][key][coefficient].is_number()) << key << coefficient;
    EXPECT_TRUE(json["compass"][key].contains("A"));
  }
  const Json& magnetometer = json["magnetometer"];
  EXPECT_EQ(magnetometer["offset_uT"].size(), 3U);
  ASSERT_EQ(magnetometer["matrix"].size(), 3U);
  for (const Json& row : magnetometer["matrix"]) EXPECT_EQ(row.size(), 3U);
  EXPECT_TRUE(magnetometer["residual_uT"].is_number());
  EXPECT_GE(magnetometer["coverage"], 0);
  EXPECT_LE(magnetometer["coverage"], 1);
  EXPECT_TRUE(json["heading"]["before_rms_deg"].is_number());
  EXPECT_TRUE(json["heading"]["after_rms_deg"].is_number());
  EXPECT_EQ(json["heading"]["held_out"], true);
  for (const char* beyond : {"swing", "compass_delay", "course_delay", "misalignment", "gps_compass", "left_out"})
    EXPECT_TRUE(json.contains(beyond)) << beyond;
}

TEST_F(Calibrate, FindsWhatWasPutIn) {
  const Json json = json_of({write("a.cap", turning())});
  EXPECT_TRUE(json["gyro"]["accepted"]) << json["gyro"]["reason"];
  const double scale_error = json["gyro"]["scale"].get<double>() - 1 / 0.9;
  EXPECT_LT(std::abs(scale_error), 4 * json["gyro"]["scale_std"].get<double>()) << scale_error;
  EXPECT_TRUE(json["magnetometer"]["accepted"]) << json["magnetometer"]["reason"];
  EXPECT_NEAR(json["magnetometer"]["offset_uT"][0], 4, 0.1);
  EXPECT_NEAR(json["magnetometer"]["offset_uT"][1], -3, 0.1);
  EXPECT_LT(json["heading"]["after_rms_deg"], json["heading"]["before_rms_deg"].get<double>() / 4);
}

TEST_F(Calibrate, TwoRecordingsTellMoreThanOne) {
  auto options = with_iron(120);
  options.seed = 9;
  options.begin_s += 86'400;
  const auto first = write("a.cap", turning());
  const auto second = write("b.cap", simulated_recording(turning_path(120), options));
  const Json one = json_of({first}), both = json_of({first, second});
  EXPECT_GT(both["magnetometer"]["samples"], one["magnetometer"]["samples"]);
  EXPECT_GT(both["gyro"]["samples"], one["gyro"]["samples"]);
  // In the other order time goes back: another run of the instruments, and no worse.
  const Json reversed = json_of({second, first});
  EXPECT_EQ(reversed["gyro"]["samples"], both["gyro"]["samples"]);
  EXPECT_TRUE(reversed["gyro"]["accepted"]) << reversed["gyro"]["reason"];
}

TEST_F(Calibrate, ASeriesIsOneRecording) {
  const std::string& whole = turning();
  std::size_t cut = whole.size() / 2;
  cut = whole.find('\n', cut) + 1;
  const std::string ports = whole.substr(0, whole.find("\n1") + 1);
  const Json series = json_of({write("1.cap", whole.substr(0, cut)), write("2.cap", ports + whole.substr(cut))});
  const Json one = json_of({write("a.cap", whole)});
  EXPECT_EQ(series["gyro"], one["gyro"]);
  EXPECT_EQ(series["magnetometer"], one["magnetometer"]);
}

TEST_F(Calibrate, AStraightRunIsRefusedWithTheReasonAndTheManoeuvre) {
  const Json json = json_of({write("a.cap", simulated_recording(straight_path(60), with_iron(60)))});
  for (const char* part : {"gyro", "gyro_b", "compass", "magnetometer"}) {
    EXPECT_FALSE(json[part]["accepted"]) << part;
    EXPECT_NE(json[part]["reason"].get<std::string>().find("turn"), std::string::npos) << json[part]["reason"];
  }
  EXPECT_TRUE(json["heading"]["before_rms_deg"].is_null());
}

TEST_F(Calibrate, InstrumentsThatAreNotThereAreNamed) {
  auto options = with_iron(30);
  options.compass = false;
  const auto no_compass = write("c.cap", simulated_recording(turning_path(30), options));
  options.compass = true;
  options.imu = options.gps = false;
  const auto no_gyro = write("g.cap", simulated_recording(turning_path(30), options));
  const auto nothing = write("n.cap", "#capture 1\n#port imu imu-card 57600\n");
  for (const auto& file : {no_compass, no_gyro, nothing}) {
    const Json json = json_of({file});
    EXPECT_FALSE(json["gyro"]["accepted"]) << file;
    EXPECT_NE(json["gyro"]["reason"], "") << file;
    EXPECT_FALSE(json["compass"]["accepted"]) << file;
    EXPECT_TRUE(json["compass"]["deviation_deg"]["A"].is_null()) << file;
  }
  EXPECT_TRUE(json_of({no_gyro})["magnetometer"]["offset_uT"].is_array());
  EXPECT_NE(run({nothing}).output.find("has no compass"), std::string::npos);
}

TEST_F(Calibrate, TextForPeople) {
  const Outcome outcome = run({write("a.cap", turning())});
  EXPECT_EQ(outcome.status, 0) << outcome.message;
  for (const char* part : {"2 min ", "Gyro A ", "accepted", "scale 1.1", "+-", "deg/s", "headings seen",
                           "36 of 36 sectors", "Heading against the calibrated gyro"}) {
    EXPECT_NE(outcome.output.find(part), std::string::npos) << part << '\n' << outcome.output;
  }
  EXPECT_EQ(outcome.output.find("nan"), std::string::npos) << outcome.output;
  EXPECT_EQ(outcome.output.find("inf"), std::string::npos) << outcome.output;
}

TEST_F(Calibrate, BadInputNamesFileAndPlace) {
  const auto text = write("a.txt", "hello, world");
  EXPECT_EQ(run({text}).status, 3);
  EXPECT_EQ(run({text}).message.find(text), 0U) << run({text}).message;
  EXPECT_EQ(run({(folder_ / "absent.cap").string()}).status, 3);
  const auto torn = write("b.cap", "#capture 1\n#port imu imu-card 57600\nx\n");
  EXPECT_EQ(run({torn}).status, 3);
  EXPECT_EQ(run({torn}).message.find(torn + ":3: "), 0U) << run({torn}).message;
  const auto good = write("c.cap", turning().substr(0, 100'000));
  const auto bad_config = write("d.toml", "[calibration]\nmargin = 1\n");
  const Outcome outcome = run({"--config", bad_config, good});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.message.find(bad_config), std::string::npos) << outcome.message;
  EXPECT_EQ(run({good, text}).status, 3) << "the second of two";
  EXPECT_EQ(run({}).status, 2);
}

}  // namespace
}  // namespace navcal::cli::test
