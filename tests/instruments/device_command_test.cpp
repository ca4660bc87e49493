// SPDX-License-Identifier: Apache-2.0
#include "instruments/device_command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "base/durations.h"
#include "protocols/device_types.h"
#include "protocols/oncore_command.h"
#include "protocols/oncore_encode.h"

namespace navcal::instruments {
namespace {

using protocols::Protocol;

config::PortSettings port_of(Protocol protocol) {
  config::PortSettings port;
  port.protocol = protocol;
  port.rate_Hz = 10;
  return port;
}

/// One command on a simulated clock, against a device made of one line.
struct Talk {
  using Device = std::function<void(Talk&, const std::string& sent)>;

  Talk(
      Protocol protocol, std::string_view name, Device device = [](Talk&, const std::string&) {})
      : command(make_device_command(port_of(protocol), name, now_ns)) {
    while (!command->outcome() && now_ns < 60 * base::kSecond_ns) {
      if (!coming_id.empty() && now_ns >= comes_ns) frame(std::exchange(coming_id, {}), coming);
      while (const auto bytes = command->next(now_ns)) {
        sent.emplace_back(bytes->begin(), bytes->end());
        at_ns.push_back(now_ns);
        device(*this, sent.back());
      }
      if (now_ns < command->deadline_ns() || !coming_id.empty()) now_ns += base::kMillisecond_ns;
    }
  }
  void frame(std::string_view id, std::string_view bytes) const {
    command->on_frame(
        {protocols::FrameId(id), 0, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}}, now_ns);
  }
  void answer(std::string_view id, std::string_view bytes) {
    coming_id = id;
    coming = bytes;
    comes_ns = now_ns + 30 * base::kMillisecond_ns;
  }

  std::int64_t now_ns = 0;
  std::unique_ptr<DeviceCommand> command;
  std::vector<std::string> sent;
  std::vector<std::int64_t> at_ns;
  std::string coming_id, coming;
  std::int64_t comes_ns = 0;
};

using Strings = std::vector<std::string>;

TEST(DeviceCommand, EachThatIsListedCanBeMadeAndNoOther) {
  for (const auto& device : protocols::kDeviceTypes) {
    const Protocol protocol = device.protocol;
    for (const auto& command : device_commands(protocol)) {
      EXPECT_TRUE(make_device_command(port_of(protocol), command.name, 0)) << command.name;
      EXPECT_FALSE(command.meaning.empty());
    }
    EXPECT_FALSE(make_device_command(port_of(protocol), "format", 0));
    EXPECT_FALSE(make_device_command(port_of(protocol), "", 0));
  }
  EXPECT_TRUE(device_commands(Protocol::motor_card).empty()) << "orders have leases of their own";
  EXPECT_FALSE(make_device_command(port_of(Protocol::oncore), "restart_stream", 0));
}

TEST(DeviceCommand, WhatStopsDataOrForgetsNeedsForce) {
  Strings forced;
  for (const auto protocol : {Protocol::tcm2, Protocol::oncore}) {
    for (const auto& command : device_commands(protocol)) {
      if (command.needs_force) forced.emplace_back(command.name);
    }
  }
  EXPECT_EQ(forced, (Strings{"restart", "cold_start"}));
}

TEST(DeviceCommand, TheStreamOfACompassIsHaltedTwiceAndBegunAgain) {
  Talk talk(Protocol::tcm2, "restart_stream", [](Talk& with, const std::string& sent) {
    if (sent == "go\r") {
      with.answer("WORD", "$C1.0*00");
    } else {
      with.frame("WORD", "$C1.0*00");  // one that was under way
    }
  });
  EXPECT_EQ(talk.sent, (Strings{"h\r", "h\r", "go\r"}));
  EXPECT_EQ(talk.at_ns[1] - talk.at_ns[0], 100 * base::kMillisecond_ns);
  EXPECT_EQ(talk.at_ns[2] - talk.at_ns[1], 200 * base::kMillisecond_ns);
  EXPECT_TRUE(talk.command->outcome()->done);
}

TEST(DeviceCommand, ACompassThatStaysSilentIsAskedThreeTimes) {
  Talk talk(Protocol::tcm2, "restart_stream");
  EXPECT_EQ(talk.sent, (Strings{"h\r", "h\r", "go\r", "go\r", "go\r"}));
  EXPECT_FALSE(talk.command->outcome()->done);
  EXPECT_EQ(talk.command->outcome()->text, "no answer");
  EXPECT_FALSE(talk.command->next(talk.now_ns + base::kSecond_ns)) << "it is over";
}

TEST(DeviceCommand, ScoreAndRefusalAmidWords) {
  const auto answered = [](const char* reply) {
    return Talk(Protocol::tcm2, "calibration_score", [reply](Talk& with, const std::string& sent) {
      EXPECT_EQ(sent, "lc?\r");
      with.frame("WORD", "$C1.0*00");
      with.frame("REPLY", ":\r\n");  // to an earlier command
      with.answer("REPLY", reply);
    });
  };
  const Talk good = answered("H9V3M1.20\r\n"), with_colon = answered(":H9V3M1.20\r\n"),
             bad = answered(":E010\r\n");
  EXPECT_EQ(good.command->outcome()->text, "H9V3M1.20");
  EXPECT_EQ(with_colon.command->outcome()->text, "H9V3M1.20");
  EXPECT_FALSE(bad.command->outcome()->done);
  EXPECT_EQ(bad.command->outcome()->text, "refused (E010)");
}

TEST(DeviceCommand, ARestartIsOrderedOnceAndAnsweredByTheBanner) {
  Talk talk(Protocol::tcm2, "restart",
            [](Talk& with, const std::string&) { with.answer("BANNER", "TCM2 version 2.6\r\n"); });
  EXPECT_EQ(talk.sent, Strings{"ax\r"});
  EXPECT_EQ(talk.command->outcome()->text, "TCM2 version 2.6");
  Talk deaf(Protocol::tcm2, "restart");
  EXPECT_EQ(deaf.sent, Strings{"ax\r"});
  EXPECT_FALSE(deaf.command->outcome()->done);
}

TEST(DeviceCommand, TheIdentificationOfAReceiverWithoutItsBlanks) {
  const auto frame = protocols::oncore::encode_cj("COPYRIGHT 1991-1997      \r\nMODEL # B4121P1155       \r\n");
  const std::string bytes(frame.begin(), frame.end());
  Talk talk(Protocol::oncore, "receiver_id", [&](Talk& with, const std::string&) {
    with.frame("Ha", "");
    with.answer("Cj", bytes);
  });
  EXPECT_EQ(talk.sent, Strings{std::string("@@Cj\x29\r\n")});
  EXPECT_EQ(talk.command->outcome()->text, "COPYRIGHT 1991-1997; MODEL # B4121P1155");
}

TEST(DeviceCommand, AColdStartIsNeverRepeated) {
  const std::string cold("@@Cf\x25\r\n");
  Talk talk(Protocol::oncore, "cold_start", [&](Talk& with, const std::string& sent) { with.answer("Cf", sent); });
  EXPECT_EQ(talk.sent, Strings{cold});
  EXPECT_TRUE(talk.command->outcome()->done);
  EXPECT_EQ(Talk(Protocol::oncore, "cold_start").sent, Strings{cold});
}

}  // namespace
}  // namespace navcal::instruments
