// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <thread>

#include "emulate_program.h"
#include "protocols/imu_card.h"
#include "record/recording.h"
#include "tests/ports/harness.h"

namespace navcal::cli::test {
namespace {

namespace fs = std::filesystem;

struct Emulate : ::testing::Test {
  ports::testing::Folder folder;
  fs::path dir = folder.path() / "ports";
  std::unique_ptr<Program> program;

  void start(std::vector<std::string> options = {}) {
    options.insert(options.begin(), {"emulate", "--dir", dir.string()});
    program = std::make_unique<Program>(options);
    ASSERT_EQ(program->line(), "ready");
  }
};

TEST_F(Emulate, TheCompassHoldsItsDialogue) {
  start();
  Client compass(dir / "compass");
  compass.write("h\r");
  EXPECT_NE(compass.read_until(":\r\n").find(":\r\n"), std::string::npos);  // perhaps after the banner
  compass.write("em=e\rnonsense\r");
  EXPECT_NE(compass.read_until(":E010\r\n").find(":\r\n:\r\n:E010\r\n"), std::string::npos);
  compass.write("s?\r");
  EXPECT_NE(compass.read_until("*").find("$C"), std::string::npos);
  compass.write("ax\r");
  EXPECT_NE(compass.read_until("TCM2").find("TCM2"), std::string::npos);
}

TEST_F(Emulate, AClientAtTheWrongSpeedHearsGarbageAndIsNotUnderstood) {
  start();
  Client motor(dir / "motor");
  motor.set_speed(9600);
  Client compass(dir / "compass");
  compass.set_speed(9600);
  compass.write("s?\r");
  EXPECT_EQ(compass.read_until("$C", std::chrono::milliseconds(500)).find("$C"), std::string::npos);
  compass.set_speed(38400);
  motor.set_speed(19200);
  compass.write("\rs?\r");
  EXPECT_NE(compass.read_until("$C").find("$C"), std::string::npos);
  EXPECT_NE(motor.read_until("$MCS,").find("$MCS,"), std::string::npos);
}

TEST_F(Emulate, DevicesOfAnyProtocolBesideTheVehiclesAndInTheirPlace) {
  const fs::path log = folder.path() / "sent.cap";
  start({"--device", "gps=motor-card", "--device", "second=nmea", "--sent-log", log.string()});
  EXPECT_NE(Client(dir / "gps").read_until("$MCS,").find("$MCS,"), std::string::npos);
  EXPECT_NE(Client(dir / "second").read_until("$GP").find("$GP"), std::string::npos);
  program->interrupt();
  EXPECT_EQ(program->wait(), 0);
  const auto recording = record::Recording::open(log);
  std::map<std::string, protocols::Protocol> protocols;
  for (const auto& port : recording->settings().ports) protocols[port.name] = port.protocol;
  EXPECT_EQ(protocols.size(), 5U);
  EXPECT_EQ(protocols.at("gps"), protocols::Protocol::motor_card);
  EXPECT_EQ(protocols.at("second"), protocols::Protocol::nmea);
  EXPECT_EQ(protocols.at("compass"), protocols::Protocol::tcm2);
}

TEST_F(Emulate, ADeviceThatIsNoneIsRefused) {
  for (const char* device : {"gps=loran", "gps", "=nmea", "../gps=nmea"}) {
    Program refused({"emulate", "--dir", dir.string(), "--device", device});
    EXPECT_EQ(refused.wait(), 2) << device;
  }
}

TEST_F(Emulate, LinksAreRemovedAtTheEndHoweverItComes) {
  start({"--seconds", "0.5"});
  EXPECT_EQ(program->wait(), 0);
  EXPECT_TRUE(fs::is_empty(dir));
  start();
  for (const char* port : {"compass", "imu", "gps", "motor"}) EXPECT_TRUE(fs::is_symlink(dir / port)) << port;
  program->interrupt();
  EXPECT_EQ(program->wait(), 0);
  EXPECT_TRUE(fs::is_empty(dir));
}

TEST_F(Emulate, TheSentLogIsWhatAClientRead) {
  const fs::path log = folder.path() / "sent.cap";
  start({"--seconds", "3", "--noise", "0.3", "--drop", "0.1", "--sent-log", log.string()});
  std::map<std::string, std::string> read;
  {
    std::map<std::string, Client> clients;
    for (const char* port : {"compass", "imu", "gps", "motor"}) clients.emplace(port, dir / port);
    clients.at("compass").write("go\r");
    std::vector<std::thread> readers;
    for (auto& [port, client] : clients) {
      readers.emplace_back([&read = read[port], &reader = client] { read = reader.read_all(); });
    }
    for (std::thread& reader : readers) reader.join();
  }
  EXPECT_EQ(program->wait(), 0);
  std::map<std::string, std::string> logged, said;
  const auto recording = record::Recording::open(log);
  while (const auto entry = recording->next()) {
    const auto* bytes = std::get_if<record::RawRead>(&*entry);
    if (bytes == nullptr) continue;
    auto& text =
        (bytes->direction == record::Direction::sent ? said
                                                     : logged)[recording->settings().ports[bytes->port].name];
    text.append(bytes->bytes.begin(), bytes->bytes.end());
  }
  EXPECT_EQ(said["compass"], "go\r");
  for (const char* port : {"compass", "imu", "motor"}) {
    ASSERT_FALSE(read[port].empty()) << port;
    // The hang-up at the very end may take with it what was written last.
    ASSERT_LE(read[port].size(), logged[port].size()) << port;
    EXPECT_EQ(read[port], logged[port].substr(0, read[port].size())) << port;
    EXPECT_LT(logged[port].size() - read[port].size(), 200U) << port;
  }
}

TEST_F(Emulate, PullingThePlugHangsUpAndPuttingItBackBringsThePort) {
  start();
  Client imu(dir / "imu");
  program->type("unplug imu\n");
  imu.read_all();
  EXPECT_TRUE(imu.hung_up());
  EXPECT_FALSE(fs::exists(dir / "imu"));
  program->type("replug imu\n");
  for (int i = 0; i < 1000 && !fs::exists(dir / "imu"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  Client again(dir / "imu");
  EXPECT_FALSE(again.read_until("\xA5\x5A").empty());
}

TEST_F(Emulate, PlansToUnplug) {
  start({"--unplug", "motor@0.3+0.3"});
  Client motor(dir / "motor");
  motor.read_all();
  EXPECT_TRUE(motor.hung_up());
  for (int i = 0; i < 1000 && !fs::exists(dir / "motor"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(Client(dir / "motor").read_until("$MCS").empty());
}

TEST_F(Emulate, ALeakIsReported) {
  start();
  Client imu(dir / "imu");
  program->type("imu-status 2\n");
  const auto leak_seen = [&] {
    bool seen = false;
    protocols::imu_card::Parser parser;
    parser.feed(ports::testing::bytes_of(imu.read_until("never")), [&](const protocols::Frame& frame) {
      seen = seen || protocols::imu_card::decode_record(frame.bytes)->status == protocols::imu_card::leak_aft;
    });
    return seen;
  };
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    program->type("quit\n");
  });
  EXPECT_TRUE(leak_seen());
  stopper.join();
  EXPECT_EQ(program->wait(), 0);
}

TEST_F(Emulate, WhatItIsToldWrongly) {
  start();
  program->type("unplug sonar\nnoise 2\nfly\nquit\n");
  EXPECT_EQ(program->wait(), 0);
  const std::string errors = program->errors();
  EXPECT_NE(errors.find("there is no port sonar"), std::string::npos) << errors;
  EXPECT_NE(errors.find("a probability from 0 to 1"), std::string::npos) << errors;
  EXPECT_NE(errors.find("'fly' is none of"), std::string::npos) << errors;
}

TEST_F(Emulate, ASecondOneIsRefusedWhileTheFirstRuns) {
  start();
  const fs::path of_first = fs::read_symlink(dir / "compass");
  Program second({"emulate", "--dir", dir.string()});
  EXPECT_EQ(second.wait(), 1);
  EXPECT_NE(second.errors().find("another navcal that runs has this port"), std::string::npos);
  EXPECT_EQ(fs::read_symlink(dir / "compass"), of_first);
  program.reset();                                                   // by SIGKILL
  EXPECT_TRUE(fs::is_symlink(fs::symlink_status(dir / "compass")));  // left behind
  start();
  EXPECT_NE(Client(dir / "compass").read_until("\r").find('\r'), std::string::npos);
}

TEST_F(Emulate, WrongUsageAndBadPathsHaveTheirStatuses) {
  EXPECT_EQ(Program({"emulate"}).wait(), 2);
  EXPECT_EQ(Program({"emulate", "--dir", dir.string(), "--stall", "5"}).wait(), 2);
  EXPECT_EQ(Program({"emulate", "--dir", dir.string(), "--unplug", "sonar@1+1"}).wait(), 2);
  EXPECT_EQ(Program({"emulate", "--dir", dir.string(), "--path", "/nowhere.csv"}).wait(), 3);
  EXPECT_EQ(Program({"emulate", "--dir", "/proc/no"}).wait(), 1);
}

}  // namespace
}  // namespace navcal::cli::test
