// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace navcal::reference {

/// tau y' + y = x, exact for an input that runs straight between two calls; begins at its first input.
template <class Value>
class Lag {
 public:
  /// `after_s` since the last call; a lag of zero passes its input on.
  const Value& feed(double after_s, double tau_s, const Value& input) {
    if (!begun_ || tau_s <= 0) {
      output_ = input;
    } else if (after_s > 0) {
      const Value behind = (tau_s / after_s) * (input - input_);  // of a ramp, when settled
      output_ = input - behind + std::exp(-after_s / tau_s) * (output_ - input_ + behind);
    }
    input_ = input;
    begun_ = true;
    return output_;
  }
  [[nodiscard]] const Value& output() const { return output_; }

 private:
  Value input_{}, output_{};
  bool begun_ = false;
};

}  // namespace navcal::reference
