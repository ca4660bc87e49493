// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "../record/sample_log.h"
#include "tests/cli/command_outcome.h"
#include "tests/record/temporary_folder.h"

namespace navcal::cli {
namespace {

class LogCommand : public record::testing::TemporaryFolder {
 protected:
  static test::Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "log");
    return test::run_command(test::add_log_of_files, std::move(arguments));
  }
};

TEST_F(LogCommand, InfoAnswersInJson) {
  const auto log = record::testing::sample_log(2, true);
  const auto outcome = run({"info", "--json", write("a.mcap", log.bytes).string()});
  EXPECT_EQ(outcome.status, 0) << outcome.message;
  const auto json = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(json["finished"], true);
  EXPECT_EQ(json["topics"]["/imu"]["messages"], 40);
  EXPECT_EQ(json["ports"][0]["name"], "compass");
}

TEST_F(LogCommand, FinishGivesAnUnfinishedLogItsEnd) {
  const auto file = write("a.mcap", record::testing::sample_log(1, false).bytes + "torn");
  const auto outcome = run({"finish", file.string()});
  EXPECT_EQ(outcome.status, 0) << outcome.message;
  EXPECT_NE(outcome.output.find("4 bytes after the last whole record removed"), std::string::npos)
      << outcome.output;
  const auto info = run({"info", "--json", file.string()});
  EXPECT_EQ(nlohmann::json::parse(info.output)["finished"], true);
}

TEST_F(LogCommand, ExportWritesWhatWasAskedFor) {
  const auto file = write("a.mcap", record::testing::sample_log(1, true).bytes).string();
  EXPECT_EQ(run({"export", "--cap", (path_ / "a.cap").string(), file}).status, 0);
  EXPECT_EQ(read(path_ / "a.cap").substr(0, 10), "#capture 1");
  EXPECT_EQ(run({"export", "--csv", (path_ / "csv").string(), file}).status, 0);
  EXPECT_TRUE(std::filesystem::exists(path_ / "csv" / "compass.csv"));
  EXPECT_EQ(run({"export", "--netcdf", (path_ / "a.nc").string(), file}).output, (path_ / "a.nc\n").string());
  EXPECT_EQ(read(path_ / "a.nc").substr(1, 3), "HDF");
  EXPECT_EQ(run({"export", "--mat", (path_ / "a.mat").string(), file}).output, (path_ / "a.mat\n").string());
  EXPECT_EQ(read(path_ / "a.mat").substr(0, 19), "MATLAB 5.0 MAT-file");
  const auto bag = (path_ / "bag.mcap").string(), back = (path_ / "back.mcap").string();
  EXPECT_EQ(run({"export", "--ros2", bag, file}).output, bag + "\n");
  EXPECT_EQ(run({"import", "-o", back, bag}).status, 0) << "a bag becomes a log again";
  EXPECT_NE(run({"export", "--ros2", file, file}).status, 0) << "no input is written over";
  EXPECT_EQ(read(file), record::testing::sample_log(1, true).bytes);
}

TEST_F(LogCommand, ImportMakesALogThatHoldsTheCapture) {
  const auto log = write("a.mcap", record::testing::sample_log(20, true).bytes).string();
  const auto capture = (path_ / "a.cap").string();
  const auto imported = (path_ / "b.mcap").string();
  ASSERT_EQ(run({"export", "--cap", capture, log}).status, 0);
  ASSERT_EQ(run({"import", "-o", imported, capture}).status, 0);
  ASSERT_EQ(run({"export", "--cap", (path_ / "b.cap").string(), imported}).status, 0);
  EXPECT_EQ(read(path_ / "b.cap"), read(capture));
  const auto info = nlohmann::json::parse(run({"info", "--json", imported}).output);
  EXPECT_EQ(info["finished"], true);
  EXPECT_EQ(info["ports"].size(), 2U);
  EXPECT_GT(info["topics"]["/compass"]["messages"], 100);  // the words are real ones, the card's frames are not
  EXPECT_EQ(run({"import", "-o", imported + "2.mcap", log}).status, 3) << "it is a log already";
  EXPECT_EQ(run({"import", "-o", (path_ / "absent" / "b.mcap").string(), capture}).status, 1);
  const auto torn = write("torn.cap", "#capture 1\n#port imu imu-card 57600\nx\n").string();
  EXPECT_EQ(run({"import", "-o", (path_ / "c.mcap").string(), torn}).status, 3);
  EXPECT_FALSE(std::filesystem::exists(path_ / "c.mcap") || std::filesystem::exists(path_ / "c.mcap.part"));
}

TEST_F(LogCommand, MarksOfACaptureAreEventsOfTheLog) {
  const std::string text =
      "#capture 1\n#port imu imu-card 57600\n#event before\n1700000000.000000000 imu < a5\n#event dive \"one\"\n"
      "1700000001.000000000 imu < a5\n#event after\n";
  const auto capture = write("a.cap", text).string();
  const auto imported = (path_ / "a.mcap").string();
  ASSERT_EQ(run({"import", "-o", imported, capture}).status, 0);
  const auto info = nlohmann::json::parse(run({"info", "--json", imported}).output);
  EXPECT_EQ(info["topics"]["/event"]["messages"], 3);
  const auto shown = run({"info", imported}).output;
  EXPECT_NE(shown.find("dive \"one\""), std::string::npos) << shown;
  EXPECT_NE(run({"info", capture}).output.find("after"), std::string::npos);
  ASSERT_EQ(run({"export", "--cap", (path_ / "b.cap").string(), imported}).status, 0);
  const std::string back = read(path_ / "b.cap");
  for (const char* mark : {"#event before\n", "#event dive \"one\"\n", "#event after\n"}) {
    EXPECT_NE(back.find(mark), std::string::npos) << mark << back;
  }
}

TEST_F(LogCommand, BadInputNamesFileAndPlace) {
  const auto text = write("a.txt", "hello, world").string();
  for (const auto* command : {"info", "finish"}) {
    const auto outcome = run({command, text});
    EXPECT_EQ(outcome.status, 3) << command;
    EXPECT_EQ(outcome.message.find(text), 0U) << outcome.message;
  }
  EXPECT_EQ(run({"export", "--csv", (path_ / "csv").string(), text}).status, 3);
  const auto capture = write("a.cap", "#capture 1\n#port imu imu-card 57600\nx\n").string();
  const auto outcome = run({"info", capture});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(outcome.message.find(capture + ":3: "), 0U) << outcome.message;
  EXPECT_EQ(run({"info", (path_ / "absent").string()}).status, 3);
}

TEST_F(LogCommand, WrongUsageIsToldApartFromAFailedJob) {
  const auto file = write("a.mcap", record::testing::sample_log(1, true).bytes).string();
  EXPECT_EQ(run({}).status, 2);
  EXPECT_EQ(run({"info"}).status, 2);
  EXPECT_EQ(run({"export", file}).status, 2);
  EXPECT_EQ(run({"export", "--csv", "x", "--cap", "y", file}).status, 2);
  EXPECT_EQ(run({"export", "--mat", "x", "--netcdf", "y", file}).status, 2);
  EXPECT_EQ(run({"import", file}).status, 2);
  EXPECT_EQ(run({"export", "--cap", (path_ / "absent" / "a.cap").string(), file}).status, 1);
}

TEST_F(LogCommand, NothingOfAForeignFileMovesTheCursorOrBeginsALine) {
  const auto capture = write(
      "x\x1b[31m.cap", "#capture 1\n#port a nmea 4800\n#event \x1b]0;OWNED\x07\n1700000000.000000000 a < 24\n");
  const auto log = write("a.mcap", record::testing::sample_log(1, true).bytes);
  for (const auto& file : {capture, log}) {
    const auto outcome = run({"info", file.string()});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(std::all_of(outcome.output.begin(), outcome.output.end(), [](char c) {
      return c == '\n' || (static_cast<unsigned char>(c) >= ' ' && c != '\x7f');
    })) << outcome.output;
  }
  EXPECT_NE(run({"info", capture.string()}).output.find("\\u001b]0;OWNED\\u0007\n"), std::string::npos);
  EXPECT_NE(run({"info", log.string()}).output.find("gone: \"EIO\"\\u000a"), std::string::npos);
}

TEST_F(LogCommand, ACaptureGoesToTheStandardOutput) {
  const auto log = write("a.mcap", record::testing::sample_log(1, true).bytes).string();
  ASSERT_EQ(run({"export", "--cap", (path_ / "a.cap").string(), log}).status, 0);
  const auto outcome = run({"export", "--cap", "-", log});
  EXPECT_EQ(outcome.status, 0) << outcome.message;
  EXPECT_EQ(outcome.output, read(path_ / "a.cap"));
}

}  // namespace
}  // namespace navcal::cli
