// SPDX-License-Identifier: Apache-2.0
#include "identify/replay/instrument_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/angles.h"
#include "base/gravity.h"
#include "identify/filter/filtered_replay.h"
#include "sim/effects/effect_table.h"
#include "tests/identify/identification_case.h"

namespace navcal::identify {
namespace {

/// An effect of the simulator with one parameter that is not zero.
InstrumentErrors errors_by(std::string_view name, std::size_t parameter, double value) {
  std::vector<double> values(parameter + 1);
  values[parameter] = value;
  return InstrumentErrors({{name, values}});
}

MotionPoint turning() {
  MotionPoint point;
  point.body.euler_rad = {0.1, -0.2, 0.7};
  point.body.velocity << 0.5, 0.1, 0, 0.1, 0.2, 0.3;
  return point;
}

TEST(InstrumentErrors, NoneAreZero) {
  const InstrumentErrors none, of_no_effects(std::map<std::string_view, std::vector<double>>{});
  EXPECT_TRUE(none.empty());
  EXPECT_TRUE(of_no_effects.empty());
  const Eigen::Vector3d field_uT(20, -5, 40);
  EXPECT_EQ(none.shown_field(field_uT), field_uT);
  EXPECT_EQ(none.felt_tilt(turning().body, sim::Vector6::Ones()), Eigen::Vector2d::Zero());
  for (const double rate : none.of_rates(turning().body, {1, 2, 3})) EXPECT_EQ(rate, 0);
}

TEST(InstrumentErrors, AGyroFeelsTheRateAboutAnotherAxis) {
  // ax_from_y, az_from_x, by_from_z and bz_from_y, in the order of the effect's parameters.
  const std::array<std::pair<std::size_t, std::array<double, 4>>, 4> kCases{
      {{0, {0.02, 0, 0, 0}}, {2, {0, 0, 0.01, 0}}, {5, {0, 0.03, 0, 0}}, {7, {0, 0, 0, 0.02}}}};
  for (const auto& [parameter, expected] : kCases) {
    const auto errors =
        errors_by("gyro_cross_axis", parameter, 0.1).of_rates(turning().body, Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(errors[i], expected[i], 1e-12) << parameter << i;
  }
}

TEST(InstrumentErrors, AGyroFeelsTheSpecificForce) {
  const Eigen::Vector3d force_m_s2(0, 0, -base::kGravity_m_s2);
  const auto errors =
      errors_by("gyro_g_sensitivity", 5, 2).of_rates(turning().body, force_m_s2);  // az_z, deg/s per g
  EXPECT_NEAR(errors[2], -2 * base::kRadiansPerDegree, 1e-9);
  EXPECT_EQ(errors[0], 0);
}

// H is the level field, and deviation = -(bx sin psi + by cos psi) / H.
TEST(InstrumentErrors, HardIronDeviatesTheHeadingByItsSineAndCosine) {
  constexpr double kDip_rad = 1, kField_uT = 50;
  const double level_uT = kField_uT * std::cos(kDip_rad);
  for (double heading_rad = -3; heading_rad < 3; heading_rad += 0.5) {
    const Eigen::Vector3d field_uT = kField_uT * field_in_body({0, 0, heading_rad}, kDip_rad);
    EXPECT_NEAR(levelled_heading(field_uT, {0, 0}), heading_rad, 1e-12);
    const auto deviation = [&](std::size_t axis) {
      const Eigen::Vector3d shown_uT = errors_by("hard_iron", axis, 0.01).shown_field(field_uT);
      return levelled_heading(shown_uT, {0, 0}) - heading_rad;
    };
    EXPECT_NEAR(deviation(0), -0.01 * std::sin(heading_rad) / level_uT, 1e-6);
    EXPECT_NEAR(deviation(1), -0.01 * std::cos(heading_rad) / level_uT, 1e-6);
    EXPECT_NEAR(deviation(2), 0, 1e-9);
  }
}

TEST(InstrumentErrors, TheFluidOfATiltSensorFeelsAccelerations) {
  sim::Body body;
  sim::Vector6 acceleration = sim::Vector6::Zero();
  acceleration[0] = 0.5;
  const Eigen::Vector2d tilt_rad = errors_by("tilt_slosh", 0, 0.4).felt_tilt(body, acceleration);
  EXPECT_NEAR(tilt_rad.x(), 0, 1e-12);
  EXPECT_NEAR(tilt_rad.y(), 0.4 * 0.5 / base::kGravity_m_s2, 1e-12);
}

/// A parameter for each number of some effects.
std::vector<Parameter> numbers_of(std::initializer_list<std::string_view> effects) {
  std::vector<Parameter> all;
  for (const std::string_view name : effects) {
    const sim::EffectDescription& about = sim::make_effect(name)->description();
    for (std::size_t i = 0; i < about.parameters.size(); ++i) {
      Parameter parameter{
          std::string(about.parameters[i].name), {}, 0, 0.1 * about.parameters[i].typical, -1e9, 1e9, {}, {}};
      parameter.of_instruments = {name, i};
      all.push_back(std::move(parameter));
    }
  }
  return all;
}

// At zero, and where all of them are at work.
TEST(InstrumentErrors, AColumnOfTheFilterIsTheDifferenceOfTwoReplays) {
  const VehicleCase of = vehicle_case("reference");
  RecordedMotion recording = draw_recording(of, of.prior, 12, 3, 0);
  set_field(recording, {18, 2, 44});
  for (const double lag_s : {0.0, 0.4}) {
    recording.tilt_lag_s = lag_s;
    FilterNoises noises;
    noises.white.setConstant(1e-3);
    noises.coloured.setConstant(1e-2);
    const FilteredReplay filter(of.prior,
                                numbers_of({"hard_iron", "soft_iron", "compass_misalignment", "tilt_slosh",
                                            "gyro_cross_axis", "gyro_g_sensitivity", "gyro_nonlinearity"}),
                                recording, noises);
    const auto pass = filter.follow(filter.start());
    ASSERT_TRUE(pass.has_value());
    Eigen::VectorXd elsewhere = filter.start();
    std::vector<Eigen::Index> columns;
    for (Eigen::Index i = 0; i < std::ssize(filter.parameters()); ++i) {
      columns.push_back(i);
      elsewhere[i] = filter.parameters()[static_cast<std::size_t>(i)].prior_std;
    }
    for (const Eigen::VectorXd& at : {filter.start(), elsewhere}) {
      const auto linear = filter.linearise(*pass, at, columns);
      ASSERT_TRUE(linear.has_value());
      int compared = 0;
      for (const Eigen::Index i : columns) {
        const Parameter& parameter = filter.parameters()[static_cast<std::size_t>(i)];
        Eigen::VectorXd values = at;
        values[i] += 0.01 * parameter.prior_std;
        const Eigen::VectorXd exact =
            (filter.replayed(*pass, values) - linear->white) / (0.01 * parameter.prior_std);
        const Eigen::VectorXd error = linear->jacobian.col(i) - exact;
        if (exact.norm() * parameter.prior_std < 1e-3) continue;
        // The derivatives of readings by the state are held; a field that is levelled by a late tilt changes them.
        EXPECT_LT(error.norm(), (i < 12 ? 0.12 : 0.06) * exact.norm())
            << parameter.name << " with a lag of " << lag_s;
        ++compared;
      }
      EXPECT_GT(compared, 30);
    }
  }
}

}  // namespace
}  // namespace navcal::identify
