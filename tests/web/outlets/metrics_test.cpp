// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/metrics.h"

#include <gtest/gtest.h>

#include <string>

#include "web/outlets/outlets.h"

namespace navcal::web {
namespace {

class MetricsTest : public testing::Test {
 protected:
  void say(std::string_view topic, std::string_view device, std::string_view message) {
    hub_.publish({topic, device, std::nullopt, message});
  }
  [[nodiscard]] bool has(std::string_view line) const {
    return ("\n" + metrics_.page()).find("\n" + std::string(line)) != std::string::npos;
  }

  Hub hub_;
  Metrics metrics_{hub_};
};

TEST_F(MetricsTest, AsksForEventsAndReportsOnceASecond) {
  const Demand demand = hub_.demand();
  EXPECT_FALSE(demand.all_topics);
  EXPECT_TRUE(demand.topics.contains("/health") && demand.topics.contains("/event"));
  EXPECT_EQ(demand.rate_Hz, 1);
}

TEST_F(MetricsTest, NothingIsSaidOfADaemonThatHasSaidNothing) {
  EXPECT_TRUE(has("navcald_up 0"));
  EXPECT_EQ(metrics_.page().find("navcald_port"), std::string::npos);
  EXPECT_EQ(metrics_.page().find("navcald_depth"), std::string::npos);
  EXPECT_EQ(metrics_.page().find("navcal_web_connections"), std::string::npos) << "no server is watched";
}

TEST_F(MetricsTest, NullAndAbsentMembersGiveNoLineAndZeroGivesOne) {
  say("/nav", "navigation",
      R"({"depth_m":0,"altitude_m":null,"heading_rad":"north","time":null,"bottom_lock":null})");
  EXPECT_TRUE(has("navcald_depth_meters 0\n"));
  for (const char* absent :
       {"navcald_altitude", "navcald_heading", "navcald_navigation_timestamp", "navcald_bottom_lock"})
    EXPECT_EQ(metrics_.page().find(absent), std::string::npos) << absent;
}

TEST_F(MetricsTest, LinesOfOneHealthComeTogetherInAnyOrder) {
  say("/health", "", R"({"part":2,"parts":2,"ports":[{"device":"b","frames":2,"state":"running"}]})");
  EXPECT_TRUE(has("navcald_port_frames_total{device=\"b\"} 2"));
  say("/health", "", R"({"part":1,"parts":2,"uptime_s":3,"ports":[{"device":"a","frames":1}]})");
  EXPECT_TRUE(has("navcald_port_frames_total{device=\"a\"} 1\nnavcald_port_frames_total{device=\"b\"} 2\n"));
  EXPECT_TRUE(has("navcald_uptime_seconds 3"));
  say("/health", "", R"({"uptime_s":4,"ports":[{"device":"c","frames":7}]})");
  EXPECT_FALSE(has("navcald_port_frames_total{device=\"b\"}")) << "a HEALTH of one line replaces all";
}

TEST_F(MetricsTest, AStateThatIsNotKnownHereIsNoneOfThoseThatAre) {
  say("/health", "", R"({"ports":[{"device":"a","state":"dreaming"}],"log":{"state":"full"}})");
  EXPECT_TRUE(has("navcald_port_state{device=\"a\",state=\"running\"} 0"));
  EXPECT_EQ(metrics_.page().find("dreaming"), std::string::npos);
  EXPECT_TRUE(has("navcald_log_state{state=\"writing\"} 0\nnavcald_log_state{state=\"full\"} 1\n"));
}

TEST_F(MetricsTest, MessagesOfAnyShapeAreTaken) {
  for (const char* topic : {"/health", "/nav", "/calib", "/battery", "/time", "/event"}) {
    for (const char* message : {"{}", "[]", "7", "\"x\"", "{", "",
                                R"({"ports":7,"alarms":{},"log":[],"motor":"x","calibrators":[1,null]})",
                                R"({"class":"CALIB","calibrators":"x"})", R"({"part":-1,"parts":1e9})",
                                R"({"part":9,"parts":2})", R"({"part":1,"parts":4000000000})",
                                R"({"ports":[{"device":"a","latency_log2_us":[-1,"x",1.5],"clock":3}]})",
                                R"({"severity":5,"device":[],"source":{}})"}) {
      say(topic, "", message);
      EXPECT_TRUE(has("navcald_up 0")) << topic << message;
    }
  }
}

TEST_F(MetricsTest, WhatDependsOnTheConnectionGoesWithIt) {
  hub_.set_link({true, ""});
  say("/nav", "navigation", R"({"depth_m":3})");
  say("/battery", "gauge", R"({"device":"gauge","charge_percent":25,"low":true})");
  say("/calib", "",
      R"({"class":"CALIB","calibrators":[{"calibrator":"compass","verdict":"in_force","coverage":0.5}]})");
  say("/calib", "", R"({"class":"CALIBRATION","calibrators":[]})");
  say("/time", "", R"({"source":"gps","bound":0.02})");
  say("/event", "", R"({"severity":"error"})");
  EXPECT_TRUE(has("navcald_up 1"));
  EXPECT_TRUE(has("navcald_battery_charge_ratio{device=\"gauge\"} 0.25"));
  EXPECT_TRUE(has("navcald_battery_low{device=\"gauge\"} 1"));
  EXPECT_TRUE(has("navcald_calibrator_verdict{calibrator=\"compass\",verdict=\"in_force\"} 1"));
  EXPECT_TRUE(has("navcald_calibrator_coverage_ratio{calibrator=\"compass\"} 0.5"));
  EXPECT_TRUE(has("navcald_clock_bound_seconds 0.02"));
  hub_.set_link({false, "gone"});
  EXPECT_TRUE(has("navcald_up 0"));
  EXPECT_TRUE(has("navcald_events_total{severity=\"error\"} 1")) << "counted here, not by navcald";
  for (const char* stale : {"navcald_depth", "navcald_battery", "navcald_calibrator", "navcald_clock"})
    EXPECT_EQ(metrics_.page().find(stale), std::string::npos) << stale;
}

TEST_F(MetricsTest, TheClockIsKnownFromHealthBeforeAnyTime) {
  say("/health", "",
      R"({"utc":{"source":"gps","bound_s":0.06},"process":{"version":"1.2","cpu_s":3,"most_resident_kB":2}})");
  EXPECT_TRUE(has("navcald_clock_source{source=\"gps\"} 1"));
  EXPECT_TRUE(has("navcald_clock_bound_seconds 0.06"));
  EXPECT_TRUE(has("navcald_info{version=\"1.2\"} 1"));
  EXPECT_EQ(metrics_.page().find("navcald_vehicle_info{"), std::string::npos)
      << "an older navcald does not say it";
  EXPECT_TRUE(has("navcald_cpu_seconds_total 3"));
  EXPECT_TRUE(has("navcald_most_resident_memory_bytes 2048"));
  say("/health", "", R"({"vehicle":{"config_crc32c":"0a1b2c3d","id":"auv-7"}})");
  EXPECT_TRUE(has("navcald_vehicle_info{id=\"auv-7\",name=\"\",config_crc32c=\"0a1b2c3d\"} 1"));
  say("/time", "", R"({"source":"system","bound":null})");
  EXPECT_TRUE(has("navcald_clock_source{source=\"gps\"} 0"));
  EXPECT_EQ(metrics_.page().find("navcald_clock_bound"), std::string::npos);
  say("/health", "", R"({"utc":{"source":"none","bound_s":null}})");
  EXPECT_TRUE(has("navcald_clock_source{source=\"system\"} 1")) << "/time is the log's own word";
}

TEST_F(MetricsTest, CountersOfTheServerAreTold) {
  ServerCounters server;
  LiveSource::Counters source;
  server.messages_dropped = 5;
  source.missed = 2;
  metrics_.watch(server, source);
  EXPECT_TRUE(has("navcal_web_dropped_messages_total 5"));
  EXPECT_TRUE(has("navcal_web_status_missed_reports 2"));
}

TEST(BlueOs, SaysWhatItsServiceMetadataNeed) {
  const auto service = nlohmann::json::parse(blueos_service("1.2.3"));
  for (const char* key : {"name", "description", "icon", "company", "version", "webpage", "api"})
    EXPECT_TRUE(service.at(key).is_string() && !service.at(key).get<std::string>().empty()) << key;
  EXPECT_EQ(service.at("version"), "1.2.3");
  EXPECT_TRUE(service.at("icon").get<std::string>().starts_with("mdi-"));
  EXPECT_EQ(service.at("works_in_relative_paths"), true);
}

}  // namespace
}  // namespace navcal::web
