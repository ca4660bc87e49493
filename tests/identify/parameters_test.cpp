// SPDX-License-Identifier: Apache-2.0
#include "identify/parameters.h"

#include <gtest/gtest.h>

#include <cmath>

#include "config/error.h"
#include "config/layout/layout_file.h"

namespace navcal::identify {
namespace {

config::Layout layout_with(const std::string& body, const std::string& rest = "") {
  return config::parse_layout("[body]\nmass_kg = 10\ninertia_kg_m2 = [1, 2, 2]\n" + body + rest, "v.toml");
}

TEST(IdentifyParameters, AreWhatTheFileSaysIsUncertain) {
  const auto layout = layout_with(
      "mass_kg_std = 0.1\nneutral = true\ngravity_centre_m = [0, 0, 0.02]\ngravity_centre_m_std = [0.001, 0, "
      "0.002]\n",
      "[damping]\nlinear = [1, 2, 0, 0, 0, 3]\nlinear_std = 0.5\nquadratic = [1, 2, 3, 4, 5, 6]\n"
      "quadratic_std = [0.1, 0, 0, 0, 0, 0.6]\n[damping.axial]\ncoefficient = 0.3\ncoefficient_range = [0.2, "
      "0.4]\n"
      "area_m2 = 0.01\n");
  const auto parameters = uncertain_parameters(layout);
  std::vector<std::string> names;
  for (const Parameter& one : parameters) names.push_back(one.name);
  EXPECT_EQ(names, (std::vector<std::string>{"body.mass_kg", "body.gravity_centre_m.x", "body.gravity_centre_m.z",
                                             "damping.linear.surge", "damping.linear.sway", "damping.linear.yaw",
                                             "damping.quadratic.surge", "damping.quadratic.yaw",
                                             "damping.axial.coefficient"}));
  EXPECT_EQ(parameters[1].prior, 0);
  EXPECT_EQ(parameters[1].prior_std, 0.001);
  EXPECT_NEAR(parameters[8].prior_std, 0.2 / std::sqrt(12), 1e-12);
  EXPECT_EQ(parameters[8].low, 0.2);
  EXPECT_EQ(parameters[8].high, 0.4);
}

TEST(IdentifyParameters, BuoyancyFollowsMassWhereTheFileSaysSo) {
  const auto layout = layout_with("mass_kg_std = 0.1\nneutral = true\n");
  const auto parameters = uncertain_parameters(layout);
  const auto heavier = with_values(layout, parameters, Eigen::VectorXd::Constant(1, 11));
  EXPECT_NEAR(heavier.body.buoyancy_N, heavier.weight_N(), 1e-9);
  const auto stated = layout_with("mass_kg_std = 0.1\nbuoyancy_N = 98\n");
  EXPECT_EQ(with_values(stated, uncertain_parameters(stated), Eigen::VectorXd::Constant(1, 11)).body.buoyancy_N,
            98);
}

TEST(IdentifyParameters, ElementsAcrossTheDiagonalOfAddedMassAreOneNumber) {
  const std::string zeros = "0,0,0,0,0,0,";
  const auto layout =
      layout_with("neutral = true\n", "[added_mass]\nmatrix = [1,0,0,0,0,0, 0,2,0,0,0,0.5, " + zeros + zeros +
                                          zeros + "0,0.5,0,0,0,3]\nmatrix_std = 0.1\n");
  const auto parameters = uncertain_parameters(layout);
  ASSERT_EQ(parameters.size(), 4U);
  EXPECT_EQ(parameters[2].name, "added_mass.matrix.sway_yaw");
  Eigen::VectorXd values = prior_values(parameters);
  values[2] = 0.7;
  const auto moved = with_values(layout, parameters, values);
  EXPECT_EQ(moved.added_mass.matrix_kg[11], 0.7);
  EXPECT_EQ(moved.added_mass.matrix_kg[31], 0.7);
}

TEST(IdentifyParameters, EstimatesSurviveTheFile) {
  const auto layout = layout_with(
      "mass_kg_std = 0.1\nneutral = true\n",
      "[damping]\nlinear = [1, 2, 0, 0, 0, 3]\nlinear_std = 0.5\n[[surface]]\nname = "
      "\"fin\"\nplace_m = [0, 0, 0]\n"
      "normal = [0, 1, 0]\narea_m2 = 0.01\nlift_slope_per_rad = 3\nstall_deg = 20\nstall_deg_std = 2\n");
  const auto parameters = uncertain_parameters(layout);
  const Eigen::VectorXd values = prior_values(parameters) * 1.1, stds = prior_stds(parameters) * 0.3;
  const auto again =
      config::parse_layout(config::layout_file(with_estimates(layout, parameters, values, stds)), "w");
  const auto read = uncertain_parameters(again);
  ASSERT_EQ(read.size(), parameters.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].name, parameters[i].name);
    EXPECT_NEAR(read[i].prior, values[static_cast<Eigen::Index>(i)], 1e-9) << read[i].name;
    EXPECT_NEAR(read[i].prior_std, stds[static_cast<Eigen::Index>(i)], 1e-9) << read[i].name;
  }
  EXPECT_TRUE(again.body.is_neutral);
}

TEST(IdentifyParameters, WrongNumbersOfErrorsAreSaid) {
  try {
    layout_with("neutral = true\ngravity_centre_m = [0, 0, 1]\ngravity_centre_m_std = [1, 2]\n");
    FAIL();
  } catch (const config::Error& error) {
    EXPECT_NE(std::string(error.what()).find("v.toml:6: body.gravity_centre_m_std: one number or 3 are expected"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace navcal::identify
