// SPDX-License-Identifier: Apache-2.0
// Layouts of vehicles: what is read, what is written, and every kind of mistake by line and key.
#include "config/layout/layout_file.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace navcal::config {
namespace {

using LayoutProblems = std::vector<std::string>;

LayoutProblems layout_problems(const std::string& toml) {
  try {
    (void)parse_layout(toml, "v.toml");
    return {};
  } catch (const Error& error) {
    return error.problems();
  }
}

/// A body that is all right with these further lines; they begin at line 5.
std::string with_body(std::string_view lines) {
  return "[body]\nmass_kg = 10\ninertia_kg_m2 = [1, 2, 2]\nneutral = true\n" + std::string(lines);
}

constexpr std::string_view kThruster =
    "[[thruster]]\nname = \"a\"\nplace_m = [0, 0, 0]\ndirection = [1, 0, 0]\ncommand = \"percent\"\n"
    "table_command = [-100, 0, 100]\ntable_force_N = [-10, 0, 20]\n";

constexpr std::string_view kEverything = R"(
name = "all"
source = "a data sheet"
[water]
density_kg_m3 = 1025
[body]
source = "weighed"
mass_kg = 10
mass_kg_std = 0.1
mass_kg_range = [9, 11]
gravity_centre_m = [0, 0, 0.02]
buoyancy_centre_m = [0, 0, -0.01]
inertia_kg_m2 = [1, 2, 2, 0.1, 0, 0]
volume_m3 = 0.01
size_m = [1, 0.2, 0.3]
[added_mass]
matrix = [1, 2, 3, 4, 5, 6]
[added_mass.spheroid]
length_m = 1
diameter_m = 0.2
[added_mass.strips]
x_m = [-0.3, 0.3]
length_m = 0.6
width_m = [0.1, 0.2]
height_m = 0.3
[damping]
linear = [1, 0, 0, 0, 0, 0,  0, 2, 0, 0, 0, 0,  0, 0, 3, 0, 0.5, 0,  0, 0, 0, 4, 0, 0,  0, 0, 0, 0, 5, 0,
          0, 0, 0, 0, 0, 6]
linear_std = 0.2
quadratic = [1, 2, 3, 4, 5, 6]
lift = [0, 1, 1, 0, 0, 0]
[damping.axial]
coefficient = 0.3
area_m2 = 0.01
[damping.body_lift]
slope_per_rad = 0.6
area_m2 = 0.05
at_m = 0.05
[damping.cross_flow]
coefficient = 1.1
x_m = [-0.3, 0.3]
length_m = [0.6, 0.6]
width_m = 0.2
[damping.flow_axes]
lift_kg_m = [0, 100]
drag_kg_m = [2, 25]
side_kg_m = 20
roll_kg = -1
pitch_kg = [0, -50]
yaw_kg = 10
stall_deg = 20
[[thruster]]
name = "stern"
source = "tank test"
place_m = [-0.5, 0, 0]
direction = [1, 0, 0]
command = "rpm"
diameter_m = 0.1
KT = [0.4, -0.3, -0.1]
KQ = [0.04, -0.02]
limits = [-500, 1500]
reverse_efficiency = 0.6
torque_share = 0.5
hand = "left"
dead_band = 50
lag_s = 0.4
lag_s_std = 0.1
[[thruster]]
name = "bow"
place_m = [0.5, 0, 0]
direction = [0, 1, 0]
command = "us"
table_command = [1100, 1500, 1900]
table_force_N = [-30, 0, 40]
advance_loss_sqrtN_s_m = 1
torque_m = 0.01
[[surface]]
name = "rudder"
place_m = [-0.5, 0, 0]
normal = [0, 1, 0]
chord = [1, 0, 0]
area_m2 = 0.01
lift_slope_per_rad = 3
induced_drag = 1
drag = 0.01
stall_deg = 20
lag_s = 0.2
limit_deg = 25
[ballast]
place_m = [0.1, 0, 0]
range_N = [-3, 3]
rate_N_s = 0.1
[moving_mass]
name = "battery"
mass_kg = 3
place_m = [0, 0, 0.05]
axis = [1, 0, 0]
range_m = [-0.1, 0.1]
range_m_range = [-0.2, 0.2]
rate_m_s = 0.01
)";

TEST(LayoutFile, EverythingIsRead) {
  const Layout layout = parse_layout(kEverything, "v.toml");
  EXPECT_EQ(layout.name, "all");
  EXPECT_NEAR(layout.body.buoyancy_N, 1025 * 9.81 * 0.01, 1e-9);
  EXPECT_EQ(layout.added_mass.matrix_kg[7 * 4], 5);
  EXPECT_EQ(layout.added_mass.strips.height_m, (std::vector<double>{0.3, 0.3}));
  EXPECT_EQ(layout.damping.linear[2 * 6 + 4], 0.5);
  EXPECT_EQ(layout.damping.strips.height_m, (std::vector<double>{0.2, 0.2})) << "as high as wide";
  EXPECT_EQ(layout.damping.flow_axes->pitch_kg[1], -50);
  ASSERT_EQ(layout.thrusters.size(), 2U);
  EXPECT_TRUE(layout.thrusters[0].is_left_handed);
  EXPECT_EQ(layout.thrusters[1].high, 1900) << "the unit's own";
  EXPECT_EQ(layout.thrusters[1].neutral(), 1500);
  EXPECT_NEAR(layout.surfaces[0].limit_rad, 25 * 3.14159265358979 / 180, 1e-12);
  EXPECT_EQ(layout.ballasts[0].low_N, -3);
  EXPECT_EQ(layout.moving_masses[0].high_m, 0.1);
}

TEST(LayoutFile, ErrorsAndSourcesOfNumbersAreKept) {
  const Layout layout = parse_layout(kEverything, "v.toml");
  const std::vector<LayoutUncertainty> expected{{"body.mass_kg", 0.1, std::pair(9.0, 11.0)},
                                                {"damping.linear", 0.2, {}},
                                                {"thruster[1].lag_s", 0.1, {}},
                                                {"moving_mass[1].range_m", {}, std::pair(-0.2, 0.2)}};
  EXPECT_EQ(layout.uncertainties, expected);
  const std::vector<LayoutSource> sources{{"", "a data sheet"}, {"body", "weighed"}, {"thruster[1]", "tank test"}};
  EXPECT_EQ(layout.sources, sources);
}

TEST(LayoutFile, IsWrittenAndReadBackToTheLastBit) {
  const Layout layout = parse_layout(kEverything, "v.toml");
  EXPECT_EQ(parse_layout(layout_file(layout), "w.toml"), layout);
}

TEST(LayoutFile, InertiaAboutTheOriginIsMovedToTheCentreOfGravity) {
  const Layout layout = parse_layout(
      "[body]\nmass_kg = 10\ngravity_centre_m = [0.1, 0, 0.2]\ninertia_kg_m2 = [1, 2, 2]\n"
      "inertia_about = \"origin\"\nneutral = true\n",
      "v.toml");
  const std::array<double, 6> expected{1 - 10 * 0.04, 2 - 10 * 0.05, 2 - 10 * 0.01, 0, 10 * 0.02, 0};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(layout.body.inertia_kg_m2[i], expected[i], 1e-12) << i;
}

TEST(LayoutFile, WhatIsWrongIsSaidWithLineKeyUnitAndBounds) {
  EXPECT_EQ(layout_problems("name = \"v\"\n"),
            LayoutProblems{"v.toml:1: body: missing; a layout has a table [body]"});
  EXPECT_EQ(layout_problems(with_body("mass = 3\n")),
            LayoutProblems{"v.toml:5: body.mass: unknown key; did you mean mass_kg?"});
  EXPECT_EQ(layout_problems("[body]\nmass_kg = -1\ninertia_kg_m2 = [1, 2, 2]\nneutral = true\n"),
            LayoutProblems{"v.toml:2: body.mass_kg: -1 is out of range: 0.01 to 1000000 kg"});
  EXPECT_EQ(layout_problems(with_body("mass_kg_std = -1\n")),
            LayoutProblems{"v.toml:5: body.mass_kg_std: -1 is out of range: 0 to 999999.99 kg"});
  EXPECT_EQ(
      layout_problems(with_body("mass_kg_range = [12, 8]\n")),
      LayoutProblems{"v.toml:5: body.mass_kg_range: [LOW, HIGH] is expected, the first not above the second"});
  EXPECT_EQ(layout_problems(with_body("volume_m3 = 0.01\n")),
            LayoutProblems{"v.toml:5: body.volume_m3: exactly one of buoyancy_N (N), volume_m3 (m3) and neutral = "
                           "true is expected"});
  EXPECT_EQ(layout_problems(with_body("size_m = [1, 2]\n")),
            LayoutProblems{"v.toml:5: body.size_m: an array of 3 numbers (0 to 50 m) is expected, not 2"});
  EXPECT_EQ(layout_problems(with_body("gravity_centre_m = [0, 0, 60]\n")),
            LayoutProblems{"v.toml:5: body.gravity_centre_m: number 3 of it, 60, is out of range: -50 to 50 m"});
  EXPECT_EQ(layout_problems(with_body("gravity_centre_m = \"low\"\n")),
            LayoutProblems{"v.toml:5: body.gravity_centre_m: an array of 3 numbers (-50 to 50 m) is expected, not "
                           "the text \"low\""});
  EXPECT_EQ(layout_problems(with_body("[damping]\nlinear = [1, 2]\n")),
            LayoutProblems{"v.toml:6: damping.linear: 2 numbers; a diagonal has 6, a matrix row by row 36"});
  EXPECT_EQ(layout_problems(with_body("[damping.cross_flow]\ncoefficient = 1\nx_m = [0, 1]\nlength_m = 1\n"
                                      "width_m = [1, 2, 3]\n")),
            LayoutProblems{"v.toml:9: damping.cross_flow.width_m: 3 numbers, but 2 of x_m"});
  EXPECT_EQ(layout_problems(with_body("[added_mass.spheroid]\nlength_m = 1\ndiameter_m = 2\n")),
            LayoutProblems{"v.toml:7: added_mass.spheroid.diameter_m: 2 m is not less than the length, 1 m"});
}

TEST(LayoutFile, ActuatorsThatAreWrongAreNamed) {
  const std::string thruster(kThruster);
  EXPECT_EQ(layout_problems(with_body(thruster)), LayoutProblems{});
  EXPECT_EQ(layout_problems(with_body(thruster + thruster)),
            LayoutProblems{"v.toml:13: thruster[2].name: \"a\" is already the name of another actuator"});
  EXPECT_EQ(layout_problems(with_body(thruster + "direction_deg = 3\n")).size(), 1U);
  EXPECT_EQ(layout_problems(with_body(thruster + "limits = [50, -50]\n")),
            LayoutProblems{"v.toml:12: thruster[1].limits: the lower limit, 50, is above the upper one, -50"});
  EXPECT_EQ(layout_problems(with_body("[[thruster]]\nname = \"a\"\nplace_m = [0, 0, 0]\ndirection = [0, 0, 0]\n"
                                      "command = \"rmp\"\ndiameter_m = 0.1\nKT = [0.3]\nlimits = [0, 900]\n")),
            (LayoutProblems{"v.toml:8: thruster[1].direction: has no direction: all its numbers are zero",
                            "v.toml:9: thruster[1].command: unknown command \"rmp\"; did you mean rpm?"}));
  EXPECT_EQ(
      layout_problems(with_body("[[thruster]]\nname = \"a\"\nplace_m = [0, 0, 0]\ndirection = [1, 0, 0]\n"
                                "command = \"percent\"\ntable_command = [0, 0]\ntable_force_N = [0, 1, 2]\n")),
      (LayoutProblems{"v.toml:10: thruster[1].table_command: the commands do not increase",
                      "v.toml:11: thruster[1].table_force_N: 3 forces for 2 commands; two or more of each are "
                      "expected"}));
  EXPECT_EQ(
      layout_problems(with_body("[moving_mass]\nmass_kg = 12\nrange_m = [0, 1]\n")),
      LayoutProblems{"v.toml:6: moving_mass.mass_kg: 12 kg is not less than the mass of the body, 10 kg, which "
                     "it is part of"});
  EXPECT_EQ(
      layout_problems(with_body("[[surface]]\nname = \"s\"\nplace_m = [0, 0, 0]\nnormal = [0, 1, 0]\n"
                                "lift_slope_per_rad = 3\n")),
      LayoutProblems{"v.toml:5: surface[1].area_m2: missing; area that the coefficients count on (0 to 100 m2)"});
}

}  // namespace
}  // namespace navcal::config
