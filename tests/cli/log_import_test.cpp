// SPDX-License-Identifier: Apache-2.0
// `navcal log import` of logs of other systems; the readers have tests of their own (tests/analysis/import).
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "protocols/checked_line.h"
#include "protocols/mavlink.h"
#include "protocols/ubx_navigation.h"
#include "tests/cli/command_outcome.h"
#include "tests/record/temporary_folder.h"
#include "tests/support/temporary_folder.h"

namespace navcal::cli {
namespace {

constexpr const char* kColumns =
    "[time]\ncolumn = \"t\"\nformat = \"unix_s\"\n[column.depth]\nmeaning = \"depth\"\n"
    "[column.o2]\nmeaning = \"sensor\"\nunit = \"umol/l\"\n";

class LogImport : public record::testing::TemporaryFolder {
 protected:
  static test::Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "log");
    return test::run_command(test::add_log_of_files, std::move(arguments));
  }
  [[nodiscard]] std::string to(const std::string& name) const { return (path_ / name).string(); }
};

TEST_F(LogImport, WhatWasTakenAndLeftIsSaidAndTheLogReplays) {
  const auto csv =
      write("a.csv", "t,depth,o2\n1700000000,1.5,250\n1700000001,2.5,251\nnever,3,4\n1700000002,50000,\n")
          .string();
  const auto map = write("a.toml", kColumns).string();
  const auto outcome = run({"import", "--json", "--map", map, "-o", to("a.mcap"), csv});
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  const auto json = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(json["class"], "IMPORT");
  EXPECT_EQ(json["format"], "csv");
  EXPECT_EQ(json["utc"], "file");
  EXPECT_EQ(json["start"], 1'700'000'000);
  EXPECT_EQ(json["cut_at"], nullptr);
  EXPECT_EQ(json["refused"], 1) << "a depth of 50 km";
  ASSERT_EQ(json["taken"].size(), 2U);
  EXPECT_EQ(json["taken"][0]["message"], "DEPTH depth");
  EXPECT_EQ(json["taken"][0]["count"], 3);
  EXPECT_EQ(json["taken"][0]["rate_Hz"], 1);
  EXPECT_EQ(json["left"][0]["message"], "row (no time)");
  const auto info = nlohmann::json::parse(run({"info", "--json", to("a.mcap")}).output);
  EXPECT_EQ(info["finished"], true);
  EXPECT_EQ(info["topics"]["/depth"]["messages"], 2);
  EXPECT_EQ(info["topics"]["/sensor"]["messages"], 2);
  const auto exported = run({"export", "--csv", to("csv"), to("a.mcap")});
  ASSERT_EQ(exported.status, 0) << exported.message;
  const std::string depths = navcal::test::read_file(to("csv") + "/depth.csv");
  EXPECT_NE(depths.find("\n1700000001.000000000,"), std::string::npos) << depths;
}

TEST_F(LogImport, TheTextNamesCutsAndUtc) {
  const auto csv = write("a.csv", "t,depth,o2\n1500,1.5,250\n2500,1.5").string();
  std::string columns = kColumns;
  columns.replace(columns.find("unix_s"), 6, "ms");
  const auto outcome = run({"import", "--map", write("a.toml", columns).string(), "-o", to("a.mcap"), csv});
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  EXPECT_NE(outcome.output.find("no UTC: times count from boot, which is set to 2000-01-01"), std::string::npos)
      << outcome.output;
  EXPECT_NE(outcome.output.find("its last record, at byte 24, is not whole"), std::string::npos) << outcome.output;
}

TEST_F(LogImport, AnOutputThatIsThereIsLeftAlone) {
  const auto csv = write("a.csv", "t,depth,o2\n1700000000,1.5,250\n").string();
  const auto map = write("a.toml", kColumns).string();
  write("a.mcap", "precious");
  const auto outcome = run({"import", "--map", map, "-o", to("a.mcap"), csv});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(read(path_ / "a.mcap"), "precious");
}

TEST_F(LogImport, WhatCannotBeReadIsSaidAndNothingIsWritten) {
  const auto nothing = write("nothing.bin", std::string(1000, 'x')).string();
  EXPECT_EQ(run({"import", "-o", to("b.mcap"), nothing}).status, 3);
  const auto outcome = run({"import", "--format", "ulog", "-o", to("b.mcap"), nothing});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.message.find("without any message that can be taken"), std::string::npos) << outcome.message;
  EXPECT_EQ(run({"import", "--format", "floppy", "-o", to("b.mcap"), nothing}).status, 2);
  EXPECT_EQ(run({"import", "--format", "csv", "-o", to("b.mcap"), nothing}).status, 3) << "it needs a map";
  const auto table = run({"import", "-o", to("b.mcap"), write("t.csv", "t,z\n0,1\n").string()});
  EXPECT_EQ(table.status, 3);
  EXPECT_NE(table.message.find("t.csv: a CSV file needs a map of its columns: --map"), std::string::npos)
      << table.message;
  EXPECT_EQ(run({"import", "--map", write("bad.toml", "x = 1\n").string(), "-o", to("b.mcap"), nothing}).status,
            3);
  EXPECT_FALSE(std::filesystem::exists(path_ / "b.mcap"));
  EXPECT_FALSE(std::filesystem::exists(path_ / "b.mcap.part"));
}

TEST_F(LogImport, AFileThatAnotherProgramConvertsIsNamedWithTheConversion) {
  std::filesystem::create_directory(path_ / "folder");
  const std::vector<std::pair<std::string, std::string>> expected{
      {write("a.bag", "#ROSBAG V2.0\n" + std::string(100, 'x')).string(), "a ROS 1 bag: \"rosbags-convert"},
      {write("b.db3", std::string("SQLite format 3\0", 16)).string(), "ros2 bag convert"},
      {to("folder"), "a folder; of a ROS 2 bag, name the .mcap file in it"},
      {write("c.nmea", "$GPGLL,,,,,,V*06").string(), "no frame of nmea gives a sample"},
      {write("d.ubx", "\xB5\x62\x01").string(), "no frame of ubx gives a sample"}};
  for (const auto& [file, words] : expected) {
    const auto outcome = run({"import", "-o", to("o.mcap"), file});
    EXPECT_EQ(outcome.status, 3) << file;
    EXPECT_NE(outcome.message.find(file + ": "), std::string::npos) << outcome.message;
    EXPECT_NE(outcome.message.find(words), std::string::npos) << outcome.message;
  }
  EXPECT_FALSE(std::filesystem::exists(path_ / "o.mcap"));
}

std::string sentence(const std::string& body) {
  const auto line = protocols::checked_line(body);
  return {line.begin(), line.end()};
}

/// A receiver's seconds from 12:00:10 on with a compass between them, as `cat` saves them.
std::string saved_sentences(int seconds, const std::string& date) {
  std::string bytes;
  for (int s = 10; s < 10 + seconds; ++s) {
    const std::string time = std::to_string(120'000 + s) + ".00", place = "3844.1200,N,00908.4000,W";
    bytes += sentence("GNRMC," + time + ",A," + place + ",1.2,75.0," + date + ",,,A");
    bytes += sentence("GNGGA," + time + "," + place + ",1,14,0.8,60.0,M,48.0,M,,");
    for (int i = 0; i < 5; ++i) bytes += sentence("HEHDT,123.4,T");
    bytes += sentence("PXYZA,1");
  }
  return bytes;
}

/// The samples that were read, in the log and left out agree.
void expect_counts_agree(const nlohmann::json& report, const nlohmann::json& info, int samples) {
  int taken = 0, in_log = 0;
  for (const auto& one : report["taken"]) taken += one["samples"].get<int>();
  for (const auto& [topic, of] : info["topics"].items()) {
    if (topic == "/gps" || topic == "/compass" || topic == "/sky") in_log += of["messages"].get<int>();
  }
  EXPECT_EQ(taken, samples) << report;
  EXPECT_EQ(in_log + report["refused"].get<int>(), taken) << info;
}

TEST_F(LogImport, SavedBytesOfAReceiverAreALogAtTheTimesThatItStates) {
  // The second date is before the last rollover of the weeks, and 1024 weeks later is not yet.
  for (const auto& [date, start] : {std::pair("010326", 1'772'366'410), std::pair("010615", 1'433'160'010)}) {
    const auto file = write("walk.nmea", "x*00\r\n" + saved_sentences(30, date)).string();
    const auto outcome = run({"import", "--json", "--baud", "38400", "-o", to("walk.mcap"), file});
    ASSERT_EQ(outcome.status, 0) << outcome.message;
    const auto report = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(report["format"], "nmea");
    EXPECT_EQ(report["utc"], "gps");
    EXPECT_NEAR(report["start"].get<double>(), start, 0.1);
    EXPECT_NEAR(report["duration"].get<double>(), 29.1, 0.1);
    EXPECT_EQ(report["damaged_bytes"], 6);
    EXPECT_EQ(report["cut_at"], nullptr);
    ASSERT_EQ(report["left"].size(), 1U);
    EXPECT_EQ(report["left"][0]["message"], "PXYZA");
    EXPECT_EQ(report["left"][0]["count"], 30);
    expect_counts_agree(report, nlohmann::json::parse(run({"info", "--json", to("walk.mcap")}).output), 30 + 150);
    ASSERT_EQ(run({"export", "--csv", to("csv"), to("walk.mcap")}).status, 0);
    const std::string fixes = navcal::test::read_file(to("csv") + "/gps.csv");
    EXPECT_NE(fixes.find("\n" + std::to_string(start + 20) + "."), std::string::npos) << fixes;
    ASSERT_EQ(run({"export", "--cap", to("walk.cap"), to("walk.mcap")}).status, 0);
    std::filesystem::remove_all(path_ / "csv");
    for (const char* name : {"walk.mcap", "walk.cap"}) std::filesystem::remove(path_ / name);
  }
}

TEST_F(LogImport, SavedBytesWithoutATimeArePlacedEvenlyAndThatIsSaid) {
  std::string headings;
  for (int i = 0; i < 96; ++i) headings += sentence("HEHDT,123.4,T");
  const auto file = write("a.bin", headings + "$HEHDT,12").string();
  const auto outcome = run({"import", "--json", "--driver", "nmea", "-o", to("a.mcap"), file});
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  const auto report = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(report["utc"], "none");
  EXPECT_NEAR(report["start"].get<double>(), 946'684'800, 1);
  EXPECT_NEAR(report["duration"].get<double>(), static_cast<double>(headings.size()) * 10 / 4800, 0.1);
  EXPECT_EQ(report["cut_at"], headings.size());
  EXPECT_EQ(report["remarks"][0], "no time is stated: the bytes are placed evenly, at 4800 Bd");
  expect_counts_agree(report, nlohmann::json::parse(run({"info", "--json", to("a.mcap")}).output), 96);
  EXPECT_EQ(run({"import", "--driver", "floppy", "-o", to("b.mcap"), file}).status, 2);
  EXPECT_EQ(run({"import", "--driver", "keller", "-o", to("b.mcap"), file}).status, 3);
  EXPECT_FALSE(std::filesystem::exists(path_ / "b.mcap"));
}

TEST_F(LogImport, SavedUbxIsKnownByItsBytesAlsoBetweenSentences) {
  std::string bytes = saved_sentences(2, "010326");
  for (int s = 0; s < 20; ++s) {
    protocols::ubx::NavPvt pvt;
    pvt.date = {2026, 3, 1};
    pvt.hour = 12;
    pvt.second = static_cast<std::uint8_t>(20 + s);
    pvt.date_valid = pvt.time_valid = pvt.fully_resolved = pvt.fix_ok = true;
    pvt.fix_type = 3;
    pvt.latitude_deg = 38;
    const auto frame = protocols::ubx::encode_nav_pvt(pvt);
    bytes.append(frame.begin(), frame.end());
  }
  const auto outcome = run({"import", "--json", "-o", to("a.mcap"), write("mixed.log", bytes).string()});
  ASSERT_EQ(outcome.status, 0) << outcome.message;
  const auto report = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(report["format"], "ubx");
  EXPECT_EQ(report["utc"], "gps");
  EXPECT_NEAR(report["duration"].get<double>(), 19, 1);
  expect_counts_agree(report, nlohmann::json::parse(run({"info", "--json", to("a.mcap")}).output), 20);
}

/// A telemetry log of an autopilot with its heartbeat, and SERVO_OUTPUT_RAW with 1500 and 1900 us.
std::string telemetry_of_pulses() {
  constexpr std::array<std::uint8_t, 8> kTime{0x00, 0x06, 0x0A, 0x24, 0x18, 0x1E, 0x40, 0x00};
  constexpr std::array<std::uint8_t, 9> kHeartbeat{0, 0, 0, 0, 12, 3, 0, 4, 3};
  constexpr std::array<std::uint8_t, 8> kPulses{5, 0, 0, 0, 0xDC, 0x05, 0x6C, 0x07};
  std::string log;
  for (const auto& frame : {protocols::mavlink::encode(0, {1, 1, 0}, kHeartbeat),
                            protocols::mavlink::encode(36, {1, 1, 1}, kPulses)}) {
    log.append(kTime.begin(), kTime.end());
    log.append(frame.begin(), frame.end());
  }
  return log;
}

TEST_F(LogImport, AMapMakesShaftAndFinsOfOutputsAndItsMistakesAreNamed) {
  const auto tlog = write("a.tlog", telemetry_of_pulses()).string();
  const std::string map =
      "[column.\"SERVO_OUTPUT_RAW.servo1_raw\"]\nmeaning = \"rpm_commanded\"\nfrom = [1100, 1900]\nto = [-1200, "
      "1200]\n[column.\"SERVO_OUTPUT_RAW.servo2_raw\"]\nmeaning = \"fin_1\"\nfrom = [1100, 1900]\nto = [-20, "
      "20]\nunit = \"deg\"\n";
  const auto good = run({"import", "--map", write("a.toml", map).string(), "-o", to("a.mcap"), tlog});
  ASSERT_EQ(good.status, 0) << good.message;
  EXPECT_NE(good.output.find("SERVO_OUTPUT_RAW by the map"), std::string::npos) << good.output;
  ASSERT_EQ(run({"export", "--csv", to("csv"), to("a.mcap")}).status, 0);
  const std::string motor = navcal::test::read_file(to("csv") + "/motor.csv");
  EXPECT_NE(motor.find(",motor,,0,0.3490658503988659,,,"), std::string::npos) << motor;
  std::string wrong = map;
  wrong.replace(wrong.find("servo2"), 6, "servo7");
  const auto absent = run({"import", "--map", write("b.toml", wrong).string(), "-o", to("b.mcap"), tlog});
  EXPECT_EQ(absent.status, 3);
  EXPECT_EQ(absent.message,
            to("b.toml") + ":5: column.SERVO_OUTPUT_RAW.servo7_raw: the log has no value of this channel");
  EXPECT_FALSE(std::filesystem::exists(path_ / "b.mcap"));
}

}  // namespace
}  // namespace navcal::cli
