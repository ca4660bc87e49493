// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "protocols/device_types.h"
#include "tests/support/temporary_folder.h"

// The program itself, run by a shell as people run it.
namespace navcal::cli {
namespace {

const std::string kFixtures = NAVCAL_SOURCE_DIR "/fixtures/decode/";

class Decode : public testing::Test {
 protected:
  struct Outcome {
    int status = 0;
    std::string output, errors;
  };

  /// `decode` stands for the program with its subcommand; `shell` is the rest of a command of bash.
  [[nodiscard]] Outcome run(const std::string& shell) const {
    const auto script = folder_ / "script";
    std::ofstream(script) << "set -o pipefail\ndecode() { '" NAVCAL_PROGRAM "' decode \"$@\"; }\n"
                          << shell << '\n';
    const std::string command = "bash " + script.string() + " > " + (folder_ / "out").string() + " 2> " +
                                (folder_ / "err").string() + " < /dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, navcal::test::read_file(folder_ / "out"),
            navcal::test::read_file(folder_ / "err")};
  }

  navcal::test::TemporaryFolder folder_;
};

std::vector<nlohmann::json> lines(const std::string& text) {
  std::vector<nlohmann::json> parsed;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) parsed.push_back(nlohmann::json::parse(line));
  return parsed;
}

TEST_F(Decode, AnswersEveryStreamAsExpectedToTheByte) {
  for (const auto& device : protocols::kDeviceTypes) {
    if (device.protocol == protocols::Protocol::described) continue;  // its frames are what a file describes
    const std::string protocol(device.name);
    const auto outcome = run("decode --protocol " + protocol + " --json " + kFixtures + protocol + ".bin");
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_EQ(outcome.output, navcal::test::read_file(kFixtures + protocol + ".jsonl")) << protocol;
    EXPECT_EQ(outcome.errors, "");
  }
}

TEST_F(Decode, StandardInputInSmallPiecesGivesTheSame) {
  const auto outcome =
      run("dd if=" + kFixtures + "oncore.bin bs=7 status=none | decode --protocol oncore --json -");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.output, navcal::test::read_file(kFixtures + "oncore.jsonl"));
}

TEST_F(Decode, EveryByteIsInExactlyOnePlace) {
  for (const auto& device : protocols::kDeviceTypes) {
    if (device.protocol == protocols::Protocol::described) continue;
    const std::string protocol(device.name);
    const auto all =
        lines(run("decode --protocol " + protocol + " --json " + kFixtures + protocol + ".bin").output);
    ASSERT_FALSE(all.empty());
    const auto& summary = all.back();
    EXPECT_EQ(summary["class"], "SUMMARY");
    EXPECT_EQ(summary["bytes"], std::filesystem::file_size(kFixtures + protocol + ".bin"));
    std::uint64_t framed = 0, frames = 0, end = 0;
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
      EXPECT_EQ(all[i]["class"], "FRAME");
      EXPECT_EQ(all[i]["protocol"], protocol);
      EXPECT_GE(all[i]["offset"].get<std::uint64_t>(), end);
      framed += all[i]["length"].get<std::uint64_t>();
      end = all[i]["offset"].get<std::uint64_t>() + all[i]["length"].get<std::uint64_t>();
    }
    for (const auto& count : summary["frames"]) frames += count.get<std::uint64_t>();
    EXPECT_EQ(frames, all.size() - 1);
    EXPECT_EQ(summary["framed_bytes"], framed);
    EXPECT_EQ(summary["bytes"].get<std::uint64_t>(), framed + summary["skipped_bytes"].get<std::uint64_t>() +
                                                         summary["incomplete_bytes"].get<std::uint64_t>());
  }
}

TEST_F(Decode, PositionsHaveTheKeysOfTheContract) {
  for (const auto& line : lines(navcal::test::read_file(kFixtures + "oncore.jsonl"))) {
    const std::string id = line.value("id", "");
    if (id != "Ha" && id != "Ea" && id != "Eq") continue;
    for (const char* key : {"time", "time_corrected", "lat", "lon", "height_m", "speed_m_s", "heading_deg", "dop",
                            "visible", "tracked", "fix"}) {
      EXPECT_TRUE(line.contains(key)) << id << ' ' << key;
    }
  }
}

TEST_F(Decode, ThePivotMovesDatesAndOnlyWhenTheyLieBeforeIt) {
  const std::string oncore = "decode --protocol oncore --json " + kFixtures + "oncore.bin";
  const auto third = [](const std::string& text) { return lines(text).at(2); };
  EXPECT_EQ(third(run(oncore).output)["time"], "2020-04-10T04:50:60.000353244Z");
  EXPECT_EQ(third(run(oncore).output)["time_corrected"], true);
  EXPECT_EQ(third(run(oncore + " --pivot 1999-08-22").output)["time"], "2000-08-25T04:50:60.000353244Z");
  EXPECT_EQ(third(run(oncore + " --pivot 1999-08-22").output)["time_corrected"], false);
  const std::string nmea = "decode --protocol nmea --json " + kFixtures + "nmea.bin";
  EXPECT_EQ(third(run(nmea).output)["time"], "2016-12-31T23:59:60.250Z") << "dates of NMEA are left alone";
  EXPECT_EQ(third(run(nmea + " --pivot 2019-04-07").output)["time_corrected"], true);
}

TEST_F(Decode, PeopleGetAListingAndASummary) {
  const auto outcome = run("decode --protocol oncore " + kFixtures + "oncore.bin");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.output.find(" Ha       time=2026-11-21T23:59:60.250000123Z "), std::string::npos);
  EXPECT_NE(outcome.output.find("fix=3d"), std::string::npos);
  EXPECT_NE(outcome.output.find("12 frames: Bb 1, Bo 3, Cj 1, Ea 2, Eq 1, Gj 1, Ha 2, Hn 1\n"), std::string::npos);
  EXPECT_NE(outcome.output.find("1308 bytes: 1065 in frames, 203 skipped, 40 in an incomplete frame at the end\n"),
            std::string::npos);
}

TEST_F(Decode, PeopleAreToldWhatHasNoDecoder) {
  const auto outcome = run(R"(decode --protocol nmea - <<< $'$PXYZA,1*57\r\n$PXYZA,2*54\r\n$HCHDM,182.3,M*21\r')");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.output.find("\nframes without a decoder: PXYZA 2\n"), std::string::npos) << outcome.output;
}

TEST_F(Decode, AnEmptyInputIsASummaryOfNothing) {
  EXPECT_EQ(run("decode --protocol nmea --json - < /dev/null").output,
            R"({"class":"SUMMARY","bytes":0,"frames":{},"bad_checksum":0,"framed_bytes":0,"skipped_bytes":0,)"
            R"("incomplete_bytes":0})"
            "\n");
}

TEST_F(Decode, BadInputNamesTheFile) {
  const auto missing = run("decode --protocol nmea /nowhere/gps.nmea");
  EXPECT_EQ(missing.status, 3);
  EXPECT_EQ(missing.errors, "navcal: /nowhere/gps.nmea: cannot open: No such file or directory\n");
  const auto folder = run("decode --protocol nmea /tmp");
  EXPECT_EQ(folder.status, 3);
  EXPECT_EQ(folder.errors, "navcal: /tmp: cannot read: Is a directory\n");
}

TEST_F(Decode, WrongUsageSaysWhatIsKnown) {
  const auto unknown = run("decode --protocol loran " + kFixtures + "nmea.bin");
  EXPECT_EQ(unknown.status, 2);
  for (const char* name : {"loran", "tcm2", "imu-card", "oncore", "motor-card", "nmea"})
    EXPECT_NE(unknown.errors.find(name), std::string::npos) << name;
  EXPECT_EQ(run("decode " + kFixtures + "nmea.bin").status, 2) << "no protocol";
  EXPECT_EQ(run("decode --protocol nmea").status, 2) << "no file";
  EXPECT_EQ(run("decode --protocol nmea --pivot yesterday " + kFixtures + "nmea.bin").status, 2);
  const auto help = run("decode --help");
  EXPECT_EQ(help.status, 0);
  EXPECT_NE(help.output.find("navcal decode --protocol oncore gps.bin"), std::string::npos) << "an example";
}

/// A capture in which `bytes` came over the port "gps" in reads of 100 bytes, with orders sent and another port.
std::string capture_of(const std::string& bytes) {
  std::ostringstream text;
  text << "#capture 1\n#port gps oncore 9600\n#port compass tcm2 38400\n";
  int second = 0;
  for (std::size_t at = 0; at < bytes.size(); at += 100, ++second) {
    text << 1'700'000'000 + second << ".000000000 gps < ";
    for (const char c : bytes.substr(at, 100)) {
      constexpr const char* kDigits = "0123456789abcdef";
      const auto byte = static_cast<unsigned char>(c);
      text << kDigits[byte >> 4U] << kDigits[byte & 15U];
    }
    text << '\n' << 1'700'000'000 + second << ".000000000 gps > 4040\n";
    text << 1'700'000'000 + second << ".000000000 compass < 2443\n";
  }
  return text.str();
}

TEST_F(Decode, OnePortOfARecordingIsDecodedAsItsBytesAre) {
  const auto capture = folder_ / "dive.cap";
  std::ofstream(capture) << capture_of(navcal::test::read_file(kFixtures + "oncore.bin"));
  const auto decoded = run("decode --port gps --json " + capture.string());
  EXPECT_EQ(decoded.status, 0) << decoded.errors;
  EXPECT_EQ(decoded.output, navcal::test::read_file(kFixtures + "oncore.jsonl"));
  const auto log = (folder_ / "dive.mcap").string();
  ASSERT_EQ(run("'" NAVCAL_PROGRAM "' log import -o " + log + " " + capture.string()).status, 0);
  EXPECT_EQ(run("decode --port gps --json " + log).output, decoded.output);
  const auto other = lines(run("decode --port gps --protocol nmea --json " + capture.string()).output);
  EXPECT_EQ(other.back()["frames"].size(), 0U) << "the language that was asked for";
}

TEST_F(Decode, ARecordingIsNotTakenForBytes) {
  const auto capture = folder_ / "dive.cap";
  std::ofstream(capture) << capture_of("abc");
  for (const std::string& from : std::vector<std::string>{" " + capture.string(), " - < " + capture.string()}) {
    const auto without = run("decode --protocol tcm2" + from);
    EXPECT_EQ(without.status, 3) << from;
    EXPECT_NE(without.errors.find("a capture, not the bytes of one device: --port NAME"), std::string::npos)
        << without.errors;
  }
  const auto absent = run("decode --port sonar " + capture.string());
  EXPECT_EQ(absent.status, 2);
  EXPECT_NE(absent.errors.find("no port \"sonar\"; its ports: gps, compass"), std::string::npos) << absent.errors;
  EXPECT_EQ(run("decode --port gps " + kFixtures + "oncore.bin").status, 3) << "no recording";
}

TEST_F(Decode, AFullDiskAndAReaderThatLeavesAreTold) {
  const auto full = run("decode --protocol nmea --json " + kFixtures + "nmea.bin > /dev/full");
  EXPECT_EQ(full.status, 1);
  EXPECT_EQ(full.errors, "navcal: standard output: cannot write: No space left on device\n");
  const auto gone = run("yes '$HCHDM,182.3,M*21' | decode --protocol nmea --json - | head -1");
  EXPECT_EQ(gone.status, 1);
  EXPECT_EQ(lines(gone.output).size(), 1U);
  EXPECT_EQ(gone.errors, "navcal: standard output: its reader has gone; the rest was not decoded\n");
}

}  // namespace
}  // namespace navcal::cli
