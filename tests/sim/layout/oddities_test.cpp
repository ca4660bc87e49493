// SPDX-License-Identifier: Apache-2.0
// Oddities of a layout are named with their keys.
#include <gtest/gtest.h>

#include <functional>

#include "sim/layout/assessment/assessment.h"
#include "sim/layout/layout_of.h"

namespace navcal::sim::testing {
namespace {

using Change = std::function<void(config::Layout&)>;

std::string oddities(const Change& change) {
  config::Layout layout = layout_of({});
  change(layout);
  std::string all;
  for (const Oddity& oddity : assess(layout).odd) all += oddity.key + ": " + oddity.message + "\n";
  return all;
}

void expect_odd(const Change& change, std::string_view key, std::string_view words) {
  const std::string all = oddities(change);
  EXPECT_NE(all.find(std::string(key) + ": "), std::string::npos) << all;
  EXPECT_NE(all.find(words), std::string::npos) << all;
}

TEST(LayoutOddities, TheReferenceVehicleHasNone) {
  EXPECT_EQ(oddities([](config::Layout&) {}), "");
}

TEST(LayoutOddities, AreFoundInTheFile) {
  expect_odd([](auto& l) { l.body.buoyancy_N *= 0.8; }, "body.buoyancy_N", "it cannot float");
  expect_odd([](auto& l) { l.body.buoyancy_N *= 1.3; }, "body.buoyancy_N", "it cannot sink");
  expect_odd([](auto& l) { l.body.buoyancy_N *= 1000; }, "body.buoyancy_N", "off by a thousand");
  expect_odd([](auto& l) { l.body.inertia_kg_m2[2] = 2; }, "body.inertia_kg_m2", "exceeds the sum of the others");
  expect_odd([](auto& l) { l.body.inertia_kg_m2[3] = 0.2; }, "body.inertia_kg_m2", "not positive");
  expect_odd([](auto& l) { l.body.inertia_kg_m2 = {3, 3, 3, 0, 0, 0}; }, "body.inertia_kg_m2",
             "radius of gyration");
  expect_odd([](auto& l) { l.body.inertia_kg_m2[1] /= 1000; }, "body.inertia_kg_m2", "off by a thousand");
  expect_odd([](auto& l) { l.body.size_m = {0.3, 0.03, 0.03}; }, "body.size_m", "are displaced");
  expect_odd([](auto& l) { l.added_mass.matrix_kg[7] = -1; }, "added_mass.matrix", "smallest eigenvalue is -1");
  expect_odd([](auto& l) { l.added_mass.matrix_kg[1] = 0.1; }, "added_mass.matrix", "not symmetric");
  expect_odd([](auto& l) { l.added_mass.matrix_kg[7] *= 1000; }, "added_mass.matrix", "off by a thousand");
  expect_odd([](auto& l) { l.thrusters[0].direction = {3, 0, 0}; }, "thruster[1].direction", "length is 3");
  expect_odd([](auto& l) { l.surfaces[1].chord = {1, 1, 0}; }, "surface[2].normal", "not 90");
  expect_odd([](auto& l) { l.thrusters[0].place_m = {-455, 0, 0}; }, "thruster[1].place_m", "455 m");
}

TEST(LayoutOddities, AreFoundInTheMotion) {
  expect_odd([](auto& l) { l.body.gravity_centre_m[2] = -0.01; }, "body.gravity_centre_m", "unstable in roll");
  expect_odd([](auto& l) { l.damping.linear[21] = -0.3; }, "damping", "roll at 0.5 rad/s is driven");
  expect_odd([](auto& l) { l.damping.axial_coefficient = 0, l.surfaces.clear(); }, "damping",
             "nothing brakes surge");
  expect_odd(
      [](auto& l) {
        l.damping.axial_coefficient = 0;
        l.surfaces.clear();
        l.thrusters[0].KT = {0.3};
      },
      "damping", "no terminal speed");
  expect_odd(
      [](auto& l) {
        l.body.gravity_centre_m[2] = 1e-4;
        l.thrusters[0].torque_share = 1;
      },
      "thruster", "it spins");
  expect_odd([](auto& l) { l.thrusters.push_back(l.thrusters[0]); }, "thruster", "singular: 5 actuators, rank 4");
  expect_odd([](auto& l) { l.thrusters.clear(), l.surfaces.clear(); }, "thruster", "no actuators");
}

TEST(LayoutOddities, AMassMatrixThatIsNotPositiveCannotBeSimulated) {
  config::Layout layout = layout_of({});
  layout.added_mass.matrix_kg[14] = -50;
  const Assessment found = assess(layout);
  EXPECT_NE(found.cannot_simulate.find("not positive definite"), std::string::npos);
  EXPECT_TRUE(found.motions.empty());
}

}  // namespace
}  // namespace navcal::sim::testing
