// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace navcal::reference {

/// y(t + h) of y' = slope(t, y) by the fifth-order formula of Dormand and Prince (J. Comp. Appl. Math. 6, 1980),
/// six slopes a step; what it leaves out is of the order h^6 a step. The step is the caller's: events (a new
/// command) lie on the ends of steps, and the same steps give the same bits.
template <class State, class Slope>
[[nodiscard]] State dormand_prince(double t, const State& y, double h, const Slope& slope) {
  const State k1 = slope(t, y);
  const State k2 = slope(t + h / 5, State(y + h * (1.0 / 5) * k1));
  const State k3 = slope(t + h * 3 / 10, State(y + h * (3.0 / 40 * k1 + 9.0 / 40 * k2)));
  const State k4 = slope(t + h * 4 / 5, State(y + h * (44.0 / 45 * k1 - 56.0 / 15 * k2 + 32.0 / 9 * k3)));
  const State k5 =
      slope(t + h * 8 / 9,
            State(y + h * (19372.0 / 6561 * k1 - 25360.0 / 2187 * k2 + 64448.0 / 6561 * k3 - 212.0 / 729 * k4)));
  const State k6 = slope(t + h, State(y + h * (9017.0 / 3168 * k1 - 355.0 / 33 * k2 + 46732.0 / 5247 * k3 +
                                               49.0 / 176 * k4 - 5103.0 / 18656 * k5)));
  return y + h * (35.0 / 384 * k1 + 500.0 / 1113 * k3 + 125.0 / 192 * k4 - 2187.0 / 6784 * k5 + 11.0 / 84 * k6);
}

}  // namespace navcal::reference
