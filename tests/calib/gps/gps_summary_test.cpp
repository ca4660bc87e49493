// SPDX-License-Identifier: Apache-2.0
#include "calib/gps/gps_summary.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "calib/gps/gps_coefficients.h"
#include "calib/gps/gps_compass.h"
#include "tests/calib/gps_paths.h"

namespace navcal::calib {
namespace {

using namespace test;

GpsCoefficients::Unknowns some_unknowns() {
  GpsCoefficients::Unknowns x;
  x << gps_deviation(), 1.07, -0.19, 0.1, -0.05;
  return x;
}

TEST(GpsCoefficients, AreTheHarmonicsOfTheModel) {
  const auto x = some_unknowns();
  const double declination = 0.03, k0 = -0.15;
  const GpsCoefficients coefficients(x, declination, k0);
  for (double psi = 0; psi < 6.3; psi += 0.17) {
    for (const double rate : {-0.8, 0.0, 0.5}) {
      GpsSummary::Complex sum = coefficients.value[GpsSummary::kTerms - 1];
      for (int j = 0; j < GpsSummary::kSlipTerms; ++j)
        for (int m = -GpsSummary::kHarmonics; m <= GpsSummary::kHarmonics; ++m)
          sum += coefficients.value[GpsSummary::index(j, m)] * std::pow(GpsSummary::Complex(0, rate), j) *
                 std::polar(1.0, psi + k0 * rate + m * psi);
      const auto truth = GpsSummary::Complex(x[7], x[8]) +
                         std::polar(x[5], psi + declination - deviation_rad(x.head<5>(), psi) + x[6] * rate);
      EXPECT_LT(std::abs(sum - truth), 2e-5);
    }
  }
}

TEST(GpsCoefficients, SlopesAreThoseOfTheValues) {
  const auto x = some_unknowns();
  for (int i = 0; i < GpsCoefficients::kUnknowns; ++i) {
    const GpsCoefficients::Unknowns step = 1e-6 * GpsCoefficients::Unknowns::Unit(i);
    const GpsSummary::Terms difference =
        (GpsCoefficients(x + step, 0, -0.15).value - GpsCoefficients(x - step, 0, -0.15).value) / 2e-6;
    EXPECT_LT((difference - GpsCoefficients(x, 0, -0.15).slope.col(i)).cwiseAbs().maxCoeff(), 1e-8) << i;
  }
}

/// The same observations as rows, with the full covariance of the positions: the summary must be their
/// information.
TEST(GpsSummary, EqualsGeneralisedLeastSquaresOverAllFixes) {
  Random random(1);
  const GpsNoise noise{.interval_s = 1, .velocity_std_m_s = 0.05, .position_std_m = 0.5};
  auto path = load_true_path("path2");
  path.erase(path.begin(), path.begin() + 50);  // under way from the beginning
  const GpsRun run = measure_by_gps(path, gps_deviation(), noise, random);
  GpsCompass::Parameters parameters;
  parameters.summary.velocity_std_m_s = 0.05;
  parameters.summary.position_std_m = 0.5;
  GpsCompass compass(parameters);
  feed(compass, run);
  const GpsSummary::Information information = compass.summary().information().selfadjointView<Eigen::Lower>();

  const auto& p = parameters.summary;
  std::vector<GpsSummary::Terms> rows;  // integrals to each fix
  std::vector<GpsSummary::Terms> now;
  GpsSummary::Terms integral = GpsSummary::Terms::Zero(), before = GpsSummary::Terms::Zero();
  std::size_t g = 0;
  for (std::size_t k = 0; k < run.track.size(); ++k) {
    GpsSummary::Terms terms;
    const auto& track = run.track[k];
    for (int j = 0; j < GpsSummary::kSlipTerms; ++j)
      for (int m = -GpsSummary::kHarmonics; m <= GpsSummary::kHarmonics; ++m)
        terms[GpsSummary::index(j, m)] =
            track.speed_m_s * std::pow(GpsSummary::Complex(0, track.turn_rate_rad_s), j) *
            std::polar(1.0, (m + 1) * track.heading_rad + parameters.slip_s * track.turn_rate_rad_s);
    terms[GpsSummary::kTerms - 1] = 1;
    if (k > 0) integral += 0.05 * (before + terms);
    before = terms;
    if (g < run.ground.size() && run.ground[g].time_s <= track.time_s + 1e-9) {
      rows.push_back(integral);
      now.push_back(terms);
      ++g;
    }
  }
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXcd position(n, GpsSummary::kTerms + 1), velocity(n, GpsSummary::kTerms);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(n, n) * 0.25;
  for (Eigen::Index i = 0; i < n; ++i) {
    position.row(i) << rows[static_cast<std::size_t>(i)].transpose(), 1;  // the place of the first fix is free
    velocity.row(i) = now[static_cast<std::size_t>(i)].transpose();
    for (Eigen::Index j = 0; j < n; ++j)
      covariance(i, j) +=
          2 * p.model_std_m_s * p.model_std_m_s * p.model_correlation_s * static_cast<double>(std::min(i, j));
  }
  const Eigen::MatrixXcd whole =
      position.adjoint() * covariance.llt().solve(position.real()).cast<GpsSummary::Complex>() +
      position.adjoint() * covariance.llt().solve(position.imag()).cast<GpsSummary::Complex>() *
          GpsSummary::Complex(0, 1);
  const int last = GpsSummary::kTerms;
  const Eigen::MatrixXcd batch =
      whole.topLeftCorner(last, last) -
      whole.topRightCorner(last, 1) * whole.bottomLeftCorner(1, last) / whole(last, last) +
      velocity.adjoint() * velocity / (0.05 * 0.05 + p.model_std_m_s * p.model_std_m_s);
  EXPECT_LT((batch - information).cwiseAbs().maxCoeff(), 1e-9 * batch.cwiseAbs().maxCoeff());
}

struct Counted {
  GpsSummary::LeftOut left_out;
  std::uint64_t fixes;
  Deviation found;
};

/// Ten minutes in which every so many fixes are spoiled.
Counted with(void (*spoil)(GroundReading&), std::size_t every) {
  Random random(1);
  const GpsNoise noise{.interval_s = 1, .velocity_std_m_s = 0.05, .position_std_m = 0.5};
  GpsRun run = measure_by_gps(load_true_path("path_long600"), gps_deviation(), noise, random);
  for (std::size_t i = every; i < run.ground.size(); i += every) spoil(run.ground[i]);
  GpsCompass::Parameters parameters;
  parameters.summary.velocity_std_m_s = 0.05;
  parameters.summary.position_std_m = 0.5;
  parameters.summary.model_std_m_s = 0.003;
  GpsCompass compass(parameters);
  feed(compass, run);
  return {compass.summary().left_out(), compass.summary().fixes(), compass.solve()->unknowns.head<5>()};
}

constexpr double kStill_rad = 0.8 / 57.3;

TEST(GpsSummary, JumpsOfThePositionDoNotSpoilIt) {
  const auto result = with([](GroundReading& ground) { ground.position_m += Eigen::Vector2d(80, -40); }, 50);
  EXPECT_GE(result.left_out.jumps, 11U);
  EXPECT_LT(worst_residual_rad(result.found, gps_deviation()), kStill_rad);
}

TEST(GpsSummary, NotANumberIsLeftOut) {
  const auto result =
      with([](GroundReading& ground) { ground.position_m.x() = std::numeric_limits<double>::quiet_NaN(); }, 10);
  EXPECT_EQ(result.left_out.not_finite, 60U);
  EXPECT_LT(worst_residual_rad(result.found, gps_deviation()), kStill_rad);
}

TEST(GpsSummary, AReceiverThatHoldsItsPositionIsLeftOut) {
  const auto result = with(
      [](GroundReading& ground) {
        ground.position_m.setZero();
        ground.speed_m_s = 0;
        ground.course_rad = 0;
      },
      20);
  EXPECT_GE(result.left_out.slow, 30U);
  EXPECT_LT(worst_residual_rad(result.found, gps_deviation()), kStill_rad);
}

TEST(GpsSummary, DivesWithoutFixesAndGapsOfTheTrackDoNotSpoilIt) {
  Random random(1);
  const GpsNoise noise{.interval_s = 1, .velocity_std_m_s = 0.05, .position_std_m = 0.5};
  const GpsRun run = measure_by_gps(load_true_path("path_long600"), gps_deviation(), noise, random);
  GpsCompass::Parameters parameters;
  parameters.summary.velocity_std_m_s = 0.05;
  parameters.summary.position_std_m = 0.5;
  GpsCompass compass(parameters);
  std::size_t g = 0;
  for (std::size_t k = 0; k < run.track.size(); ++k) {
    for (; g < run.ground.size() && run.ground[g].time_s <= run.track[k].time_s; ++g)
      if (g % 150 < 100) compass.update(run.ground[g]);  // dives of 50 s
    if (k % 700 < 680) compass.update(run.track[k]);
    WaterTrackReading bad = run.track[k];
    bad.speed_m_s = std::numeric_limits<double>::quiet_NaN();
    compass.update(bad);
  }
  ASSERT_TRUE(compass.solve());
  EXPECT_LT(worst_residual_rad(compass.solve()->unknowns.head<5>(), gps_deviation()), kStill_rad);
}

}  // namespace
}  // namespace navcal::calib
