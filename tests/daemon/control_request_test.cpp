// SPDX-License-Identifier: Apache-2.0
#include "daemon/control_request.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace navcal::daemon {
namespace {

std::string refusal(std::string_view line) {
  const auto parsed = parse_control(line);
  return std::holds_alternative<std::string>(parsed) ? std::get<std::string>(parsed) : "accepted";
}

TEST(ControlRequest, EveryCommandOfTheContractIsKnown) {
  for (const auto& [name, command] :
       {std::pair{"event", ControlCommand::event}, std::pair{"log.rotate", ControlCommand::log_rotate},
        std::pair{"calibration.start", ControlCommand::calibration_start},
        std::pair{"calibration.accept", ControlCommand::calibration_accept},
        std::pair{"calibration.rollback", ControlCommand::calibration_rollback},
        std::pair{"calibration.stop", ControlCommand::calibration_stop},
        std::pair{"status", ControlCommand::status}}) {
    const auto line = nlohmann::json{{"command", name}, {"text", "dive 3"}, {"calibrator", "compass"}}.dump();
    const auto parsed = parse_control(line);
    ASSERT_TRUE(std::holds_alternative<ControlRequest>(parsed)) << name;
    EXPECT_EQ(std::get<ControlRequest>(parsed).command, command);
    EXPECT_EQ(std::get<ControlRequest>(parsed).text, "dive 3");
    EXPECT_EQ(std::get<ControlRequest>(parsed).calibrator, "compass");
  }
}

TEST(ControlRequest, ForceIsSaidInSoManyWords) {
  const auto forced = [](const std::string& more) {
    const auto parsed = parse_control(R"({"command":"calibration.accept","calibrator":"compass")" + more + "}");
    return std::get<ControlRequest>(parsed).force;
  };
  EXPECT_TRUE(forced(R"(,"force":true)"));
  EXPECT_FALSE(forced(R"(,"force":false)"));
  EXPECT_FALSE(forced(""));
  EXPECT_EQ(refusal(R"({"command":"calibration.accept","calibrator":"compass","force":1})"),
            "force is true or false");
}

TEST(ControlRequest, RefusalsSayWhatWouldBeRight) {
  EXPECT_NE(refusal("nonsense").find("not a JSON object"), std::string::npos);
  EXPECT_NE(refusal("[1,2]").find("not a JSON object"), std::string::npos);
  EXPECT_NE(refusal(R"({"command":"halt"})").find("known are event, log.rotate"), std::string::npos);
  EXPECT_NE(refusal(R"({"command":7})").find("unknown command"), std::string::npos);
  EXPECT_NE(refusal("{}").find("unknown command"), std::string::npos);
  EXPECT_EQ(refusal(R"({"command":"event"})"), "an event needs a text");
  EXPECT_EQ(refusal(R"({"command":"event","text":3})"), "text and calibrator are strings");
}

TEST(ControlRequest, ErrorsAreOneLineOfJson) {
  const std::string line = control_error("a \"quoted\"\nreason");
  const auto answer = nlohmann::json::parse(line);
  EXPECT_EQ(answer["ok"], false);
  EXPECT_EQ(answer["error"], "a \"quoted\"\nreason");
  EXPECT_EQ(line.find('\n'), line.size() - 1);
}

}  // namespace
}  // namespace navcal::daemon
