// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace navcal::instruments {

/// Whether an absolute pressure can be: from the highest mountain lake to the deepest sea. A gauge that measures
/// relative to the air says nearly zero at the surface, and is thus found out.
[[nodiscard]] constexpr bool is_possible_pressure(double pressure_Pa) {
  return pressure_Pa >= 30e3 && pressure_Pa <= 150e6;
}

}  // namespace navcal::instruments
