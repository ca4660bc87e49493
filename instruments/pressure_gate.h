// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace navcal::instruments {

/// Lets in the absolute pressures of one gauge: from the highest mountain lake to the deepest sea. A gauge that
/// measures relative to the air, or to air that is sealed in it, says nearly zero at the surface. After three such
/// readings in a row, which no damaged frame makes, it is not believed below the surface either.
class PressureGate {
 public:
  [[nodiscard]] bool lets_in(double pressure_Pa) {
    constexpr int kRelative = 3;
    if (lows_ < kRelative) lows_ = pressure_Pa < 30e3 ? lows_ + 1 : 0;
    return lows_ == 0 && pressure_Pa <= 150e6;
  }

 private:
  int lows_ = 0;
};

}  // namespace navcal::instruments
