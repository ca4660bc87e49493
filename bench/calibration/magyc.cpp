// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "bench/calibration/magnetometer.h"
#include "calib/magnetometer/ellipsoid_estimator.h"

/// Rodríguez-Martínez and Troni, "Full magnetometer and gyroscope bias estimation using angular rates" (2024):
/// 6000 readings at 25 Hz on sinusoidal motions of three widths, field (227.2, 51.8, 411.7) mG, noise 10 mG.
/// Theirs takes three-axis rates and no tilt; ours takes the tilt and no rates.
namespace navcal::bench {

using namespace calib;

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kReadings = 6000;
constexpr double kPeriod_s = 0.04;
constexpr double kFieldNoise_uT = 1;  // 10 mG
constexpr double kTiltNoise_rad = 0.1 * kDegree;

struct Motion {
  const char* name;
  double roll_deg, pitch_deg, heading_deg;
};
constexpr std::array kMotions{Motion{"large", 5, 45, 360}, Motion{"middle", 5, 5, 360},
                              Motion{"small", 5, 45, 90}};

struct Reading {
  Eigen::Vector3d field_uT;
  double roll_rad, pitch_rad;
};

Eigen::Matrix3d soft_iron() {
  Eigen::Matrix3d soft;
  soft << 1.10, .10, .04, .10, .88, .02, .04, .02, 1.22;
  return soft;
}
const Eigen::Vector3d kHardIron_uT(2, 12, 9);
const Eigen::Vector3d kField_uT(22.7207, 5.1796, 41.1731);

/// Without noise where `noise` is zero.
std::vector<Reading> readings_of(const Motion& motion, std::mt19937_64& random, double noise, bool tilt_known) {
  std::uniform_real_distribution<double> phase(-std::numbers::pi, std::numbers::pi);
  std::normal_distribution<double> normal;
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const std::array amplitude{motion.roll_deg * kDegree, motion.pitch_deg * kDegree, motion.heading_deg * kDegree};
  const std::array rate{between(0.05, 0.08), between(0.1, 0.3), between(0.2, 0.4)};
  const std::array begin{phase(random), phase(random), phase(random)};
  std::vector<Reading> readings;
  for (int k = 0; k < kReadings; ++k) {
    std::array<double, 3> angle{};
    for (std::size_t i = 0; i < 3; ++i)
      angle[i] = amplitude[i] * std::sin(rate[i] / amplitude[i] * kPeriod_s * k + begin[i]);
    const Eigen::Matrix3d world_from_body = (Eigen::AngleAxisd(angle[2], Eigen::Vector3d::UnitZ()) *
                                             Eigen::AngleAxisd(angle[1], Eigen::Vector3d::UnitY()) *
                                             Eigen::AngleAxisd(angle[0], Eigen::Vector3d::UnitX()))
                                                .toRotationMatrix();
    Reading reading;
    reading.field_uT = soft_iron() * (world_from_body.transpose() * kField_uT) + kHardIron_uT;
    for (double& component : reading.field_uT) component += noise * kFieldNoise_uT * normal(random);
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    reading.roll_rad = tilt_known ? angle[0] + noise * kTiltNoise_rad * normal(random) : unknown;
    reading.pitch_rad = tilt_known ? angle[1] + noise * kTiltNoise_rad * normal(random) : unknown;
    readings.push_back(reading);
  }
  return readings;
}

/// Cramer-Rao bound of the centre, with the priors of the estimator: its information at the true shape.
Eigen::Vector3d bound_uT(const std::vector<Reading>& exact) {
  EllipsoidFit truth;
  truth.shape.centre_uT = kHardIron_uT;
  truth.shape.matrix_per_uT = soft_iron().inverse() / kField_uT.norm();
  truth.shape.sine_of_dip = kField_uT.z() / kField_uT.norm();
  EllipsoidCells single;
  for (const Reading& reading : exact) {
    EllipsoidCells::value_type cell;
    cell.count = 1;
    cell.mean.head<3>() = reading.field_uT;
    if (std::isfinite(reading.roll_rad)) cell.mean.tail<3>() = down_in_body(reading.roll_rad, reading.pitch_rad);
    single.push_back(cell);
  }
  EllipsoidNoise noise;
  noise.field_uT = kFieldNoise_uT;
  noise.tilt_rad = kTiltNoise_rad;
  return improve(truth, single, noise, {}).covariance.diagonal().head<3>().cwiseSqrt();
}

struct Row {
  int accepted = 0, within = 0, numbers = 0, matrix_within = 0, matrix_numbers = 0;
  Eigen::Vector3d error2 = Eigen::Vector3d::Zero(), stated2 = error2, bound2 = error2;
  double heading = 0;
  std::string refusal;
};

void add_run(Row& row, const Motion& motion, std::uint64_t seed, bool tilt_known) {
  std::mt19937_64 random(seed), again(seed);
  EllipsoidEstimator::Parameters parameters;
  parameters.noise_uT = kFieldNoise_uT;
  EllipsoidEstimator estimator(parameters);
  for (const Reading& r : readings_of(motion, random, 1, tilt_known))
    estimator.update(r.field_uT, r.roll_rad, r.pitch_rad);
  estimator.settle();
  const auto estimate = estimator.estimate();
  const Judgement judgement = estimator.judgement();
  if (!judgement.accepted) row.refusal = judgement.reason;
  row.accepted += judgement.accepted ? 1 : 0;
  if (!estimate) return;
  const Eigen::Vector3d error = estimate->correction.offset_uT - kHardIron_uT;
  const Eigen::Vector3d& stated = estimate->offset_std_uT;
  row.error2 += error.cwiseAbs2();
  row.stated2 += stated.cwiseAbs2();
  row.bound2 += bound_uT(readings_of(motion, again, 0, tilt_known)).cwiseAbs2();
  row.heading += estimate->heading_std_rad / kDegree;
  const Eigen::Matrix3d truth = soft_iron().inverse() * std::cbrt(soft_iron().determinant());
  for (int i = 0; i < 3; ++i) {
    row.within += std::abs(error[i]) <= 2 * stated[i] ? 1 : 0;
    ++row.numbers;
    for (int j = i; j < 3; ++j) {
      const double off = estimate->correction.matrix(i, j) - truth(i, j);
      row.matrix_within += std::abs(off) <= 2 * estimate->matrix_std(i, j) ? 1 : 0;
      ++row.matrix_numbers;
    }
  }
}

}  // namespace

void print_magyc(const TableOptions& options) {
  const int runs = std::max(1, options.runs / 20);
  fmt::print(
      "{} runs. Centre: root-mean-square error, stated error and Cramer-Rao bound (uT, x y z); shares of centre "
      "and "
      "matrix within two standard errors.\n\n"
      "| motion | tilt | accepted | error | stated | bound | centre, % | matrix, % | worst heading stated, deg |\n"
      "|-|-|-|-|-|-|-|-|-|\n",
      runs);
  for (const bool tilt_known : {true, false}) {
    for (const Motion& motion : kMotions) {
      Row row;
      for (int run = 1; run <= runs; ++run) add_run(row, motion, static_cast<std::uint64_t>(run), tilt_known);
      const auto three = [&](const Eigen::Vector3d& square) {
        const Eigen::Vector3d v = (square / runs).cwiseSqrt();
        return fmt::format("{:.2f} {:.2f} {:.2f}", v.x(), v.y(), v.z());
      };
      fmt::print("| {} | {} | {} of {} | {} | {} | {} | {:.1f} | {:.1f} | {:.2f} |\n", motion.name,
                 tilt_known ? "0.1 degrees" : "none", row.accepted, runs, three(row.error2), three(row.stated2),
                 three(row.bound2), 100.0 * row.within / std::max(1, row.numbers),
                 100.0 * row.matrix_within / std::max(1, row.matrix_numbers), row.heading / runs);
      if (!row.refusal.empty()) fmt::print("\nRefused: {}.\n\n", row.refusal);
    }
  }
}

}  // namespace navcal::bench
