// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/gap_report.h"
#include "tests/report/gap_samples.h"

namespace navcal::cli {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> keys_of(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

TEST(GapJson, HasTheKeysOfTheContract) {
  const Json json = Json::parse(report::gap_json(test::explained_gap()));
  EXPECT_EQ(keys_of(json),
            (std::vector<std::string>{
                "verdict",  "sentence",    "where",      "least_p_value", "sources", "proposal",   "effects",
                "gap",      "unexplained", "candidates", "next",          "remarks", "gyro_bias",  "instruments",
                "commands", "least_ratio", "changes",    "field",         "bank",    "duration_s", "seconds"}));
  EXPECT_EQ(json["verdict"], "explained");
  EXPECT_EQ(keys_of(json["where"][0]),
            (std::vector<std::string>{"channel", "regime", "gap", "unit", "floor", "p_value"}));
  EXPECT_EQ(keys_of(json["effects"][0]),
            (std::vector<std::string>{"name", "probability", "parameters", "std_errors", "confused_with"}));
  EXPECT_EQ(keys_of(json["gap"]),
            (std::vector<std::string>{"before", "after", "floor", "closed", "closed_ci", "unit", "channels",
                                      "held_out", "heading_error_rad", "dead_reckoning_m_per_100m"}));
  EXPECT_EQ(keys_of(json["gap"]["channels"][0]),
            (std::vector<std::string>{"channel", "before", "after", "floor", "closed", "closed_ci", "unit"}));
  EXPECT_EQ(keys_of(json["bank"]), (std::vector<std::string>{"missions", "seed", "from_cache", "seconds"}));
}

TEST(GapJson, SaysTheSmallestProbabilityOfTheMap) {
  EXPECT_EQ(Json::parse(report::gap_json(test::explained_gap()))["least_p_value"], 1e-14);
  EXPECT_EQ(Json::parse(report::gap_json(test::no_gap()))["least_p_value"], 0.9);
  EXPECT_TRUE(Json::parse(report::gap_json({}))["least_p_value"].is_null());
}

TEST(GapJson, SaysWhyAGapIsUnknown) {
  EXPECT_FALSE(Json::parse(report::gap_json(test::explained_gap())).contains("kind"));
  auto diagnosis = test::unknown_gap();
  EXPECT_EQ(Json::parse(report::gap_json(diagnosis))["kind"], "cannot say");
  EXPECT_EQ(Json::parse(report::gap_json(diagnosis))["alternatives"], Json::array());
  diagnosis.kind = gap::UnknownKind::outside;
  EXPECT_EQ(Json::parse(report::gap_json(diagnosis))["kind"], "outside");
  diagnosis.kind = gap::UnknownKind::ambiguous;
  diagnosis.alternatives = {{{diagnosis.candidates[0]}, 0.6, 0.98}, {{diagnosis.candidates[1]}, 0.4, {}}};
  const Json json = Json::parse(report::gap_json(diagnosis));
  EXPECT_EQ(json["kind"], "ambiguous");
  EXPECT_EQ(keys_of(json["alternatives"][0]), (std::vector<std::string>{"effects", "probability", "closed"}));
  EXPECT_EQ(json["alternatives"][0]["effects"][0]["name"], "motor_field");
  EXPECT_EQ(json["alternatives"][0]["closed"], 0.98);
  EXPECT_TRUE(json["alternatives"][1]["closed"].is_null());
}

TEST(GapJson, SaysWhereTheErrorEntersAndDescribesWhatIsUnknown) {
  EXPECT_EQ(Json::parse(report::gap_json(test::explained_gap()))["sources"], Json::array());
  EXPECT_TRUE(Json::parse(report::gap_json(test::explained_gap()))["proposal"].is_null());
  auto diagnosis = test::unknown_gap();
  diagnosis.sources.push_back({"vehicle.moments",
                               "the moments on the vehicle",
                               11,
                               {{"roll", "", "speed", "speed", {"speed"}, 0.5, 0.01, "deg of fin"}}});
  const Json json = Json::parse(report::gap_json(diagnosis));
  EXPECT_EQ(keys_of(json["sources"][0]), (std::vector<std::string>{"source", "gain_nats", "errors"}));
  EXPECT_EQ(json["sources"][0]["source"], "compass.field");
  EXPECT_EQ(keys_of(json["sources"][0]["errors"][0]),
            (std::vector<std::string>{"component", "channel", "follows", "families", "rms", "std_error", "unit"}));
  EXPECT_EQ(json["sources"][0]["errors"][0]["families"], Json::array({"current"}));
  EXPECT_TRUE(json["sources"].back()["errors"][0]["channel"].is_null());
  EXPECT_EQ(keys_of(json["proposal"]),
            (std::vector<std::string>{"source", "errors", "held_out", "held_out_gain_nats", "power", "warning"}));
  EXPECT_EQ(keys_of(json["proposal"]["power"]), (std::vector<std::string>{"before", "after", "floor"}));
  EXPECT_EQ(json["proposal"]["held_out"], true);
}

TEST(GapJson, SaysWhichInstrumentsAreMissing) {
  auto diagnosis = test::explained_gap();
  EXPECT_TRUE(Json::parse(report::gap_json(diagnosis))["commands"].is_null());
  diagnosis.instruments = {{"GPS"}, {{"compass", 100, 200}}, {"water_current"}};
  diagnosis.commands.emplace().saturated = 0.25;
  diagnosis.least_ratio = 1.5;
  const Json json = Json::parse(report::gap_json(diagnosis));
  EXPECT_EQ(json["instruments"]["missing"], Json::array({"GPS"}));
  EXPECT_EQ(json["instruments"]["not_judged"], Json::array({"water_current"}));
  EXPECT_EQ(json["instruments"]["interrupted"][0]["name"], "compass");
  EXPECT_EQ(json["instruments"]["interrupted"][0]["until_s"], 200);
  EXPECT_TRUE(json["commands"]["delay_s"].is_null());
  EXPECT_EQ(json["commands"]["saturated"], 0.25);
  EXPECT_EQ(json["least_ratio"], 1.5);
}

TEST(GapJson, NumbersComeBackToTheLastBit) {
  auto diagnosis = test::explained_gap();
  diagnosis.effects[0].parameters[0].value = 0.1 + 0.2;
  const Json json = Json::parse(report::gap_json(diagnosis));
  EXPECT_EQ(json["effects"][0]["parameters"]["x_uT_per_A"].get<double>(), 0.1 + 0.2);
  EXPECT_EQ(json["effects"][0]["std_errors"]["x_uT_per_A"], 0.0042);
  EXPECT_EQ(json["effects"][1]["confused_with"][0]["name"], "fin_gain");
  EXPECT_EQ(json["gap"]["closed_ci"], Json::array({0.954, 1.012}));
  EXPECT_EQ(json["gap"]["unit"], "noise power");
  EXPECT_EQ(json["gap"]["channels"][0]["unit"], "uT");
  EXPECT_TRUE(json["gap"]["channels"][2]["closed"].is_null());
  EXPECT_TRUE(json["gap"]["channels"][2]["closed_ci"].is_null());
  EXPECT_EQ(json["gyro_bias"]["az_rad_s"], -0.002);
}

TEST(GapJson, SaysWhichFieldOfTheEarthTheModelHas) {
  auto diagnosis = test::explained_gap();
  diagnosis.field.emplace().source = gap::EarthField::Source::given;
  const Json given = Json::parse(report::gap_json(diagnosis))["field"];
  EXPECT_EQ(keys_of(given), (std::vector<std::string>{"source", "north_east_down_uT", "place", "date"}));
  EXPECT_EQ(given["source"], "given");
  EXPECT_EQ(given["north_east_down_uT"], Json::array({19.0, 0.6, 44.0}));
  EXPECT_TRUE(given["place"].is_null());
  EXPECT_TRUE(given["date"].is_null());

  diagnosis.field->place = {0.5, -1.0, 3};
  diagnosis.field->utc_ns = 1'780'272'000'000'000'000;
  diagnosis.field->set_by_model();
  const Json by_model = Json::parse(report::gap_json(diagnosis))["field"];
  EXPECT_EQ(by_model["source"], "model");
  EXPECT_EQ(by_model["date"], "2026-06-01");
  EXPECT_NEAR(by_model["place"]["latitude_deg"], 28.6479, 1e-4);
  EXPECT_NEAR(by_model["place"]["longitude_deg"], -57.2958, 1e-4);
}

TEST(GapJson, NothingAtAllIsAnAnswer) {
  const Json json = Json::parse(report::gap_json({}));
  EXPECT_EQ(json["verdict"], "unknown");
  for (const char* list : {"where", "effects", "unexplained", "candidates", "next", "remarks", "changes"}) {
    EXPECT_EQ(json[list], Json::array()) << list;
  }
  EXPECT_EQ(json["gap"]["channels"], Json::array());
  EXPECT_TRUE(json["gap"]["closed"].is_null());
  EXPECT_TRUE(json["gap"]["heading_error_rad"].is_null());
  EXPECT_EQ(Json::parse(report::gap_json(test::no_gap()))["verdict"], "no-gap");
}

TEST(GapJson, WhatIsNoNumberIsNullAndAnyTextIsTaken) {
  const std::string text = report::gap_json(test::hostile_gap());
  const Json json = Json::parse(text);
  EXPECT_TRUE(json["where"][0]["gap"].is_null());
  EXPECT_TRUE(json["where"][0]["floor"].is_null());
  EXPECT_TRUE(json["effects"][0]["probability"].is_null());
  EXPECT_TRUE(json["gap"]["closed"].is_null());
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace navcal::cli
