// SPDX-License-Identifier: Apache-2.0
#include "record/read_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/record/memory_source.h"

namespace navcal::record {
namespace {

TEST(ReadWindow, PassesOverALongSourceInTheMemoryOfItsFirstChunk) {
  std::string bytes(3 << 20, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 31 / 7);
  ReadWindow window(std::make_unique<MemorySource>(bytes));
  std::uintptr_t lowest = std::numeric_limits<std::uintptr_t>::max(), highest = 0;
  constexpr std::size_t kStep = 1000;
  while (window.ensure(kStep)) {
    ASSERT_EQ(window.view().substr(0, kStep), std::string_view(bytes).substr(window.offset(), kStep));
    const auto place = reinterpret_cast<std::uintptr_t>(window.view().data());
    lowest = std::min(lowest, place);
    highest = std::max(highest, place);
    window.advance(kStep);
  }
  EXPECT_LT(highest - lowest, 512U << 10);
  EXPECT_EQ(window.view(), std::string_view(bytes).substr(window.offset()))
      << "the rest is shorter than asked for";
  EXPECT_EQ(window.view().size(), bytes.size() % kStep);
  window.advance(window.view().size());
  EXPECT_FALSE(window.more());
  EXPECT_EQ(window.offset(), bytes.size());
}

TEST(ReadWindow, WhatIsAskedForComesWhole) {
  std::string bytes(1 << 20, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 31 / 7);
  ReadWindow window(std::make_unique<MemorySource>(bytes));
  window.ensure(17);
  window.advance(17);
  EXPECT_TRUE(window.ensure(900'000));
  EXPECT_EQ(window.view().substr(0, 900'000), std::string_view(bytes).substr(17, 900'000));
  EXPECT_FALSE(window.ensure(bytes.size())) << "17 bytes are lacking";
}

}  // namespace
}  // namespace navcal::record
