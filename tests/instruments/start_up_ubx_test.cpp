// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "config/load.h"
#include "protocols/ubx_configuration.h"
#include "protocols/ubx_navigation.h"
#include "protocols/ubx_receiver.h"
#include "tests/instruments/dialogue.h"

namespace navcal::instruments::test {
namespace {

namespace ubx = protocols::ubx;
using ubx::ReceiverPort;

protocols::Bytes bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}
std::string text_of(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

std::unique_ptr<StartUp> receiver_start_up(const std::string& path = "/dev/ttyUSB0", double rate_Hz = 1) {
  auto port = config::default_port("gps", protocols::Protocol::ubx, 38400);
  port.path = path;
  port.rate_Hz = rate_Hz;
  return make_start_up(port);
}

/// A receiver at one of its ports. Set what it cannot do.
struct FakeReceiver {
  bool takes_values = true, takes_pvt = true, is_silent = false, has_usb = true;
  ReceiverPort port = ReceiverPort::uart1;
  int deaf_to = 0;  ///< commands that it does not hear
  bool sends_pvt = false, sends_nmea = true;
  std::vector<std::string> asked;

  void operator()(Dialogue& dialogue, const std::string& command) {
    const auto bytes = bytes_of(command);
    const auto code = ubx::code_of({{}, 0, bytes}).value();
    asked.emplace_back(ubx::id_of(code).view());
    if (is_silent || deaf_to-- > 0) return;
    if (code == ubx::kMonVer) {
      dialogue.answer("MON-VER", text_of(ubx::encode_mon_ver({"EXT CORE 1.00", "00190000", {"PROTVER=27.11"}})));
      return;
    }
    bool accepted = true;
    if (const auto values = ubx::decode_cfg_valset(bytes)) {
      EXPECT_EQ(values->layers, ubx::Layer::ram) << "nothing may outlive a loss of power";
      accepted = takes_values;
      for (const auto& item : values->items) {
        if (item.key == ubx::key_of_message(ubx::kNavPvt, ReceiverPort::usb)) accepted = accepted && has_usb;
      }
      for (const auto& item : values->items) {
        if (!accepted) break;
        if (item.key == ubx::key_of_message(ubx::kNavPvt, port)) sends_pvt = item.value > 0;
        if (item.key == ubx::key_of_nmea_output(port)) sends_nmea = item.value > 0;
      }
    } else if (const auto rate = ubx::decode_cfg_msg(bytes)) {
      if (rate->code == ubx::kNavPvt) sends_pvt = accepted = takes_pvt;
      if (rate->code >> 8 == 0xF0) sends_nmea = false;
    }
    dialogue.answer(accepted ? "ACK-ACK" : "ACK-NAK", text_of(ubx::encode_acknowledgement({code, accepted})));
  }
  [[nodiscard]] int count(std::string_view id) const {
    return static_cast<int>(std::count(asked.begin(), asked.end(), id));
  }
};

struct UbxDialogue : testing::Test {
  FakeReceiver receiver;
  std::unique_ptr<Dialogue> dialogue;

  void start(const std::string& path = "/dev/ttyUSB0", double rate_Hz = 1) {
    dialogue = std::make_unique<Dialogue>(
        receiver_start_up(path, rate_Hz),
        [this](Dialogue& running, const std::string& command) { receiver(running, command); });
    dialogue->begin();
  }
  void run(double seconds) {
    dialogue->run_for(static_cast<std::int64_t>(seconds * 1e9), [this] {
      if (dialogue->now_ns() % base::kSecond_ns != 0) return;
      if (receiver.sends_pvt) dialogue->frame("NAV-PVT", text_of(ubx::encode_nav_pvt({})));
      if (receiver.sends_nmea) dialogue->frame("GNRMC", "$GNRMC");
    });
  }
};

TEST_F(UbxDialogue, AReceiverOfGenerationNineIsSetByOneMessageInItsRam) {
  start();
  run(3);
  EXPECT_EQ(receiver.asked, (std::vector<std::string>{"MON-VER", "CFG-VALSET"}));
  EXPECT_EQ(dialogue->state(), "running on NAV-PVT; EXT CORE 1.00, PROTVER=27.11");
  EXPECT_FALSE(receiver.sends_nmea);
  run(60);
  EXPECT_EQ(receiver.asked.size(), 2U);
}

TEST_F(UbxDialogue, TheBytesOfTheSettings) {
  start("/dev/ttyUSB0", 5);
  run(0.1);
  const auto values = ubx::decode_cfg_valset(bytes_of(dialogue->sent.at(1).text));
  ASSERT_TRUE(values);
  // Keys of the interface description F9: rate 200 ms, one solution an epoch, messages on UART1, UBX on, NMEA off.
  const std::vector<ubx::ConfigurationItem> expected{{0x30210001, 200}, {0x30210002, 1}, {0x20910007, 1},
                                                     {0x20910039, 1},   {0x20910048, 5}, {0x20910016, 25},
                                                     {0x10740001, 1},   {0x10740002, 0}};
  EXPECT_EQ(values->items, expected);
}

TEST_F(UbxDialogue, WithoutARateTheReceiverKeepsItsOwn) {
  start("/dev/ttyUSB0", 0);
  run(0.1);
  const auto values = ubx::decode_cfg_valset(bytes_of(dialogue->sent.at(1).text));
  ASSERT_TRUE(values);
  EXPECT_EQ(values->items.front().key, 0x20910007U);
}

TEST_F(UbxDialogue, TheOtherPortsOfTheReceiverAreTriedWhenNothingComes) {
  receiver.port = ReceiverPort::uart2;
  start();
  run(12);
  EXPECT_EQ(receiver.count("CFG-VALSET"), 3) << "UART1, USB, UART2";
  EXPECT_TRUE(dialogue->state().starts_with("running on NAV-PVT")) << dialogue->state();
}

TEST_F(UbxDialogue, APortThatTheReceiverDoesNotHaveIsPassedOver) {
  receiver.port = ReceiverPort::uart2;
  receiver.has_usb = false;
  start();
  run(12);
  EXPECT_EQ(dialogue->state(), "running on NAV-PVT; EXT CORE 1.00, PROTVER=27.11; refused: CFG-VALSET for USB");
}

TEST_F(UbxDialogue, AtAUsbSocketThatPortComesFirst) {
  receiver.port = ReceiverPort::usb;
  start("/dev/ttyACM0");
  run(3);
  EXPECT_EQ(receiver.count("CFG-VALSET"), 1);
  EXPECT_TRUE(dialogue->state().starts_with("running on NAV-PVT")) << dialogue->state();
}

TEST_F(UbxDialogue, AnOlderReceiverIsSetMessageByMessage) {
  receiver.takes_values = false;
  start();
  run(4);
  EXPECT_EQ(receiver.count("CFG-VALSET"), 1);
  EXPECT_EQ(receiver.count("CFG-MSG"), 4 + 6) << "four messages on, six sentences off";
  EXPECT_EQ(receiver.count("CFG-RATE"), 1);
  EXPECT_TRUE(dialogue->state().starts_with("running on NAV-PVT")) << dialogue->state();
  EXPECT_FALSE(receiver.sends_nmea);
}

TEST_F(UbxDialogue, AReceiverWithoutNavPvtKeepsItsSentences) {
  receiver.takes_values = receiver.takes_pvt = false;
  start();
  run(5);
  EXPECT_EQ(receiver.count("CFG-MSG"), 1);
  EXPECT_TRUE(receiver.sends_nmea);
  EXPECT_EQ(dialogue->state(),
            "running on NMEA: no NAV-PVT comes; trying again every 10 s, 1 so far; EXT CORE 1.00, PROTVER=27.11; "
            "refused: CFG-VALSET for UART1, CFG-MSG for NAV-PVT");
}

TEST_F(UbxDialogue, LostCommandsAreRepeated) {
  receiver.deaf_to = 3;  // the question for the version, and the settings twice
  start();
  run(6);
  EXPECT_EQ(receiver.count("CFG-VALSET"), 3);
  EXPECT_EQ(dialogue->state(), "running on NAV-PVT");
  EXPECT_TRUE(never_repeated_within(dialogue->sent, base::kSecond_ns));
}

TEST_F(UbxDialogue, ASilentLineIsTriedAgainAndAgain) {
  receiver.is_silent = true;
  receiver.sends_nmea = false;
  start();
  run(10);
  EXPECT_EQ(dialogue->state(),
            "no NAV-PVT comes; trying again every 10 s, 1 so far; no answer to: CFG-VALSET for UART1, CFG-MSG for "
            "NAV-PVT");
  run(90);
  EXPECT_GE(receiver.count("MON-VER"), 5);
  EXPECT_TRUE(never_repeated_within(dialogue->sent, base::kSecond_ns));
  receiver.is_silent = false;
  run(25);
  EXPECT_TRUE(dialogue->state().starts_with("running on NAV-PVT")) << dialogue->state();
}

TEST_F(UbxDialogue, AfterARestartItBeginsAnew) {
  start();
  run(5);
  receiver.sends_pvt = false;  // its RAM is empty again
  receiver.sends_nmea = true;
  receiver.asked.clear();
  run(1.5);
  EXPECT_TRUE(receiver.asked.empty());
  run(4);
  EXPECT_EQ(receiver.asked, (std::vector<std::string>{"MON-VER", "CFG-VALSET"}));
  EXPECT_TRUE(dialogue->state().starts_with("running on NAV-PVT")) << dialogue->state();
}

TEST_F(UbxDialogue, TheAnswerToAnotherMessageDoesNotCount) {
  receiver.is_silent = true;
  start();
  run(0.1);
  dialogue->frame("ACK-ACK", text_of(ubx::encode_acknowledgement({ubx::kCfgMsg, true})));
  dialogue->frame("ACK-ACK", text_of(ubx::encode_frame(ubx::kAckAck, {})));
  EXPECT_EQ(dialogue->state(), "setting: CFG-VALSET for UART1");
  dialogue->frame("ACK-ACK", text_of(ubx::encode_acknowledgement({ubx::kCfgValset, true})));
  EXPECT_EQ(dialogue->state(), "settings sent, waiting for NAV-PVT");
}

TEST(StartUpUbx, SaysNothingWhenItIsOff) {
  auto port = config::default_port("gps", protocols::Protocol::ubx, 38400);
  port.start_up = false;
  EXPECT_EQ(make_start_up(port), nullptr);
}

}  // namespace
}  // namespace navcal::instruments::test
