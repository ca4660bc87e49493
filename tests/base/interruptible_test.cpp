// SPDX-License-Identifier: Apache-2.0
#include "base/interruptible.h"

#include <gtest/gtest.h>

namespace navcal::base {
namespace {

TEST(Interruptible, EveryEndingSignalIsHeldBackOnceAndKeptAsAWish) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const Interruptible interruptible;
    EXPECT_FALSE(Interruptible::interrupted()) << signal;
    std::raise(signal);
    EXPECT_TRUE(Interruptible::interrupted()) << signal;
  }
  EXPECT_EQ(std::signal(SIGHUP, SIG_DFL), SIG_DFL) << "as before";
}

TEST(Interruptible, AProgramThatIsToOutliveItsTerminalDoes) {
  std::signal(SIGHUP, SIG_IGN);
  {
    const Interruptible interruptible;
    std::raise(SIGHUP);
    EXPECT_FALSE(Interruptible::interrupted());
  }
  EXPECT_EQ(std::signal(SIGHUP, SIG_DFL), SIG_IGN);
}

}  // namespace
}  // namespace navcal::base
