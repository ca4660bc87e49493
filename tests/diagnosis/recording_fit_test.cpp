// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/recording_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/limits.h"
#include "diagnosis/nominal_bank.h"
#include "tests/diagnosis/micro_case.h"

namespace navcal::diagnosis {
namespace {

// A filter that expects other errors is more or less probable for that alone. Damping and mass change what it
// expects: nominal vehicles seemed to have another damping, with 30 nats.
TEST(RecordingFit, ItsValueFollowsItsScoreWhereGainsAreHeld) {
  const auto of = micro();
  const identify::RecordedMotion nominal = recording(of, of.prior, 3);
  const CauseLibrary library = causes_of(of.prior, nominal, {});
  FittedRecording fitted(of.prior, library, nominal, {}, 1);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(library.columns());
  ASSERT_TRUE(fitted.hold(none));
  const auto here = fitted.fit(none);
  ASSERT_TRUE(here);
  int tried = 0;
  for (const Cause& cause : library.causes) {
    if (cause.name != "damping" && cause.name != "added_mass") continue;
    Eigen::VectorXd apart = none;
    apart[cause.parameters[0].column] = cause.parameters[0].typical * cause.parameters[0].per_unit;
    const auto there = fitted.fit(apart);
    ASSERT_TRUE(there) << cause.words();
    const double by_line = here->linear.about(apart).value - here->linear.value;
    const double found = there->linear.about(apart).value - here->linear.value;
    EXPECT_NEAR(found, by_line, 1 + 0.3 * std::abs(by_line)) << cause.words();
    ++tried;
  }
  EXPECT_GE(tried, 8);
}

// Over 80 ms a delay was a secant whose sign was that of the other slope: each fit led away from the next one, and
// true causes lost their leads. The same of a lag that was fitted from its estimate back to zero.
TEST(RecordingFit, TheSlopesOfADelayAndOfALagAreThoseWhereTheyAre) {
  const auto of = micro();
  const identify::RecordedMotion slow = recording(of, changed(of.prior, "thruster_lag", "thruster.1", {0.3}), 3);
  const CauseLibrary library = causes_of(of.prior, slow, {});
  FittedRecording fitted(of.prior, library, slow, {}, 1);
  Eigen::VectorXd at = Eigen::VectorXd::Zero(library.columns());
  ASSERT_TRUE(fitted.hold(at));
  for (const Cause& cause : library.causes) {
    if (cause.words() == "thruster_lag of thruster.1") at[cause.parameters[0].column] = 0.25;
  }
  const auto here = fitted.fit(at);
  ASSERT_TRUE(here);
  int tried = 0;
  for (const Cause& cause : library.causes) {
    if (cause.name != "actuator_delay" && cause.words() != "thruster_lag of thruster.1") continue;
    const Eigen::Index column = cause.parameters[0].column;
    const double sigma = 1 / std::sqrt(here->linear.information(column, column));
    for (const double step : {-2 * sigma, 2 * sigma}) {
      Eigen::VectorXd apart = at;
      apart[column] += step;
      const auto there = fitted.fit(apart);
      ASSERT_TRUE(there) << cause.words();
      const double by_line = here->linear.about(apart).value - here->linear.about(at).value;
      const double found = there->linear.about(apart).value - here->linear.about(at).value;
      EXPECT_NEAR(found, by_line, 1 + 0.3 * std::abs(by_line)) << cause.words() << ", " << step;
      ++tried;
    }
  }
  EXPECT_EQ(tried, 4);
}

/// Departures of one column, told with this information by each recording.
TEST(JointPrior, RecordingsAverageOutWhatIsTheirsAndNotWhatTheyShare) {
  const ColumnScatter scatter{Eigen::VectorXd::Constant(1, 2), Eigen::VectorXd::Constant(1, 3)};
  const double information = 4;
  const Likelihood one{Eigen::MatrixXd::Constant(1, 1, information), Eigen::VectorXd::Constant(1, 5), -1, 0};
  for (const Eigen::Index count : {1, 2, 5}) {
    const std::vector<Likelihood> all(static_cast<std::size_t>(count), one);
    const Likelihood changes = prior_from({}, scatter, count).of_changes(side_by_side(all));
    const double own = count == 1 ? 9 : 9 * (1 - kSessionShare);
    EXPECT_NEAR(1 / changes.information(0, 0),
                4 + (9 - own) + (own + 1 / information) / static_cast<double>(count), 1e-9);
    EXPECT_NEAR(changes.score[0] / changes.information(0, 0), 5 / information, 1e-9);
  }
}

}  // namespace
}  // namespace navcal::diagnosis
