// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "instruments/samples.h"

namespace navcal::instruments {

/// To the millimetre a second, the step of Teledyne's formats.
inline void expect_velocity(const std::optional<Vector3>& velocity_m_s, const Vector3& expected) {
  ASSERT_TRUE(velocity_m_s);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR((*velocity_m_s)[i], expected[i], 1.1e-3) << i;
}

}  // namespace navcal::instruments
