// SPDX-License-Identifier: Apache-2.0
#include <navcal/diagnose.h>
#include <navcal/next_mission.h>

#include <set>

#include "tests/api/api_program.h"

namespace navcal::api::test {
namespace {

class ApiDiagnose : public ApiProgram {
 protected:
  [[nodiscard]] std::filesystem::path survey(const std::string& name, int seconds) const {
    (void)output_of("simulate --mission survey --effect motor_field=1 --seconds " + std::to_string(seconds) +
                    " -o " + name);
    return folder_ / name;
  }
  /// An answer without its computing times and without where its bank came from.
  [[nodiscard]] static nlohmann::json without_times(const std::string& text) {
    auto json = nlohmann::json::parse(text);
    json.erase("seconds");
    json["bank"].erase("seconds");
    return json;
  }
};

TEST_F(ApiDiagnose, TheAnswerIsThatOfTheProgram) {
  const auto mission = survey("a.cap", 60);
  DiagnoseOptions options;
  options.bank = 10;
  options.cache = folder_ / "mine";
  std::set<std::string> steps;
  options.progress = [&](std::string_view step, double share) {
    EXPECT_GE(share, 0);
    EXPECT_LE(share, 1);
    steps.emplace(step);
    return true;
  };
  const Diagnosis answer = diagnose(mission, options);
  EXPECT_TRUE(steps.contains("null bank of a.cap"));
  EXPECT_EQ(without_times(answer.json).dump(),
            without_times(output_of("gap --json - --bank 10 --cache others a.cap")).dump());

  const auto json = nlohmann::json::parse(answer.json);
  const std::array names{"no-gap", "explained", "unknown"};
  EXPECT_EQ(json["verdict"], names.at(static_cast<std::size_t>(answer.verdict)));
  EXPECT_EQ(json["sentence"], answer.sentence);
  EXPECT_EQ(json["gap"]["before"].get<double>(), answer.gap.before);
  EXPECT_EQ(json["bank"]["missions"].get<int>(), answer.bank_missions);
  ASSERT_EQ(json["effects"].size(), answer.effects.size());
  for (std::size_t i = 0; i < answer.effects.size(); ++i) {
    EXPECT_EQ(json["effects"][i]["name"], answer.effects[i].name);
    for (const auto& parameter : answer.effects[i].parameters) {
      EXPECT_EQ(json["effects"][i]["parameters"][parameter.name].get<double>(), parameter.value);
    }
  }
}

TEST_F(ApiDiagnose, AVehicleWithALayoutIsDiagnosedAsByTheProgram) {
  const std::string layout = NAVCAL_SOURCE_DIR "/share/vehicles/micro-auv.toml";
  for (const char* options :
       {"--seed 1 -o n1.cap", "--seed 2 -o n2.cap", "--seed 3 --effect thrust_scale@thruster.1=4 -o a.cap"})
    (void)output_of("simulate --vehicle " + layout + " --mission survey --seconds 40 " + options);
  DiagnoseOptions options;
  options.vehicle = layout;
  options.nominals = {folder_ / "n1.cap", folder_ / "n2.cap"};
  options.steady = true;  // much faster, and as good as the other way for what is asked here
  const Diagnosis answer = diagnose(folder_ / "a.cap", options);
  EXPECT_EQ(without_times(answer.json).dump(),
            without_times(output_of("gap --steady --vehicle " + layout +
                                    " --nominal n1.cap --nominal n2.cap --json - a.cap"))
                .dump());
  ASSERT_FALSE(answer.candidates.empty());
  EXPECT_FALSE(answer.candidates.front().of.empty());
  EXPECT_NE(answer.layout_toml.find("[[thruster]]"), std::string::npos) << answer.layout_toml;
  NextMissionOptions next;
  next.diagnosis = options;
  EXPECT_THROW((void)plan_next_mission({folder_ / "a.cap"}, next), Error);
  options.vehicle.clear();
  EXPECT_NO_THROW((void)diagnose(folder_ / "a.cap", options)) << "the reference vehicle is a layout, too";
}

TEST_F(ApiDiagnose, ARecordingThatCannotBeDiagnosedHasAnAnswer) {
  const Diagnosis answer = diagnose(survey("a.cap", 5));
  EXPECT_EQ(answer.verdict, Verdict::unknown);
  EXPECT_FALSE(answer.remarks.empty());
  EXPECT_EQ(without_times(answer.json).dump(), without_times(output_of("gap --json - a.cap")).dump());
}

TEST_F(ApiDiagnose, MayBeCancelledInTheNullBank) {
  const auto mission = survey("a.cap", 60);
  DiagnoseOptions options;
  options.cache = folder_ / "cache";
  int calls = 0;
  options.progress = [&](std::string_view step, double) { return !step.starts_with("null bank") || ++calls < 3; };
  const auto error = error_of([&] { (void)diagnose(mission, options); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->kind, ErrorKind::cancelled);
  EXPECT_TRUE(!std::filesystem::exists(options.cache) || std::filesystem::is_empty(options.cache));
}

TEST_F(ApiDiagnose, BadInputIsAnErrorThatNamesIt) {
  const auto missing = error_of([&] { (void)diagnose(folder_ / "missing.cap"); });
  ASSERT_TRUE(missing);
  EXPECT_EQ(missing->kind, ErrorKind::bad_input);
  EXPECT_TRUE(missing->names("missing.cap"));
  const auto refused = [&](const std::string& words, ErrorKind kind, auto change) {
    DiagnoseOptions options;
    change(options);
    const auto error = error_of([&] { (void)diagnose(folder_ / "never_opened.cap", options); });
    ASSERT_TRUE(error) << words;
    EXPECT_EQ(error->kind, kind) << words;
    EXPECT_TRUE(error->names(words)) << error->message;
  };
  refused("warp_drive", ErrorKind::bad_argument, [](auto& o) { o.exclude = {"warp_drive"}; });
  refused("bank", ErrorKind::bad_argument, [](auto& o) { o.bank = 9; });
  refused("field", ErrorKind::bad_argument, [](auto& o) { o.field_uT = {0, 0, 0}; });
  refused("missing.toml", ErrorKind::bad_input, [](auto& o) { o.config = "/missing.toml"; });
  refused("missing.toml", ErrorKind::bad_input, [](auto& o) { o.vehicle = "/missing.toml"; });
}

TEST_F(ApiDiagnose, AHoldOutWithTheSameReadingsIsRefused) {
  const auto mission = survey("a.cap", 5);
  DiagnoseOptions options;
  options.holdouts = {mission};
  const auto error = error_of([&] { (void)diagnose(mission, options); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->kind, ErrorKind::bad_argument);
  EXPECT_TRUE(error->names("a.cap")) << error->message;
}

}  // namespace
}  // namespace navcal::api::test
