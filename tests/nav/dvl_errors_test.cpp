// SPDX-License-Identifier: Apache-2.0
// Vehicles with a DVL whose errors are drawn as large as the options say: are the position errors as large as
// stated? docs/navigation.md quotes what these tests print.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

#include "nav/navigator.h"
#include "tests/nav/drive.h"

namespace navcal::nav::test {
namespace {

using Eigen::Vector2d;

constexpr int kDvlRuns = 60;

/// Squares of errors over stated standard errors: the mean of both axes is 1 when the statement is exact.
struct Statement {
  double sum = 0, worst = 0, error_m2 = 0, stated_m2 = 0;

  void add(const Navigator& navigator, const sim::Motion& motion, const Vector2d& current_m_s) {
    const auto estimate = navigator.estimate();
    const Vector2d error_m = *estimate.position_m - true_position_m(motion, estimate.time_ns, current_m_s);
    const double square = error_m.cwiseQuotient(estimate.position_std_m).squaredNorm() / 2;
    sum += square;
    worst = std::max(worst, square);
    error_m2 += error_m.squaredNorm();
    stated_m2 += estimate.position_std_m.squaredNorm();
  }
  [[nodiscard]] double mean() const { return sum / kDvlRuns; }
  void print(const char* what) const {
    std::cout << what << ": rms error " << std::sqrt(error_m2 / kDvlRuns) << " m, stated "
              << std::sqrt(stated_m2 / kDvlRuns) << " m, mean square of their ratio " << mean() << ", worst "
              << worst << '\n';
  }
};

/// The mean of 60 times chi-square with two degrees over two has a standard deviation of 0.13.
void expect_as_stated(const Statement& statement, double least = 0.4) {
  EXPECT_GT(statement.mean(), least) << "stated too large";
  EXPECT_LT(statement.mean(), 1.4) << "stated too small";
  EXPECT_LT(statement.worst, 9);
}

/// A vehicle as well known as the options say, and how it drives.
struct Drawn {
  sim::PathMotion way;
  DriveOptions drive;
};

Drawn draw(std::mt19937& random, const Options& options, double duration_s) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const double speed_m_s = 0.7 + uniform(random);
  Drawn drawn{level_way(
                  duration_s, speed_m_s, [](double t_s) { return t_s > 70 && t_s < 80 ? 0.1 : 0.0; }, 0,
                  10 * normal(random)),
              {}};
  auto& drive = drawn.drive;
  const double off_rad = options.heading_error_rad * normal(random);
  drive.compass_says = [=](double heading_rad) { return heading_rad + off_rad; };
  drive.shaft_share = 1 + options.reckoning.speed_error * normal(random);
  drive.current_m_s = {options.reckoning.set_m_s * normal(random), options.reckoning.set_m_s * normal(random)};
  drive.fixed = [](double t_s) { return t_s < 20; };
  drive.seed = static_cast<std::uint32_t>(random());
  auto& dvl = drive.dvl.emplace();
  dvl.noise_m_s = 0.005 + 0.03 * uniform(random);
  dvl.period_s = uniform(random) < 0.5 ? 0.2 : 1;
  dvl.scale = 1 + options.velocity.scale_error * normal(random);
  dvl.yaw_rad = options.velocity.alignment_error_rad * normal(random);
  dvl.bad_share = 0.02;
  return drawn;
}

TEST(DvlErrors, AreAsLargeAsIsStatedWithBottomLockAndWithout) {
  std::mt19937 random(5);
  const Options options;
  Statement locked, lost, found;
  for (int run = 0; run < kDvlRuns; ++run) {
    Drawn drawn = draw(random, options, 200);
    drawn.drive.dvl->water = run % 2 == 0;
    drawn.drive.dvl->locked = [](double t_s) { return t_s < 90 || t_s > 150; };
    Navigator navigator(options);
    double before_s = 0;
    for (const auto& arrived : readings_along(drawn.way, 200, drawn.drive)) {
      give(navigator, arrived.reading);
      const double t_s = since_start_s(arrived.arrival_ns);
      if (before_s < 89 && t_s >= 89) locked.add(navigator, drawn.way, drawn.drive.current_m_s);
      if (before_s < 149 && t_s >= 149) lost.add(navigator, drawn.way, drawn.drive.current_m_s);
      before_s = t_s;
    }
    found.add(navigator, drawn.way, drawn.drive.current_m_s);
  }
  locked.print("70 s with bottom lock");
  lost.print("60 s later without");
  found.print("50 s later with it again");
  for (const Statement* statement : {&locked, &lost, &found}) expect_as_stated(*statement);
}

TEST(DvlErrors, AreAsLargeAsIsStatedWithAWellKnownHeading) {
  std::mt19937 random(6);
  Options options;
  options.heading_error_rad = options.heading_error_calibrated_rad = 0.2 * kDegree;
  Statement locked;
  for (int run = 0; run < kDvlRuns; ++run) {
    const Drawn drawn = draw(random, options, 200);
    Navigator navigator(options);
    give(navigator, readings_along(drawn.way, 200, drawn.drive));
    locked.add(navigator, drawn.way, drawn.drive.current_m_s);
  }
  locked.print("180 s with bottom lock and a heading good to 0.2 degrees");
  expect_as_stated(locked);
}

TEST(DvlErrors, AreAsLargeAsIsStatedWhileThereAreFixes) {
  // A heading that is off pulls the track away from the fixes all the time: their gain must allow for it.
  std::mt19937 random(7);
  const Options options;
  Statement fixed;
  for (int run = 0; run < kDvlRuns; ++run) {
    Drawn drawn = draw(random, options, 150);
    drawn.drive.fixed = [](double) { return true; };
    Navigator navigator(options);
    give(navigator, readings_along(drawn.way, 150, drawn.drive));
    fixed.add(navigator, drawn.way, drawn.drive.current_m_s);
  }
  fixed.print("150 s with bottom lock and fixes");
  expect_as_stated(fixed);
}

TEST(DvlErrors, AreAsLargeAsIsStatedThroughTheWater) {
  std::mt19937 random(8);
  const Options options;
  Statement water;
  for (int run = 0; run < kDvlRuns; ++run) {
    Drawn drawn = draw(random, options, 150);
    drawn.drive.fixed = [](double t_s) { return t_s < 60; };
    drawn.drive.dvl->bottom = false;
    drawn.drive.dvl->water = true;
    Navigator navigator(options);
    give(navigator, readings_along(drawn.way, 150, drawn.drive));
    water.add(navigator, drawn.way, drawn.drive.current_m_s);
  }
  water.print("90 s through the water");
  expect_as_stated(water, 0.3);
}

TEST(DvlErrors, TheErrorForeseenIsTheOneThatComes) {
  const auto way = level_way(150, 1, [](double) { return 0.0; });
  DriveOptions drive;
  drive.fixed = [](double t_s) { return t_s < 20; };
  drive.dvl.emplace();
  Navigator navigator({});
  const auto readings = readings_along(way, 150, drive);
  double foreseen_m = 0;
  for (const auto& arrived : readings) {
    give(navigator, arrived.reading);
    if (foreseen_m == 0 && since_start_s(arrived.arrival_ns) > 50)
      foreseen_m = navigator.error_radius_m(100).value();
  }
  EXPECT_NEAR(navigator.error_radius_m(0).value(), foreseen_m, 0.03 * foreseen_m);
}

}  // namespace
}  // namespace navcal::nav::test
