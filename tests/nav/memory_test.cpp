// SPDX-License-Identifier: Apache-2.0
// A reading costs no memory: a program of its own, for it counts every allocation.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "nav/navigator.h"
#include "tests/nav/drive.h"

namespace {
std::size_t allocations = 0;
}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace navcal::nav::test {
namespace {

TEST(NavigatorMemory, IsTakenOnceAndIsSmall) {
  const auto way = reference_way("path5");
  DriveOptions options;
  options.dvl.emplace().water = true;
  const auto readings = readings_along(way, 50, options);
  Navigator navigator({});
  const std::size_t before = allocations;
  for (const auto& arrived : readings) {
    give(navigator, arrived.reading);
    EXPECT_EQ(navigator.estimate().time_ns, navigator.time_ns());
  }
  EXPECT_EQ(allocations, before);
  EXPECT_LT(sizeof(Navigator), 9000U);
}

}  // namespace
}  // namespace navcal::nav::test
