#include "gap/servo_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace navcal::gap {
namespace {

constexpr double kLag_s = 0.15, kDegree = 0.017453292519943295, kDuration_s = 120;

/// A helmsman who tells the servos something ten times a second, and what the card reports of it.
struct Steered {
  std::vector<MotorReading> readings;
  std::vector<Vector3> servos_rad;  ///< at the times of rows
};

Steered steered(double restless_deg) {
  std::mt19937_64 dice(7);
  std::normal_distribution<double> normal;
  Steered result;
  Vector3 command{}, servo{};
  for (int k = 0; k * ActuatorTrack::kStep_s <= kDuration_s; ++k) {
    const double t = k * ActuatorTrack::kStep_s;
    if (k % 10 == 0) {
      const double rudder = (5 * std::sin(0.4 * t) + restless_deg * normal(dice)) * kDegree;
      const double elevator = restless_deg * normal(dice) * kDegree, side = std::sqrt(0.75) * elevator;
      command = {-rudder, rudder / 2 + side, rudder / 2 - side};
    }
    for (std::size_t i = 0; i < 3; ++i) {
      servo[i] = command[i] + (servo[i] - command[i]) * std::exp(-ActuatorTrack::kStep_s / kLag_s);
    }
    result.servos_rad.push_back(servo);
    if (k % 10 != 4) continue;
    MotorReading reading{t, 780, servo, 1.4};
    for (double& angle : reading.fins_rad) {
      angle = std::round((angle / kDegree + 0.1 * normal(dice)) * 10) / 10 * kDegree;
    }
    result.readings.push_back(reading);
  }
  return result;
}

std::vector<Vector3> path_of(const Steered& steered, double later_s) {
  const ActuatorTrack track(steered.readings, kLag_s, kDuration_s);
  return servo_path(track.rows(), steered.readings, kLag_s, later_s);
}

/// Root mean square of what moves within a tenth of a second beyond the second around it, degrees.
double restlessness(const std::vector<Vector3>& path, std::size_t fin) {
  double square = 0;
  int count = 0;
  for (std::size_t k = 200; k + 200 < path.size() && k < 11'500; ++k, ++count) {
    const double bend = path[k][fin] - (path[k - 10][fin] + path[k + 10][fin]) / 2;
    square += bend * bend;
  }
  return std::sqrt(square / count) / kDegree;
}

TEST(ServoPath, OfASteadyHelmIsWithoutTheNoiseOfTheReports) {
  const Steered helm = steered(0);
  const auto path = path_of(helm, 0.03);
  for (const std::size_t fin : {0U, 1U, 2U}) EXPECT_LT(restlessness(path, fin), 0.05) << fin;
}

// When its commands come between two reports cannot be told, and then the reports see the servos half way: the
// path is the less restless of what may have been.
TEST(ServoPath, OfARestlessHelmIsRestless) {
  const Steered helm = steered(0.6);
  for (const double later_s : {0.0, 0.03, 0.08}) {
    const auto path = path_of(helm, later_s);
    for (const std::size_t fin : {0U, 1U, 2U}) {
      const double theirs = restlessness(helm.servos_rad, fin);
      EXPECT_GT(restlessness(path, fin), 0.5 * theirs) << fin << " later by " << later_s;
      EXPECT_LT(restlessness(path, fin), 1.2 * theirs) << fin << " later by " << later_s;
    }
  }
}

double rolling_deg(const Vector3& fins) { return (fins[0] + fins[1] + fins[2]) / 3 / kDegree; }

// Nulls that were rolled by the noise of the recorded reports had twice the roll of the vehicle that they stood
// for.
TEST(ServoPath, RollsTheVehicleByWhatTenthsRoundOffAndNotByTheReportsNoise) {
  const Steered helm = steered(0.6);
  const auto path = path_of(helm, 0);
  double square = 0;
  int count = 0;
  for (std::size_t k = 200; k < 11'500; ++k, ++count) square += std::pow(rolling_deg(path[k]), 2);
  const double rms = std::sqrt(square / count);
  EXPECT_LT(rms, 0.02);  // 0.1 / sqrt(12) of a fin, 1 / sqrt(3) of that, and less behind the servo's lag
  EXPECT_GT(rms, 0.005);
}

TEST(ServoPath, RollsTheVehicleOnPurpose) {
  Steered helm = steered(0);
  for (MotorReading& reading : helm.readings) {
    for (double& angle : reading.fins_rad) angle += 2 * kDegree;
  }
  const auto path = path_of(helm, 0.05);
  for (std::size_t k = 200; k < 11'500; ++k) EXPECT_NEAR(rolling_deg(path[k]), 2, 0.15);
}

TEST(ServoPath, IsTheTrackWhereThereAreNoReports) {
  Steered helm = steered(0.6);
  std::erase_if(helm.readings, [](const MotorReading& r) { return r.time_s > 40 && r.time_s < 60; });
  const ActuatorTrack track(helm.readings, kLag_s, kDuration_s);
  const auto path = servo_path(track.rows(), helm.readings, kLag_s, 0.05);
  ASSERT_EQ(path.size(), track.rows().size());
  for (std::size_t k = 4100; k < 5900; ++k) EXPECT_EQ(path[k], track.rows()[k].clean_fins_rad);
  const std::vector<MotorReading> one(1, helm.readings.front());
  const ActuatorTrack still(one, kLag_s, 5);
  for (const Vector3& fins : servo_path(still.rows(), one, kLag_s, 0)) EXPECT_EQ(fins, one.front().fins_rad);
}

}  // namespace
}  // namespace navcal::gap
