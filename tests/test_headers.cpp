// SPDX-License-Identifier: Apache-2.0
// What is precompiled once for all tests.
#include <gtest/gtest.h>

#include <Eigen/Core>
