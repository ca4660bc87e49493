#pragma once

#include "gap/library.h"
#include "gap/null_bank.h"

namespace navcal::gap::test {

/// A bank of the right shapes that nobody simulated.
[[nodiscard]] NullBank made_up_bank(const Library& library);

}  // namespace navcal::gap::test
