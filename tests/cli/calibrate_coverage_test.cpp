// SPDX-License-Identifier: Apache-2.0
// Errors that `navcal calibrate` states, on missions of `navcal simulate`: how often they contain the truth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "tests/cli/calibrate_program.h"

namespace navcal::cli::test {
namespace {

using Json = nlohmann::json;

/// Errors in units of those stated.
struct Tally {
  int within_two = 0, count = 0;
  double square = 0, largest = 0;

  void add(const Json& value, const Json& std, double truth) {
    if (!value.is_number() || !std.is_number() || !(std.get<double>() > 0)) return;
    const double error = std::abs(value.get<double>() - truth) / std.get<double>();
    if (error <= 2) ++within_two;
    ++count;
    square += error * error;
    largest = std::max(largest, error);
  }
  [[nodiscard]] double share() const { return static_cast<double>(within_two) / count; }
  [[nodiscard]] double rms() const { return std::sqrt(square / count); }
};

class CalibrateCoverage : public CalibrateProgram {
 protected:
  void add(const std::string& mission, int seed) {
    output_of("simulate --mission " + mission + " --seed " + std::to_string(seed) + " -o a.cap");
    const Json json = calibrated("a.cap");
    std::filesystem::remove(folder_ / "a.cap");
    // Nominal missions: scale 1, no deviation, no iron, no delay beyond the configured latency.
    if (json["gyro"]["accepted"] == true) gyro_.add(json["gyro"]["scale"], json["gyro"]["scale_std"], 1);
    if (json["gyro_b"]["accepted"] == true) gyro_.add(json["gyro_b"]["scale"], json["gyro_b"]["scale_std"], 1);
    for (const char* name : {"B", "C", "D", "E"}) {
      if (json["compass"]["accepted"] != true) break;
      deviation_.add(json["compass"]["deviation_deg"][name], json["compass"]["deviation_std_deg"][name], 0);
    }
    const Json& magnetometer = json["magnetometer"];
    for (std::size_t i = 0; i < 3 && magnetometer["accepted"] == true; ++i) {
      iron_.add(magnetometer["offset_uT"][i], magnetometer["std"]["offset_uT"][i], 0);
    }
  }
  Tally gyro_, deviation_, iron_;
};

/// Few seeds: bounds are wide enough for chance, and narrow enough for errors twice as large as stated.
TEST_F(CalibrateCoverage, StatedErrorsContainTheTruthOnNominalMissions) {
  for (const char* mission : {"identification", "thesis2", "thesis5", "thesis6", "survey"}) {
    for (const int seed : {71, 72}) add(mission, seed);
  }
  struct Expected {
    std::string_view name;
    const Tally& tally;
  };
  for (const auto& [name, tally] :
       {Expected{"gyro scale", gyro_}, Expected{"deviation", deviation_}, Expected{"hard iron", iron_}}) {
    ASSERT_GE(tally.count, 12) << name;
    EXPECT_GE(tally.share(), 0.8) << name << ": " << tally.within_two << " of " << tally.count;
    EXPECT_LT(tally.rms(), 1.5) << name;
    EXPECT_LT(tally.largest, 4.5) << name;
  }
}

}  // namespace
}  // namespace navcal::cli::test
