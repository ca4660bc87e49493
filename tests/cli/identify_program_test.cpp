// SPDX-License-Identifier: Apache-2.0
// navcal identify on a capture of navcal simulate, which is a simulator of its own (its vehicle and the emulated
// instruments).
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "config/layout/layout_file.h"
#include "tests/cli/program_in_folder.h"

namespace navcal::cli {
namespace {

class IdentifyProgram : public test::ProgramInFolder {
 protected:
  /// The reference vehicle with drag, thrust and one mass that are wrong and uncertain.
  void write_prior() {
    config::Layout prior = config::load_layout(NAVCAL_SOURCE_DIR "/share/vehicles/reference.toml");
    prior.damping.axial_coefficient = 0.36;
    prior.damping.linear[21] *= 1.2;
    prior.added_mass.matrix_kg[0] *= 1.2;
    prior.uncertainties = {{"damping.axial.coefficient", 0.06, {}},
                           {"damping.linear", {}, {}, {0, 0, 0, 0.01, 0, 0}},
                           {"added_mass.matrix", {}, {}, {0.03, 0, 0, 0, 0, 0}}};
    std::ofstream(folder_ / "prior.toml") << config::layout_file(prior);
  }
};

TEST_F(IdentifyProgram, FindsTheNumbersOfTheSimulatedVehicle) {
  write_prior();
  ASSERT_EQ(run_navcal("simulate --mission identification --seconds 60 --seed 5 -o a.cap"), 0) << said("err");
  ASSERT_EQ(run_navcal("simulate --mission identification --seconds 60 --seed 6 -o b.cap"), 0) << said("err");
  ASSERT_EQ(run_navcal("identify --vehicle prior.toml --holdout b.cap --holdout a.cap -o fit.toml --json fit.json "
                       "--report fit.html a.cap"),
            0)
      << said("err");
  const auto json = nlohmann::json::parse(said("fit.json"));
  const auto expect_near = [&](const std::string& name, double truth) {
    const auto& one = json.at("parameters").at(name);
    EXPECT_LT(std::abs(one.at("value").get<double>() - truth), 4 * one.at("std").get<double>()) << name;
    EXPECT_EQ(one.at("identified").get<bool>(),
              one.at("std").get<double>() <= one.at("prior_std").get<double>() / 2);
  };
  const config::Layout truth = config::load_layout(NAVCAL_SOURCE_DIR "/share/vehicles/reference.toml");
  expect_near("damping.axial.coefficient", truth.damping.axial_coefficient);
  expect_near("damping.linear.roll", truth.damping.linear[21]);
  expect_near("added_mass.matrix.surge", truth.added_mass.matrix_kg[0]);
  EXPECT_TRUE(json.at("parameters").at("damping.linear.roll").at("identified").get<bool>());
  EXPECT_LT(json.at("held_out").at("after").get<double>(), json.at("held_out").at("before").get<double>());
  EXPECT_TRUE(json.at("predictions").empty()) << "the fixes measure the velocity nowhere for long enough";
  const config::Layout fitted = config::load_layout(folder_ / "fit.toml");
  EXPECT_NEAR(fitted.damping.linear[21], json.at("parameters").at("damping.linear.roll").at("value").get<double>(),
              1e-12);
  EXPECT_EQ(fitted.uncertainties.size(), 3U);
  EXPECT_NE(said("fit.html").find("Fitted numbers"), std::string::npos);
  EXPECT_NE(said("out").find("held-out recordings"), std::string::npos) << said("out");
  EXPECT_NE(said("err").find("s of it are in a.cap as well, so it is left out"), std::string::npos) << said("err");
}

// A survey hardly tells the front thrusters from the rear ones. Two searches end far apart there.
TEST_F(IdentifyProgram, StandardErrorsContainWhatTwoSearchesDisagreeOn) {
  const std::string vehicle = "--vehicle " NAVCAL_SOURCE_DIR "/share/vehicles/bluerov2-heavy.toml";
  ASSERT_EQ(run_navcal("simulate --mission survey --seconds 30 --seed 3 -o a.cap " + vehicle), 0) << said("err");
  ASSERT_EQ(run_navcal("identify --no-advice -o fit.toml --json fit.json a.cap " + vehicle), 0) << said("err");
  const auto parameters = nlohmann::json::parse(said("fit.json")).at("parameters");
  for (const auto& [name, one] : parameters.items()) {
    // The simulated vehicle is that of the file.
    EXPECT_LT(std::abs(one.at("value").get<double>() - one.at("prior").get<double>()),
              5 * one.at("std").get<double>())
        << name;
  }
}

// Recordings of a vehicle that is not that of the others.
TEST_F(IdentifyProgram, ALayoutThatIsWorseThanTheFileIsNotWritten) {
  config::Layout prior = config::load_layout(NAVCAL_SOURCE_DIR "/share/vehicles/reference.toml");
  prior.uncertainties = {{"damping.axial.coefficient", 0.2, {}}};
  std::ofstream(folder_ / "prior.toml") << config::layout_file(prior);
  ASSERT_EQ(
      run_navcal("simulate --mission identification --seconds 25 --seed 5 --effect thrust_scale=-8 -o a.cap"), 0)
      << said("err");
  ASSERT_EQ(run_navcal("simulate --mission identification --seconds 25 --seed 6 -o b.cap"), 0) << said("err");
  const std::string identify = "identify --no-advice --vehicle prior.toml --holdout b.cap -o fit.toml a.cap";
  EXPECT_EQ(run_navcal(identify), 1) << said("out");
  EXPECT_NE(said("err").find("fit.toml is not written: on the held-out recordings its "), std::string::npos)
      << said("err");
  EXPECT_NE(said("out").find("damping.axial.coefficient"), std::string::npos) << "the answer is shown";
  EXPECT_FALSE(std::filesystem::exists(folder_ / "fit.toml"));
  EXPECT_EQ(run_navcal(identify + " --force"), 0) << said("err");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "fit.toml"));
}

TEST_F(IdentifyProgram, ALayoutIsJudgedByItsPredictions) {
  write_prior();
  ASSERT_EQ(run_navcal("simulate --mission identification --seconds 60 --seed 5 -o a.cap"), 0) << said("err");
  ASSERT_EQ(run_navcal("vehicle predict " NAVCAL_SOURCE_DIR
                       "/share/vehicles/reference.toml a.cap --fit a.cap --json p.json"),
            0)
      << said("err");
  EXPECT_NE(said("out").find("quadratic"), std::string::npos) << said("out");
  const auto json = nlohmann::json::parse(said("p.json"));
  ASSERT_EQ(json.at("horizons").size(), 3U);
  const auto& after_1_s = json.at("horizons")[0];
  EXPECT_EQ(after_1_s.at("s").get<double>(), 1);
  EXPECT_GT(after_1_s.at("starts").get<int>(), 0);
  const auto& errors = after_1_s.at("velocity_m_s");
  EXPECT_LT(errors.at("layout").get<double>(), errors.at("still").get<double>());
  EXPECT_TRUE(errors.at("quadratic").is_number());
  EXPECT_EQ(run_navcal("vehicle predict prior.toml a.cap --json a.cap"), 2);
}

TEST_F(IdentifyProgram, NeverOverwritesAnInput) {
  write_prior();
  const std::string before = said("prior.toml");
  std::ofstream(folder_ / "a.cap") << "";
  EXPECT_EQ(run_navcal("identify --vehicle prior.toml -o prior.toml a.cap"), 2);
  EXPECT_EQ(said("prior.toml"), before);
}

TEST_F(IdentifyProgram, MissingCommandsAreBadInput) {
  ASSERT_EQ(run_navcal("simulate --mission identification --seconds 20 --seed 5 -o a.cap"), 0) << said("err");
  config::Layout prior = config::load_layout(NAVCAL_SOURCE_DIR "/share/vehicles/bluerov2-heavy.toml");
  prior.uncertainties = {{"body.mass_kg", 0.3, {}}};
  std::ofstream(folder_ / "rov.toml") << config::layout_file(prior);
  EXPECT_EQ(run_navcal("identify --vehicle rov.toml -o fit.toml a.cap"), 3);
  EXPECT_NE(said("err").find(
                "a.cap: commands are missing: thruster front_starboard needs output1; the recording has fin_1"),
            std::string::npos)
      << said("err");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "fit.toml"));
}

TEST_F(IdentifyProgram, ALayoutWithNothingUncertainIsBadInput) {
  ASSERT_EQ(run_navcal("simulate --mission identification --seconds 20 --seed 5 -o a.cap"), 0) << said("err");
  EXPECT_EQ(
      run_navcal("identify --vehicle '" NAVCAL_SOURCE_DIR "/share/vehicles/reference.toml' -o fit.toml a.cap"), 3);
  EXPECT_NE(said("err").find("states no uncertain number"), std::string::npos) << said("err");
}

}  // namespace
}  // namespace navcal::cli
