// SPDX-License-Identifier: Apache-2.0
#include "gap/watch/change_detector.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>
#include <string>

#include "gap/watch/window.h"
#include "tests/gap/prepared_mission.h"

namespace navcal::gap {
namespace {

constexpr double kMeasurements = 3000;

/// Windows whose information is that of independent residuals, and whose scores are drawn.
class Windows {
 public:
  explicit Windows(const Library& library) : n_(static_cast<Eigen::Index>(library.unknowns().size())) {
    priors_.spike.resize(n_);
    priors_.slab.resize(n_);
    for (Eigen::Index j = 0; j < n_; ++j) {
      priors_.slab[j] = library.unknowns()[static_cast<std::size_t>(j)].typical;
      priors_.spike[j] = 0.02 * priors_.slab[j];
    }
    priors_.model_error.setZero(n_);
    // Each unknown alone shows with a signal of 30 standard deviations at its typical value.
    gram_ = (30 * priors_.slab.cwiseInverse()).cwiseAbs2().asDiagonal();
  }
  [[nodiscard]] const Priors& priors() const { return priors_; }
  [[nodiscard]] const Eigen::MatrixXd& gram() const { return gram_; }
  /// Score of a window in which the unknowns have these values.
  [[nodiscard]] Eigen::VectorXd score(const Eigen::VectorXd& values) {
    std::normal_distribution<double> normal;
    Eigen::VectorXd noise(n_);
    for (double& each : noise) each = normal(dice_);
    return gram_ * values + gram_.diagonal().cwiseSqrt().cwiseProduct(noise);
  }
  [[nodiscard]] Eigen::VectorXd within_tolerance() {
    std::normal_distribution<double> normal;
    Eigen::VectorXd values(n_);
    for (Eigen::Index j = 0; j < n_; ++j) values[j] = priors_.spike[j] * normal(dice_);
    return values;
  }

 private:
  Eigen::Index n_;
  Priors priors_;
  Eigen::MatrixXd gram_;
  std::mt19937_64 dice_{7};
};

ChangeDetector detector_of(const Library& library, const Windows& windows) {
  return {library, windows.priors(), watched_effects(library), 1};
}

TEST(ChangeDetector, StaysBelowTheNumberOfWindowsWhenNothingChanges) {
  const Library library({});
  Windows windows(library);
  for (int vehicle = 0; vehicle < 2; ++vehicle) {
    const Eigen::VectorXd values = windows.within_tolerance();
    ChangeDetector detector = detector_of(library, windows);
    for (int i = 1; i <= 40; ++i) {
      detector.take(windows.gram(), windows.score(values), kMeasurements);
      EXPECT_LT(detector.log_statistic(), std::log(20.0 * i));
    }
  }
}

TEST(ChangeDetector, NamesAnEffectThatBeginsLate) {
  const Library library({});
  Windows windows(library);
  Eigen::VectorXd values = windows.within_tolerance();
  ChangeDetector detector = detector_of(library, windows);
  for (int i = 0; i < 20; ++i) detector.take(windows.gram(), windows.score(values), kMeasurements);
  const std::size_t effect = test::index_of(library, "hard_iron");
  values[library.first(effect)] += library.unknowns()[static_cast<std::size_t>(library.first(effect))].typical;
  for (int i = 0; i < 4; ++i) detector.take(windows.gram(), windows.score(values), kMeasurements);
  EXPECT_GT(detector.log_statistic(), 100);
  const ChangeDetector::Cause first = detector.causes().front();
  EXPECT_EQ(library[first.effect].name, "hard_iron");
  EXPECT_GT(first.probability, 0.99);
  EXPECT_EQ(first.onset, 20U);
  EXPECT_NEAR(detector.strength(first), 1, 0.2);
}

TEST(ChangeDetector, AnErrorFarBelowTheNoiseIsNoChangeHoweverLong) {
  const Library library({});
  Windows windows(library);
  const std::size_t effect = test::index_of(library, "gyro_scale");
  const Eigen::Index j = library.first(effect);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(windows.gram().rows());
  // A signal of 0.04 standard deviations in each residual.
  values[j] = 0.04 * std::sqrt(kMeasurements / windows.gram()(j, j));
  ChangeDetector detector = detector_of(library, windows);
  for (int i = 0; i < 100; ++i) detector.take(windows.gram(), windows.score(values), kMeasurements);
  EXPECT_LT(detector.log_statistic(), std::log(20.0 * 100));
}

TEST(ChangeDetector, GoesOnFromItsState) {
  const Library library({});
  Windows windows(library);
  const Eigen::VectorXd values = windows.within_tolerance();
  ChangeDetector first = detector_of(library, windows), second = detector_of(library, windows);
  for (int i = 0; i < 12; ++i) first.take(windows.gram(), windows.score(values), kMeasurements);
  second.restore(first.state());
  EXPECT_EQ(second.log_statistic(), first.log_statistic());
  const Eigen::VectorXd score = windows.score(values);
  first.take(windows.gram(), score, kMeasurements);
  second.take(windows.gram(), score, kMeasurements);
  EXPECT_EQ(second.log_statistic(), first.log_statistic());
  EXPECT_EQ(second.windows(), 13U);
}

TEST(ChangeDetector, KeepsFewOnsets) {
  const Library library({});
  Windows windows(library);
  const Eigen::VectorXd values = windows.within_tolerance();
  ChangeDetector detector = detector_of(library, windows);
  for (int i = 0; i < 100; ++i) detector.take(windows.gram(), windows.score(values), kMeasurements);
  EXPECT_LE(detector.state().onsets.size(), 30U);
  EXPECT_EQ(detector.state().onsets.front().window, 0U);
}

TEST(ChangeDetector, RefusesAStateOfAnotherSize) {
  const Library library({});
  Windows windows(library);
  ChangeDetector detector = detector_of(library, windows);
  detector.take(windows.gram(), windows.score(windows.within_tolerance()), kMeasurements);
  ChangeDetector::State state = detector.state();
  state.score.conservativeResize(state.score.size() - 1);
  EXPECT_THROW(detector.restore(state), std::invalid_argument);
}

TEST(PowerDetector, RisesWithPowerAndNotBelowTheRiseThatItIsMadeFor) {
  const Eigen::VectorXd mean = Eigen::VectorXd::Ones(3), scatter = Eigen::VectorXd::Constant(3, 0.1);
  PowerDetector quiet(mean, scatter), loud(mean, scatter);
  Eigen::VectorXd power(3);
  for (int i = 0; i < 50; ++i) {
    power << 1.2, 1.1, std::nan("");
    quiet.take(power);
    power << 1, 1.6, 1;
    if (i < 5) loud.take(power);
  }
  EXPECT_LT(quiet.log_statistic(), 1);
  EXPECT_GT(loud.log_statistic(), 10);
  EXPECT_EQ(loud.loudest(), 1);
  loud.restart();
  EXPECT_LT(loud.log_statistic(), 0);
}

TEST(PowerDetector, LeavesOutAChannelThatNoNullMeasured) {
  PowerDetector detector(Eigen::VectorXd::Ones(1), Eigen::VectorXd::Zero(1));
  detector.take(Eigen::VectorXd::Constant(1, 100));
  EXPECT_LT(detector.log_statistic(), 0);
}

}  // namespace
}  // namespace navcal::gap
