// SPDX-License-Identifier: Apache-2.0
#include "record/log/reused_buffer.h"

#include <gtest/gtest.h>

namespace navcal::record {
namespace {

/// Capacity that is left after a use of so many bytes.
std::size_t kept_of(std::size_t capacity, std::size_t used) {
  std::string buffer;
  buffer.reserve(capacity);
  buffer.assign(used, 'x');
  empty_for_reuse(buffer);
  EXPECT_TRUE(buffer.empty());
  return buffer.capacity();
}

TEST(ReusedBuffer, KeepsWhatIsUsedAndGivesTheRestBack) {
  EXPECT_GE(kept_of(100'000, 90'000), 100'000U);
  EXPECT_GE(kept_of(100'000, 26'000), 100'000U);
  EXPECT_LT(kept_of(100'000, 20'000), 1000U) << "one long message was in it before";
  EXPECT_GE(kept_of(10'000, 1), 10'000U) << "so little is not worth asking for again";
  EXPECT_LT(kept_of(1'000'000, 1'000'000), 1000U) << "a stall of the disk";
}

}  // namespace
}  // namespace navcal::record
