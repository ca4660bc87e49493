// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace navcal::base {

[[nodiscard]] constexpr double square(double x) { return x * x; }

}  // namespace navcal::base
