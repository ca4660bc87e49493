// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/cli/calibrate_command.h"

namespace navcal::cli::test {
namespace {

using Json = nlohmann::json;

/// Recordings of the simulator, calibrated by the program's own subcommands.
class CalibrateMotor : public CalibrateCommand {
 protected:
  /// The answer of `calibrate` for a mission, with or without a field of the motor's current.
  Json calibrated(const std::string& mission, const std::string& field, int seed, const std::string& seconds) {
    const auto capture = (folder_ / "a.cap").string();
    std::vector<std::string> arguments{"simulate",  "--mission", mission, "--seed", std::to_string(seed),
                                       "--seconds", seconds,     "-o",    capture};
    if (!field.empty()) arguments.insert(arguments.end(), {"--effects", write("effects.toml", field)});
    const Outcome simulated = run_command(add_simulate, arguments);
    EXPECT_EQ(simulated.status, 0) << simulated.message;
    const Outcome outcome = run({"--json", capture});
    EXPECT_EQ(outcome.status, 0) << outcome.message;
    return Json::parse(outcome.output, nullptr, false);
  }
};

TEST_F(CalibrateMotor, FindsTheFieldOfTheMotorsCurrent) {
  const std::vector<double> truth{0.9, -0.6, 1.1};
  const Json json = calibrated("identification",
                               "[motor_field]\nx_uT_per_A = 0.9\ny_uT_per_A = -0.6\nz_uT_per_A = 1.1\n", 3, "230");
  const Json motor = json["motor_current"];
  EXPECT_EQ(motor["accepted"], true) << motor;
  EXPECT_EQ(motor["reason"], "");
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double error = motor["slope_uT_per_A"][i].get<double>() - truth[i];
    EXPECT_LT(std::abs(error), 3 * motor["std"][i].get<double>()) << motor;
    square += error * error;
  }
  EXPECT_LT(std::sqrt(square), 0.1 * 1.54) << motor;
}

TEST_F(CalibrateMotor, ASteadyCurrentTellsNothing) {
  const Json motor = calibrated("survey", "", 1, "60")["motor_current"];
  EXPECT_EQ(motor["accepted"], false);
  EXPECT_TRUE(motor["slope_uT_per_A"].is_null()) << motor;
  EXPECT_NE(motor["reason"].get<std::string>().find("change the shaft speed"), std::string::npos) << motor;
}

}  // namespace
}  // namespace navcal::cli::test
