// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "record/json/flat_json.h"
#include "record/json/json_object.h"
#include "record/json/mapping_json.h"
#include "record/json/message_json.h"
#include "record/log/log_topics.h"
#include "tests/record/sample_log.h"

namespace navcal::record {
namespace {

std::string seconds(std::int64_t ns) {
  std::string out;
  append_seconds(out, ns);
  return out;
}

TEST(Json, TimesKeepEveryNanosecond) {
  EXPECT_EQ(seconds(1'893'456'000'104'697'202), "1893456000.104697202");
  EXPECT_EQ(seconds(0), "0.000000000");
  EXPECT_EQ(seconds(-1), "-0.000000001");
  EXPECT_EQ(seconds(INT64_MIN), "-9223372036.854775808");
  std::mt19937_64 random(1);
  for (int i = 0; i < 10'000; ++i) {
    const auto ns = static_cast<std::int64_t>(random()) / 2;
    ASSERT_EQ(nanoseconds(seconds(ns)), ns);
  }
}

TEST(Json, TimesThatAreNone) {
  for (const auto* text : {"", "-", ".5", "1.", "1.0000000001", "1e3", "99999999999.0", "1.5x", "+1", "--1"}) {
    EXPECT_EQ(nanoseconds(text), std::nullopt) << text;
  }
  EXPECT_EQ(nanoseconds("12"), 12'000'000'000);
  EXPECT_EQ(nanoseconds("-0.5"), -500'000'000);
}

TEST(Json, ASampleReadsAsInTheContract) {
  std::string text;
  append_json(text, testing::compass_sample(6'000'000'007), "compass");
  EXPECT_EQ(
      text,
      "{\"class\":\"COMPASS\",\"time\":1790000005.950000008,\"time_std\":0.001500000,"
      "\"arrival\":1790000006.000000008,\"device\":\"compass\",\"heading_rad\":5.7334,"
      "\"heading_calibrated_rad\":null,\"heading_is_true\":false,\"pitch_rad\":0.1,\"roll_rad\":null,\"field_body_"
      "uT\":[55.11,12.33,-18.43],"
      "\"dip_rad\":null,\"turn_rate_rad_s\":null,\"temperature_C\":null,\"error\":null,\"tilt_by_accelerometers\":"
      "false,\"heading_std_rad\":null,\"tilt_std_rad\":null,\"field_std_uT\":null,\"calibration\":null}");
}

TEST(Json, EveryKindOfSampleIsJsonWithTheMembersOfItsTopic) {
  instruments::Sample sample;
  const auto check = [&](std::string_view topic_name) {
    std::string text;
    append_json(text, sample, "a port");
    const auto json = nlohmann::json::parse(text);
    const Topic* const topic = json_topic(topic_name);
    ASSERT_NE(topic, nullptr);
    EXPECT_EQ(json.size(), topic->fields.size() + 1) << topic_name;
    for (const Field& field : topic->fields) EXPECT_TRUE(json.contains(std::string(field.name))) << field.name;
    EXPECT_EQ(nlohmann::json::parse(json_schema(*topic))["properties"].size(), topic->fields.size() + 2);
  };
  sample.value = instruments::CompassSample{};
  check("/compass");
  sample.value = instruments::ImuSample{};
  check("/imu");
  sample.value = instruments::GpsSample{};
  check("/gps");
  sample.value = instruments::MotorSample{};
  check("/motor");
  sample.value = instruments::AltimeterSample{};
  check("/altimeter");
  sample.value = instruments::PowerSample{};
  check("/power");
  sample.value = instruments::DvlSample{};
  check("/dvl");
  sample.value = instruments::DepthSample{};
  check("/depth");
  sample.value = instruments::ScalarSample{};
  check("/sensor");
}

TEST(Json, ABatteryHasTheMembersOfItsTopicWhetherItsChargeIsKnownOrNot) {
  pipeline::BatterySample sample;
  sample.capacity_Ah = 4;
  sample.nominal_V = 20;
  const auto json_of = [&] {
    std::string text;
    append_json(text, sample, "motor");
    const auto json = nlohmann::json::parse(text);
    const Topic* const topic = json_topic("/battery");
    EXPECT_EQ(json.size(), topic->fields.size() + 1);
    for (const Field& field : topic->fields) EXPECT_TRUE(json.contains(std::string(field.name))) << field.name;
    return json;
  };
  EXPECT_TRUE(json_of()["charge_percent"].is_null());
  sample.charge = pipeline::BatteryCharge{1, 0.25};
  const auto json = json_of();
  EXPECT_EQ(json["charge_percent"], 25);
  EXPECT_EQ(json["energy_Wh"], 20);
  EXPECT_EQ(json["charge_std_Ah"], 0.25);
}

TEST(Json, TheChargeInAnEventIsReadBackToTheLastBit) {
  const pipeline::BatteryCharge charge{0.1 + 0.2, 1.0 / 3};
  const auto back = battery_event_charge(battery_event_words(charge, "by command"));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->charge_Ah, charge.charge_Ah);
  EXPECT_EQ(back->std_Ah, charge.std_Ah);
  for (const char* bad : {"", "full", "3.7", "3.7 Ah, std ", "3.7 Ah; std 1 Ah"})
    EXPECT_FALSE(battery_event_charge(bad)) << bad;
}

TEST(Json, AnEstimateHasTheMembersOfItsTopicWhetherItKnowsMuchOrLittle) {
  pipeline::NavigationSample sample;
  const auto json_of = [&] {
    std::string text;
    append_json(text, sample);
    const auto json = nlohmann::json::parse(text);
    const Topic* const topic = json_topic("/nav");
    EXPECT_EQ(json.size(), topic->fields.size() + 1);
    for (const Field& field : topic->fields) EXPECT_TRUE(json.contains(std::string(field.name))) << field.name;
    return json;
  };
  auto json = json_of();
  EXPECT_EQ(json["class"], "NAV");
  EXPECT_EQ(json["position"], "none");
  for (const char* key :
       {"lat", "north_std_m", "since_fix_s", "heading_rad", "heading_std_rad", "velocity_m_s", "set_north_m_s",
        "outage_m", "outage_error_uncalibrated_m", "calibration", "speed_source", "bottom_lock", "dvl_outliers"})
    EXPECT_TRUE(json[key].is_null()) << key;

  sample.source = pipeline::PositionSource::reckoned;
  sample.latitude_rad = std::numbers::pi / 4;
  sample.longitude_rad = -std::numbers::pi / 2;
  sample.estimate.position_m = Eigen::Vector2d(1, 2);
  sample.estimate.position_std_m = {3, 4};
  sample.estimate.velocity_m_s = Eigen::Vector3d(1, 0.5, -0.25);
  sample.estimate.heading_rad = 1.5;
  sample.outage = nav::Outage{100, 90, 2};
  json = json_of();
  EXPECT_EQ(json["position"], "reckoned");
  EXPECT_EQ(json["lat"], 45);
  EXPECT_EQ(json["lon"], -90);
  EXPECT_EQ(json["north_std_m"], 3);
  EXPECT_EQ(json["east_std_m"], 4);
  EXPECT_EQ(json["velocity_m_s"], nlohmann::json::parse("[1,0.5,-0.25]"));
  EXPECT_EQ(json["outage_error_m"], 2);

  using nav::SpeedSource;
  sample.bottom_lock = false;
  sample.estimate.velocity_outliers = 7;
  for (const auto& [source, name] :
       {std::pair(SpeedSource::shaft, "shaft"), std::pair(SpeedSource::water, "water"),
        std::pair(SpeedSource::bottom, "dvl")}) {
    sample.estimate.speed_source = source;
    json = json_of();
    EXPECT_EQ(json["speed_source"], name);
  }
  EXPECT_EQ(json["bottom_lock"], false);
  EXPECT_EQ(json["dvl_outliers"], 7);
}

TEST(Json, AnOrderHasTheMembersOfItsTopicWhateverBecameOfIt) {
  control::OrderRecord record;
  pipeline::UtcMapping mapping;
  mapping.offset_ns = 1'700'000'000'000'000'000;
  const auto json_of = [&] {
    std::string text;
    append_json(text, mapping, 5'000'000'000, "motor", record);
    const auto json = nlohmann::json::parse(text);
    const Topic* const topic = json_topic("/command");
    EXPECT_EQ(json.size(), topic->fields.size() + 1);
    for (const Field& field : topic->fields) EXPECT_TRUE(json.contains(std::string(field.name))) << field.name;
    return json;
  };
  record.asked_ns = 1'000'000'000;
  record.reason = "shaft_rpm 5000 is beyond 1200";
  record.wanted.shaft_rpm = 5000;
  auto json = json_of();
  EXPECT_EQ(json["class"], "COMMAND");
  EXPECT_EQ(json["outcome"], "refused");
  EXPECT_EQ(json["time"], 1'700'000'001);
  for (const char* key : {"priority", "sent", "echoed", "late_s", "shaft_sent_rpm", "fins_sent_deg"})
    EXPECT_TRUE(json[key].is_null()) << key;
  record.outcome = control::Outcome::echoed;
  record.priority = 2;
  record.sent_ns = 2'000'000'000;
  record.echoed_ns = 2'100'000'000;
  record.sent = protocols::motor_card::Command{780, {0, -5, 5}};
  json = json_of();
  EXPECT_EQ(json["time"], 1'700'000'002);
  EXPECT_EQ(json["priority"], 2);
  EXPECT_EQ(json["shaft_sent_rpm"], 780);
  EXPECT_EQ(json["fins_sent_deg"], nlohmann::json::parse("[0.0,-5.0,5.0]"));
}

TEST(Json, NumbersReadBackToTheLastBitAndTheRestIsNull) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 10'000; ++i) {
    const double value = std::bit_cast<double>(random());
    std::string text;
    { JsonObject(text, "X").number("v", value); }
    const auto json = nlohmann::json::parse(text);
    if (std::isfinite(value)) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(json["v"].get<double>()), std::bit_cast<std::uint64_t>(value))
          << text;
    } else {
      ASSERT_TRUE(json["v"].is_null());
    }
  }
}

TEST(Json, AnyBytesAreText) {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  std::string text;
  { JsonObject(text, "X").text("v", bytes); }
  EXPECT_TRUE(nlohmann::json::parse(text)["v"].is_string());
}

TEST(Json, AMappingReadsBack) {
  for (const std::int64_t bound :
       {std::int64_t{0}, std::int64_t{123'456'789}, pipeline::UtcMapping::kUnknownBound}) {
    const pipeline::UtcMapping mapping{pipeline::UtcMapping::Source::gps, 1'790'000'000'000'000'001, bound, 77};
    std::string text;
    append_json(text, 5, mapping);
    const auto read = mapping_from_json(text);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->source, mapping.source);
    EXPECT_EQ(read->offset_ns, mapping.offset_ns);
    EXPECT_EQ(read->bound_ns, mapping.bound_ns);
    EXPECT_EQ(read->at_ns, mapping.at_ns);
  }
  EXPECT_FALSE(mapping_from_json("{}"));
  EXPECT_FALSE(mapping_from_json("[]"));
}

TEST(FlatJson, NamesWhatLiesDeeper) {
  const auto json = FlatJson::parse(R"({"a":[1,[2.50,{"b":null}]],"c":{"d":"x"},"e":true})");
  ASSERT_TRUE(json);
  EXPECT_EQ(json->get("a.0"), "1");
  EXPECT_EQ(json->get("a.1.0"), "2.50");
  ASSERT_NE(json->find("a.1.1.b"), nullptr);
  EXPECT_EQ(json->get("a.1.1.b"), "");
  EXPECT_EQ(json->get("c.d"), "x");
  EXPECT_EQ(json->get("e"), "true");
  EXPECT_EQ(json->find("f"), nullptr);
  for (const auto* bad : {"", "1", "[1]", "{", "{\"a\":1}x", "{\"a\":}"})
    EXPECT_FALSE(FlatJson::parse(bad)) << bad;
  EXPECT_FALSE(FlatJson::parse("{\"a\":" + std::string(100'000, '[')));
  EXPECT_FALSE(FlatJson::parse("{\"" + std::string(1000, 'a') + "\":[0,0]}")) << "each member keeps its path";
}

TEST(Json, APositionIsInDegreesAndAHeadingInRadians) {
  instruments::Sample sample;
  instruments::GpsSample gps;
  gps.latitude_rad = 0.5;
  gps.longitude_rad = -0.25;
  sample.value = gps;
  std::string text;
  append_json(text, sample, "gps");
  const auto json = nlohmann::json::parse(text);
  EXPECT_DOUBLE_EQ(json["lat"].get<double>(), 28.64788975654116);
  EXPECT_DOUBLE_EQ(json["lon"].get<double>(), -14.32394487827058);
  instruments::CompassSample compass;
  compass.heading_rad = 0.5;
  sample.value = compass;
  text.clear();
  append_json(text, sample, "compass");
  EXPECT_EQ(nlohmann::json::parse(text)["heading_rad"], 0.5);
}

}  // namespace
}  // namespace navcal::record
