// SPDX-License-Identifier: Apache-2.0
#include "gap/nulls/null_bayes_factors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <numeric>
#include <utility>

#include "gap/inference/biases.h"
#include "gap/inference/subset_evidence.h"
#include "tests/gap/simulated_mission.h"
#include "tests/support/temporary_folder.h"

namespace navcal::gap {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// A mission and its bank.
class AmongNulls : public testing::Test {
 protected:
  explicit AmongNulls(Mission mission)
      : mission_(std::move(mission)), replay_(mission_, vehicle_), at_(with_biases_found(replay_, library_, 2)) {
    (void)replay_.run(library_.model(at_), &course_);
    bank_ = make_null_bank(repeated(), library_, at_, {30, 1, 2}, [](double) {});
    priors_ = fit_spike_widths(library_, bank_.gram, bank_.scores);
    nominal_ = linearise({replay_, library_, bank_.whitening, 2}, at_);
  }
  [[nodiscard]] RepeatedMission repeated() const { return {replay_, course_, vehicle_}; }
  [[nodiscard]] EffectSubset named(std::string_view name) const {
    for (std::size_t e = 0; e < library_.size(); ++e) {
      if (library_[e].name == name) return {e};
    }
    return {};
  }
  [[nodiscard]] std::vector<double> gains(const EffectSubset& set) const {
    return null_bayes_factors(set, std::array{repeated()},
                              {{replay_, library_, bank_.whitening}, nominal_, priors_}, {12, 1, 2});
  }
  /// Gains of the bank's missions by the recorded mission's regressors.
  [[nodiscard]] std::vector<double> gains_by_recorded(const EffectSubset& set) const {
    std::vector<double> all;
    for (Eigen::Index i = 0; i < bank_.scores.cols(); ++i) {
      Linearised null;
      null.at = Eigen::VectorXd::Zero(at_.size());
      null.residual = Eigen::VectorXd::Zero(1);
      null.gram = bank_.gram;
      null.score = bank_.scores.col(i);
      const SubsetEvidence evidence({null, library_, priors_});
      all.push_back(evidence(set) - evidence({}));
    }
    return all;
  }

  const config::VehicleSettings vehicle_;
  const Library library_{{}};
  const Mission mission_;
  const Replay replay_;
  const Eigen::VectorXd at_;
  Trajectory10Hz course_;
  NullBank bank_;
  Priors priors_;
  Linearised nominal_;
};

/// Only holds its course.
class OnAStraightCourse : public AmongNulls {
 protected:
  OnAStraightCourse() : AmongNulls(sailed()) {}

 private:
  [[nodiscard]] static Mission sailed() {
    const navcal::test::TemporaryFolder folder;
    const auto file = folder / "straight.toml";
    std::ofstream(file) << "start.depth_m = 1\nstart.shaft_rpm = 780\n"
                           "step = [{do = \"leg\", heading_deg = 40, metres = 1000}]\n";
    return test::simulated_mission(file.string(), "", 300, 4);
  }
};

/// Turns sharply: a null's fins move otherwise between two reports.
class OnCorners : public AmongNulls {
 protected:
  OnCorners() : AmongNulls(test::simulated_mission("survey", "", 420, 4)) {}
};

// Gyros' dependence on force was found where a vehicle only held its course: its signature is made of the noise of
// the gyros themselves there.
TEST_F(OnAStraightCourse, NoiseInASignatureGainsMoreThanTheBankKnows) {
  const EffectSubset set = named("gyro_g_sensitivity");
  const auto own = gains(set);
  ASSERT_GE(own.size(), 10U);
  EXPECT_GT(mean(own), mean(gains_by_recorded(set)) + 1);
}

TEST_F(OnAStraightCourse, WhatIsSeenPlainlyGainsNothingAmongNulls) {
  const EffectSubset set = named("hard_iron");
  const auto own = gains(set);
  EXPECT_LT(*std::max_element(own.begin(), own.end()), 10);
  EXPECT_TRUE(stands_out(30, own));
  EXPECT_EQ(gains(set), own) << "the same seed, the same nulls";
}

// The recorded mission's regressors do not contain a null's own lag of the fins. With them two of sixteen nulls
// show a late card by 35 and 47 nats, and a real one of 10 ms with 44 would be dropped.
TEST_F(OnCorners, ALagOfTheFinsWithinToleranceIsNoLateCard) {
  const auto own = gains(named("imu_latency"));
  ASSERT_GE(own.size(), 10U);
  EXPECT_LT(*std::max_element(own.begin(), own.end()), 5);
}

}  // namespace
}  // namespace navcal::gap
