// SPDX-License-Identifier: Apache-2.0
#include "calib/turn/inclinometer_lag.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "calib/turn/tilt_smoother.h"

namespace navcal::calib {
namespace {

constexpr double kInclinometerLag_s = 0.3, kNoise_rad = 0.0017;

/// A hull that rolls and pitches on a straight course.
double swaying_roll(double t) { return 0.12 * std::sin(1.9 * t); }
double swaying_pitch(double t) { return 0.08 * std::sin(1.1 * t + 0.4); }
double roll_rate(double t) { return 0.12 * 1.9 * std::cos(1.9 * t); }
double pitch_rate(double t) { return 0.08 * 1.1 * std::cos(1.1 * t + 0.4); }

struct Drive {
  double lag_s = kInclinometerLag_s;  ///< what the inclinometer really has
  double motion = 1;                  ///< 0: still water
  bool gyros_tell = true;             ///< false: a card with a yaw gyro alone
  double bias_rad_s = 0.01;

  /// Calls `gyro(t, rates)` and `tilt(t, shown, true)` at 10 Hz.
  template <class Gyro, class Tilt>
  void run(double seconds, Gyro gyro, Tilt tilt) const {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    Eigen::Vector2d shown = motion * Eigen::Vector2d(swaying_roll(0), swaying_pitch(0));
    for (int ms = 0; ms < 1000 * seconds; ++ms) {
      const double t = ms / 1000.0;
      const Eigen::Vector2d now = motion * Eigen::Vector2d(swaying_roll(t), swaying_pitch(t));
      shown += lag_s > 0 ? Eigen::Vector2d(0.001 / lag_s * (now - shown)) : Eigen::Vector2d(now - shown);
      if (ms % 100 != 0) continue;
      const double p = motion * roll_rate(t), q = motion * pitch_rate(t) * std::cos(now.x()),
                   r = -motion * pitch_rate(t) * std::sin(now.x());
      Eigen::Vector3d rates(p + bias_rad_s, q - bias_rad_s, r);
      for (double& rate : rates) rate += 0.0012 * normal(random);
      gyro(t, gyros_tell ? rates : Eigen::Vector3d(0, 0, rates.z()));
      tilt(t, Eigen::Vector2d(shown + kNoise_rad * Eigen::Vector2d(normal(random), normal(random))), now);
    }
  }
  [[nodiscard]] bool decides_for_lag() const {
    InclinometerLag lag(kInclinometerLag_s);
    double waiting_s = -1;
    Eigen::Vector2d waiting = Eigen::Vector2d::Zero();
    run(
        60, [&](double t, const Eigen::Vector3d& rates) { lag.update(t, rates); },
        [&](double t, const Eigen::Vector2d& shown, const Eigen::Vector2d&) {
          if (waiting_s >= 0) lag.update(waiting_s, waiting);
          waiting_s = t;
          waiting = shown;
        });
    return lag.lags();
  }
};

TEST(InclinometerLag, AFluidLags) { EXPECT_TRUE(Drive{}.decides_for_lag()); }

TEST(InclinometerLag, AnAccelerometerDoesNot) { EXPECT_FALSE(Drive{.lag_s = 0}.decides_for_lag()); }

TEST(InclinometerLag, GyrosThatTellNothingAreNotUsed) {
  const Drive drive{.gyros_tell = false, .bias_rad_s = 0};
  EXPECT_FALSE(drive.decides_for_lag());
}

TEST(InclinometerLag, StillWaterDecidesNothing) { EXPECT_TRUE(Drive{.motion = 0}.decides_for_lag()); }

TEST(TiltSmoother, RestoresTheTiltThatALaggingInclinometerShows) {
  TiltSmoother smoother({.lag_s = kInclinometerLag_s, .tilt_noise_rad = kNoise_rad});
  double newest_s = 0;
  double square = 0, shown_square = 0;
  int count = 0;
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> held;
  Eigen::Vector3d rates = Eigen::Vector3d::Zero();
  Drive{}.run(
      120, [&](double, const Eigen::Vector3d& measured) { rates = measured; },
      [&](double t, const Eigen::Vector2d& shown, const Eigen::Vector2d& now) {
        if (smoother.size() == 0) {
          smoother.start(shown, Eigen::Vector2d(roll_rate(t), pitch_rate(t)));
        } else {
          smoother.predict(rates, t - newest_s);
          smoother.correct(shown);
        }
        newest_s = t;
        held.emplace_back(shown, now);
        if (smoother.size() < 20) return;
        const TiltSmoother::State state = smoother.oldest();
        smoother.drop_oldest();
        const auto& [then_shown, then] = held[held.size() - 20];
        if (t < 30) return;  // the biases of the gyros are found by then
        square += (state.head<2>() - then).squaredNorm();
        shown_square += (then_shown - then).squaredNorm();
        ++count;
      });
  ASSERT_GT(count, 800);
  const double rms_rad = std::sqrt(square / count), shown_rms_rad = std::sqrt(shown_square / count);
  // Rates at the end of each interval, not its mean, limit this test's own precision.
  EXPECT_LT(rms_rad, 0.25 * shown_rms_rad);
}

TEST(TiltSmoother, SteadyReadingsStayAsTheyAre) {
  TiltSmoother smoother({});
  smoother.start({0.1, -0.05}, {0, 0});
  const TiltSmoother::State alone = smoother.oldest();
  EXPECT_NEAR(alone[TiltSmoother::kRoll], 0.1, 1e-12);
  EXPECT_NEAR(alone[TiltSmoother::kPitch], -0.05, 1e-12);
  for (int i = 0; i < 20; ++i) {
    smoother.predict(Eigen::Vector3d::Zero(), 0.1);
    smoother.correct({0.1, -0.05});
  }
  const TiltSmoother::State later = smoother.oldest();
  EXPECT_NEAR(later[TiltSmoother::kRoll], 0.1, 1e-3);
  EXPECT_NEAR(later[TiltSmoother::kPitch], -0.05, 1e-3);
}

}  // namespace
}  // namespace navcal::calib
