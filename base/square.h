#pragma once

namespace navcal::base {

[[nodiscard]] constexpr double square(double x) { return x * x; }

}  // namespace navcal::base
