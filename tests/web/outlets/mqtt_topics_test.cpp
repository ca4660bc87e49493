// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/mqtt_topics.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "web/outlets/mqtt.h"

namespace navcal::web {
namespace {

std::string topic_of(const Record& record) { return mqtt_place("p", record).value_or(MqttPlace()).topic; }

TEST(MqttPlace, TopicsFollowTheLogsWithTheDeviceBehind) {
  EXPECT_EQ(topic_of({"/imu", "card", {}, "{}"}), "p/imu/card");
  EXPECT_EQ(topic_of({"/nav", "navigation", {}, "{}"}), "p/nav");
  EXPECT_EQ(topic_of({"/health", "", {}, "{}"}), "p/health");
  EXPECT_EQ(topic_of({"/health", "", {}, R"({"part":2,"parts":3})"}), "p/health/2");
  EXPECT_FALSE(mqtt_place("p", {"", "", {}, "{}"}));
  EXPECT_FALSE(mqtt_place("p", {"/", "", {}, "{}"}));
  EXPECT_FALSE(mqtt_place("p", {"imu", "", {}, "{}"}));
}

TEST(MqttPlace, EventsAreNoStates) {
  EXPECT_TRUE(mqtt_place("p", {"/event", "gps", {}, "{}"})->is_event);
  EXPECT_EQ(topic_of({"/event", "gps", {}, "{}"}), "p/event");
  EXPECT_TRUE(mqtt_place("p", {"/command", "motor", {}, "{}"})->is_event);
  EXPECT_FALSE(mqtt_place("p", {"/calib", "", {}, R"({"class":"CALIB"})"})->is_event);
  const auto change = mqtt_place("p", {"/calib", "", {}, R"({"class":"CALIBRATION"})"});
  EXPECT_TRUE(change->is_event);
  EXPECT_EQ(change->topic, "p/calibration");
}

TEST(MqttPlace, NamesCannotReachOtherTopics) {
  for (int byte = 0; byte < 128; ++byte) {
    const std::string device = std::string("a") + static_cast<char>(byte) + "b";
    const std::string topic = topic_of({"/imu", device, {}, "{}"});
    EXPECT_EQ(topic.find_first_of(std::string("#+\0", 3)), std::string::npos) << byte;
    EXPECT_EQ(std::count(topic.begin(), topic.end(), '/'), 2) << byte;
  }
  EXPECT_LE(topic_of({"/imu", std::string(100'000, 'x'), {}, "{}"}).size(), 250U);
}

TEST(MqttPlace, PartsOfAnyShapeAreTaken) {
  for (const char* message : {R"({"parts":)", R"({"parts":1,"part":"x"})", R"({"parts":1,"part":1e99})",
                              R"({"parts":1,"part":-1})", R"(["parts":])"})
    EXPECT_EQ(topic_of({"/health", "", {}, message}), "p/health") << message;
}

TEST(MqttPrefix, IsCheckedBeforeItIsUsed) {
  for (const char* good : {"navcal", "fleet/auv 1", "\xC3\xA5"}) EXPECT_EQ(problem_of_prefix(good), "") << good;
  for (const char* bad : {"", "#", "a/+/b", "$SYS", "/a", "a/", "a\nb", "\xFF"})
    EXPECT_NE(problem_of_prefix(bad), "") << bad;
}

TEST(MqttBrokerName, HasAHostAndPerhapsAPort) {
  const auto text_of = [](std::string_view text) {
    const auto broker = mqtt_broker(text);
    return broker ? broker->host + " " + broker->port : std::string("none");
  };
  EXPECT_EQ(text_of("shore"), "shore 1883");
  EXPECT_EQ(text_of("shore.local:8883"), "shore.local 8883");
  EXPECT_EQ(text_of("[::1]"), "::1 1883");
  EXPECT_EQ(text_of("[fe80::1]:99"), "fe80::1 99");
  for (const char* bad : {"", ":1883", "a:", "a:0", "a:65536", "a:x", "a:1:2", "[::1", "[]:1", "a:-1", "::1"})
    EXPECT_EQ(text_of(bad), "none") << bad;
}

TEST(MqttLoginFile, MustNotBeForEverybody) {
  const auto file = std::filesystem::temp_directory_path() / ("navcal-login-" + std::to_string(::getpid()));
  std::ofstream(file) << "auv\nword with blanks \n";
  ::chmod(file.c_str(), 0640);
  const MqttLogin login = read_mqtt_login(file);
  EXPECT_EQ(login.user, "auv");
  EXPECT_EQ(login.password, "word with blanks ");
  ::chmod(file.c_str(), 0644);
  EXPECT_THROW(static_cast<void>(read_mqtt_login(file)), std::runtime_error);
  ::chmod(file.c_str(), 0600);
  std::ofstream(file) << "auv";
  EXPECT_THROW(static_cast<void>(read_mqtt_login(file)), std::runtime_error);
  std::filesystem::remove(file);
  EXPECT_THROW(static_cast<void>(read_mqtt_login(file)), std::runtime_error);
}

}  // namespace
}  // namespace navcal::web
