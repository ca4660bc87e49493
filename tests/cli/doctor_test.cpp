// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/live/doctor_checks.h"
#include "ports/pseudo_terminal.h"
#include "tests/cli/command_outcome.h"
#include "tests/support/temporary_folder.h"

namespace navcal::cli {
namespace {

using Json = nlohmann::json;

class Doctor : public testing::Test {
 protected:
  test::Outcome run(const std::string& configuration, const std::vector<std::string>& options = {}) {
    const auto file = (folder_ / "navcald.toml").string();
    std::ofstream(file) << configuration;
    std::vector<std::string> arguments{"doctor", "--config", file};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return test::run_command(add_doctor, arguments);
  }
  /// Configuration of a daemon on a pseudo-terminal, with its log here and a status port that is not in use.
  [[nodiscard]] std::string healthy() const {
    return "[log]\ndirectory = \"" + folder_.path().string() +
           "\"\nrotate_MB = 16\nfree_floor_MB = 0\n[status]\nport = 1\n[port.compass]\nprotocol = \"tcm2\"\npath "
           "= \"" +
           terminal_.slave_name + "\"\n";
  }

  navcal::test::TemporaryFolder folder_;
  ports::PseudoTerminal terminal_ = ports::make_pseudo_terminal(9600);
};

TEST_F(Doctor, WhereAllIsWellItSaysSo) {
  const auto outcome = run(healthy());
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("ok       port compass"), std::string::npos) << outcome.output;
}

TEST_F(Doctor, OnlyRootMayFix) {
  const auto outcome = run(healthy(), {"--fix"});
  EXPECT_EQ(outcome.status, ::geteuid() == 0 ? 0 : 1) << outcome.output;
  if (::geteuid() == 0) {
    EXPECT_NE(outcome.output.find("fix"), std::string::npos) << outcome.output;
  } else {
    EXPECT_NE(outcome.message.find("sudo navcal doctor --fix"), std::string::npos) << outcome.message;
  }
}

TEST_F(Doctor, AFaultHasItsMendAndTheStatus) {
  ports::point_link(folder_ / "gone", "/dev/navcal-is-not-there");
  const auto outcome =
      run("[port.imu]\nprotocol = \"imu-card\"\npath = \"" + (folder_ / "gone").string() + "\"\n" + healthy());
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.message, "1 fault found") << outcome.output;
  EXPECT_NE(outcome.output.find("fault    port imu"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("-> connect it"), std::string::npos) << outcome.output;
}

TEST_F(Doctor, AConfigurationThatCannotBeReadIsAFaultWithFileAndLine) {
  const std::string kTypo = "[log]\nsync_intervall_s = 2\n[port.imu]\nprotocol = \"imu-card\"\npath = \"x\"\n";
  const auto outcome = run(kTypo, {"--json"});
  EXPECT_EQ(outcome.status, 1);
  const Json answer = Json::parse(outcome.output);
  EXPECT_EQ(answer["class"], "DOCTOR");
  const auto& first = answer["findings"][0];
  EXPECT_EQ(first["severity"], "fault");
  EXPECT_NE(first["found"].get<std::string>().find("navcald.toml:2"), std::string::npos) << first;
  EXPECT_EQ(first["mend"], "sudoedit " + (folder_ / "navcald.toml").string());
  EXPECT_GE(answer["faults"], 1);
  EXPECT_EQ(run(kTypo).status, 1);
}

TEST_F(Doctor, OneThatIsNotThereAndWrongUsage) {
  const auto absent = test::run_command(add_doctor, {"doctor", "--config", (folder_ / "absent.toml").string()});
  EXPECT_EQ(absent.status, 1);
  EXPECT_NE(absent.output.find("absent.toml"), std::string::npos) << absent.output;
  EXPECT_EQ(test::run_command(add_doctor, {"doctor", "--cure"}).status, 2);
}

TEST_F(Doctor, JsonHasAllThatWasLookedAt) {
  const Json answer = Json::parse(run(healthy(), {"--json"}).output);
  std::vector<std::string> topics;
  for (const auto& finding : answer["findings"]) {
    topics.push_back(finding["topic"]);
    EXPECT_EQ(finding["mend"].is_null(), finding["severity"] == "ok") << finding;
  }
  EXPECT_EQ(topics, (std::vector<std::string>{"configuration", "port compass", "status socket", "log", "clock",
                                              "limits"}));
  EXPECT_EQ(answer["faults"], 0) << answer;
  EXPECT_FALSE(answer["account"].get<std::string>().empty());
}

TEST(DoctorReport, CountsInWords) {
  EXPECT_EQ(doctor_text({}), "No faults and no warnings.\n");
  EXPECT_EQ(doctor_text({good("a", "x")}), "ok       a  x\nNo faults and no warnings.\n");
  EXPECT_EQ(
      doctor_text({fault("log", "x", "y"), warning("clock", "z", "w")}),
      "fault    log    x\n                -> y\nwarning  clock  z\n                -> w\n1 fault, 1 warning.\n");
}

}  // namespace
}  // namespace navcal::cli
