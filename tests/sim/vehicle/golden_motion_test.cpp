// SPDX-License-Identifier: Apache-2.0
// State of the reference vehicle after 150 s of a mission, by the code of 2026-11-27: a change of its
// equations or of the effects on it shows here.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "config/mission_file.h"
#include "sim/effects/document.h"
#include "sim/vehicle/mission_helm.h"
#include "sim/vehicle/simulated_motion.h"

namespace navcal::sim::testing {
namespace {

struct GoldenMotion {
  const char* mission;
  const char* effects;
  std::array<double, 15> state;  ///< position, Euler angles, u, v, w, p, q, r, specific force
};

class Golden : public ::testing::TestWithParam<GoldenMotion> {};

TEST_P(Golden, MotionIsWhatItWas) {
  const auto& [mission, toml, wanted] = GetParam();
  EffectSet effects;
  std::vector<config::Problem> problems;
  add_effects(toml, effects, problems);
  ASSERT_TRUE(problems.empty());
  const SimulatedMotion motion(
      config::VehicleSettings{},
      std::make_unique<MissionHelm>(config::VehicleSettings{}, config::load_mission(std::string(mission))),
      {.influencer = &effects});
  const State now = motion.at(150'000'000'000);
  std::array<double, 15> found{};
  auto out = found.begin();
  for (const Vector3& part :
       {now.position_m, now.euler_rad, now.velocity_body_m_s, now.rate_rad_s, now.specific_force_m_s2})
    out = std::copy(part.begin(), part.end(), out);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], wanted[i], 1e-7 * std::max(1.0, std::abs(wanted[i]))) << i;
  if (HasFailure()) ADD_FAILURE() << fmt::format("it is now {:.12g}", fmt::join(found, ", "));
}

INSTANTIATE_TEST_SUITE_P(
    Missions, Golden,
    ::testing::Values(
        GoldenMotion{"identification",
                     "",
                     {153.169909579, 30.3849207523, 1.50186825354, 0.0067559219896, 0.0102594550254,
                      0.474801467678, 0.855235141145, -0.00129249889591, 0.000469383213418, -0.00622395318039,
                      -0.00121113806792, 0.00338531402072, 0.115585200959, -0.0590353272682, -9.80915587734}},
        GoldenMotion{"survey",
                     "[thrust_scale]\nscale = -0.2\n[yaw_damping]\nper_s = 0.6\n[buoyancy]\nforce_N = 0.5\n"
                     "from_s = 20\n[water_current]\nnorth_m_s = 0.1\neast_m_s = -0.2\n",
                     {60.3406255769, -15.5998857849, 1.50086789063, 0.0063933805008, -0.013599877703,
                      3.14160227282, 1.08766449521, -9.02513639498e-05, -0.0147372735527, -0.00141638650369,
                      0.000387548084947, -6.4090079818e-05, -0.133384128825, -0.0625733003104, -9.8094062869}},
        GoldenMotion{"thesis4",
                     "[fin_gain]\nscale = 0.2\n[fin_lag]\ntau_s = 0.3\n[fin_backlash]\nwidth_deg = 3\n"
                     "[fin_offset]\nangle_deg = 2\n[elevator_offset]\nangle_deg = -1\n",
                     {93.4546803948, 64.0767057205, 0.14916054684, -0.0113387018992, 0.0221263503004,
                      0.377922335829, 0.95919650073, 0.00085577719377, -0.00367466106444, 0.00666561162875,
                      -0.0238527658922, -0.00451082450019, 0.216938005475, 0.106078138844, -9.78592341048}}));

}  // namespace
}  // namespace navcal::sim::testing
