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
    return test::run_command(add_log, std::move(arguments));
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
  EXPECT_EQ(run({"export", "--cap", (path_ / "absent" / "a.cap").string(), file}).status, 1);
}

}  // namespace
}  // namespace navcal::cli
