// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gap/nulls/null_bank.h"

namespace navcal::gap::test {

/// A bank of the right shapes that nobody simulated.
[[nodiscard]] NullBank made_up_bank(Eigen::Index unknowns);

}  // namespace navcal::gap::test
