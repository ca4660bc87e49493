// SPDX-License-Identifier: Apache-2.0
#include "base/spawn.h"

#include <gtest/gtest.h>

namespace navcal::base {
namespace {

TEST(Spawn, ACommandThatIsNotThereIsNoCrash) {
  EXPECT_EQ(run_command({"navcal-no-such-program"}).status, 127);
  EXPECT_EQ(run_command({"sh", "-c", "echo out; echo err >&2; exit 3"}).status, 3);
  EXPECT_EQ(run_command({"sh", "-c", "echo out; echo err >&2"}).out, "out\n");
  EXPECT_EQ(run_command({"sh", "-c", "echo out; echo err >&2"}).err, "err\n");
  EXPECT_EQ(run_command({"sh", "-c", "kill -9 $$"}).status, 128 + 9);
}

}  // namespace
}  // namespace navcal::base
