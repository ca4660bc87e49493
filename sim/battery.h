// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace navcal::sim {

/// A pack: an open-circuit voltage that follows from the charge, behind an internal resistance. Its charge is
/// never less than nothing, nor more than the capacity.
class Battery {
 public:
  struct Options {
    double capacity_Ah = 3.7;
    double charge_Ah = 3.7;  ///< at first
    double resistance_ohm = 0.2;
    double hotel_A = 0.5;  ///< drawn by everything but the motor
    /// Open circuit, at charges 0, 1/7, ... 1 of the capacity.
    std::array<double, 8> curve_V{18.0, 20.7, 21.5, 21.9, 22.5, 23.2, 24.1, 25.1};
  };
  explicit Battery(const Options& options);

  /// The motor drew this current for so long.
  void draw(double motor_A, double duration_s);
  [[nodiscard]] double charge_Ah() const { return charge_Ah_; }
  [[nodiscard]] double open_circuit_V() const;
  /// Current out of the pack and the voltage at its terminals while the motor draws this current.
  [[nodiscard]] double current_A(double motor_A) const { return motor_A + options_.hotel_A; }
  [[nodiscard]] double voltage_V(double motor_A) const;

 private:
  Options options_;
  double charge_Ah_;
};

}  // namespace navcal::sim
