// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/recording_fit.h"

#include <gtest/gtest.h>

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
  fitted.hold_gains(none);
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

}  // namespace
}  // namespace navcal::diagnosis
