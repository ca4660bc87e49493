// SPDX-License-Identifier: Apache-2.0
// Each departure of the compass against its equation, without noise.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/validation/reference/bench.h"

namespace navcal::reference::testing {
namespace {

constexpr double kCompassDuration_s = 40;
constexpr double kHalfStep_uT = 0.0051;

const World& compass_world() {
  static const World swung_about = swung(kCompassDuration_s);
  return swung_about;
}

Vector3 in_body(const Snapshot& s) { return s.world_from_body.conjugate() * Vector3(19.0, 0.6, 44.0); }

/// The field that is read is what the equation makes of the state at that moment.
void expect_field(const ParameterDeviations& deviations, const std::function<Vector3(const Snapshot&)>& equation) {
  const auto samples = compass_along(compass_world(), deviations.compass);
  ASSERT_GT(samples.size(), 350U);
  for (const CompassSample& sample : samples) {
    const Vector3 expected = equation(compass_world().at(sample.time_s));
    ASSERT_LT((sample.field_uT - expected).cwiseAbs().maxCoeff(), kHalfStep_uT) << sample.time_s << " s";
  }
}

/// tau y' + y = x(t) by small steps, from y = x at time 0.
template <class Value>
std::function<Value(double)> lagged(std::function<Value(const Snapshot&)> input,
                                    std::function<double(const Snapshot&)> tau_s) {
  constexpr double kStep_s = 0.002;
  std::vector<Value> course{input(compass_world().at(0))};
  for (int i = 0; i * kStep_s < kCompassDuration_s; ++i) {
    const Snapshot s = compass_world().at((i + 0.5) * kStep_s);
    const double decay = std::exp(-kStep_s / tau_s(s));
    course.push_back(Value(input(s) + decay * (course.back() - input(s))));
  }
  return [course](double time_s) {
    const auto i = static_cast<std::size_t>(time_s / kStep_s);
    return Value(course[i] + (time_s / kStep_s - static_cast<double>(i)) * (course[i + 1] - course[i]));
  };
}

TEST(Compass, NominallyReadsTheFieldInItsOwnAxes) { expect_field({}, in_body); }

TEST(Compass, HardIron) {
  expect_field(with("hard_iron", {{"x_uT", 2}, {"y_uT", -1}, {"z_uT", 0.5}}),
               [](const Snapshot& s) { return Vector3(in_body(s) + Vector3(2, -1, 0.5)); });
}

TEST(Compass, SoftIronBeforeMisalignment) {
  ParameterDeviations deviations =
      with("soft_iron", {{"xx", 0.02}, {"yy", -0.01}, {"zz", 0.03}, {"xy", 0.01}, {"xz", -0.02}, {"yz", 0.015}});
  add({"compass_misalignment", {{"x_deg", 1}, {"y_deg", -2}, {"z_deg", 3}}}, deviations);
  expect_field(deviations, [](const Snapshot& s) {
    Eigen::Matrix3d S;
    S << 0.02, 0.01, -0.02, 0.01, -0.01, 0.015, -0.02, 0.015, 0.03;
    const Vector3 m = in_body(s) + S * in_body(s);
    // A turn is many small ones.
    Vector3 turned = m;
    for (int i = 0; i < 1000; ++i) turned -= (1e-3 * kDegree * Vector3(1, -2, 3)).cross(turned);
    return turned;
  });
}

TEST(Compass, DeclinationTurnsTheFieldEast) {
  expect_field(with("declination", {{"angle_deg", 4}}), [](const Snapshot& s) {
    const double c = std::cos(4 * kDegree), d = std::sin(4 * kDegree);
    return Vector3(s.world_from_body.conjugate() * Vector3(19 * c - 0.6 * d, 19 * d + 0.6 * c, 44));
  });
}

TEST(Compass, MotorAndTemperatureAddVectors) {
  expect_field(with("motor_field", {{"y_uT_per_A", 1}}),
               [](const Snapshot& s) { return Vector3(in_body(s) + Vector3(0, s.motor_current_A, 0)); });
  expect_field(with("mag_temperature", {{"z_uT_per_C", 0.15}}), [](const Snapshot& s) {
    return Vector3(in_body(s) + Vector3(0, 0, 0.15 * (s.electronics_C - 15)));
  });
}

TEST(Compass, SaturationTakesTheCube) {
  expect_field(with("magnetometer_saturation", {{"per_uT2", 2e-5}}), [](const Snapshot& s) {
    const Vector3 m = in_body(s);
    return Vector3(m - 2e-5 * m.cwiseProduct(m).cwiseProduct(m));
  });
}

TEST(Compass, HysteresisAddsTheFieldThroughALongLowPass) {
  const auto memory = lagged<Vector3>(in_body, [](const Snapshot&) { return 60.0; });
  for (const CompassSample& sample :
       compass_along(compass_world(), with("magnetic_hysteresis", {{"gain", 0.06}}).compass)) {
    const Vector3 expected = in_body(compass_world().at(sample.time_s)) + 0.06 * memory(sample.time_s);
    ASSERT_LT((sample.field_uT - expected).cwiseAbs().maxCoeff(), kHalfStep_uT + 0.001);
  }
}

TEST(Compass, LagsOfTheField) {
  const auto constant = lagged<Vector3>(in_body, [](const Snapshot&) { return 0.2; });
  for (const CompassSample& sample : compass_along(compass_world(), with("compass_lag", {{"tau_s", 0.2}}).compass))
    ASSERT_LT((sample.field_uT - constant(sample.time_s)).cwiseAbs().maxCoeff(), kHalfStep_uT + 0.01);
  // 0.5 s when it heads east, none when it heads west.
  const auto turning =
      lagged<Vector3>(in_body, [](const Snapshot& s) { return 0.25 + 0.25 * std::sin(s.heading_rad()) + 1e-9; });
  for (const CompassSample& sample :
       compass_along(compass_world(), with("heading_lag", {{"east_s", 0.25}}).compass))
    ASSERT_LT((sample.field_uT - turning(sample.time_s)).cwiseAbs().maxCoeff(), kHalfStep_uT + 0.02);
}

void expect_tilt(const ParameterDeviations& deviations,
                 const std::function<Eigen::Vector2d(const Snapshot&)>& input, const Eigen::Vector2d& offset_deg) {
  const auto tilt = lagged<Eigen::Vector2d>(input, [](const Snapshot&) { return 0.3; });
  for (const CompassSample& sample : compass_along(compass_world(), deviations.compass)) {
    const Eigen::Vector2d expected = tilt(sample.time_s) / kDegree + offset_deg;
    ASSERT_NEAR(sample.roll_rad / kDegree, expected(0), 0.055) << sample.time_s;
    ASSERT_NEAR(sample.pitch_rad / kDegree, expected(1), 0.055) << sample.time_s;
  }
}

Eigen::Vector2d true_tilt(const Snapshot& s) { return {s.roll_rad(), s.pitch_rad()}; }

TEST(Compass, TiltIsThatOfTheFluidAndItsOffset) {
  expect_tilt({}, true_tilt, {0, 0});
  expect_tilt(with("tilt_offset", {{"roll_deg", 1}, {"pitch_deg", -2}}), true_tilt, {1, -2});
}

TEST(Compass, SloshFollowsTheAcceleration) {
  expect_tilt(with("tilt_slosh", {{"gain", 0.3}}),
              [](const Snapshot& s) {
                const Vector3& a = s.acceleration_m_s2;
                return Eigen::Vector2d(true_tilt(s) + 0.3 / 9.81 * Eigen::Vector2d(-a.y(), a.x()));
              },
              {0, 0});
}

TEST(Compass, HeadingIsThatOfTheLevelledField) {
  World straight(Vehicle(Hull{}, {}, {}), 10);
  straight.advance(4);
  for (const CompassSample& sample : compass_along(straight, {}))
    EXPECT_NEAR(std::remainder(sample.heading_rad, 2 * std::numbers::pi), -1.81 * kDegree, 0.06 * kDegree);
  for (const CompassSample& sample : compass_along(compass_world(), {})) {
    const Vector3 level = Eigen::AngleAxisd(sample.pitch_rad, Vector3::UnitY()) *
                          (Eigen::AngleAxisd(sample.roll_rad, Vector3::UnitX()) * sample.field_uT);
    EXPECT_NEAR(std::remainder(sample.heading_rad - std::atan2(-level.y(), level.x()), 2 * std::numbers::pi), 0,
                0.3 * kDegree);
  }
}

TEST(Compass, TemperatureIsThatOfTheElectronics) {
  for (const CompassSample& sample : compass_along(compass_world(), {}))
    EXPECT_NEAR(sample.temperature_C, compass_world().at(sample.time_s).electronics_C, 0.051);
}

TEST(Compass, NoiseIsOfTheStatedSize) {
  Fitting fitting = exact();
  fitting.noisy = true;
  const auto noisy = compass_along(compass_world(), {}, fitting), clean = compass_along(compass_world(), {});
  double field = 0, tilt = 0;
  for (std::size_t i = 0; i < noisy.size(); ++i) {
    field += (noisy[i].field_uT - clean[i].field_uT).squaredNorm() / 3;
    tilt += std::pow((noisy[i].pitch_rad - clean[i].pitch_rad) / kDegree, 2);
  }
  const auto n = static_cast<double>(noisy.size());
  EXPECT_NEAR(field / n / (0.15 * 0.15), 1, 5 * std::sqrt(2 / (3 * n)) + 0.01);
  const double rounding = 2 * 0.1 * 0.1 / 12;  // of both
  EXPECT_NEAR(tilt / n / (0.1 * 0.1 + rounding), 1, 5 * std::sqrt(2 / n) + 0.05);
}

}  // namespace
}  // namespace navcal::reference::testing
