// SPDX-License-Identifier: Apache-2.0
// Files for simulators: every effect of the library is written, or left out with a reason.
// tests/cli/check_simulator_files.py reads the numbers back with readers of its own.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "report/simulators/transfer.h"
#include "sim/effects/effect_table.h"
#include "tests/report/gap_samples.h"
#include "tests/support/temporary_folder.h"

namespace navcal::report {
namespace {

gap::EffectFinding typical_finding(const sim::Effect& effect) {
  gap::EffectFinding finding{std::string(effect.description().name), 0.97, {}, {}};
  for (const auto& parameter : effect.description().parameters)
    finding.parameters.push_back({std::string(parameter.name), 0.3 * parameter.typical, 0.01});
  return finding;
}

CorrectedModel model_of(std::vector<gap::EffectFinding> effects) {
  CorrectedModel model;
  model.diagnosis.verdict = gap::Verdict::explained;
  model.diagnosis.effects = std::move(effects);
  model.diagnosis.field = gap::EarthField{};
  model.origin = "dives/a.cap";
  return model;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Parameters of a SITL file, "NAME value".
std::vector<std::string> parameters_of(const std::string& text) {
  std::vector<std::string> lines = lines_of(text);
  std::erase_if(lines, [](const std::string& line) { return line.empty() || line.front() == '#'; });
  return lines;
}

TEST(SimulatorExport, EveryEffectThatCanBeACauseHasARow) {
  for (const auto& entry : sim::effect_table()) {
    const bool is_cause = entry.make()->description().place != sim::EffectPlace::lines;
    const std::string_view text = representation_of(entry.name, Simulator::sitl).text;
    EXPECT_EQ(!text.starts_with("this version of navcal") && !text.starts_with("noise, clocks"), is_cause)
        << entry.name << ": a row in report/simulators/representation.cpp says how each simulator can have it";
  }
}

TEST(SimulatorExport, WhatTheTablePromisesIsWrittenAndTheRestHasAReason) {
  for (const auto& entry : sim::effect_table()) {
    const std::string name(entry.name);
    const CorrectedModel model = model_of({typical_finding(*entry.make())});
    for (const Simulator simulator : kSimulators) {
      const Representation cell = representation_of(name, simulator);
      const SimulatorFile file = simulator_file(simulator, model);
      EXPECT_FALSE(cell.text.empty());
      const std::string where = name + " in " + std::string(title_of(simulator)) + ": " + file.summary;
      if (cell.fidelity == Fidelity::none) {
        EXPECT_NE(file.summary.find("left out: " + name + " (" + std::string(cell.text) + ")"), std::string::npos)
            << where;
      } else {
        EXPECT_EQ(file.summary, name) << where;
      }
    }
  }
}

TEST(SimulatorExport, AnUnknownEffectIsLeftOut) {
  const CorrectedModel model = model_of({{"sea_monster", 0.99, {{"arms", 8, 1}}, {}}});
  for (const Simulator simulator : kSimulators) {
    const SimulatorFile file = simulator_file(simulator, model);
    EXPECT_NE(file.summary.find("left out: sea_monster (this version of navcal has no conversion"),
              std::string::npos)
        << file.summary;
  }
}

TEST(SimulatorExport, TheFileSaysWhereItComesFromHowSureItIsAndWhatIsMissing) {
  CorrectedModel model = model_of({});
  model.diagnosis = cli::test::explained_gap();
  for (const Simulator simulator : kSimulators) {
    std::string text;
    for (std::string line : lines_of(simulator_file(simulator, model).text)) {
      line.erase(0, line.find_first_not_of("# "));
      text += line + ' ';
    }
    for (const char* words : {"dives/a.cap", "explained", "navcal " NAVCAL_VERSION, "motor_field", "gyro_scale"})
      EXPECT_NE(text.find(words), std::string::npos) << words << '\n' << text;
    const bool has_gyro_scale = representation_of("gyro_scale", simulator).fidelity != Fidelity::none;
    EXPECT_EQ(text.find("97.3 %; scale ax 0.002 +- 0.020") != std::string::npos, has_gyro_scale) << text;
    EXPECT_EQ(text.find("may as well be fin_gain (6.4 nats apart)") != std::string::npos, has_gyro_scale);
    EXPECT_EQ(text.find("Left out: gyro_scale: ") == std::string::npos, has_gyro_scale);
  }
}

TEST(SimulatorExport, WithoutACertainEffectThereIsNoCorrection) {
  for (auto diagnosis : {cli::test::unknown_gap(), cli::test::no_gap()}) {
    diagnosis.effects = cli::test::explained_gap().effects;  // of another program: the verdict decides
    CorrectedModel model = model_of({});
    const std::string nominal = simulator_file(Simulator::holoocean, model).text;
    model.diagnosis = diagnosis;
    const SimulatorFile sitl = simulator_file(Simulator::sitl, model);
    EXPECT_TRUE(parameters_of(sitl.text).empty()) << sitl.text;
    EXPECT_EQ(sitl.summary.find("no correction: the verdict is "), 0U) << sitl.summary;
    const SimulatorFile stonefish = simulator_file(Simulator::stonefish, model);
    EXPECT_NE(stonefish.text.find("<scenario>\n</scenario>"), std::string::npos) << stonefish.text;
    auto scenario = nlohmann::json::parse(simulator_file(Simulator::holoocean, model).text);
    EXPECT_EQ(scenario["agents"][0]["actuator"], nlohmann::json::parse(nominal)["agents"][0]["actuator"]);
    EXPECT_EQ(scenario["agents"][0]["dynamics"], nlohmann::json::parse(nominal)["agents"][0]["dynamics"]);
  }
  CorrectedModel unknown = model_of({});
  unknown.diagnosis = cli::test::unknown_gap();
  EXPECT_NE(simulator_file(Simulator::sitl, unknown).summary.find("candidates: motor_field, adc_droop"),
            std::string::npos);
}

TEST(SimulatorExport, ValuesThatCannotBeAreLeftOut) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const CorrectedModel model =
      model_of({{"hard_iron", 1, {{"x_uT", 1e300, 1}, {"y_uT", 0, 1}, {"z_uT", 3, 0}}, {}},
                {"buoyancy", 1, {{"force_N", kNan, 1}}, {}},
                {"thrust_scale", 1, {}, {}},
                {"compass_lag", 1, {{"tau_s", 2, 0.1}}, {}},
                {"gps_latency", 1, {{"tau_s", 9, 0.1}}, {}}});
  const SimulatorFile sitl = simulator_file(Simulator::sitl, model);
  EXPECT_TRUE(parameters_of(sitl.text).empty()) << sitl.text;
  for (const char* words : {"hard_iron (x_uT lies between -200 and 200", "buoyancy (force_N is not determined)",
                            "compass_lag (SITL keeps readings of the compass for 490 ms only)",
                            "gps_latency (SITL keeps fixes for 3800 ms only)"})
    EXPECT_NE(sitl.summary.find(words), std::string::npos) << words << '\n' << sitl.summary;
  EXPECT_NE(simulator_file(Simulator::stonefish, model).summary.find("thrust_scale (scale is not determined)"),
            std::string::npos);
}

TEST(SimulatorExport, AMotorsFieldIsThatBeforeTheSoftIron) {
  const gap::EffectFinding motor{
      "motor_field", 1, {{"x_uT_per_A", 1, 0}, {"y_uT_per_A", 0, 0}, {"z_uT_per_A", 0, 0}}, {}};
  gap::EffectFinding iron{"soft_iron", 1, {}, {}};
  for (const char* name : {"xx", "yy", "zz", "xy", "xz", "yz"})
    iron.parameters.push_back({name, name == std::string("xx") ? 0.25 : 0.0, 0});
  const auto alone = parameters_of(simulator_file(Simulator::sitl, model_of({motor})).text);
  EXPECT_EQ(alone.front(), "SIM_MAG_MOT_X 10");
  const auto both = parameters_of(simulator_file(Simulator::sitl, model_of({motor, iron})).text);
  EXPECT_EQ(both.front(), "SIM_MAG_MOT_X 8");
  // A matrix without inverse is left out, and then the motor's field is not changed by it.
  for (auto& parameter : iron.parameters) parameter.value = 0.5;
  iron.parameters[0].value = iron.parameters[1].value = iron.parameters[2].value = -0.5;
  const SimulatorFile singular = simulator_file(Simulator::sitl, model_of({motor, iron}));
  EXPECT_EQ(parameters_of(singular.text).front(), "SIM_MAG_MOT_X 10") << singular.text;
  EXPECT_NE(singular.summary.find("soft_iron (1 + S has no inverse)"), std::string::npos) << singular.summary;
}

TEST(SimulatorExport, DeclinationNeedsAFieldOnlyWhereFieldsAreAdded) {
  CorrectedModel model = model_of({{"declination", 1, {{"angle_deg", 90, 1}}, {}}});
  model.diagnosis.field.reset();
  EXPECT_NE(simulator_file(Simulator::sitl, model).summary.find("the diagnosis states no field of the Earth"),
            std::string::npos);
  const auto scenario = nlohmann::json::parse(simulator_file(Simulator::holoocean, model).text);
  const auto& configuration = scenario["agents"][0]["sensors"].back()["configuration"];
  EXPECT_NEAR(configuration["MagneticVector"][0].get<double>(), 0, 1e-12);
  EXPECT_NEAR(configuration["MagneticVector"][1].get<double>(), -1, 1e-12);
  EXPECT_FALSE(configuration.contains("Sigma")) << "noise in uT has no meaning beside a unit vector";
}

TEST(SimulatorExport, TheNominalVehicleIsTheUsers) {
  CorrectedModel model =
      model_of({{"buoyancy", 1, {{"force_N", 9.81, 0.1}}, {}}, {"yaw_damping", 1, {{"per_s", 0.15, 0.01}}, {}}});
  model.vehicle.hull.mass_kg = 20;
  model.vehicle.damping.yaw_per_s = 0.35;
  model.instruments.imu.depth_noise_m = 0.5;
  EXPECT_NE(simulator_file(Simulator::stonefish, model).text.find("<mass value=\"19\"/>"), std::string::npos);
  const auto agent = nlohmann::json::parse(simulator_file(Simulator::holoocean, model).text)["agents"][0];
  EXPECT_DOUBLE_EQ(agent["dynamics"]["mass"].get<double>(), 20);
  EXPECT_DOUBLE_EQ(agent["dynamics"]["T_yaw"].get<double>(), 2);
  EXPECT_DOUBLE_EQ(agent["sensors"][2]["configuration"]["Sigma"].get<double>(), 0.5);
  model.vehicle.hull.mass_kg = 0.5;
  model.vehicle.damping.yaw_per_s = -0.15;
  EXPECT_NE(simulator_file(Simulator::stonefish, model).summary.find("buoyancy (the mass would not be positive)"),
            std::string::npos);
  EXPECT_NE(simulator_file(Simulator::holoocean, model).summary.find("yaw_damping (damping that is not positive"),
            std::string::npos);
}

TEST(SimulatorExport, AnyTextStaysWithinItsComment) {
  CorrectedModel model = model_of({});
  model.diagnosis = cli::test::hostile_gap();
  model.diagnosis.verdict = gap::Verdict::explained;
  model.diagnosis.sentence += "--><scenario>\nSIM_SPEEDUP 9\n";
  model.origin = "\nSIM_SPEEDUP 9\r\xff--->";
  const SimulatorFile sitl = simulator_file(Simulator::sitl, model);
  EXPECT_TRUE(parameters_of(sitl.text).empty()) << sitl.text;
  for (const std::string& line : lines_of(sitl.text)) EXPECT_LT(line.size(), 98U);
  const std::string xml = simulator_file(Simulator::stonefish, model).text;
  const std::size_t end = xml.find("<scenario>\n</scenario>\n");
  ASSERT_NE(end, std::string::npos) << xml;
  std::size_t comments = 0;
  for (std::size_t at = 0; (at = xml.find("--", at)) != std::string::npos; at += 2) ++comments;
  EXPECT_EQ(comments % 2, 0U) << xml;
  EXPECT_TRUE(nlohmann::json::accept(simulator_file(Simulator::holoocean, model).text));
}

TEST(SimulatorExport, LinesOfCommentsKeepTheirWidth) {
  EXPECT_EQ(comment_lines("one two three", "# ", 9), "# one two\n# three\n");
  EXPECT_EQ(comment_lines("abcdefghij k", "# ", 6), "# abcd\n# efgh\n# ij k\n");
  EXPECT_EQ(comment_lines("", "# ", 6), "");
}

std::string table_of(Simulator simulator) {
  std::map<std::string, std::string> rows;
  for (const auto& entry : sim::effect_table()) {
    if (entry.make()->description().place == sim::EffectPlace::lines) continue;
    const Representation cell = representation_of(entry.name, simulator);
    const char* const word = cell.fidelity == Fidelity::exact         ? "exact"
                             : cell.fidelity == Fidelity::approximate ? "approximate"
                                                                      : "not representable";
    const std::string name(entry.name);
    rows[name] = "| `" + name + "` | " + word + " | " + std::string(cell.text) + " |\n";
  }
  std::string text = "| effect | representation | how, or why not |\n|---|---|---|\n";
  for (const auto& [name, row] : rows) text += row;
  return text;
}

TEST(SimulatorExport, TheTablesAreThoseOfTheDocumentation) {
  const std::string page = test::read_file(NAVCAL_SOURCE_DIR "/docs/simulator-export.md");
  for (const Simulator simulator : kSimulators)
    EXPECT_NE(page.find(table_of(simulator)), std::string::npos) << "put this into docs/simulator-export.md:\n"
                                                                 << table_of(simulator);
}

TEST(SimulatorExport, SimulatorsHaveNames) {
  for (const Simulator simulator : kSimulators) EXPECT_EQ(simulator_named(name_of(simulator)), simulator);
  EXPECT_FALSE(simulator_named("gazebo"));
}

}  // namespace
}  // namespace navcal::report
