// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace navcal::analysis {

/// What drives each output, by the parameters of an autopilot: ArduPilot's SERVOn_FUNCTION, SERVOn_MIN,
/// SERVOn_MAX, SERVOn_REVERSED, and PX4's PWM_MAIN_FUNCn, PWM_MAIN_MINn, PWM_MAIN_MAXn. It helps to write a map.
class ServoParameters {
 public:
  /// A parameter; those of other names are ignored.
  void take(std::string_view name, double value);
  /// "outputs by the parameters of the vehicle: 1 motor 1 (1100 to 1900 us), 3 rudder"; empty: none is known.
  [[nodiscard]] std::string words() const;

 private:
  struct Output {
    std::string function;
    std::optional<double> least_us, most_us;
    bool is_reversed = false;
  };
  std::map<int, Output> outputs_;
};

}  // namespace navcal::analysis
