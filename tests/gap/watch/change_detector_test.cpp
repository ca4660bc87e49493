// SPDX-License-Identifier: Apache-2.0
#include "gap/watch/change_detector.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>
#include <string>

#include "gap/inference/effect_subset.h"
#include "gap/inference/spike_and_slab.h"
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

/// Each effect of the library, at its place in it.
ChangeDetector detector_of(const Library& library, const Windows& windows) {
  std::vector<WatchedCause> causes;
  for (std::size_t effect = 0; effect < library.size(); ++effect) {
    WatchedCause cause{std::string(library[effect].name), parameter_indices(library, {effect}), {}};
    cause.typical = windows.priors().slab(cause.columns);
    causes.push_back(std::move(cause));
  }
  return {std::move(causes), windows.priors().spike.asDiagonal(), 1};
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
  EXPECT_EQ(detector.name(first), "hard_iron");
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

TEST(ChangeDetector, UnknownsThatDependOnEachOtherHideNoOtherChange) {
  // Only the sum of the first two is known; a change of the third is not in it.
  Eigen::MatrixXd covariance = Eigen::Vector3d(1, 1, 1e-4).asDiagonal();
  covariance(0, 1) = covariance(1, 0) = -0.999;
  const auto cause = [](std::string name, Eigen::Index column) {
    return WatchedCause{std::move(name), {column}, Eigen::VectorXd::Ones(1)};
  };
  ChangeDetector detector({cause("sum", 0), cause("third", 2)}, Eigen::MatrixXd(covariance.llt().matrixL()), 1);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(3, 3);
  gram << 400, 400, 0, 400, 400, 0, 0, 0, 400;
  for (int i = 0; i < 6; ++i) detector.take(gram, gram * Eigen::Vector3d(0.8, -0.8, i < 3 ? 0 : 1), kMeasurements);
  EXPECT_EQ(detector.name(detector.causes().front()), "third");
  EXPECT_EQ(detector.causes().front().onset, 3U);
  EXPECT_NEAR(detector.strength(detector.causes().front()), 1, 0.1);
  EXPECT_GT(detector.log_statistic(), 20);
}

TEST(ChangeDetector, ACauseThatWouldBeStrongerThanItCanIsNone) {
  WatchedCause weak{"weak", {0}, Eigen::VectorXd::Ones(1)};
  weak.most = 2;
  for (const double size : {1.5, 2.5}) {
    ChangeDetector detector({weak}, Eigen::MatrixXd::Constant(1, 1, 0.01), 1);
    const Eigen::MatrixXd gram = Eigen::MatrixXd::Constant(1, 1, 400);
    detector.take(gram, Eigen::VectorXd::Constant(1, 400 * size), kMeasurements);
    EXPECT_EQ(detector.log_statistic() > 20, size < weak.most);
  }
}

TEST(NominalPower, OnlyChannelsOfEnoughWindowsAreTested) {
  std::vector<Eigen::VectorXd> windows;
  for (int i = 0; i < 6; ++i) windows.emplace_back(Eigen::Vector3d(1 + 0.1 * i, i < 3 ? 1 : std::nan(""), 1));
  NominalPower power = nominal_power(windows, 2, 4, 0.1);
  EXPECT_NEAR(power.mean, 1.25, 1e-12);
  for (int i = 0; i < 5; ++i) power.detector.take(Eigen::Vector3d(1, 9, 9));
  EXPECT_LT(power.detector.log_statistic(), 0) << "the second has three windows, the third is not to be tested";
  power.detector.take(Eigen::Vector3d(9, 1, 1));
  EXPECT_GT(power.detector.log_statistic(), 5);
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
