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

TEST(ControlRequest, ThePartOfALogIsCheckedNumberByNumber) {
  const auto part = [](const std::string& more) {
    return refusal(R"({"command":"log.read","file":"navcal-20261121T023000Z-000123.mcap")" + more + "}");
  };
  EXPECT_EQ(part(R"(,"offset":0,"length":65536)"), "accepted");
  EXPECT_EQ(part(R"(,"offset":9223372036854775807,"length":1)"), "accepted");
  for (const char* bad : {R"("length":10)", R"("offset":-1,"length":10)", R"("offset":1.5,"length":10)",
                          R"("offset":9223372036854775808,"length":10)", R"("offset":1e3,"length":10)",
                          R"("offset":"0","length":10)", R"("offset":null,"length":10)"})
    EXPECT_EQ(part("," + std::string(bad)), "offset is a number of bytes") << bad;
  for (const char* bad : {"0", "-5", "65537", "1e400", "1.0", "\"10\"", "[]", "18446744073709551616"})
    EXPECT_NE(part(R"(,"offset":0,"length":)" + std::string(bad)), "accepted") << bad;
  EXPECT_NE(part(R"(,"offset":0,"length":NaN)"), "accepted");
  EXPECT_EQ(refusal(R"({"command":"log.sum","file":"x","offset":0,"length":16777216})"), "accepted");
  EXPECT_EQ(refusal(R"({"command":"log.read","offset":0,"length":1})"), "file is the name of a log");
  EXPECT_EQ(refusal(R"({"command":"log.read","file":7,"offset":0,"length":1})"), "file is the name of a log");
}

TEST(ControlRequest, ListsChoicesAndSuppliesAreChecked) {
  const auto list = std::get<ControlRequest>(parse_control(R"({"command":"log.list"})"));
  EXPECT_EQ(list.length, 100U);
  EXPECT_EQ(refusal(R"({"command":"log.list","after":"navcal-20261121T023000Z-000123.mcap","limit":3})"),
            "accepted");
  EXPECT_EQ(refusal(R"({"command":"log.list","after":"../x"})"), "after is the name of a log");
  EXPECT_EQ(refusal(R"({"command":"log.list","limit":0})"), "limit is 1 to 100 logs");
  EXPECT_FALSE(std::get<ControlRequest>(parse_control(R"({"command":"log.select"})")).leave_out);
  const auto choice =
      std::get<ControlRequest>(parse_control(R"({"command":"log.select","leave_out":["raw.gps"]})"));
  EXPECT_EQ(choice.leave_out, std::vector<std::string>{"raw.gps"});
  for (const char* bad : {"\"raw\"", "[1]", "{}", "null"})
    EXPECT_EQ(refusal(R"({"command":"log.select","leave_out":)" + std::string(bad) + "}"),
              "leave_out is a list of texts");
  EXPECT_EQ(refusal(R"({"command":"power.off","name":"mast"})"), "accepted");
  EXPECT_EQ(refusal(R"({"command":"power.off"})"), "name is that of a supply; power.list has them");
  EXPECT_EQ(refusal(R"({"command":"power.list"})"), "accepted");
}

TEST(ControlRequest, CommandsToInstruments) {
  const auto given =
      parse_control(R"({"command":"device.command","port":"gps","name":"cold_start","force":true})");
  ASSERT_TRUE(std::holds_alternative<ControlRequest>(given));
  EXPECT_EQ(std::get<ControlRequest>(given).port, "gps");
  EXPECT_EQ(std::get<ControlRequest>(given).name, "cold_start");
  EXPECT_TRUE(std::get<ControlRequest>(given).force);
  EXPECT_EQ(refusal(R"({"command":"device.command","name":"cold_start"})"), "port is the name of a port");
  EXPECT_EQ(refusal(R"({"command":"device.command","port":7,"name":"cold_start"})"), "port is the name of a port");
  EXPECT_EQ(refusal(R"({"command":"device.command","port":"gps"})"),
            "name is that of a command; device.commands has them");
  EXPECT_EQ(refusal(R"({"command":"device.commands"})"), "accepted");
  EXPECT_EQ(refusal(R"({"command":"device.commands","port":[]})"), "port is the name of a port");
}

TEST(ControlRequest, ChargeOfTheBattery) {
  const auto set = parse_control(R"({"command":"battery.set","charge_Ah":2.5,"charge_std_Ah":0.1})");
  ASSERT_TRUE(std::holds_alternative<ControlRequest>(set));
  EXPECT_EQ(std::get<ControlRequest>(set).charge_Ah, 2.5);
  EXPECT_EQ(std::get<ControlRequest>(set).charge_std_Ah, 0.1);
  const auto full = parse_control(R"({"command":"battery.full"})");
  ASSERT_TRUE(std::holds_alternative<ControlRequest>(full));
  EXPECT_FALSE(std::get<ControlRequest>(full).charge_Ah);
  EXPECT_NE(refusal(R"({"command":"battery.set"})"), "accepted");
  EXPECT_NE(refusal(R"({"command":"battery.set","charge_Ah":"full"})"), "accepted");
  EXPECT_NE(refusal(R"({"command":"battery.set","charge_Ah":1,"charge_std_Ah":[]})"), "accepted");
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

TEST(ControlRequest, LeasesAndOrdersAreTakenWithTheirNumbers) {
  const auto lease = std::get<ControlRequest>(
      parse_control(R"({"command":"motor.lease","holder":"pilot","priority":2,"timeout_s":0.5})"));
  EXPECT_EQ(lease.command, ControlCommand::motor_lease);
  EXPECT_EQ(lease.lease_request.holder, "pilot");
  EXPECT_EQ(lease.lease_request.priority, 2);
  EXPECT_EQ(lease.lease_request.timeout_s, 0.5);
  const auto usual = std::get<ControlRequest>(parse_control(R"({"command":"motor.lease","holder":"pilot"})"));
  EXPECT_EQ(usual.lease_request.priority, 1);
  EXPECT_EQ(usual.lease_request.timeout_s, 1);
  const auto order = std::get<ControlRequest>(parse_control(
      R"({"command":"motor.order","lease":"x","shaft_rpm":780,"fins_deg":[0,-5.5,5],"state_time":1700000000.125})"));
  EXPECT_EQ(order.lease, "x");
  EXPECT_EQ(order.order, (control::Order{780, {0, -5.5, 5}}));
  EXPECT_EQ(order.state_time_utc_s, 1700000000.125);
  const auto release = std::get<ControlRequest>(parse_control(R"({"command":"motor.release","lease":"x"})"));
  EXPECT_EQ(release.lease, "x");
}

TEST(ControlRequest, OrdersThatAreNoNumbersSayWhichIsNone) {
  EXPECT_EQ(refusal(R"({"command":"motor.lease"})"), "motor.lease needs a holder, a name");
  EXPECT_EQ(refusal(R"({"command":"motor.lease","holder":7})"), "motor.lease needs a holder, a name");
  EXPECT_EQ(refusal(R"({"command":"motor.lease","holder":"x","priority":1.5})"), "priority is a whole number");
  EXPECT_EQ(refusal(R"({"command":"motor.lease","holder":"x","timeout_s":"1"})"),
            "timeout_s is a number of seconds");
  EXPECT_EQ(refusal(R"({"command":"motor.order","shaft_rpm":1,"fins_deg":[0,0,0]})"),
            "lease is what motor.lease answered");
  const auto order = [](const std::string& rest) {
    return refusal(R"({"command":"motor.order","lease":"x",)" + rest);
  };
  EXPECT_EQ(order(R"("fins_deg":[0,0,0]})"), "shaft_rpm is a number");
  EXPECT_EQ(order(R"("shaft_rpm":"fast","fins_deg":[0,0,0]})"), "shaft_rpm is a number");
  EXPECT_EQ(order(R"("shaft_rpm":true,"fins_deg":[0,0,0]})"), "shaft_rpm is a number");
  EXPECT_EQ(order(R"("shaft_rpm":null,"fins_deg":[0,0,0]})"), "shaft_rpm is a number");
  EXPECT_EQ(order(R"("shaft_rpm":1})"), "fins_deg is three numbers");
  EXPECT_EQ(order(R"("shaft_rpm":1,"fins_deg":[0,0]})"), "fins_deg is three numbers");
  EXPECT_EQ(order(R"("shaft_rpm":1,"fins_deg":[0,0,null]})"), "fins_deg is three numbers");
  EXPECT_EQ(order(R"("shaft_rpm":1,"fins_deg":[0,0,0],"state_time":"now"})"),
            "state_time is the time of a STATE, a number");
  EXPECT_NE(order(R"("shaft_rpm":NaN,"fins_deg":[0,0,0]})").find("not a JSON object"), std::string::npos);
  EXPECT_NE(order(R"("shaft_rpm":1e999,"fins_deg":[0,0,0]})"), "accepted");
}

TEST(ControlRequest, APriorityBeyondEveryBoundStaysBeyondIt) {
  const auto priority = [](const std::string& number) {
    const auto parsed = parse_control(R"({"command":"motor.lease","holder":"x","priority":)" + number + "}");
    return std::get<ControlRequest>(parsed).lease_request.priority;
  };
  EXPECT_GT(priority("4294967297"), control::kMaxPriority);
  EXPECT_LT(priority("-4294967297"), 0);
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
