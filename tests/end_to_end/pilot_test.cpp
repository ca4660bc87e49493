// SPDX-License-Identifier: Apache-2.0
// The closed loop without water: navcal emulate --vehicle, navcald and navcal pilot on pseudo-terminals, in real
// time. What the vehicle did is read from the emulator's truth file.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>
#include <sstream>

#include "base/descriptor.h"
#include "tests/support/free_port.h"
#include "tests/support/process.h"

namespace navcal {
namespace {

using test::eventually;
using test::free_port;
using test::Process;

constexpr std::chrono::seconds kPilotPatience{120};
constexpr double kSpeedOfMission_rpm = 780;

struct TruthRow {
  double t_s, depth_m, heading_deg, rpm;
};

class ClosedLoop : public testing::Test {
 protected:
  void SetUp() override {
    write("mission.toml",
          "start.heading_deg = 0\n"
          "step = [{do = \"leg\", heading_deg = 60, seconds = 8}, {do = \"dive\", depth_m = 1}, "
          "{do = \"leg\", seconds = 6}]\n");
    write("long.toml", "step = [{do = \"leg\", heading_deg = 0, depth_m = 0.6, seconds = 300}]\n");
    // Kept open here, so that the emulator sees no end of its input.
    ASSERT_EQ(::mkfifo((folder_ / "console").c_str(), 0600), 0);
    console_ = base::Descriptor(::open((folder_ / "console").c_str(), O_RDWR | O_CLOEXEC));
  }
  void write(const std::string& name, std::string_view text) const { std::ofstream(folder_ / name) << text; }

  /// Emulator and daemon; `options` are the emulator's, `gauge` a port of the daemon's with NMEA sentences.
  void start(const std::string& options = "", const std::string& gauge = "",
             const std::vector<std::string>& settings = {}) {
    const std::string command = "exec " NAVCAL_PROGRAM " emulate --vehicle --dir " + (folder_ / "ports").string() +
                                " --truth " + (folder_ / "truth.csv").string() + " " + options + " < " +
                                (folder_ / "console").string();
    emulator_ = std::make_unique<Process>(std::vector<std::string>{"sh", "-c", command}, folder_ / "emulate");
    ASSERT_TRUE(eventually([&] { return emulator_->out().find("ready") != std::string::npos; }, kPilotPatience))
        << emulator_->err();
    status_port_ = free_port();
    std::ifstream shipped(NAVCAL_SOURCE_DIR "/config/navcald.toml");
    std::ofstream configuration(folder_ / "navcald.toml");
    configuration << shipped.rdbuf();
    if (!gauge.empty()) {
      configuration << "\n[port." << gauge << "]\nprotocol = \"nmea\"\npath = " << folder_ / "ports" / gauge
                    << "\nbaud = 4800\n";
    }
    configuration.close();
    std::vector<std::string> daemon{NAVCALD, "--config", (folder_ / "navcald.toml").string()};
    const auto set = [&](const std::string& key, const std::string& value) {
      daemon.insert(daemon.end(), {"--set", key + "=" + value});
    };
    for (const std::string port : {"compass", "imu", "gps", "motor"})
      set("port." + port + ".path", (folder_ / "ports" / port).string());
    set("log.directory", (folder_ / "logs").string());
    set("log.free_floor_MB", "0");
    set("control.socket", (folder_ / "control").string());
    set("status.port", std::to_string(status_port_));
    for (const std::string& setting : settings) daemon.insert(daemon.end(), {"--set", setting});
    daemon_ = std::make_unique<Process>(daemon, folder_ / "navcald");
    ASSERT_TRUE(
        eventually([&] { return daemon_->err().find("motor port.opened") != std::string::npos; }, kPilotPatience))
        << daemon_->err();
  }
  /// Limits of time that a busy machine keeps, unless a test is about one.
  [[nodiscard]] std::unique_ptr<Process> pilot(const std::string& mission, const std::string& name,
                                               const std::string& lease_timeout_s = "3",
                                               const std::string& wait_s = "60") const {
    const std::vector<std::string> command{NAVCAL_PROGRAM,
                                           "pilot",
                                           (folder_ / mission).string(),
                                           "--control=" + (folder_ / "control").string(),
                                           "--port=" + std::to_string(status_port_),
                                           "--max-age=5",
                                           "--lease-timeout=" + lease_timeout_s,
                                           "--wait=" + wait_s};
    return std::make_unique<Process>(command, folder_ / name);
  }
  /// Stops daemon and emulator as a user does; the true motion.
  std::vector<TruthRow> finish() {
    daemon_->signal(SIGTERM);
    EXPECT_EQ(daemon_->wait(kPilotPatience), 0) << daemon_->err();
    emulator_->signal(SIGINT);
    EXPECT_EQ(emulator_->wait(kPilotPatience), 0) << emulator_->err();
    std::vector<TruthRow> rows;
    std::ifstream file(folder_ / "truth.csv");
    std::string line;
    EXPECT_TRUE(std::getline(file, line)) << "the truth file is there";
    while (std::getline(file, line)) {
      std::istringstream fields(line);
      std::vector<double> values;
      for (std::string field; std::getline(fields, field, ',');) values.push_back(std::stod(field));
      EXPECT_EQ(values.size(), 17U) << line;
      if (values.size() != 17) break;
      EXPECT_NEAR(values[0], 0.01 * static_cast<double>(rows.size()), 1e-6) << "no row is missing";
      rows.push_back({values[0], values[3], values[6] * 180 / std::numbers::pi, values[13]});
    }
    EXPECT_GT(rows.size(), 100U);
    return rows;
  }
  /// The daemon's answer to one line on its control socket; empty without one.
  [[nodiscard]] std::string control(const std::string& line) const {
    const std::string program =
        "import socket,sys\ns=socket.socket(socket.AF_UNIX)\ns.connect(sys.argv[1])\n"
        "s.sendall(sys.argv[2].encode()+b'\\n')\nprint(s.makefile().readline())";
    Process client({"python3", "-c", program, (folder_ / "control").string(), line}, folder_ / "client");
    return client.wait(kPilotPatience) == 0 ? client.out() : std::string();
  }
  [[nodiscard]] bool daemon_said(std::string_view text) const {
    return daemon_->err().find(text) != std::string::npos;
  }
  static void expect_stopped(const std::vector<TruthRow>& rows) {
    const bool sailed = std::any_of(rows.begin(), rows.end(),
                                    [](const TruthRow& row) { return row.rpm > 0.9 * kSpeedOfMission_rpm; });
    EXPECT_TRUE(sailed);
    EXPECT_LT(std::abs(rows.back().rpm), 10) << "the shaft stands";
  }
  /// Ten times the lag of the shaft.
  static void let_the_shaft_run_down() { std::this_thread::sleep_for(std::chrono::seconds(5)); }

  test::TemporaryFolder folder_;
  base::Descriptor console_;
  std::uint16_t status_port_ = 0;
  std::unique_ptr<Process> emulator_, daemon_;
};

TEST_F(ClosedLoop, AMissionIsSailed) {
  start("--seed 3");
  const auto run = pilot("mission.toml", "pilot");
  ASSERT_EQ(run->wait(kPilotPatience), 0) << run->err();
  EXPECT_NE(run->err().find("3/3 leg"), std::string::npos) << run->err();
  let_the_shaft_run_down();
  const auto rows = finish();
  ASSERT_FALSE(rows.empty());
  EXPECT_NEAR(rows.front().depth_m, 0.15, 1e-6) << "at the surface";
  EXPECT_EQ(rows.front().rpm, 0) << "at rest";
  expect_stopped(rows);
  const auto last = std::find_if(rows.rbegin(), rows.rend(),
                                 [](const TruthRow& row) { return row.rpm > 0.95 * kSpeedOfMission_rpm; });
  EXPECT_NEAR(last->depth_m, 1, 0.3);
  EXPECT_NEAR(last->heading_deg, 60, 10) << "of true north";
}

TEST_F(ClosedLoop, AKilledPilotLeavesTheShaftStanding) {
  start();
  const auto run = pilot("long.toml", "pilot");
  ASSERT_TRUE(eventually([&] { return daemon_said("motor.lease: pilot"); }, kPilotPatience)) << run->err();
  const auto second = pilot("long.toml", "second");
  EXPECT_EQ(second->wait(kPilotPatience), 1);
  EXPECT_NE(second->err().find("no lease of the motor card: the lease is held by pilot"), std::string::npos)
      << second->err();
  let_the_shaft_run_down();  // up, here
  run->signal(SIGKILL);
  EXPECT_TRUE(eventually([&] { return daemon_said("motor.safe"); }, kPilotPatience));
  let_the_shaft_run_down();
  expect_stopped(finish());
}

TEST_F(ClosedLoop, APilotThatHangsLosesItsLeaseAndTheShaftStops) {
  start();
  const auto run = pilot("long.toml", "pilot", "1");
  ASSERT_TRUE(eventually([&] { return daemon_said("motor.lease: pilot"); }, kPilotPatience)) << run->err();
  let_the_shaft_run_down();  // up, here
  run->signal(SIGSTOP);
  EXPECT_TRUE(eventually([&] { return daemon_said("motor.safe"); }, kPilotPatience));
  let_the_shaft_run_down();
  run->signal(SIGCONT);
  EXPECT_EQ(run->wait(kPilotPatience), 1) << "it is no longer in charge";
  EXPECT_NE(run->err().find("the lease expired"), std::string::npos) << run->err();
  expect_stopped(finish());
}

TEST_F(ClosedLoop, ALeakStopsTheVehicle) {
  start();
  const auto run = pilot("long.toml", "pilot");
  ASSERT_TRUE(eventually([&] { return daemon_said("motor.lease: pilot"); }, kPilotPatience)) << run->err();
  let_the_shaft_run_down();  // up, here
  constexpr std::string_view kLeak = "imu-status 1\n";
  ASSERT_EQ(::write(console_.get(), kLeak.data(), kLeak.size()), static_cast<ssize_t>(kLeak.size()));
  EXPECT_EQ(run->wait(kPilotPatience), 1);
  EXPECT_NE(run->err().find("leak forward"), std::string::npos) << run->err();
  EXPECT_TRUE(daemon_said("motor.leak: leak_forward: the lease of pilot"));
  let_the_shaft_run_down();
  expect_stopped(finish());
}

/// The battery is known to be nearly low. What the shaft draws makes it so.
TEST_F(ClosedLoop, ABatteryThatRunsLowStopsTheVehicle) {
  start("--battery 2", "battery", {"battery.enabled=true"});
  const auto run = pilot("long.toml", "pilot");
  ASSERT_TRUE(eventually([&] { return daemon_said("motor.lease: pilot"); }, kPilotPatience)) << run->err();
  let_the_shaft_run_down();  // up, here
  EXPECT_FALSE(run->wait(std::chrono::seconds(0)).has_value());
  ASSERT_NE(control(R"({"command":"battery.set","charge_Ah":0.742})").find("true"), std::string::npos);
  EXPECT_EQ(run->wait(kPilotPatience), 1);
  EXPECT_NE(run->err().find("the vehicle was stopped: battery low"), std::string::npos) << run->err();
  EXPECT_TRUE(daemon_said("battery alarm.raised: battery_low: 0.74 of 3.7 Ah left")) << daemon_->err();
  let_the_shaft_run_down();
  expect_stopped(finish());
  EXPECT_TRUE(std::filesystem::exists(folder_ / "logs/battery.state"));
}

TEST_F(ClosedLoop, AFloorThatRisesStopsTheVehicle) {
  start("--floor-depth 6 --floor-slope -0.2 0", "altimeter", {"navigation.min_altitude_m=3"});
  const auto run = pilot("long.toml", "pilot");
  EXPECT_EQ(run->wait(kPilotPatience), 1);
  EXPECT_NE(run->err().find("the vehicle was stopped: floor near"), std::string::npos) << run->err();
  EXPECT_TRUE(daemon_said("altimeter alarm.raised: floor_near: ")) << daemon_->err();
  let_the_shaft_run_down();
  expect_stopped(finish());
}

TEST_F(ClosedLoop, AClosedTerminalStopsTheVehicleAsCtrlCDoes) {
  start();
  const auto run = pilot("long.toml", "pilot");
  ASSERT_TRUE(eventually([&] { return daemon_said("motor.lease: pilot"); }, kPilotPatience)) << run->err();
  let_the_shaft_run_down();  // up, here
  run->signal(SIGHUP);
  EXPECT_EQ(run->wait(kPilotPatience), 1);
  EXPECT_NE(run->err().find("the vehicle was stopped: interrupted"), std::string::npos) << run->err();
  EXPECT_TRUE(eventually([&] { return daemon_said("the lease was released"); }, kPilotPatience));
  let_the_shaft_run_down();
  expect_stopped(finish());
}

TEST_F(ClosedLoop, WithoutACompassTheMissionDoesNotBegin) {
  start("--unplug compass@0+1000");
  const auto run = pilot("mission.toml", "pilot", "3", "2");
  EXPECT_EQ(run->wait(kPilotPatience), 1);
  EXPECT_NE(run->err().find("the mission cannot begin: no compass"), std::string::npos) << run->err();
  for (const TruthRow& row : finish()) ASSERT_EQ(row.rpm, 0);
}

}  // namespace
}  // namespace navcal
