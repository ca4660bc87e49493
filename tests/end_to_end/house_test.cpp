// SPDX-License-Identifier: Apache-2.0
// The vehicle's house on emulated instruments, live: what a leak does to the one in charge, and the log that is
// listed, downloaded, stopped and started by the programs that a user has.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/descriptor.h"
#include "record/recording.h"
#include "tests/daemon/tcp_client.h"
#include "tests/support/free_port.h"
#include "tests/support/process.h"

namespace navcal {
namespace {

namespace fs = std::filesystem;
using test::eventually;
using test::Process;
using Json = nlohmann::json;

constexpr std::chrono::seconds kHousePatience{90};

/// Emulated instruments and their navcald.
class House : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream config(folder_ / "navcald.toml");
    for (const auto& [port, protocol] : {std::pair{"imu", "imu-card"}, std::pair{"motor", "motor-card"}}) {
      config << "[port." << port << "]\nprotocol = \"" << protocol << "\"\npath = \""
             << (folder_ / "ports" / port).string() << "\"\n";
    }
    config.close();
    // Kept open here, so that the emulator sees no end of its input.
    ASSERT_EQ(::mkfifo((folder_ / "console").c_str(), 0600), 0);
    console_ = base::Descriptor(::open((folder_ / "console").c_str(), O_RDWR | O_CLOEXEC));
    const std::string emulate = "exec " NAVCAL_PROGRAM " emulate --dir " + (folder_ / "ports").string() + " < " +
                                (folder_ / "console").string();
    emulator_ = std::make_unique<Process>(std::vector<std::string>{"sh", "-c", emulate}, folder_ / "emulate");
    ASSERT_TRUE(eventually([&] { return emulator_->out().find("ready") != std::string::npos; }, kHousePatience))
        << emulator_->err();
  }
  void start(const std::vector<std::string>& settings = {}) {
    std::vector<std::string> command{NAVCALD, "--config", (folder_ / "navcald.toml").string()};
    for (const std::string& setting :
         {"log.directory=" + (folder_ / "logs").string(), "status.port=" + std::to_string(test::free_port()),
          "control.socket=" + (folder_ / "control").string(), std::string("log.free_floor_MB=0"),
          std::string("command.max_timeout_s=100")})
      command.insert(command.end(), {"--set", setting});
    for (const std::string& setting : settings) command.insert(command.end(), {"--set", setting});
    daemon_ = std::make_unique<Process>(command, folder_ / "navcald");
    ASSERT_TRUE(eventually([&] { return said("motor port.opened") && said("imu port.opened"); }, kHousePatience))
        << daemon_->err();
  }
  [[nodiscard]] bool said(std::string_view text) const { return daemon_->err().find(text) != std::string::npos; }
  void type(std::string_view line) const {
    ASSERT_EQ(::write(console_.get(), line.data(), line.size()), static_cast<ssize_t>(line.size()));
  }
  /// `navcal log ...`; its exit status.
  int log_command(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "log");
    return tool_command(std::move(arguments));
  }
  int tool_command(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), NAVCAL_PROGRAM);
    arguments.insert(arguments.end(), {"--control", (folder_ / "control").string()});
    Process program(arguments, folder_ / "tool-command");
    const int status = program.wait(kHousePatience).value_or(-1);
    out_ = program.out();
    err_ = program.err();
    return status;
  }
  [[nodiscard]] static std::string contents(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }

  test::TemporaryFolder folder_;
  base::Descriptor console_;
  std::unique_ptr<Process> emulator_, daemon_;
  std::string out_, err_;
};

/// One controller of the motor card.
class InCharge {
 public:
  explicit InCharge(const fs::path& control) : client_(control) {}
  Json ask(const Json& request) {
    client_.send(request.dump() + "\n");
    return Json::parse(client_.line().value());
  }
  Json lease(int priority) {
    Json answer = ask({{"command", "motor.lease"}, {"holder", "test"}, {"priority", priority}, {"timeout_s", 90}});
    if (answer["ok"] == true) token_ = answer["lease"];
    return answer;
  }
  Json order(double rpm) {
    return ask({{"command", "motor.order"}, {"lease", token_}, {"shaft_rpm", rpm}, {"fins_deg", {0, 0, 0}}});
  }
  Json release() { return ask({{"command", "motor.release"}, {"lease", token_}}); }
  Json motor() { return ask({{"command", "status"}})["health"][0]["motor"]; }

 private:
  daemon::Client client_;
  std::string token_;
};

TEST_F(House, ALeakEndsTheLeaseOfAProgramAndAnOperatorMayTakeOver) {
  start();
  InCharge program(folder_ / "control"), person(folder_ / "control");
  ASSERT_EQ(program.lease(1)["ok"], true);
  ASSERT_EQ(program.order(300)["ok"], true);
  type("imu-status 1\n");
  ASSERT_TRUE(eventually(
      [&] { return said("motor motor.leak: leak_forward: the lease of test (priority 1) ends"); }, kHousePatience))
      << daemon_->err();
  EXPECT_EQ(program.order(300)["error"], "the vehicle has a leak: leak_forward");
  EXPECT_EQ(person.motor()["safe"], true);
  EXPECT_EQ(person.motor()["shaft_rpm"], 0);
  EXPECT_EQ(program.lease(1)["ok"], false);
  ASSERT_EQ(person.lease(2)["ok"], true);
  EXPECT_EQ(person.order(200)["ok"], true);
  type("imu-status 3\n");
  ASSERT_TRUE(
      eventually([&] { return said("motor.leak: leak_aft: test (priority 2) stays in charge"); }, kHousePatience))
      << daemon_->err();
  EXPECT_EQ(person.order(210)["ok"], true);
  ASSERT_EQ(person.ask({{"command", "status"}})["ok"], true);
  type("imu-status 0\n");
  ASSERT_TRUE(eventually([&] { return said("alarm.cleared: leak_aft"); }, kHousePatience)) << daemon_->err();
}

TEST_F(House, ALeakThatIsAnAlarmOnlyLeavesTheProgramInCharge) {
  start({"command.on_leak=alarm"});
  InCharge program(folder_ / "control");
  ASSERT_EQ(program.lease(1)["ok"], true);
  type("imu-status 2\n");
  ASSERT_TRUE(eventually([&] { return said("alarm.raised: leak_aft"); }, kHousePatience)) << daemon_->err();
  EXPECT_EQ(program.order(300)["ok"], true);
  EXPECT_FALSE(said("motor.leak"));
}

TEST_F(House, TheMotorCardKeepsItsPowerWhileSomebodyIsInCharge) {
  // There is no such controller: what is tested is that the line is not even asked for.
  std::ofstream(folder_ / "navcald.toml", std::ios::app)
      << "[power.drive]\ngpio_chip = \"gpiochip9999\"\nline = 0\ndevices = [\"motor\"]\n";
  start();
  EXPECT_TRUE(said("power.failed: drive: gpiochip9999 line 0")) << daemon_->err();
  InCharge program(folder_ / "control");
  const Json off{{"command", "power.off"}, {"name", "drive"}};
  ASSERT_EQ(program.lease(1)["ok"], true);
  const std::string held =
      "test (priority 1) holds the motor card: release the lease first, which orders the safe state";
  EXPECT_EQ(program.ask(off)["error"], held);
  ASSERT_EQ(program.order(300)["ok"], true);
  EXPECT_EQ(program.ask(off)["error"], held);
  EXPECT_EQ(program.release()["ok"], true);
  EXPECT_NE(program.ask(off)["error"].get<std::string>().find("gpiochip9999"), std::string::npos);
  const Json supply = program.ask({{"command", "power.list"}})["supplies"][0];
  EXPECT_EQ(supply["name"], "drive");
  EXPECT_EQ(supply["on"], nullptr);
  EXPECT_EQ(supply["devices"], Json({"motor"}));
}

TEST_F(House, LogsAreListedFetchedStoppedAndStarted) {
  start();
  ASSERT_EQ(log_command({"stop"}), 0) << err_;
  ASSERT_TRUE(eventually(
      [&] {
        EXPECT_EQ(log_command({"list", "--json"}), 0) << err_;
        const Json logs = Json::parse(out_);
        return logs.size() == 1 && logs[0]["finished"] == true;
      },
      kHousePatience));
  const std::string name = Json::parse(out_)[0]["name"];
  ASSERT_EQ(log_command({"select", "--leave-out", "raw.imu"}), 0) << err_;
  EXPECT_EQ(out_, "raw.imu\n");
  ASSERT_EQ(log_command({"start"}), 0) << err_;
  const fs::path original = folder_ / "logs" / name, dives = folder_ / "dives", copy = dives / name;
  const fs::path part = copy.string() + ".part";
  fs::create_directory(dives);
  const std::string whole = contents(original);
  // Continued where an earlier attempt ended; what is wrong of it is fetched again.
  std::ofstream(part, std::ios::binary) << whole.substr(0, whole.size() / 2);
  ASSERT_EQ(log_command({"fetch", "--to", dives.string()}), 0) << err_;
  EXPECT_EQ(out_, copy.string() + "\n");
  EXPECT_EQ(contents(copy), whole);
  EXPECT_FALSE(fs::exists(part));
  ASSERT_EQ(log_command({"fetch", name, "--to", dives.string()}), 0);
  EXPECT_NE(err_.find("is there already"), std::string::npos) << err_;
  fs::remove(copy);
  std::ofstream(part, std::ios::binary) << std::string(whole.size() + 100, 'x');
  ASSERT_EQ(log_command({"fetch", name, "--to", dives.string()}), 0) << err_;
  EXPECT_EQ(contents(copy), whole);
  // A file that exists is never overwritten.
  fs::remove(copy);
  std::ofstream(copy) << "mine";
  EXPECT_EQ(log_command({"fetch", name, "--to", dives.string()}), 1);
  EXPECT_EQ(contents(copy), "mine");
  EXPECT_EQ(log_command({"fetch", "../navcald.toml", "--to", dives.string()}), 3);
  EXPECT_EQ(log_command({"fetch", "--to", (folder_ / "nowhere").string()}), 2);
  daemon_->signal(SIGTERM);
  EXPECT_EQ(daemon_->wait(kHousePatience), 0);
  EXPECT_EQ(log_command({"list"}), 1) << "there is no navcald";
  // A reader of others, where it is installed (npm ci in tests/mcap).
  if (fs::exists(NAVCAL_SOURCE_DIR "/tests/mcap/node_modules/@mcap/core")) {
    Process reader({"node", NAVCAL_SOURCE_DIR "/tests/mcap/read.mjs", original.string()}, folder_ / "reader");
    EXPECT_EQ(reader.wait(kHousePatience), 0) << reader.err();
    EXPECT_EQ(Json::parse(reader.out())["finished"], true) << reader.out();
  }
  // Both logs are whole, and the second says what it lacks.
  int left_out = 0;
  for (const auto& log : fs::directory_iterator(folder_ / "logs")) {
    if (log.path().extension() != ".mcap") continue;
    const auto recording = record::Recording::open(log.path());
    while (recording->next()) {
    }
    for (const std::string& remark : recording->remarks()) {
      EXPECT_NE(remark.find("left out of this log"), std::string::npos) << remark;
      ++left_out;
    }
  }
  EXPECT_EQ(left_out, 1);
}

TEST_F(House, CompassAndReceiverObeyTheOperatorAndGoOnDelivering) {
  std::ofstream(folder_ / "navcald.toml", std::ios::app)
      << "[port.compass]\nprotocol = \"tcm2\"\nbaud = 38400\npath = \"" << (folder_ / "ports" / "compass").string()
      << "\"\n[port.gps]\nprotocol = \"oncore\"\npath = \"" << (folder_ / "ports" / "gps").string() << "\"\n";
  start();
  const auto comes = [&](std::string_view text) { return eventually([&] { return said(text); }, kHousePatience); };
  ASSERT_TRUE(comes("compass port.start_up: running")) << daemon_->err();
  ASSERT_TRUE(comes("gps port.start_up: running on Ha")) << daemon_->err();
  ASSERT_EQ(tool_command({"ports", "command"}), 0) << err_;
  for (const char* listed : {"restart_stream", "calibration_score", "receiver_id", "(--force)"})
    EXPECT_NE(out_.find(listed), std::string::npos) << out_;
  EXPECT_EQ(tool_command({"ports", "command", "compass", "calibration_score"}), 0) << err_;
  EXPECT_EQ(out_.substr(0, 1), "H");
  EXPECT_EQ(tool_command({"ports", "command", "compass", "restart_stream"}), 0) << err_;
  EXPECT_EQ(out_, "words come\n");
  EXPECT_EQ(tool_command({"ports", "command", "compass", "restart", "--force"}), 0) << err_;
  EXPECT_EQ(out_, "TCM2 emulated, navcal\n");
  EXPECT_EQ(tool_command({"ports", "command", "gps", "receiver_id"}), 0) << err_;
  EXPECT_GT(out_.size(), 10U);
  EXPECT_EQ(tool_command({"ports", "command", "gps", "cold_start"}), 1);
  EXPECT_NE(err_.find("it needs force"), std::string::npos) << err_;
  EXPECT_EQ(tool_command({"ports", "command", "gps", "cold_start", "--force"}), 0) << err_;
  EXPECT_EQ(tool_command({"ports", "command", "motor", "go"}), 1);
  // Both were silent, and are set up again.
  const auto running = [&] {
    InCharge person(folder_ / "control");
    const Json health = person.ask({{"command", "status"}});
    const auto text = health.dump();
    return text.find("\"start_up\":\"running\"") != std::string::npos &&
           text.find("\"start_up\":\"running on Ha\"") != std::string::npos;
  };
  EXPECT_TRUE(eventually(running, kHousePatience)) << daemon_->err();
}

}  // namespace
}  // namespace navcal
