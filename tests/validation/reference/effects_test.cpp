// SPDX-License-Identifier: Apache-2.0
#include "validation/reference/effects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

namespace navcal::reference::testing {
namespace {

std::vector<EffectKind> all_kinds() {
  std::vector<EffectKind> kinds(library_effects().begin(), library_effects().end());
  kinds.insert(kinds.end(), foreign_effects().begin(), foreign_effects().end());
  return kinds;
}

std::string refusal(const Effect& effect) {
  ParameterDeviations deviations;
  try {
    add(effect, deviations);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Effects, TheLibraryIsHeldWhole) {
  const std::set<std::string_view> expected{"hard_iron",         "soft_iron",          "compass_misalignment",
                                            "declination",       "motor_field",        "magnetic_hysteresis",
                                            "mag_temperature",   "compass_lag",        "tilt_slosh",
                                            "tilt_offset",       "gyro_scale",         "gyro_temperature",
                                            "gyro_drift",        "gyro_g_sensitivity", "gyro_cross_axis",
                                            "gyro_nonlinearity", "accel_bias",         "accel_scale",
                                            "accel_vibration",   "adc_droop",          "imu_latency",
                                            "depth_scale",       "depth_temperature",  "gps_latency",
                                            "gps_lever_arm",     "water_current",      "thrust_scale",
                                            "fin_offset",        "elevator_offset",    "fin_lag",
                                            "fin_gain",          "fin_backlash",       "yaw_damping",
                                            "buoyancy"};
  std::set<std::string_view> names;
  for (const EffectKind& kind : library_effects()) names.insert(kind.name);
  EXPECT_EQ(names, expected);
  EXPECT_EQ(library_effects().size(), expected.size());
  EXPECT_GE(foreign_effects().size(), 10U);
  for (const EffectKind& kind : foreign_effects()) EXPECT_FALSE(expected.contains(kind.name)) << kind.name;
}

TEST(Effects, EveryParameterHasAPlaceOfItsOwn) {
  std::set<const double*> places;
  ParameterDeviations deviations;
  std::size_t parameters = 0;
  for (const EffectKind& kind : all_kinds()) {
    EXPECT_EQ(kind.parameters.size() % kind.size.group, 0U) << kind.name;
    EXPECT_GT(kind.size.typical, 0) << kind.name;
    for (std::size_t i = 0; i < kind.parameters.size(); ++i) {
      const double* place = kind.field(deviations) + i;
      EXPECT_TRUE(places.insert(place).second) << kind.name << " " << kind.parameters[i];
      const auto* byte = reinterpret_cast<const char*>(place);
      EXPECT_GE(byte, reinterpret_cast<const char*>(&deviations));
      EXPECT_LE(byte + sizeof(double), reinterpret_cast<const char*>(&deviations + 1));
      ++parameters;
    }
  }
  EXPECT_EQ(parameters, places.size());
}

TEST(Effects, WhatIsDrawnHasItsStrengthInEachOfItsVectors) {
  Rng dice(5, 1);
  for (const EffectKind& kind : all_kinds()) {
    for (const double strength : {1.0, -0.2, 3.0}) {
      const Effect effect = drawn(kind, strength, dice);
      ASSERT_EQ(effect.parameters.size(), kind.parameters.size());
      for (std::size_t first = 0; first < kind.parameters.size(); first += kind.size.group) {
        double squares = 0;
        for (std::size_t i = 0; i < kind.size.group; ++i) {
          const double value = effect.parameters.at(std::string(kind.parameters[first + i]));
          squares += value * value * (kind.size.symmetric && i >= 3 ? 2 : 1);
          if (kind.size.sign != Sign::either) {
            EXPECT_GE(value, 0) << kind.name;
          }
        }
        EXPECT_NEAR(std::sqrt(squares), std::abs(strength) * kind.size.typical, 1e-12) << kind.name;
      }
      ParameterDeviations deviations;
      EXPECT_NO_THROW(add(effect, deviations)) << kind.name;
    }
  }
}

TEST(Effects, DirectionsAreDrawnAllRound) {
  Rng dice(6, 1);
  const EffectKind& iron = *find_effect("hard_iron");
  Vector3 sum = Vector3::Zero(), squares = Vector3::Zero();
  constexpr int kDraws = 3000;
  for (int i = 0; i < kDraws; ++i) {
    ParameterDeviations deviations;
    add(drawn(iron, 1, dice), deviations);
    sum += deviations.compass.hard_iron_uT;
    squares += deviations.compass.hard_iron_uT.cwiseAbs2();
  }
  const double sigma = 2 / std::sqrt(3.0);
  EXPECT_LT((sum / kDraws).cwiseAbs().maxCoeff(), 5 * sigma / std::sqrt(kDraws));
  EXPECT_LT((squares / kDraws / (sigma * sigma) - Vector3::Ones()).cwiseAbs().maxCoeff(), 0.1);
}

TEST(Effects, AddToEachOther) {
  ParameterDeviations deviations;
  add({"fin_offset", {{"angle_deg", 1}}}, deviations);
  add({"fin_offset", {{"angle_deg", 0.5}}}, deviations);
  EXPECT_NEAR(deviations.vehicle.rudder_rad, 0.026179938779914945, 1e-15);
}

TEST(Effects, WhatCannotBeIsRefusedWithAReason) {
  const std::string unknown = refusal({"hard_irno", {{"x_uT", 1}}});
  EXPECT_NE(unknown.find("hard_irno"), std::string::npos);
  EXPECT_NE(unknown.find("hard_iron"), std::string::npos);
  EXPECT_NE(unknown.find("fouling"), std::string::npos);
  const std::string parameter = refusal({"hard_iron", {{"x", 1}}});
  EXPECT_NE(parameter.find("x_uT, y_uT, z_uT"), std::string::npos);
  EXPECT_NE(refusal({"fin_lag", {{"tau_s", -0.1}}}).find("negative"), std::string::npos);
  EXPECT_NE(refusal({"buoyancy", {{"force_N", std::nan("")}}}).find("finite"), std::string::npos);
  EXPECT_EQ(refusal({"buoyancy", {}}), "");
}

TEST(Effects, LooseningSpreadsEachParameterByItsTypicalStrength) {
  Rng dice(7, 1);
  constexpr int kVehicles = 400;
  for (const EffectKind& kind : library_effects()) {
    double squares = 0;
    Rng own = dice;
    for (int i = 0; i < kVehicles; ++i) {
      ParameterDeviations deviations;
      apply_tolerance(0.02, deviations, own);
      squares += std::pow(*kind.field(deviations) / kind.size.si / (0.02 * kind.size.typical), 2);
      if (kind.size.sign == Sign::not_negative) {
        ASSERT_GE(*kind.field(deviations), 0) << kind.name;
      }
    }
    EXPECT_NEAR(squares / kVehicles, 1, 5 * std::sqrt(2.0 / kVehicles)) << kind.name;
  }
  ParameterDeviations deviations;
  apply_tolerance(0.02, deviations, dice);
  for (const EffectKind& kind : foreign_effects()) {
    for (std::size_t i = 0; i < kind.parameters.size(); ++i) EXPECT_EQ(kind.field(deviations)[i], 0) << kind.name;
  }
}

TEST(Effects, TheHullIsLoosenedByParts) {
  Rng dice(8, 1);
  Hull hull;
  apply_tolerance(0.02, hull, dice);
  EXPECT_NE(hull.axial_drag, Hull{}.axial_drag);
  EXPECT_NEAR(hull.axial_drag, Hull{}.axial_drag, 0.1 * Hull{}.axial_drag);
  EXPECT_EQ(hull.length_m, Hull{}.length_m);
  EXPECT_LT(hull.thrust_per_advance, 0);
}

}  // namespace
}  // namespace navcal::reference::testing
