// SPDX-License-Identifier: Apache-2.0
// Every kind of mistake outside ports, by file, line and key.
#include "tests/config/expect_problems.h"

namespace navcal::config {
namespace {

TEST(ConfigErrors, NamesTheUnknownKeyAndTheOneThatWasMeant) {
  EXPECT_EQ(problems_beside_a_port("[log]\nsync_intervall_s = 1\n"),
            Problems{"t.toml:7: log.sync_intervall_s: unknown key; did you mean sync_interval_s?"});
}

TEST(ConfigErrors, AForgottenUnitIsFound) {
  EXPECT_EQ(problems_beside_a_port("[log]\nrotate_age = 1\n"),
            Problems{"t.toml:7: log.rotate_age: unknown key; did you mean rotate_age_h?"});
}

TEST(ConfigErrors, AKeyLikeNoOtherGetsNoGuess) {
  EXPECT_EQ(problems_beside_a_port("[log]\ncolour = 1\n"), Problems{"t.toml:7: log.colour: unknown key"});
}

TEST(ConfigErrors, AnUnknownTableIsNamedOnce) {
  EXPECT_EQ(problems_beside_a_port("[stats]\na = 1\nb.c = 2\n"),
            Problems{"t.toml:6: stats: unknown key; did you mean status?"});
  EXPECT_EQ(problems_of("[ports.gps]\nprotocol = \"oncore\"\n").front(),
            "t.toml:1: ports: unknown key; did you mean port?");
}

TEST(ConfigErrors, AKeyOutsideEveryTable) {
  EXPECT_EQ(problems_of(std::string("declination_deg = 1\n").append(kGoodPort)),
            Problems{"t.toml:1: declination_deg: unknown key"});
}

TEST(ConfigErrors, AValueWhereATableIsWanted) {
  EXPECT_EQ(problems_of(std::string("log = 3\n").append(kGoodPort)),
            Problems{"t.toml:1: log: a table [log] is expected"});
  EXPECT_EQ(problems_beside_a_port("[[status]]\nport = 1\n"),
            Problems{"t.toml:6: status: a table [status] is expected"});
}

TEST(ConfigErrors, ANumberWithItsUnitInQuotes) {
  EXPECT_EQ(
      problems_beside_a_port("[log]\nsync_interval_s = \"10 ms\"\n"),
      Problems{"t.toml:7: log.sync_interval_s: a number in s is expected (0.01 to 60 s), not the text \"10 ms\""});
}

TEST(ConfigErrors, WrongTypes) {
  EXPECT_EQ(problems_beside_a_port("[log]\nenabled = 1\n"),
            Problems{"t.toml:7: log.enabled: true or false is expected, not the number 1"});
  EXPECT_EQ(problems_beside_a_port("[log]\ndirectory = true\n"),
            Problems{"t.toml:7: log.directory: a text is expected (an absolute path), not true"});
  EXPECT_EQ(problems_beside_a_port("[log]\ndirectory = {}\n"),
            Problems{"t.toml:7: log.directory: a text is expected (an absolute path), not a table"});
  EXPECT_EQ(problems_beside_a_port("[status]\nport = 2947.5\n"),
            Problems{"t.toml:7: status.port: a whole number is expected (0 to 65535), not the number 2947.5"});
  EXPECT_EQ(
      problems_beside_a_port("[status]\nmax_clients = [1, 2]\n"),
      Problems{
          "t.toml:7: status.max_clients: a whole number is expected (1 to 10000), not an array of 2 numbers"});
  EXPECT_EQ(problems_beside_a_port("[log]\nrotate_age_h = 12:00:00\n"),
            Problems{"t.toml:7: log.rotate_age_h: a number in h is expected (0.001 to 8760 h), not a time"});
}

TEST(ConfigErrors, OutOfRangeSaysTheRangeAndItsUnit) {
  EXPECT_EQ(problems_beside_a_port("[log]\nsync_interval_s = 100\n"),
            Problems{"t.toml:7: log.sync_interval_s: 100 is out of range: 0.01 to 60 s"});
  EXPECT_EQ(problems_beside_a_port("[environment]\ndip_deg = -90.5\n"),
            Problems{"t.toml:7: environment.dip_deg: -90.5 is out of range: -90 to 90 deg"});
  EXPECT_EQ(problems_beside_a_port("[status]\nport = -9223372036854775808\n"),
            Problems{"t.toml:7: status.port: -9223372036854775808 is out of range: 0 to 65535"});
}

TEST(ConfigErrors, NeitherNanNorInfinityIsANumberHere) {
  EXPECT_EQ(problems_beside_a_port("[environment]\nfield_uT = nan\n"),
            Problems{"t.toml:7: environment.field_uT: nan is out of range: 0 to 100 uT"});
  EXPECT_EQ(problems_beside_a_port("[log]\nrotate_MB = inf\n"),
            Problems{"t.toml:7: log.rotate_MB: inf is out of range: 0.1 to 1000000 MB"});
}

TEST(ConfigErrors, AFileModeWrittenInDecimal) {
  EXPECT_EQ(problems_beside_a_port("[control]\nmode = 660\n"),
            Problems{"t.toml:7: control.mode: 0o1224 is out of range: 0o000 to 0o777"});
  EXPECT_EQ(problems_beside_a_port("[control]\nmode = -1\n"),
            Problems{"t.toml:7: control.mode: -1 is out of range: 0o000 to 0o777"});
}

TEST(ConfigErrors, TextsThatCannotBe) {
  EXPECT_EQ(problems_beside_a_port("[log]\ndirectory = \"log\"\n"),
            Problems{"t.toml:7: log.directory: \"log\" is not an absolute path"});
  EXPECT_EQ(problems_beside_a_port("[log]\ndirectory = \"/var/\\u0000log\"\n"),
            Problems{"t.toml:7: log.directory: \"/var/\\u0000log\" is not an absolute path"});
  EXPECT_EQ(problems_beside_a_port("[status]\naddress = \"localhost\"\n"), Problems{});
  EXPECT_EQ(problems_beside_a_port("[status]\naddress = \"vehicle.local\"\n"),
            Problems{"t.toml:7: status.address: \"vehicle.local\" is not an IPv4 or IPv6 address, or localhost"});
  const std::string long_path = "/" + std::string(107, 'x');
  EXPECT_EQ(
      problems_beside_a_port("[control]\nsocket = \"" + long_path + "\"\n"),
      Problems{"t.toml:7: control.socket: \"" + long_path + "\" is not an absolute path of at most 107 bytes"});
  EXPECT_EQ(problems_beside_a_port("[control]\nsocket = \"" + long_path.substr(1) + "\"\n").size(), 1U);
  EXPECT_EQ(problems_beside_a_port("[control]\nsocket = \"" + long_path.substr(0, 107) + "\"\n"), Problems{});
}

TEST(ConfigErrors, AllAreReportedTogetherInTheOrderOfTheFile) {
  const auto problems = problems_beside_a_port("[status]\nport = 70000\n[log]\nenabled = 2\nrotate_MB = 0\n[x]\n");
  ASSERT_EQ(problems.size(), 4U);
  EXPECT_TRUE(problems[0].starts_with("t.toml:7: status.port: "));
  EXPECT_TRUE(problems[1].starts_with("t.toml:9: log.enabled: "));
  EXPECT_TRUE(problems[2].starts_with("t.toml:10: log.rotate_MB: "));
  EXPECT_TRUE(problems[3].starts_with("t.toml:11: x: "));
}

TEST(ConfigErrors, WhatHasOneLineForEachProblem) {
  try {
    static_cast<void>(parse("[log]\nenabled = 2\n", "t.toml"));
    FAIL();
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_EQ(what, error.problems().at(0) + "\n" + error.problems().at(1));
  }
}

}  // namespace
}  // namespace navcal::config
