// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/instruments/dialogue.h"

namespace navcal::instruments::test {
namespace {

std::unique_ptr<StartUp> receiver_start_up() {
  config::PortSettings port;
  port.protocol = protocols::Protocol::oncore;
  return make_start_up(port);
}

/// The letters of the commands that were sent.
std::string asked(const Dialogue& dialogue) {
  std::string text;
  for (const Sent& command : dialogue.sent) text += command.text.substr(2, 2) + ' ';
  return text;
}

/// Sends `id` every second while it is not empty.
std::function<void()> every_second(Dialogue& dialogue, const std::string& id) {
  return [&dialogue, &id] {
    if (!id.empty() && dialogue.now_ns() % base::kSecond_ns == 0) dialogue.frame(id);
  };
}

TEST(StartUpOncore, AsksForPositionSatellitesAndOffsetEverySecond) {
  Dialogue dialogue(receiver_start_up());
  dialogue.begin();
  dialogue.run_for(base::kMillisecond_ns);
  EXPECT_EQ(asked(dialogue), "Ha Bb Bo ");
  EXPECT_EQ(dialogue.sent[0].text, std::string("@@Ha\x01\x28\r\n"));
  EXPECT_EQ(dialogue.sent[1].text, std::string("@@Bb\x01\x21\r\n"));
  EXPECT_EQ(dialogue.sent[2].text, std::string("@@Bo\x01\x2C\r\n"));
  EXPECT_EQ(dialogue.state(), "asked for Ha");
}

TEST(StartUpOncore, ATwelveChannelReceiverIsAskedOnce) {
  Dialogue dialogue(receiver_start_up());
  dialogue.begin();
  const std::string id = "Ha";
  dialogue.run_for(60 * base::kSecond_ns, every_second(dialogue, id));
  EXPECT_EQ(asked(dialogue), "Ha Bb Bo ");
  EXPECT_EQ(dialogue.state(), "running on Ha");
}

TEST(StartUpOncore, FallsBackToEightChannels) {
  Dialogue dialogue(receiver_start_up());
  dialogue.begin();
  const std::string id = "Ea";
  dialogue.run_for(3400 * base::kMillisecond_ns, every_second(dialogue, id));
  EXPECT_EQ(asked(dialogue), "Ha Bb Bo ");
  dialogue.run_for(200 * base::kMillisecond_ns, every_second(dialogue, id));
  EXPECT_EQ(asked(dialogue), "Ha Bb Bo Ea Bb Bo ");
  EXPECT_EQ(dialogue.state(), "no answer to Ha: trying Ea");
  dialogue.run_for(30 * base::kSecond_ns, every_second(dialogue, id));
  EXPECT_EQ(asked(dialogue), "Ha Bb Bo Ea Bb Bo ");
  EXPECT_EQ(dialogue.state(), "running on Ea");
}

TEST(StartUpOncore, ContentsItselfWithNmea) {
  Dialogue dialogue(receiver_start_up());
  dialogue.begin();
  const std::string id = "GPGGA";
  dialogue.run_for(60 * base::kSecond_ns, every_second(dialogue, id));
  EXPECT_EQ(asked(dialogue), "Ha Bb Bo Ea Bb Bo ");
  EXPECT_EQ(dialogue.state(), "running on NMEA: no answer to Ha or Ea");
}

TEST(StartUpOncore, BinaryPositionsArePreferredToNmea) {
  Dialogue dialogue(receiver_start_up());
  dialogue.begin();
  std::string id = "GPGGA";
  dialogue.run_for(20 * base::kSecond_ns, every_second(dialogue, id));
  id = "Ha";
  dialogue.run_for(2 * base::kSecond_ns, every_second(dialogue, id));
  EXPECT_EQ(dialogue.state(), "running on Ha");
  id = "GPGGA";
  dialogue.run_for(2 * base::kSecond_ns, every_second(dialogue, id));
  EXPECT_EQ(dialogue.state(), "running on Ha");
}

TEST(StartUpOncore, ASilentReceiverIsAskedEveryTenSeconds) {
  Dialogue dialogue(receiver_start_up());
  dialogue.begin();
  const std::int64_t began = dialogue.now_ns();
  dialogue.run_for(8 * base::kSecond_ns);
  EXPECT_EQ(dialogue.state(), "no answer to Ha or Ea, and no NMEA: trying again every 10 s, 1 so far");
  dialogue.run_for(92 * base::kSecond_ns);
  std::vector<std::int64_t> asked_ha;
  for (const Sent& command : dialogue.sent) {
    if (command.text.starts_with("@@Ha")) asked_ha.push_back(command.at_ns);
  }
  ASSERT_EQ(asked_ha.size(), 10U);
  for (std::size_t i = 0; i < asked_ha.size(); ++i) {
    EXPECT_EQ(asked_ha[i], began + static_cast<std::int64_t>(i) * 10 * base::kSecond_ns);
  }
  EXPECT_TRUE(never_repeated_within(dialogue.sent, 3 * base::kSecond_ns));
}

TEST(StartUpOncore, OtherMessagesAreNoPosition) {
  Dialogue dialogue(receiver_start_up());
  dialogue.begin();
  const std::string id = "Bo";
  dialogue.run_for(8 * base::kSecond_ns, every_second(dialogue, id));
  EXPECT_EQ(dialogue.state(), "no answer to Ha or Ea, and no NMEA: trying again every 10 s, 1 so far");
}

TEST(StartUpOncore, AfterAPowerCycleItBeginsAgain) {
  Dialogue dialogue(receiver_start_up());
  dialogue.begin();
  std::string id = "Ha";
  dialogue.run_for(10 * base::kSecond_ns, every_second(dialogue, id));
  dialogue.sent.clear();
  id = "Bb";  // it came back in another state
  dialogue.run_for(2 * base::kSecond_ns, every_second(dialogue, id));
  EXPECT_TRUE(dialogue.sent.empty());
  dialogue.run_for(2 * base::kSecond_ns, every_second(dialogue, id));
  EXPECT_EQ(asked(dialogue), "Ha Bb Bo ");
  id = "Ha";
  dialogue.run_for(2 * base::kSecond_ns, every_second(dialogue, id));
  EXPECT_EQ(dialogue.state(), "running on Ha");
}

TEST(StartUpOncore, SaysNothingBeforeItBegins) {
  Dialogue dialogue(receiver_start_up());
  dialogue.frame("Ha");
  dialogue.run_for(20 * base::kSecond_ns);
  EXPECT_TRUE(dialogue.sent.empty());
  EXPECT_EQ(dialogue.start_up().deadline_ns(), INT64_MAX);
}

}  // namespace
}  // namespace navcal::instruments::test
